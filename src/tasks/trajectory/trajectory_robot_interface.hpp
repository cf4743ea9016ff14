/// Robot interface of a quadrotor that follows plans which change in flight and takes images at a
/// fixed rate. Ground truth stays behind `truth()`, which metrics alone may call.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/sim/render/renderer.hpp"
#include "vantage/tasks/scenario.hpp"
#include "vantage/tasks/trajectory/true_clearance.hpp"

namespace vantage {

/// An image taken in flight.
struct FlightImage {
  double time_s = 0.0;  ///< simulated
  CameraImages depth;   ///< measured depth, neither colour nor truth
  Pose T_world_camera;  ///< as estimated, OpenCV's axes
  /// The same image with its colour. A camera gives both at once; it is drawn when asked for, and
  /// only before the flight goes on. Noise of colour has a stream of its own, so that asking
  /// changes nothing else.
  std::function<CameraImages()> with_colour;
};
using ImageCallback = std::function<void(const FlightImage&)>;

struct TrajectoryTruth {
  int collisions = 0;
  double minimum_clearance_m = 0.0;  ///< so far, body surface to anything
  double tracking_error_mean_m = 0.0;
  double tracking_error_max_m = 0.0;
  double energy_j = 0.0;  ///< induced power of the rotors, integrated
  double flown_m = 0.0;
};

class TrajectoryRobotInterface {
 public:
  /// Hovers where `start` is.
  /// @throws ConfigError or InputError if the episode cannot begin, RendererError
  TrajectoryRobotInterface(const ResolvedEpisode& resolved, const FlightWaypoint& start);
  TrajectoryRobotInterface(const TrajectoryRobotInterface&) = delete;
  TrajectoryRobotInterface& operator=(const TrajectoryRobotInterface&) = delete;

  /// From now on through these waypoints, from the reference as it is, and to rest at the last.
  void follow(std::span<const FlightWaypoint> waypoints);
  /// Flies on for that long. @throws EpisodeFailed at the first contact, Interrupted
  void fly_for(double duration_s, const ImageCallback& on_image);
  /// Until the next waypoint of the plan is reached, or that many after it.
  void fly_past(int waypoints, const ImageCallback& on_image);
  /// What `follow` leads through these waypoints in so long, flying on as now until then.
  [[nodiscard]] MinimumJerkTrajectory path_in(double delay_s,
                                              std::span<const FlightWaypoint> waypoints) const;
  /// What is left in so long of the path that is flown; nothing with fewer than 3 waypoints left.
  [[nodiscard]] std::optional<MinimumJerkTrajectory> path_on(double delay_s) const;
  /// Waypoints of the plan that the reference has passed, or will have in so long.
  [[nodiscard]] int passed(double in_s = 0.0) const;
  /// Takes an image now.
  void capture_now(const ImageCallback& on_image);

  [[nodiscard]] Pose estimated_body() const { return tracking_.estimate().T_world_body; }
  [[nodiscard]] Pose T_body_camera() const;

  [[nodiscard]] TrajectoryTruth truth() const;
  [[nodiscard]] Pose true_body() const { return vehicle_.state(world_).T_world_body; }
  World& world() { return world_; }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] int camera_id() const { return vehicle_.camera_id(); }

 private:
  void tick();
  [[nodiscard]] std::string touched() const;
  [[nodiscard]] CameraImages colour_image();

  TrajectoryTask task_;
  World world_;
  Quadrotor vehicle_;
  TrajectoryTrackingController tracking_;
  TrueClearance clearance_;
  std::unique_ptr<Renderer> renderer_;
  Rng depth_noise_;
  Rng colour_noise_;
  std::optional<MinimumJerkTrajectory> path_;
  double path_start_s_ = 0.0;
  double next_image_s_ = 0.0;
  double next_clearance_s_ = 0.0;
  double flown_s_ = 0.0;
  double error_m_s_ = 0.0;
  double error_max_m_ = 0.0;
  double energy_j_ = 0.0;
  double flown_m_ = 0.0;
};

}  // namespace vantage
