#include "vantage/tasks/trajectory/flight_layout.hpp"

#include "vantage/core/error.hpp"
#include "vantage/planners/views/view_list.hpp"

namespace vantage {

FlightLayout read_flight_layout(const std::filesystem::path& scene) {
  const std::filesystem::path folder = scene.parent_path();
  FlightLayout layout;
  for (const Candidate& place : read_views(folder / "path.csv")) {
    layout.path.push_back({place.T_world_sensor.translation(), yaw_of(place)});
  }
  if (layout.path.size() < 2) {
    throw InputError((folder / "path.csv").string() + ": a path has two waypoints or more");
  }
  for (const Candidate& support_surface : read_views(folder / "stands.csv")) {
    layout.supports_m.emplace_back(support_surface.T_world_sensor.translation());
  }
  return layout;
}

Eigen::AlignedBox3d flight_region(std::span<const FlightWaypoint> path, double margin_m,
                                  double headroom_m) {
  expects(!path.empty(), "a flight has a waypoint");
  Eigen::AlignedBox3d region;
  for (const FlightWaypoint& waypoint : path) region.extend(waypoint.p_world_m);
  region.min() -= Eigen::Vector3d::Constant(margin_m);
  region.max() += Eigen::Vector3d::Constant(margin_m);
  region.max().z() += headroom_m - margin_m;
  region.min().z() = 0.0;
  return region;
}

}  // namespace vantage
