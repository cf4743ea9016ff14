#include "vantage/planners/trajectory/observation_ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

TEST(ObservationRing, HasEightPlacesRoundTheObjectAtTheHeightFlown) {
  const ObservationRing ring{.p_world_object_m = {1.0, 2.0, 0.4}, .radius_m = 1.3, .height_m = 1.2};
  EXPECT_LT((ring.view_m(0) - Eigen::Vector3d(2.3, 2.0, 1.2)).norm(), 1e-12);
  EXPECT_LT((ring.view_m(2) - Eigen::Vector3d(1.0, 3.3, 1.2)).norm(), 1e-12);
  const double diagonal = 1.3 * std::sqrt(0.5);
  EXPECT_LT((ring.view_m(5) - Eigen::Vector3d(1.0 - diagonal, 2.0 - diagonal, 1.2)).norm(), 1e-12);
}

TEST(ObservationRing, PlacesFallIntoDirectionsByTheirBearing) {
  for (const double first : {0.0, 0.3, -3.0, 5.0}) {
    const ObservationRing ring{.p_world_object_m = {1.0, 2.0, 0.4}, .first_bearing_rad = first};
    for (int d = 0; d < kObservationDirections; ++d) {
      EXPECT_EQ(ring.direction_of(ring.view_m(d)), d);
      for (const double off_rad : {-0.49 * std::numbers::pi / 4.0, 0.49 * std::numbers::pi / 4.0}) {
        const double bearing = first + d * std::numbers::pi / 4.0 + off_rad;
        const Eigen::Vector3d place(1.0 + 3.0 * std::cos(bearing), 2.0 + 3.0 * std::sin(bearing),
                                    7.0);
        EXPECT_EQ(ring.direction_of(place), d);
      }
    }
  }
}

ObservedObject half_metre_object_at(double x, double y, double entropy_nats = 2.0) {
  return {.ring = {.p_world_object_m = {x, y, 0.5}, .height_m = 1.2},
          .used = {},
          .entropy_nats = entropy_nats};
}

TEST(ActiveObject, IsTheNearestThatIsNotKnown) {
  std::vector<ObservedObject> objects{half_metre_object_at(3.0, 0.0),
                                      half_metre_object_at(1.0, 0.0, 0.05),
                                      half_metre_object_at(2.0, 0.0, 0.1)};
  EXPECT_EQ(active_object(objects, {0.0, 0.0, 1.2}, 0.1), 2U);
  EXPECT_EQ(active_object(objects, {3.1, 0.0, 1.2}, 0.1), 0U);
  EXPECT_EQ(active_object(objects, {0.0, 0.0, 1.2}, 0.01), 1U);
  objects[2].used.fill(true);  // nothing left to see of it
  EXPECT_EQ(active_object(objects, {0.0, 0.0, 1.2}, 0.1), 0U);
  EXPECT_EQ(active_object(objects, {0.0, 0.0, 1.2}, 0.1, 2.9), std::nullopt);
  EXPECT_EQ(active_object(objects, {0.0, 0.0, 1.2}, 0.1, 3.0), 0U) << "just in range";
  EXPECT_EQ(active_object({}, {0.0, 0.0, 1.2}, 0.1), std::nullopt);
}

TEST(ActiveDirection, IsTheUnusedOneNearestTheRemainingPath) {
  ObservedObject object = half_metre_object_at(2.0, 1.5);
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  EXPECT_EQ(active_direction(object, path), 6);  // straight below the object
  object.used[6] = true;
  EXPECT_EQ(active_direction(object, path), 5);  // as near as 7, and the path comes by it first
  EXPECT_EQ(active_direction(object, path.rightCols(5)), 7);  // 5 has been passed
  object.used.fill(true);
  EXPECT_EQ(active_direction(object, path), std::nullopt);
}

TEST(ActiveDirection, MayBeAnyThatIsLeft) {
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  for (int d = 0; d < kObservationDirections; ++d) {
    ObservedObject object = half_metre_object_at(2.0, 1.5);
    object.used.fill(true);
    object.used[static_cast<std::size_t>(d)] = false;
    EXPECT_EQ(active_direction(object, path), d);
  }
}

TEST(ObservationTarget, IsTheActiveDirectionOfTheActiveObject) {
  const std::vector<ObservedObject> objects{half_metre_object_at(9.0, 1.5),
                                            half_metre_object_at(2.0, 1.5, 0.7)};
  const Horizon flight = test::straight_flight();
  const auto target = observation_target(objects, {0.0, 0.0, 1.2}, flight.points, 0.1);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->p_world_object_m, Eigen::Vector3d(2.0, 1.5, 0.5));
  EXPECT_LT((target->p_world_view_m - Eigen::Vector3d(2.0, 0.2, 1.2)).norm(), 1e-12);
  EXPECT_EQ(target->entropy_nats, 0.7);
  EXPECT_FALSE(observation_target(objects, {0.0, 0.0, 1.2}, flight.points, 3.0));
}

TEST(BlockedDirections, AreLeftOut) {
  ObservedObject object = half_metre_object_at(2.0, 1.0);
  const Esdf surface = test::columns({{2.0, 1.0}, {3.4, 1.0}});
  leave_out_blocked(object, surface, 0.6);
  EXPECT_TRUE(object.used[0]);  // 0.1 m from the other column's axis
  EXPECT_FALSE(object.used[2]);
  EXPECT_FALSE(object.used[4]);
}

TEST(NearestOnPath, IsOnTheSegmentsNotAtTheWaypointsAlone) {
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  const OnPath beside = nearest_on_path(path, {0.7, 0.3, 1.2});
  EXPECT_NEAR(beside.distance_m, 0.3, 1e-12);
  EXPECT_NEAR(beside.at, 1.4, 1e-12);
  const OnPath behind = nearest_on_path(path, {-3.0, 4.0, 1.2});
  EXPECT_NEAR(behind.distance_m, 5.0, 1e-12);
  EXPECT_EQ(behind.at, 0.0);
  const OnPath beyond = nearest_on_path(path, {7.5, 4.0, 1.2});
  EXPECT_NEAR(beyond.distance_m, 5.0, 1e-12);
  EXPECT_NEAR(beyond.at, 9.0, 1e-12);
  const OnPath of_one = nearest_on_path(path.middleCols(2, 1), {4.0, 4.0, 1.2});
  EXPECT_NEAR(of_one.distance_m, 5.0, 1e-12) << "of a path of one waypoint";
  EXPECT_EQ(of_one.at, 0.0);
}

TEST(ActiveObject, OfTwoThatAreEquallyNearIsTheFirst) {
  const std::vector<ObservedObject> objects{half_metre_object_at(3.0, 4.0),
                                            half_metre_object_at(-4.0, 3.0)};
  EXPECT_EQ(active_object(objects, {0.0, 0.0, 1.2}, 0.1), 0U);
}

TEST(BlockedDirections, AreThoseNearerThanTheClearance) {
  const Esdf surface = test::columns({{2.0, 1.0}, {3.4, 1.0}});
  const ObservedObject object = half_metre_object_at(2.0, 1.0);
  const double away_m = surface.distance_m(object.ring.view_m(2));
  ObservedObject just_clear = object;
  just_clear.used[4] = true;
  leave_out_blocked(just_clear, surface, away_m);
  EXPECT_FALSE(just_clear.used[2]);
  EXPECT_TRUE(just_clear.used[4]) << "it was seen from there";
  ObservedObject too_near = object;
  leave_out_blocked(too_near, surface, away_m + 1e-9);
  EXPECT_TRUE(too_near.used[2]);
}

TEST(NearestOnPath, OfTwoPlacesIsTheFirst) {
  Eigen::Matrix4Xd path = Eigen::Matrix4Xd::Zero(4, 4);  // there and back, 2 m apart
  path.topRows<2>() << 0.0, 2.0, 2.0, 0.0, 0.0, 0.0, 2.0, 2.0;
  const OnPath between = nearest_on_path(path, {0.0, 1.0, 0.0});
  EXPECT_EQ(between.distance_m, 1.0);
  EXPECT_EQ(between.at, 0.0);
}

TEST(NearestOnPath, OfOneWaypointIsThatFromEverySide) {
  Eigen::Matrix4Xd path(4, 1);
  path.col(0) << 5.0, 6.0, 7.0, 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double away_m : {-10.0, 10.0}) {
      const Eigen::Vector3d place =
          Eigen::Vector3d(5.0, 6.0, 7.0) + away_m * Eigen::Vector3d::Unit(axis);
      const OnPath nearest = nearest_on_path(path, place);
      EXPECT_NEAR(nearest.distance_m, 10.0, 1e-12) << axis;
      EXPECT_EQ(nearest.at, 0.0) << axis;
    }
  }
}

/// Two directions are left, the second one nearer the path by so much.
TEST(ActiveDirection, IsTheOneTheFlightComesByFirstIfAMicrometreDecides) {
  const Eigen::Matrix4Xd path = test::straight_flight().points;
  const auto chosen = [&](double nearer_m) {
    ObservedObject object = half_metre_object_at(2.0, 1.5);
    object.used.fill(true);
    object.used[5] = object.used[7] = false;
    object.ring.first_bearing_rad = -nearer_m / (2.0 * 1.3 * std::sqrt(0.5));
    return active_direction(object, path);
  };
  EXPECT_EQ(chosen(7e-7), 5);
  EXPECT_EQ(chosen(1.5e-6), 7);
}

}  // namespace
}  // namespace vantage
