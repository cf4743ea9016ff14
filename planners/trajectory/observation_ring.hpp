/// From where an object is looked at, and which object and direction come next.
#pragma once

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "vantage/planners/trajectory/flight_cost.hpp"

namespace vantage {

inline constexpr int kObservationDirections = 8;

constexpr std::array<double, kObservationDirections> every_direction(double value) {
  std::array<double, kObservationDirections> values{};
  values.fill(value);
  return values;
}

/// Places round an object at the height flown, 45 deg apart.  [Potthast2016, 5.2.3]
struct ObservationRing {
  Eigen::Vector3d p_world_object_m = Eigen::Vector3d::Zero();
  double radius_m = 1.3;           ///< level, from the object's axis
  double height_m = 1.0;           ///< world z of the places
  double first_bearing_rad = 0.0;  ///< from the object to direction 0; they go counter-clockwise

  [[nodiscard]] Eigen::Vector3d view_m(int direction) const;
  /// The direction that a place falls into, by its bearing alone.
  [[nodiscard]] int direction_of(const Eigen::Vector3d& p_world) const;
};

/// An object that was detected.
struct ObservedObject {
  ObservationRing ring;
  std::array<bool, kObservationDirections> used{};  ///< seen from there, or out of reach
  double entropy_nats = std::numeric_limits<double>::infinity();  ///< of what it may be
  /// Expected information of an observation from each direction.
  std::array<double, kObservationDirections> gain_nats =
      every_direction(std::numeric_limits<double>::infinity());
};

/// Marks directions as used whose place is nearer than `clearance_m` to a surface.
void leave_out_blocked(ObservedObject& object, const Esdf& surface, double clearance_m);

/// The nearest object, level, that is not yet known (H >= tau) and has directions left; none
/// farther away than `range_m`.
std::optional<std::size_t> active_object(std::span<const ObservedObject> objects,
                                         const Eigen::Vector3d& p_world_vehicle_m, double tau_nats,
                                         double range_m = std::numeric_limits<double>::infinity());

/// The unused direction whose place is nearest the remaining path; of equal ones that which comes
/// first along it.
std::optional<int> active_direction(const ObservedObject& object,
                                    const Eigen::Matrix4Xd& remaining);

/// What the next waypoints should look at and from where: both of the above.
/// @param remaining waypoints from the vehicle on, at least one
std::optional<ObservationTarget> observation_target(
    std::span<const ObservedObject> objects, const Eigen::Vector3d& p_world_vehicle_m,
    const Eigen::Matrix4Xd& remaining, double tau_nats,
    double range_m = std::numeric_limits<double>::infinity());

/// The place on a polyline that is nearest a point.
struct OnPath {
  double distance_m = 0.0;
  double at = 0.0;  ///< index of the waypoint before and the share of the way to the next
};
OnPath nearest_on_path(const Eigen::Matrix4Xd& waypoints, const Eigen::Vector3d& p_world);

/// At z = 0: how far aside of a path a place is, whatever the heights, is the distance of these.
Eigen::Matrix4Xd levelled(const Eigen::Matrix4Xd& waypoints);
Eigen::Vector3d levelled(const Eigen::Vector3d& p_world);

}  // namespace vantage
