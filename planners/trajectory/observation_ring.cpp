#include "vantage/planners/trajectory/observation_ring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kSame_m = 1e-6;  ///< rounding does not decide
constexpr double kStep_rad = 2.0 * std::numbers::pi / kObservationDirections;

}  // namespace

Eigen::Vector3d ObservationRing::view_m(int direction) const {
  const double bearing = first_bearing_rad + direction * kStep_rad;
  return {p_world_object_m.x() + radius_m * std::cos(bearing),
          p_world_object_m.y() + radius_m * std::sin(bearing), height_m};
}

int ObservationRing::direction_of(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d from_object = p_world - p_world_object_m;
  const double bearing = std::atan2(from_object.y(), from_object.x()) - first_bearing_rad;
  const int direction = static_cast<int>(std::lround(bearing / kStep_rad)) % kObservationDirections;
  return direction < 0 ? direction + kObservationDirections : direction;
}

void leave_out_blocked(ObservedObject& object, const Esdf& surface, double clearance_m) {
  for (int d = 0; d < kObservationDirections; ++d) {
    bool& used = object.used[static_cast<std::size_t>(d)];
    used = used || surface.distance_m(object.ring.view_m(d)) < clearance_m;
  }
}

std::optional<std::size_t> active_object(std::span<const ObservedObject> objects,
                                         const Eigen::Vector3d& p_world_vehicle_m, double tau_nats,
                                         double range_m) {
  std::optional<std::size_t> nearest;
  double min_m = range_m;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObservedObject& object = objects[i];
    if (object.entropy_nats < tau_nats || std::ranges::count(object.used, false) == 0) continue;
    const double away_m = (object.ring.p_world_object_m - p_world_vehicle_m).head<2>().norm();
    if (nearest ? away_m < min_m : away_m <= min_m) {
      nearest = i;
      min_m = away_m;
    }
  }
  return nearest;
}

std::optional<int> active_direction(const ObservedObject& object,
                                    const Eigen::Matrix4Xd& remaining) {
  std::optional<int> nearest;
  OnPath least;
  for (int d = 0; d < kObservationDirections; ++d) {
    if (object.used[static_cast<std::size_t>(d)]) continue;
    const OnPath here = nearest_on_path(remaining, object.ring.view_m(d));
    const double farther_m = here.distance_m - least.distance_m;
    const bool sooner = farther_m < -kSame_m || (farther_m < kSame_m && here.at < least.at);
    if (nearest && !sooner) continue;
    nearest = d;
    least = here;
  }
  return nearest;
}

std::optional<ObservationTarget> observation_target(std::span<const ObservedObject> objects,
                                                    const Eigen::Vector3d& p_world_vehicle_m,
                                                    const Eigen::Matrix4Xd& remaining,
                                                    double tau_nats, double range_m) {
  const auto active = active_object(objects, p_world_vehicle_m, tau_nats, range_m);
  if (!active) return std::nullopt;
  const ObservedObject& object = objects[*active];
  const auto direction = active_direction(object, remaining);
  expects(direction.has_value(), "an active object has directions left");
  return ObservationTarget{.p_world_object_m = object.ring.p_world_object_m,
                           .p_world_view_m = object.ring.view_m(*direction),
                           .entropy_nats = object.entropy_nats};
}

OnPath nearest_on_path(const Eigen::Matrix4Xd& waypoints, const Eigen::Vector3d& p_world) {
  expects(waypoints.cols() > 0, "a path has waypoints");
  OnPath nearest{.distance_m = (waypoints.col(0).head<3>() - p_world).norm(), .at = 0.0};
  for (Eigen::Index i = 0; i + 1 < waypoints.cols(); ++i) {
    const Eigen::Vector3d from = waypoints.col(i).head<3>();
    const Eigen::Vector3d along = waypoints.col(i + 1).head<3>() - from;
    const double length2 = along.squaredNorm();
    const double share =
        length2 > 0.0 ? std::clamp(along.dot(p_world - from) / length2, 0.0, 1.0) : 0.0;
    const double away_m = (from + share * along - p_world).norm();
    if (away_m < nearest.distance_m) nearest = {away_m, static_cast<double>(i) + share};
  }
  return nearest;
}

Eigen::Matrix4Xd levelled(const Eigen::Matrix4Xd& waypoints) {
  Eigen::Matrix4Xd level = waypoints;
  level.row(2).setZero();
  return level;
}

Eigen::Vector3d levelled(const Eigen::Vector3d& p_world) { return {p_world.x(), p_world.y(), 0.0}; }

}  // namespace vantage
