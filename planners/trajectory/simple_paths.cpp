#include "planners/trajectory/simple_paths.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "planners/trajectory/path_spline.hpp"
#include "src/core/error.hpp"

namespace vantage {
namespace {

constexpr int kSamples = 64;  ///< of a segment, for its length

double heading_rad(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

/// Unused views, at most `count`, nearest the path; in its order.
std::vector<Eigen::Vector3d> views_by_the_path(const ObservedObject& object,
                                               const Eigen::Matrix4Xd& waypoints, int count) {
  std::vector<std::pair<OnPath, Eigen::Vector3d>> views;
  for (int d = 0; d < kObservationDirections; ++d) {
    if (object.used[static_cast<std::size_t>(d)]) continue;
    const Eigen::Vector3d view = object.ring.view_m(d);
    views.emplace_back(nearest_on_path(waypoints, view), view);
  }
  std::ranges::stable_sort(views, {}, [](const auto& v) { return v.first.distance_m; });
  views.resize(std::min(views.size(), static_cast<std::size_t>(count)));
  std::ranges::stable_sort(views, {}, [](const auto& v) { return v.first.at; });
  std::vector<Eigen::Vector3d> places;
  for (const auto& [on_path, view] : views) places.push_back(view);
  return places;
}

/// `count` places evenly along a spline, both ends among them.
std::vector<Eigen::Vector3d> evenly_along(const PathSpline& spline, Eigen::Index count) {
  std::vector<Eigen::Vector3d> fine{spline.at(0, 0.0)};
  std::vector<double> length_m{0.0};
  for (std::size_t segment = 0; segment < spline.segments(); ++segment) {
    for (int k = 1; k <= kSamples; ++k) {
      const Eigen::Vector3d place = spline.at(segment, k / double{kSamples});
      length_m.push_back(length_m.back() + (place - fine.back()).norm());
      fine.push_back(place);
    }
  }
  std::vector<Eigen::Vector3d> places;
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double wanted = length_m.back() * static_cast<double>(i) / static_cast<double>(count - 1);
    while (k + 2 < fine.size() && length_m[k + 1] < wanted) ++k;
    const double step = length_m[k + 1] - length_m[k];
    const double share = step > 0.0 ? std::min((wanted - length_m[k]) / step, 1.0) : 0.0;
    places.emplace_back(fine[k] + share * (fine[k + 1] - fine[k]));
  }
  return places;
}

}  // namespace

Eigen::Matrix4Xd initial_yaw(const Eigen::Matrix4Xd& waypoints,
                             std::span<const ObservedObject> objects, const YawToTarget& options) {
  Eigen::Matrix4Xd turned = waypoints;
  for (auto waypoint : turned.colwise()) {
    const ObservedObject* nearest = nullptr;
    double least_m = options.range_m;
    for (const ObservedObject& object : objects) {
      if (object.entropy_nats < options.tau_nats) continue;
      const double away_m = (object.ring.p_world_object_m - waypoint.head<3>()).head<2>().norm();
      if (away_m > least_m) continue;
      nearest = &object;
      least_m = away_m;
    }
    if (nearest == nullptr) continue;
    waypoint[3] = heading_rad(waypoint.head<3>(), nearest->ring.p_world_object_m);
  }
  return turned;
}

Eigen::Matrix4Xd greedy_detour(const Horizon& horizon, std::span<const ObservedObject> objects,
                               const GreedyDetour& options) {
  expects(horizon.count() >= 2, "a horizon has a first and a last point");
  const Eigen::Index last = horizon.count() - 1;
  const auto active =
      active_object(objects, horizon.points.col(0).head<3>(), options.tau_nats, options.range_m);
  if (!active) return horizon.points;
  const ObservedObject& object = objects[*active];
  std::vector<Eigen::Vector3d> places{horizon.before.head<3>(), horizon.points.col(0).head<3>()};
  for (const Eigen::Vector3d& view : views_by_the_path(object, horizon.points, options.views)) {
    places.push_back(view);
  }
  places.emplace_back(horizon.points.col(last).head<3>());
  places.emplace_back(horizon.after.head<3>());
  const auto along = evenly_along(PathSpline(places), horizon.count());
  Eigen::Matrix4Xd detour = horizon.points;
  for (Eigen::Index i = 1; i < last; ++i) {
    const Eigen::Vector3d& place = along[static_cast<std::size_t>(i)];
    detour.col(i) << place, heading_rad(place, object.ring.p_world_object_m);
  }
  return detour;
}

}  // namespace vantage
