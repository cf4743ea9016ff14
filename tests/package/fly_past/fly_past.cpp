// Flies past a column that stands on the straight path: STOMP bends the waypoints round it.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "vantage/control/minimum_jerk_trajectory.hpp"
#include "vantage/planners/trajectory/flight_cost.hpp"
#include "vantage/planners/trajectory/optimisers/stomp.hpp"

using namespace vantage;

int main() {
  // A room of 8 m x 5 m x 2.5 m, free but for a column of 0.4 m x 0.4 m in its middle.
  OccupancyGrid map(make_grid_frame({0.0, 0.0, 1.25}, {8.0, 5.0, 2.5}, {80, 50, 25}));
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    const Eigen::Vector3d p_m = map.frame.centre(map.frame.cell(cell));
    map.log_odds[cell] = p_m.head<2>().cwiseAbs().maxCoeff() < 0.2 ? 4.0F : -4.0F;
  }
  const Esdf surface = make_esdf(map, map.frame.box());

  // Ten waypoints (x, y, z, yaw) straight through the column, and the ones before and after them.
  Horizon path{.points = Eigen::Matrix4Xd::Zero(4, 10)};
  path.points.row(0).setLinSpaced(-2.7, 2.7);
  path.points.row(2).setConstant(1.2);
  path.before = {-3.3, 0.0, 1.2, 0.0};
  path.after = {3.3, 0.0, 1.2, 0.0};
  const FlightCostOptions options{.clearance_m = 0.6};
  Rng rng(1);
  path.points = Stomp{}(path, flight_cost(options, {}, {.surface = &surface}), rng).points;

  // The vehicle's centre on the smooth flight through the waypoints, and the nearest surface.
  std::vector<FlightWaypoint> waypoints;
  for (const auto& q : path.points.colwise()) waypoints.push_back({q.head<3>(), q[3]});
  const MinimumJerkTrajectory flight({.p_world_m = path.before.head<3>()}, waypoints);
  double clearance_m = surface.reach_m();
  for (double t_s = 0.0; t_s < flight.duration_s(); t_s += 0.1) {
    const Eigen::Vector3d p_m = flight.at(t_s).p_world_m;
    std::printf("%4.1f s (%+.2f, %+.2f, %.2f) m\n", t_s, p_m.x(), p_m.y(), p_m.z());
    clearance_m = std::min(clearance_m, surface.distance_m(p_m));
  }
  std::printf("clearance: %.2f m\n", clearance_m);
  return clearance_m > options.clearance_m ? 0 : 1;
}
