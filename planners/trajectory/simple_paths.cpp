#include "vantage/planners/trajectory/simple_paths.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

double heading_rad(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

struct ViewByThePath {
  OnPath on_path;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
};

/// Unused views that the path comes by, at most `count`, nearest it; in its order. What is behind
/// its first point was passed, what is beyond its last comes later.
std::vector<ViewByThePath> views_by_the_path(const ObservedObject& object,
                                             const Eigen::Matrix4Xd& waypoints, int count) {
  const auto end = static_cast<double>(waypoints.cols() - 1);
  std::vector<ViewByThePath> views;
  for (int d = 0; d < kObservationDirections; ++d) {
    if (object.used[static_cast<std::size_t>(d)]) continue;
    const Eigen::Vector3d view_m = object.ring.view_m(d);
    const OnPath on_path = nearest_on_path(waypoints, view_m);
    if (on_path.at > 0.0 && on_path.at < end) views.push_back({on_path, view_m});
  }
  std::ranges::stable_sort(views, {}, [](const auto& view) { return view.on_path.distance_m; });
  views.resize(std::min(views.size(), static_cast<std::size_t>(count)));
  std::ranges::stable_sort(views, {}, [](const auto& view) { return view.on_path.at; });
  return views;
}

}  // namespace

Eigen::Matrix4Xd initial_yaw(const Eigen::Matrix4Xd& waypoints,
                             std::span<const ObservedObject> objects, const YawToTarget& options) {
  Eigen::Matrix4Xd turned = waypoints;
  for (auto waypoint : turned.colwise()) {
    const ObservedObject* nearest = nullptr;
    double min_m = options.range_m;
    for (const ObservedObject& object : objects) {
      if (object.entropy_nats < options.tau_nats) continue;
      const double away_m = (object.ring.p_world_object_m - waypoint.head<3>()).head<2>().norm();
      if (away_m > min_m) continue;
      nearest = &object;
      min_m = away_m;
    }
    if (nearest == nullptr) continue;
    waypoint[3] = heading_rad(waypoint.head<3>(), nearest->ring.p_world_object_m);
  }
  return turned;
}

Eigen::Matrix4Xd greedy_detour(const Horizon& horizon, std::span<const ObservedObject> objects,
                               const GreedyDetour& options) {
  Eigen::Matrix4Xd detour = horizon.points;
  const auto active =
      active_object(objects, horizon.points.col(0).head<3>(), options.tau_nats, options.range_m);
  const auto views = active ? views_by_the_path(objects[*active], horizon.points, options.views)
                            : std::vector<ViewByThePath>();
  Eigen::Index free = 1;
  for (const ViewByThePath& view : views) {
    const Eigen::Index point = std::max(free, std::lround(view.on_path.at));
    if (point + 1 >= horizon.count()) break;
    detour.col(point).head<3>() = view.place_m;
    free = point + 1;
  }
  return initial_yaw(detour, objects, {.tau_nats = options.tau_nats, .range_m = options.range_m});
}

}  // namespace vantage
