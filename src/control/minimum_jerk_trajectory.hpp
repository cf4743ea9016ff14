/// Minimum-jerk trajectories through waypoints: position, velocity, acceleration and heading at any
/// time.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/control/flight_controller.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

struct FlightWaypoint {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
};

struct FlightLimits {
  double speed_m_s = 1.0;
  double acceleration_m_s2 = 2.0;
  double yaw_rate_rad_s = 1.0;
  void fields(auto&& f) {
    f("speed_m_s", speed_m_s, "greatest speed of a trajectory; higher is faster and blurs images",
      Range{0.0, 5.0, true});
    f("acceleration_m_s2", acceleration_m_s2,
      "greatest acceleration of a trajectory; higher is faster and tilts the vehicle more (11 deg "
      "at 2 m/s^2)",
      Range{0.0, 5.0, true});
    f("yaw_rate_rad_s", yaw_rate_rad_s,
      "greatest yaw rate of a trajectory; higher turns faster and blurs images",
      Range{0.0, 4.0, true});
  }
};

/// The minimum-jerk trajectory through waypoints: a quintic spline, continuous up to the fourth
/// derivative, at rest at the last waypoint. Headings turn the short way from each to the next.
class MinimumJerkTrajectory {
 public:
  /// From `start` (position, velocity, acceleration, heading and its rate) through at least one
  /// waypoint. Times between waypoints follow from a trapezoid of speed along the polyline, then
  /// are stretched together until the limits hold. A start beyond the limits, or one that moves
  /// away from the first waypoint, may be out of reach of stretching: the limits are then
  /// overstepped as little as was found.
  /// @throws ConfigError if a limit is out of range.
  MinimumJerkTrajectory(const FlightReference& start, std::span<const FlightWaypoint> waypoints,
                        const FlightLimits& limits = {});

  [[nodiscard]] double duration_s() const { return knot_s_.back(); }
  /// Times of the waypoints, the start at 0 first.
  [[nodiscard]] const std::vector<double>& knots_s() const { return knot_s_; }
  /// The start before 0, at rest at the last waypoint after the end.
  [[nodiscard]] FlightReference at(double time_s) const;
  /// What is left of it from then on, its time 0; before the end.
  [[nodiscard]] MinimumJerkTrajectory from(double time_s) const;
  [[nodiscard]] FlightWaypoint goal() const;

  /// Value and derivatives of (x, y, z, yaw) at a knot.
  struct Knot {
    Eigen::Vector4d p = Eigen::Vector4d::Zero();
    Eigen::Vector4d v = Eigen::Vector4d::Zero();
    Eigen::Vector4d a = Eigen::Vector4d::Zero();
  };

 private:
  MinimumJerkTrajectory() = default;
  /// Between two knots.
  struct Segment {
    std::size_t to = 1;  ///< the later one
    double duration_s = 0.0;
    double t = 0.0;  ///< of it that has passed, a share
  };
  [[nodiscard]] Segment segment_at(double time_s) const;
  /// How many times over the limits it is at its worst, as a factor of time.
  [[nodiscard]] double stretch_needed(const FlightLimits& limits) const;

  std::vector<double> knot_s_;
  std::vector<Knot> knots_;
};

}  // namespace vantage
