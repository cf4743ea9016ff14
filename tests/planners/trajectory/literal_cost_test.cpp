// For the record: with the costs as printed in the dissertation the cheapest path leads into the
// object that should be looked at. Distance and point-to-line distance (5.10) are both least at the
// object itself, the camera term (5.9) is always 1, and the obstacle term (5.8) is multiplied by a
// speed that is 0 where waypoints gather.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/planners/trajectory/straight_flight.hpp"
#include "vantage/planners/trajectory/observation_ring.hpp"
#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"

namespace vantage {
namespace {

/// Least distance of waypoints from the axis of an object beside the path, 0.2 m in radius.
double nearest_to_object_m(bool literal, double lateral_m, std::uint64_t seed) {
  const ObservationRing ring{.p_world_object_m = {2.25, lateral_m, 1.2}, .height_m = 1.2};
  const Esdf surface = test::columns({ring.p_world_object_m.head<2>()});
  const Horizon horizon = test::straight_flight();
  const ObservedObject object{.ring = ring, .used = {}, .entropy_nats = 3.0};
  FlightSurroundings scene{.surface = &surface, .target = {}, .p_world_obstacles_m = {}};
  scene.target = observation_target({&object, 1}, horizon.points.col(0).head<3>(), horizon.points,
                                    FlightCostOptions{}.tau_nats);
  scene.p_world_obstacles_m = {ring.p_world_object_m};
  const FlightCostOptions options{.obstacle_weight = literal ? 1.0 : 5.0,
                                  .recognition_weight = literal ? 1.0 : 0.5,
                                  .literal = literal};
  Rng rng(seed);
  const auto result = optimise(Stomp{}, horizon, flight_cost(options, {}, scene), rng);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto waypoint : result.points.colwise()) {
    nearest_m = std::min(nearest_m, (waypoint.head<3>() - ring.p_world_object_m).norm());
  }
  return nearest_m;
}

TEST(LiteralCost, FliesIntoTheObject) {
  for (const double lateral_m : {1.0, -1.2, 1.5}) {
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
      EXPECT_LT(nearest_to_object_m(true, lateral_m, seed), 0.5) << lateral_m;
    }
  }
}

TEST(LiteralCost, TheReadingInUseLooksFromOutside) {
  for (const double lateral_m : {1.0, -1.2, 1.5}) {
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
      const double nearest_m = nearest_to_object_m(false, lateral_m, seed);
      EXPECT_GT(nearest_m, 0.9) << lateral_m;
      EXPECT_LT(nearest_m, 1.5) << lateral_m;
    }
  }
}

}  // namespace
}  // namespace vantage
