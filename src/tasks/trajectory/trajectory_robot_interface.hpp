/// Robot interface of a quadrotor that follows plans which change in flight and takes images at a
/// fixed rate.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "vantage/control/minimum_jerk_trajectory.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

/// An image taken in flight.
struct FlightImage {
  double time_s = 0.0;  ///< simulated
  bool arrived = true;  ///< false: the image was taken, and lost
  CameraImages depth;   ///< measured depth, neither colour nor truth
  Pose T_world_camera;  ///< as estimated, OpenCV's axes
  /// The same image with its colour. A camera gives both at once; it is drawn when asked for, and
  /// only before the flight goes on. Noise of colour has a stream of its own, so that asking
  /// changes nothing else.
  std::function<CameraImages()> with_colour;
};
using ImageCallback = std::function<void(const FlightImage&)>;

class TrajectoryRobotInterface {
 public:
  TrajectoryRobotInterface() = default;
  TrajectoryRobotInterface(const TrajectoryRobotInterface&) = delete;
  TrajectoryRobotInterface& operator=(const TrajectoryRobotInterface&) = delete;
  virtual ~TrajectoryRobotInterface() = default;

  [[nodiscard]] virtual double time_s() const = 0;  ///< simulated
  /// From now on through these waypoints, from the reference as it is, and to rest at the last.
  virtual void follow(std::span<const FlightWaypoint> waypoints) = 0;
  /// Flies on for that long. @throws EpisodeFailed at the first contact, Interrupted
  virtual void fly_for(double duration_s, const ImageCallback& on_image) = 0;
  /// Until the next waypoint of the plan is reached, or that many after it.
  virtual void fly_past(int waypoints, const ImageCallback& on_image) = 0;
  /// What `follow` leads through these waypoints in so long, flying on as now until then.
  [[nodiscard]] virtual MinimumJerkTrajectory path_in(
      double delay_s, std::span<const FlightWaypoint> waypoints) const = 0;
  /// What is left in so long of the path that is flown; nothing with fewer than 3 waypoints left.
  [[nodiscard]] virtual std::optional<MinimumJerkTrajectory> path_on(double delay_s) const = 0;
  /// Waypoints of the plan that the reference has passed, or will have in so long.
  [[nodiscard]] virtual int passed(double in_s) const = 0;
  [[nodiscard]] int passed() const { return passed(0.0); }
  /// Takes an image now.
  virtual void capture_now(const ImageCallback& on_image) = 0;

  [[nodiscard]] virtual Pose estimated_body() const = 0;
  [[nodiscard]] virtual Pose T_body_camera() const = 0;
};

}  // namespace vantage
