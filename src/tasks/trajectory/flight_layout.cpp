#include "vantage/tasks/trajectory/flight_layout.hpp"

#include "vantage/core/error.hpp"
#include "vantage/planners/views/view_list.hpp"

namespace vantage {

std::vector<FlightWaypoint> read_flight_path(const std::filesystem::path& scene) {
  const std::filesystem::path file = scene.parent_path() / "path.csv";
  std::vector<FlightWaypoint> path;
  for (const Candidate& place : read_views(file)) {
    path.push_back({place.T_world_sensor.translation(), yaw_of(place)});
  }
  if (path.size() < 2) {
    throw InputError(file.string() + ": a path has two waypoints or more");
  }
  return path;
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
