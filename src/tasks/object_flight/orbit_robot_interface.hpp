/// Robot interface of a quadrotor that flies to bearings round the table's centre and takes images
/// there.
#pragma once

#include <vector>

#include "vantage/control/tracking_options.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

/// What the robot observes with one image.
struct FlightObservation {
  CameraImages images;       ///< colour and depth
  Pose T_world_camera;       ///< as estimated, OpenCV's axes
  double bearing_rad = 0.0;  ///< where it was meant to be taken from
};

/// A flight to a bearing before it is flown.
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
  /// Along the circle, the short way. @throws Interrupted, EpisodeFailed if it touches anything
  virtual FlightResult fly_to(double bearing_rad) = 0;
  [[nodiscard]] virtual FlightPlan plan(double bearing_rad) const = 0;
  [[nodiscard]] virtual double start_bearing_rad() const = 0;
  [[nodiscard]] virtual double bearing_rad() const = 0;  ///< flown to last
  [[nodiscard]] virtual Pose estimated_body() const = 0;
};

}  // namespace vantage
