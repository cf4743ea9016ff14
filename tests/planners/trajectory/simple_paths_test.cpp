#include "vantage/planners/trajectory/simple_paths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

ObservedObject object_at(double x, double y, double entropy_nats = 2.0) {
  return {.ring = {.p_world_object_m = {x, y, 1.2}, .radius_m = 1.3, .height_m = 1.2},
          .used = {},
          .entropy_nats = entropy_nats};
}

double bearing_rad(const Eigen::Vector4d& from, const Eigen::Vector3d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

TEST(InitialYaw, HeadsForTheNearestUnknownObjectInRange) {
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  const std::vector<ObservedObject> objects{object_at(1.0, 1.0), object_at(2.0, 0.5, 0.01),
                                            object_at(4.0, -1.5)};
  const auto turned = initial_yaw(path, objects, {.range_m = 3.0});
  EXPECT_EQ(turned.topRows(3), path.topRows(3));
  for (Eigen::Index i = 0; i < 10; ++i) {
    const double near_m = (path.col(i).head<2>() - Eigen::Vector2d(1.0, 1.0)).norm();
    const double far_m = (path.col(i).head<2>() - Eigen::Vector2d(4.0, -1.5)).norm();
    const auto& object = objects[near_m < far_m ? 0 : 2];
    EXPECT_DOUBLE_EQ(turned(3, i), bearing_rad(path.col(i), object.ring.p_world_object_m));
  }
}

TEST(InitialYaw, KeepsTheHeadingElsewhere) {
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  EXPECT_EQ(initial_yaw(path, {}), path);
  const std::vector<ObservedObject> objects{object_at(1.0, 1.0, 0.05), object_at(1.0, 5.0)};
  EXPECT_EQ(initial_yaw(path, objects), path);
}

TEST(InitialYaw, HeadsForWhatIsJustUnknownAndJustInRange) {
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  const std::vector<ObservedObject> objects{object_at(1.0, 2.0, 0.25)};
  const auto turned = initial_yaw(path, objects, {.tau_nats = 0.25, .range_m = 2.0});
  EXPECT_NEAR(turned(3, 2), std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ(turned(3, 1), 0.0);
  EXPECT_EQ(turned(3, 3), 0.0);
}

TEST(GreedyDetour, TakesTheNearestUnusedViewsInPlaceOfWaypoints) {
  const Horizon flight = test::straight_flight();
  std::vector<ObservedObject> objects{object_at(2.0, 2.0)};
  objects[0].used[6] = true;  // the one at (2.0, 0.7)
  const auto detour = greedy_detour(flight, objects);
  // At x = 1.08 and 2.92.
  EXPECT_EQ(detour.col(2).head<3>(), objects[0].ring.view_m(5));
  EXPECT_EQ(detour.col(6).head<3>(), objects[0].ring.view_m(7));
  for (const Eigen::Index i : {0, 1, 3, 4, 5, 7, 8, 9}) {
    EXPECT_EQ(detour.col(i).head<3>(), flight.points.col(i).head<3>()) << i;
  }
  EXPECT_NEAR(detour(3, 2), bearing_rad(detour.col(2), objects[0].ring.p_world_object_m), 1e-12);
  EXPECT_EQ(detour(3, 9), flight.points(3, 9)) << "too far off to look at";
}

TEST(GreedyDetour, TakesViewsInTheOrderOfThePathWhicheverIsNearer) {
  const Horizon flight = test::straight_flight();
  std::vector<ObservedObject> objects{object_at(2.0, 2.0)};
  objects[0].used.fill(true);
  objects[0].used[5] = objects[0].used[6] = false;  // at (1.08, 1.08) and at (2.0, 0.7)
  const auto both = greedy_detour(flight, objects);
  EXPECT_EQ(both.col(2).head<3>(), objects[0].ring.view_m(5));
  EXPECT_EQ(both.col(4).head<3>(), objects[0].ring.view_m(6));
  EXPECT_EQ(both.col(5).head<3>(), flight.points.col(5).head<3>());
  const auto one = greedy_detour(flight, objects, {.views = 1});
  EXPECT_EQ(one.col(2).head<3>(), flight.points.col(2).head<3>());
  EXPECT_EQ(one.col(4).head<3>(), objects[0].ring.view_m(6));
}

TEST(GreedyDetour, ViewsAtTheSameWaypointFollowEachOther) {
  const Horizon flight = test::straight_flight();
  std::vector<ObservedObject> objects{object_at(2.01, 0.1)};
  for (const int direction : {0, 1, 3, 4, 5, 7}) {
    objects[0].used[static_cast<std::size_t>(direction)] = true;
  }
  const auto detour = greedy_detour(flight, objects);
  EXPECT_EQ(detour.col(4).head<3>(), objects[0].ring.view_m(6));
  EXPECT_EQ(detour.col(5).head<3>(), objects[0].ring.view_m(2));
}

TEST(GreedyDetour, DoesNotTurnBackNorCutShort) {
  const Horizon flight = test::straight_flight();
  for (const double x_m : {-1.5, 6.0}) {
    const std::vector<ObservedObject> objects{object_at(x_m, 0.5)};
    const auto detour = greedy_detour(flight, objects, {.range_m = 8.0});
    EXPECT_EQ(detour.topRows(3), flight.points.topRows(3)) << x_m;
  }
}

TEST(GreedyDetour, LeavesTheLastWaypointAndWhatLiesBeyondIt) {
  const Horizon flight = test::straight_flight();
  const auto detour_by = [&](double x, double y, const std::vector<int>& unused, int views) {
    std::vector<ObservedObject> objects{object_at(x, y)};
    objects[0].used.fill(true);
    for (const int d : unused) objects[0].used[static_cast<std::size_t>(d)] = false;
    return greedy_detour(flight, objects, {.range_m = 8.0, .views = views});
  };
  const auto nearest_to_end = detour_by(5.6, 0.5, {4}, 2);  // at (4.3, 0.5)
  EXPECT_EQ(nearest_to_end.topRows(3), flight.points.topRows(3));
  const auto before_it = detour_by(5.4, 0.5, {4, 5}, 2);  // at (4.1, 0.5) and at (4.48, -0.42)
  EXPECT_EQ(before_it.col(8).head<3>(), object_at(5.4, 0.5).ring.view_m(4));
  EXPECT_EQ(before_it.col(9).head<3>(), flight.points.col(9).head<3>());
  const auto beyond = detour_by(5.0, 0.9, {4, 6}, 1);  // at (3.7, 0.9) and, nearer, at (5.0, -0.4)
  EXPECT_EQ(beyond.col(7).head<3>(), object_at(5.0, 0.9).ring.view_m(4));
}

TEST(GreedyDetour, LeavesTheFirstWaypointThoughAViewIsNearestIt) {
  const Horizon flight = test::straight_flight();
  std::vector<ObservedObject> objects{object_at(0.2, 1.8)};
  objects[0].used.fill(true);
  objects[0].used[6] = false;  // at (0.2, 0.5)
  const auto detour = greedy_detour(flight, objects);
  EXPECT_EQ(detour.col(0).head<3>(), flight.points.col(0).head<3>());
  EXPECT_EQ(detour.col(1).head<3>(), objects[0].ring.view_m(6));
  EXPECT_EQ(detour.col(2).head<3>(), flight.points.col(2).head<3>());
}

TEST(GreedyDetour, KeepsToThePathWhereNothingIsLeftToSee) {
  const Horizon flight = test::straight_flight();
  EXPECT_EQ(greedy_detour(flight, {}), flight.points);
  const std::vector<ObservedObject> objects{object_at(2.0, 2.0, 0.05), object_at(40.0, 1.0)};
  EXPECT_EQ(greedy_detour(flight, objects), flight.points);
}

TEST(GreedyDetour, TakesAViewWhereTheVehicleIs) {
  const Horizon flight = test::straight_flight();
  const std::vector<ObservedObject> objects{object_at(0.0, 1.3)};
  EXPECT_TRUE(greedy_detour(flight, objects).allFinite());
}

}  // namespace
}  // namespace vantage
