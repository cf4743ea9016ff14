/// Robot interface of the exploration task: a mobile robot with an RGB-D camera on its head.
#pragma once

#include <memory>
#include <vector>

#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/sensors/camera.hpp"
#include "vantage/tasks/mapping/mobile_robot_interface.hpp"

namespace vantage {

struct DepthImage {
  CameraImages image;  ///< depth alone
  Pose T_base_camera;  ///< OpenCV's axes
};

/// What the robot observes with one sweep, standing still.
struct OfficeObservation {
  std::vector<DepthImage> views;
  PlanarScan base_scan;             ///< planar scanner near the floor
  double base_scan_height_m = 0.0;  ///< of that scanner above the floor
  Pose2 T_world_base_odometry;      ///< dead reckoning since the last correction
};

class ExplorationRobotInterface : public MobileRobotInterface {
 public:
  /// @throws ConfigError, InputError if the episode cannot begin, see start_check.hpp
  explicit ExplorationRobotInterface(const ResolvedEpisode& resolved);

  /// Turns the head all round while the base stands. @throws Interrupted, RendererError
  OfficeObservation observe();
  /// Where a sweep is taken from: on the head's pan axis, x along the base's.
  [[nodiscard]] const Pose& T_base_sweep() const { return T_base_sweep_; }
  [[nodiscard]] Pose estimated_sweep() const { return to_se3(estimated_base()) * T_base_sweep_; }
  [[nodiscard]] Pose2 base_for_sweep(const Pose& T_world_sweep) const;
  [[nodiscard]] const FieldOfView& view_field() const { return field_; }

 private:
  void turn_head(double pan_rad, double tilt_rad);
  DepthImage take_image();

  Pose T_base_sweep_;
  FieldOfView field_;
  std::unique_ptr<Renderer> renderer_;
  Rng camera_noise_;
};

}  // namespace vantage
