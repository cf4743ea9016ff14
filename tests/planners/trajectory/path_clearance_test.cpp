#include "planners/trajectory/path_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planners/trajectory/path_spline.hpp"
#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

TEST(PathSpline, PassesItsPlacesAndIsStraightWhereTheyAre) {
  const std::vector<Eigen::Vector3d> places{
      {0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {3.0, 0.0, 1.0}, {3.5, 0.0, 1.0}};
  const PathSpline spline(places);
  ASSERT_EQ(spline.segments(), 1U);
  EXPECT_EQ(spline.at(0, 0.0), places[1]);
  EXPECT_EQ(spline.at(0, 1.0), places[2]);
  EXPECT_LT((spline.at(0, 0.25) - Eigen::Vector3d(1.5, 0.0, 1.0)).norm(), 1e-12);
}

TEST(PathSpline, MovesAlongTheChordOfTheNeighbours) {
  const std::vector<Eigen::Vector3d> places{
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  const PathSpline spline(places);
  const Eigen::Vector3d direction = (spline.at(0, 1e-6) - spline.at(0, 0.0)).normalized();
  EXPECT_LT((direction - Eigen::Vector3d(1.0, 1.0, 0.0).normalized()).norm(), 1e-5);
  // By symmetry half way up; bulging by 1/4 chord x tangent's share of x, 1/2.
  EXPECT_LT((spline.at(0, 0.5) - Eigen::Vector3d(1.125, 0.5, 0.0)).norm(), 1e-12);
}

TEST(PathSpline, TakesPlacesThatCoincide) {
  const PathSpline spline(std::vector<Eigen::Vector3d>(4, Eigen::Vector3d::Ones()));
  EXPECT_LT((spline.at(0, 0.3) - Eigen::Vector3d::Ones()).norm(), 1e-15);
}

TEST(PlacesAlong, AreNoFartherApartThanAsked) {
  Horizon horizon = testing::straight_flight();
  for (Eigen::Index i = 0; i < 10; ++i) horizon.points(1, i) = i % 2 == 0 ? 0.4 : -0.4;
  const auto places = places_along(horizon, 0.03);
  EXPECT_EQ(places.front(), Eigen::Vector3d(horizon.points.col(0).head<3>()));
  EXPECT_EQ(places.back(), Eigen::Vector3d(horizon.points.col(9).head<3>()));
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_LE((places[i] - places[i - 1]).norm(), 0.03 + 1e-12);
  }
}

TEST(Clearance, SeesWhatIsBetweenWaypoints) {
  // The waypoints, 2 m apart, are 1 m from the column they pass through.
  const SurfaceDistance surface = testing::columns({{1.0, 0.0}});
  Horizon horizon = testing::straight_flight(3);
  horizon.points.row(0) << 0.0, 2.0, 4.0;
  horizon.before[0] = -2.0;
  horizon.after[0] = 6.0;
  double at_waypoints_m = std::numeric_limits<double>::infinity();
  for (const auto waypoint : horizon.points.colwise()) {
    at_waypoints_m = std::min(at_waypoints_m, surface.distance_m(waypoint.head<3>()));
  }
  EXPECT_GT(at_waypoints_m, 0.7);
  EXPECT_LT(clearance_m(surface, horizon), -0.1);
}

TEST(Clearance, IsThatOfTheNearestPlace) {
  const SurfaceDistance surface = testing::columns({{1.0, 0.0}});
  const std::vector<Eigen::Vector3d> places{{1.0, 1.2, 1.0}, {1.0, -0.8, 1.0}, {4.0, 0.0, 1.0}};
  EXPECT_EQ(clearance_m(surface, places), surface.distance_m(places[1]));
  EXPECT_EQ(clearance_m(surface, std::span<const Eigen::Vector3d>{}),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace vantage
