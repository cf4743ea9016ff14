/// Robot interface of a quadrotor that flies to places round a table and takes images there.
#pragma once

#include <span>
#include <vector>

#include "vantage/control/tracking_options.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

/// What the robot observes with one image.
struct FlightObservation {
  bool arrived = true;  ///< false: the image was taken, and lost
  CameraImages images;  ///< colour and depth
  Pose T_world_camera;  ///< as estimated, OpenCV's axes
};

/// A flight before it is flown.
struct FlightPlan {
  std::vector<FlightWaypoint> waypoints;
  double duration_s = 0.0;
  double path_m = 0.0;
  double energy_j = 0.0;  ///< induced power of hovering, for that long
};

class OrbitRobotInterface {
 public:
  OrbitRobotInterface() = default;
  OrbitRobotInterface(const OrbitRobotInterface&) = delete;
  OrbitRobotInterface& operator=(const OrbitRobotInterface&) = delete;
  virtual ~OrbitRobotInterface() = default;

  [[nodiscard]] virtual double time_s() const = 0;  ///< simulated
  /// Comes to rest and takes an image.
  /// @throws Interrupted, RendererError, EpisodeFailed if it touches anything
  virtual FlightObservation observe() = 0;
  /// The camera through places, to rest at the last; at least one, see Orbit::place().
  /// @throws Interrupted, EpisodeFailed if it touches anything
  virtual FlightResult fly_along(std::span<const Pose> T_world_places) = 0;
  [[nodiscard]] virtual FlightPlan plan(std::span<const Pose> T_world_places) const = 0;
  /// Round the first object.
  [[nodiscard]] virtual double start_bearing_rad() const = 0;
  [[nodiscard]] virtual Pose estimated_body() const = 0;
};

}  // namespace vantage
