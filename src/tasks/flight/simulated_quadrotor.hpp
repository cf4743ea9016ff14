/// The simulation of a quadrotor with a camera: what all flying tasks share of it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "vantage/geometry/range_scan.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/sim/faults/robot_faults.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/robots/trajectory_tracking_controller.hpp"
#include "vantage/sim/sensors/camera_options.hpp"

namespace vantage {

struct FlightCameraOptions {
  RgbdOptions camera;
  ExposureOptions exposure;
  double colour_noise = 0.0;  ///< standard deviation of a colour value, of 255
};

class SimulatedQuadrotor {
 public:
  /// @param place puts the vehicle where the episode begins
  /// @throws ConfigError or InputError if it cannot begin, RendererError
  SimulatedQuadrotor(const EpisodeOptions& episode, const ModelSource& source,
                     const TrajectoryTrackingOptions& tracking, const FlightCameraOptions& camera,
                     const std::function<Quadrotor(World&)>& place);
  SimulatedQuadrotor(const SimulatedQuadrotor&) = delete;
  SimulatedQuadrotor& operator=(const SimulatedQuadrotor&) = delete;

  /// Depth as measured, without colour.
  CameraImages depth_image(Rng& rng);
  /// Colour with the blur and the noise of an exposure that ends now, and measured depth. In the
  /// dark there is nothing but the noise.
  CameraImages colour_image(Rng& rng);

  [[nodiscard]] Pose estimated_body() const { return tracking_.estimate().T_world_body; }
  [[nodiscard]] Pose T_body_camera() const;

  // Truth:
  [[nodiscard]] Pose true_body() const { return vehicle_.state(world_).T_world_body; }
  [[nodiscard]] int collisions() const { return tracking_.collisions(); }
  [[nodiscard]] std::string touched() const;  ///< names of what it touches

  [[nodiscard]] RobotFaults& faults() { return faults_; }
  TrajectoryTrackingController& tracking() { return tracking_; }
  [[nodiscard]] const TrajectoryTrackingController& tracking() const { return tracking_; }
  [[nodiscard]] const Quadrotor& vehicle() const { return vehicle_; }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  FlightCameraOptions options_;
  World world_;
  Quadrotor vehicle_;
  TrajectoryTrackingController tracking_;
  std::unique_ptr<Renderer> renderer_;
  RobotFaults faults_;
};

}  // namespace vantage
