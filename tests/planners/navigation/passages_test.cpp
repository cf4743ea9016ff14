// Where the outline of a robot fits, and how it gets through where a disc round it does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/planners/navigation/drawn_rooms.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/navigation/centred_legs.hpp"
#include "vantage/planners/navigation/narrow_places.hpp"
#include "vantage/planners/navigation/passage_watch.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/travel/path_lengths.hpp"

namespace vantage {
namespace {

constexpr double kWidth_m = 0.6;

NavigationOptions disc_of(const FloorOutline& outline) {
  NavigationOptions options;
  options.footprint_radius_m = circumscribed_radius_m(outline);
  options.margin_m = 0.04;
  return options;
}

/// Whether a point is inside a convex outline, by the side of each edge that it is on.
bool is_inside(const FloorOutline& outline, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    const Eigen::Vector2d to = p - outline[i];
    if (edge.x() * to.y() - edge.y() * to.x() < 0.0) return false;
  }
  return true;
}

bool covers_something(const FloorMap& detail, const FloorOutline& outline) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outline) box.extend(p);
  const Eigen::Array2i low = detail.cell_at(box.min());
  const Eigen::Array2i high = detail.cell_at(box.max());
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const bool clear = detail.contains({x, y}) && is_free(detail, detail.index({x, y}));
      if (!clear && is_inside(outline, detail.centre({x, y}))) return true;
    }
  }
  return false;
}

DrawnRooms random_room(Rng& rng, int boxes) {
  std::vector<Eigen::AlignedBox2d> walls;
  for (int i = 0; i < boxes; ++i) {
    const double x = rng.uniform(0.0, 3.0);
    const double y = rng.uniform(0.0, 3.0);
    walls.push_back(wall(x, y, x + rng.uniform(0.02, 0.3), y + rng.uniform(0.02, 0.3)));
  }
  return {3.0, 3.0, walls};
}

TEST(FootprintSpace, AgreesWithEveryPointOfTheFloor) {
  Rng rng(3);
  int fitting = 0;
  for (int scene = 0; scene < 8; ++scene) {
    const DrawnRooms rooms = random_room(rng, 5);
    const FloorOutline outline = rectangle(0.8, 0.5);
    const auto space = rooms.space({.outline = outline}, {.margin_m = 0.03});
    for (int i = 0; i < 60; ++i) {
      const Pose2 pose{rng.uniform(0.6, 2.4), rng.uniform(0.6, 2.4),
                       rng.uniform(-std::numbers::pi, std::numbers::pi)};
      EXPECT_EQ(space->fits(outline, pose), !covers_something(rooms.detail, moved(outline, pose)));
      const Eigen::Array2i cell = rooms.detail.cell_at({pose.x_m, pose.y_m});
      const int heading = space->nearest_heading(pose.yaw_rad);
      const Eigen::Vector2d p = rooms.detail.centre(cell);
      const bool fits = !covers_something(
          rooms.detail, moved(grown(outline, 0.03), {p.x(), p.y(), space->heading_rad(heading)}));
      EXPECT_EQ(space->fits(cell, heading), fits);
      fitting += fits ? 1 : 0;
    }
  }
  EXPECT_GT(fitting, 50);
  EXPECT_LT(fitting, 430);
}

TEST(FootprintSpace, HasRoomNowhereOffTheMap) {
  const DrawnRooms rooms(2.0, 2.0, {});
  const FloorOutline outline = rectangle(0.8, 0.5);
  const auto space = rooms.space({.outline = outline}, {});
  EXPECT_TRUE(space->fits(outline, {0.41, 1.0, 0.0}));
  EXPECT_FALSE(space->fits(outline, {0.38, 1.0, 0.0}));
  EXPECT_FALSE(space->fits(outline, {1.62, 1.0, 0.0}));
  EXPECT_FALSE(space->fits(outline, {1.0, 0.23, 0.0}));
}

/// A square robot of 0.6 m that keeps 2 cm: it needs 0.64 m between the middles of cells of 1 cm.
class Door : public testing::TestWithParam<double> {
 protected:
  PathField field(double door_m) const {
    const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
    const DrawnRooms rooms = rooms_with_door(door_m);
    return make_path_field(rooms.floor, {1.25, 1.5, GetParam()}, disc_of(outline),
                           rooms.space({.outline = outline}, {.margin_m = 0.0199}));
  }
};

TEST_P(Door, OpensWhereTheRobotAndItsMarginsFit) {
  const Eigen::Vector2d beyond(3.9, 1.5);
  EXPECT_TRUE(field(0.64).reachable(beyond));
  EXPECT_TRUE(field(0.80).reachable(beyond));
  EXPECT_FALSE(field(0.62).reachable(beyond)) << "1 cm too narrow";
}

TEST_P(Door, IsGoneThroughSquarely) {
  const PathField there = field(0.72);
  const PlannedPath path = centred(there, plan_path(there, {3.9, 1.5, 1.0}));
  ASSERT_TRUE(path.reaches_goal);
  ASSERT_EQ(path.legs.size(), 3U);
  EXPECT_FALSE(path.legs[0].narrow);
  EXPECT_TRUE(path.legs[1].narrow);
  EXPECT_FALSE(path.legs[2].narrow);
  const auto& through = path.legs[1].waypoints;
  ASSERT_EQ(through.size(), 2U);
  EXPECT_LT(through.front().x_m, 2.5);
  EXPECT_GT(through.back().x_m, 2.6);
  for (const Pose2& pose : through) {
    EXPECT_NEAR(std::remainder(pose.yaw_rad, std::numbers::pi / 2.0), 0.0, 1e-6);
    EXPECT_NEAR(pose.y_m, 1.5, 0.02);
  }
  EXPECT_NEAR(path.legs[0].waypoints.back().yaw_rad, through.front().yaw_rad, 1e-9);
  EXPECT_NEAR(path.end.yaw_rad, 1.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(FromAnyHeading, Door, testing::Values(0.0, 1.0, -2.6));

/// What a disc reaches is reached as before, to the bit.
TEST(Passages, LeaveOpenPlacesAsTheyAre) {
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  for (const double door_m : {0.72, 1.4}) {
    const DrawnRooms rooms = rooms_with_door(door_m);
    const Pose2 start{1.25, 1.0, 0.3};
    const PathField disc = make_path_field(rooms.floor, start, disc_of(outline));
    const PathField field = make_path_field(rooms.floor, start, disc_of(outline),
                                            rooms.space({.outline = outline}, {}));
    int more = 0;
    for (std::size_t cell = 0; cell < disc.cost.size(); ++cell) {
      if (disc.reachable(cell)) {
        EXPECT_EQ(field.cost[cell], disc.cost[cell]);
        EXPECT_EQ(field.parent[cell], disc.parent[cell]);
      } else {
        more += field.reachable(cell) ? 1 : 0;
        EXPECT_TRUE(!field.reachable(cell) || field.traversable(cell) || field.heading_rad(cell))
            << "beyond, too, only what is open or a nook";
      }
    }
    EXPECT_EQ(more > 0, door_m < 1.0);
    EXPECT_EQ(field.narrow.empty(), door_m > 1.0);
  }
}

/// The middle of a robot of 0.9 x 0.5 m in a corridor of 0.7 m, which is closed at both ends.
TEST(Passages, ARobotCannotTurnRoundInANarrowCorridor) {
  const DrawnRooms rooms(4.0, 2.0, {wall(0.0, 0.0, 4.0, 0.65), wall(0.0, 1.35, 4.0, 2.0)});
  const FloorOutline outline = rectangle(0.9, 0.5);
  const PathField field = make_path_field(rooms.floor, {2.0, 1.0, 0.0}, disc_of(outline),
                                          rooms.space({.outline = outline}, {}));
  ASSERT_GT(field.narrow.size(), 100U);
  double farthest_m = 0.0;
  for (const NarrowPose& node : field.narrow) {
    if (node.cost == std::numeric_limits<double>::infinity()) continue;
    EXPECT_LT(std::abs(node.pose.yaw_rad), 0.5);
    farthest_m = std::max(farthest_m, std::abs(node.pose.x_m - 2.0));
  }
  EXPECT_GT(farthest_m, 1.3);
  const PlannedPath path = plan_path(field, {0.7, 1.0, std::numbers::pi});
  EXPECT_TRUE(path.reaches_goal);
  EXPECT_LT(std::abs(path.end.yaw_rad), 0.5) << "it backs out";
}

/// A base that cannot go sideways does not stop where it could neither turn nor back out.
TEST(Passages, OneThatGoesAlongItsHeadingGoesThroughForwards) {
  const FloorOutline outline = rectangle(0.7, 0.5);
  const DrawnRooms rooms = rooms_with_door(0.62);
  const PathField field =
      make_path_field(rooms.floor, {1.25, 1.5, 2.0}, disc_of(outline),
                      rooms.space({.outline = outline, .goes_sideways = false}, {}));
  const PlannedPath path = plan_path(field, {3.9, 1.5, 0.0});
  ASSERT_TRUE(path.reaches_goal);
  for (const PathLeg& leg : path.legs) {
    if (!leg.narrow) continue;
    for (std::size_t i = 1; i < leg.waypoints.size(); ++i) {
      const Pose2& from = leg.waypoints[i - 1];
      const Pose2& to = leg.waypoints[i];
      EXPECT_NEAR(wrap_angle(to.yaw_rad - std::atan2(to.y_m - from.y_m, to.x_m - from.x_m)), 0.0,
                  1e-6);
    }
  }
}

void expect_free(const FloorMap& detail, const PlannedPath& path, const FloorOutline& outline) {
  for (const PathLeg& leg : path.legs) {
    for (std::size_t i = 1; i < leg.waypoints.size(); ++i) {
      const Pose2& from = leg.waypoints[i - 1];
      const Pose2& to = leg.waypoints[i];
      const int samples =
          3 + static_cast<int>(std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) / 0.02);
      for (int k = 0; k <= samples; ++k) {
        const double share = static_cast<double>(k) / samples;
        // A leg ends at the heading that the next one is driven at.
        const double yaw_rad =
            from.yaw_rad + (leg.narrow ? share : 0.0) * wrap_angle(to.yaw_rad - from.yaw_rad);
        const Pose2 pose{from.x_m + share * (to.x_m - from.x_m),
                         from.y_m + share * (to.y_m - from.y_m), yaw_rad};
        EXPECT_FALSE(covers_something(detail, moved(outline, pose)))
            << pose.x_m << " " << pose.y_m << " " << pose.yaw_rad;
      }
    }
  }
}

TEST(Passages, PathsNeverOverlapAnything) {
  Rng rng(11);
  const FloorOutline outline = rectangle(0.66, 0.5);
  int passages = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const double door_m = rng.uniform(0.58, 0.8);
    DrawnRooms rooms = rooms_with_door(door_m);
    for (int i = 0; i < 3; ++i) {  // posts in the way
      const Eigen::Vector2d p(rng.uniform(1.8, 3.4), rng.uniform(0.3, 2.7));
      for (std::size_t cell = 0; cell < rooms.detail.size(); ++cell) {
        const Eigen::Vector2d centre = rooms.detail.centre(rooms.detail.cell(cell));
        if ((centre - p).norm() > 0.04) continue;
        rooms.detail.log_odds[cell] = 3.0F;
        rooms.floor.log_odds[rooms.floor.index(rooms.floor.cell_at(centre))] = 3.0F;
      }
    }
    const PathField field =
        make_path_field(rooms.floor, {0.8, 1.5, rng.uniform(-std::numbers::pi, std::numbers::pi)},
                        disc_of(outline), rooms.space({.outline = outline}, {}));
    for (int i = 0; i < 4; ++i) {
      const Pose2 goal{rng.uniform(3.2, 4.5), rng.uniform(0.6, 2.4),
                       rng.uniform(-std::numbers::pi, std::numbers::pi)};
      const PlannedPath path = plan_path(field, goal);
      if (!path.reaches_goal || path.legs.empty()) continue;
      ++passages;
      expect_free(rooms.detail, path, outline);
      expect_free(rooms.detail, centred(field, path), outline);
    }
  }
  EXPECT_GT(passages, 10);
}

/// By eight steps, which cut no corners.
TEST(Passages, AnOpenPlaceBeyondCostsTheCheapestStepFromBesideIt) {
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  const DrawnRooms rooms = rooms_with_door(0.72);
  const PathField field = make_path_field(rooms.floor, {1.25, 1.0, 0.3}, disc_of(outline),
                                          rooms.space({.outline = outline}, {}));
  const FloorMap& floor = field.map;
  const auto is_open = [&](const Eigen::Array2i& at) {
    return floor.contains(at) && field.traversable(floor.index(at));
  };
  int beyond = 0;
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Array2i to = floor.cell(cell);
    if (to.x() < 52 || !is_open(to) || field.parent[cell] >= floor.size()) continue;
    double cheapest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 9; ++k) {
      const Eigen::Array2i from = to + Eigen::Array2i(k % 3 - 1, k / 3 - 1);
      if (k == 4 || !is_open(from) || !is_open({to.x(), from.y()}) || !is_open({from.x(), to.y()}))
        continue;
      const double length_m = floor.cell_m * (k % 2 == 0 ? std::numbers::sqrt2 : 1.0);
      const double mean =
          0.5 * (field.cost_per_metre(floor.index(from)) + field.cost_per_metre(cell));
      cheapest = std::min(cheapest, field.cost[floor.index(from)] + length_m * mean);
    }
    EXPECT_NEAR(field.cost[cell], cheapest, 1e-9) << to.transpose();
    ++beyond;
  }
  EXPECT_GT(beyond, 100);
}

/// A metre in a passage counts for as many as it takes the time of.
TEST(Passages, WaysAreAsLongBetweenPlacesAsFromTheRobot) {
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  const DrawnRooms rooms = rooms_with_door(0.75);
  const auto space = rooms.space({.outline = outline, .speed_m_s = 0.6}, {.speed_m_s = 0.2});
  const std::vector<Eigen::Vector2d> places{{0.9, 1.1}, {4.1, 1.9}, {1.5, 2.0}, {3.6, 0.9}};
  const PathField field = make_path_field(rooms.floor, {1.25, 1.5, 0.0}, disc_of(outline), space);
  const Eigen::MatrixXd lengths_m = path_lengths_m(field, places, 2);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PathField from =
        make_path_field(rooms.floor, {places[i].x(), places[i].y(), 0.0}, disc_of(outline), space);
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (i == j) continue;
      const double straight_m = (places[i] - places[j]).norm();
      const double driven_m = path_length_m(from, {places[j].x(), places[j].y(), 0.0});
      const double between_m =
          lengths_m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      EXPECT_NEAR(between_m, driven_m, 0.25 * driven_m) << i << " " << j;
      const bool through = (places[i].x() < 2.5) != (places[j].x() < 2.5);
      EXPECT_EQ(driven_m > straight_m + 0.6, through) << driven_m << " " << straight_m;
    }
  }
}

/// It stands in the door, at an angle; the way out is not that of a disc, which turns as it goes.
TEST(Passages, LeadOutOfADoorAtTheHeadingTheRobotHas) {
  const FloorOutline outline = rectangle(0.8, 0.5);
  const DrawnRooms rooms = rooms_with_door(0.62);
  const PathField field = make_path_field(rooms.floor, {2.55, 1.5, 0.02}, disc_of(outline),
                                          rooms.space({.outline = outline}, {}));
  for (const double x_m : {1.0, 4.1}) {
    const PlannedPath path = plan_path(field, {x_m, 1.5, 0.0});
    ASSERT_TRUE(path.reaches_goal) << x_m;
    ASSERT_FALSE(path.legs.empty());
    EXPECT_TRUE(path.legs.front().narrow);
    expect_free(rooms.detail, path, outline);
  }
}

/// A nearly square robot goes forwards through doors; out of an alcove it cannot turn in it backs.
TEST(Passages, LeadBackwardsOutOfAnAlcove) {
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  const DrawnRooms rooms(3.0, 3.0, {wall(0.0, 0.0, 1.16, 0.8), wall(1.84, 0.0, 3.0, 0.8)});
  for (const double yaw_rad : {-0.5 * std::numbers::pi, 0.0, std::numbers::pi}) {
    const PathField field = make_path_field(rooms.floor, {1.5, 0.35, yaw_rad}, disc_of(outline),
                                            rooms.space({.outline = outline}, {}));
    const PlannedPath path = plan_path(field, {1.5, 2.0, 0.0});
    ASSERT_TRUE(path.reaches_goal) << yaw_rad;
    ASSERT_FALSE(path.legs.empty());
    EXPECT_TRUE(path.legs.front().narrow);
    expect_free(rooms.detail, path, outline);
  }
}

/// Deep in an alcove it can turn, but only there: a place so small is no open one.
TEST(Passages, LeadOutOfAPlaceThatIsJustLargeEnoughToTurnIn) {
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  const DrawnRooms rooms(3.0, 3.0,
                         {wall(0.0, 0.0, 1.0, 0.9), wall(0.0, 0.9, 1.05, 1.0),
                          wall(2.0, 0.0, 3.0, 0.9), wall(1.95, 0.9, 3.0, 1.0)});
  for (const double yaw_rad : {-0.5 * std::numbers::pi, 0.0, 0.3, std::numbers::pi}) {
    const PathField disc = make_path_field(rooms.floor, {1.5, 0.475, yaw_rad}, disc_of(outline));
    ASSERT_TRUE(disc.traversable(disc.start_cell));
    EXPECT_FALSE(disc.reachable(Eigen::Vector2d(1.5, 2.4)));
    const PathField field = make_path_field(rooms.floor, {1.5, 0.475, yaw_rad}, disc_of(outline),
                                            rooms.space({.outline = outline}, {}));
    EXPECT_TRUE(field.reaches_open_place());
    const PlannedPath path = plan_path(field, {1.5, 2.4, 0.0});
    ASSERT_TRUE(path.reaches_goal) << yaw_rad;
    expect_free(rooms.detail, path, outline);
  }
}

/// Wherever it has got to: what is measured about it may leave its outline no way out.
TEST(Passages, ARobotGetsOutWhereverADiscDoes) {
  Rng rng(11);
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  int squeezed = 0;
  for (int i = 0; i < 80; ++i) {
    const DrawnRooms rooms = random_room(rng, 9);
    const Pose2 start{rng.uniform(0.2, 2.8), rng.uniform(0.2, 2.8),
                      rng.uniform(-std::numbers::pi, std::numbers::pi)};
    const FloorMap& floor = rooms.floor;
    if (!is_free(floor, floor.index(floor.cell_at({start.x_m, start.y_m})))) continue;
    const PathField disc = make_path_field(floor, start, disc_of(outline));
    const PathField field =
        make_path_field(floor, start, disc_of(outline), rooms.space({.outline = outline}, {}));
    const auto opens = [&](const PathField& paths) {
      for (std::size_t cell = 0; cell < floor.size(); ++cell) {
        if (paths.reachable(cell) && paths.traversable(cell)) return true;
      }
      return false;
    };
    if (opens(disc)) {
      EXPECT_TRUE(opens(field)) << "room " << i;
      squeezed += disc.traversable(disc.start_cell) ? 0 : 1;
    }
    for (std::size_t cell = 0; cell < floor.size(); ++cell) {
      if (!field.reachable(cell)) continue;
      const Eigen::Vector2d place = floor.centre(floor.cell(cell));
      EXPECT_TRUE(plan_path(field, {place.x(), place.y(), 0.0}).reaches_goal) << "room " << i;
    }
  }
  EXPECT_GT(squeezed, 20);
}

TEST(Passages, SomethingNewInTheDoorIsSeen) {
  const FloorOutline outline = rectangle(kWidth_m, kWidth_m);
  DrawnRooms rooms = rooms_with_door(0.75);
  const RobotOutline robot{.outline = outline};
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {3.1, 1.5, 0.0}}, .narrow = true};
  EXPECT_FALSE(is_passage_blocked(rooms.detail, leg, {2.1, 1.5, 0.0}, robot));
  const auto put = [&](double x, double y) {
    rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at({x, y}))] = 3.0F;
  };
  put(2.7, 1.21);
  EXPECT_TRUE(is_passage_blocked(rooms.detail, leg, {2.1, 1.5, 0.0}, robot));
  EXPECT_FALSE(is_passage_blocked(rooms.detail, leg, {3.05, 1.5, 0.0}, robot)) << "behind it";
  EXPECT_FALSE(is_passage_blocked(rooms.detail, leg, {2.8, 1.5, 0.0}, robot))
      << "under it: it cannot be there";
}

/// Within a centimetre of where it stands there is nothing; its leg ends with its front at 3.4 m.
TEST(Passages, SomethingNewIsSeenToTheCentimetre) {
  const RobotOutline robot{.outline = rectangle(kWidth_m, kWidth_m)};
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {3.1, 1.5, 0.0}}, .narrow = true};
  const auto blocked_by = [&](double x_m) {
    DrawnRooms rooms = rooms_with_door(0.75);
    rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at({x_m, 1.505}))] = 3.0F;
    return is_passage_blocked(rooms.detail, leg, {2.798, 1.5, 0.0}, robot);
  };
  EXPECT_FALSE(blocked_by(3.105)) << "0.7 cm ahead of it";
  EXPECT_TRUE(blocked_by(3.115)) << "1.7 cm";
  EXPECT_TRUE(blocked_by(3.395));
  EXPECT_FALSE(blocked_by(3.405));
}

TEST(Passages, WhatItHasTurnedAwayFromIsNotInItsWay) {
  DrawnRooms rooms(4.0, 4.0, {});
  const RobotOutline robot{.outline = rectangle(0.6, 0.4)};
  const double left_rad = 0.5 * std::numbers::pi;
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {3.0, 1.5, 0.0}, {3.0, 2.5, left_rad}},
                    .narrow = true};
  rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at({3.255, 1.505}))] = 3.0F;
  EXPECT_TRUE(is_passage_blocked(rooms.detail, leg, {2.8, 1.5, 0.0}, robot));
  EXPECT_FALSE(is_passage_blocked(rooms.detail, leg, {3.0, 1.5, left_rad}, robot));
}

TEST(Passages, SomethingNewBesideATurnInPlaceIsSeen) {
  DrawnRooms rooms = rooms_with_door(0.75);
  const RobotOutline robot{.outline = rectangle(kWidth_m, kWidth_m)};
  const PathLeg turn{.waypoints = {{2.0, 1.5, 0.0}, {2.0, 1.5, 0.6}}, .narrow = true};
  EXPECT_FALSE(is_passage_blocked(rooms.detail, turn, {2.0, 1.5, 0.0}, robot));
  const double corner_m = 0.93 * std::numbers::sqrt2 * 0.5 * kWidth_m;
  const double bearing_rad = std::numbers::pi / 4.0 + 0.6;
  const Eigen::Vector2d p_m(2.0 + corner_m * std::cos(bearing_rad),
                            1.5 + corner_m * std::sin(bearing_rad));
  rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at(p_m))] = 3.0F;
  EXPECT_TRUE(is_passage_blocked(rooms.detail, turn, {2.0, 1.5, 0.0}, robot));
}

/// A corner passes it half way.
TEST(Passages, SomethingNewOnTheWayOfATurnInPlaceIsSeenUntilItIsPassed) {
  DrawnRooms rooms = rooms_with_door(0.75);
  const RobotOutline robot{.outline = rectangle(kWidth_m, kWidth_m)};
  const double quarter_rad = 0.5 * std::numbers::pi;
  const PathLeg turn{.waypoints = {{2.0, 1.5, 0.0}, {2.0, 1.5, quarter_rad}}, .narrow = true};
  const Eigen::Vector2d p_m(2.0, 1.5 + 1.3 * 0.5 * kWidth_m);
  rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at(p_m))] = 3.0F;
  EXPECT_TRUE(is_passage_blocked(rooms.detail, turn, {2.0, 1.5, 0.0}, robot));
  EXPECT_TRUE(is_passage_blocked(rooms.detail, turn, {2.0, 1.5, 0.3}, robot));
  EXPECT_FALSE(is_passage_blocked(rooms.detail, turn, {2.0, 1.5, 1.3}, robot));
}

/// A seam along every wall leads nowhere.
TEST(NarrowPlaces, AreNoneInARoomWithoutADoor) {
  const DrawnRooms rooms(3.0, 3.0, {wall(1.4, 1.4, 1.6, 1.6)});
  std::vector<std::uint8_t> open(rooms.floor.size(), 0);
  std::vector<std::uint8_t> may_stand(rooms.floor.size(), 0);
  const auto field =
      make_path_field(rooms.floor, {0.7, 0.7, 0.0}, disc_of(rectangle(kWidth_m, kWidth_m)));
  const auto space = rooms.space({.outline = rectangle(kWidth_m, kWidth_m)}, {});
  for (std::size_t cell = 0; cell < open.size(); ++cell) {
    open[cell] = field.traversable(cell) ? 1 : 0;
    may_stand[cell] = space->may_stand(rooms.floor.cell(cell) * DrawnRooms::kParts + 2) ? 1 : 0;
  }
  EXPECT_GT(std::ranges::count(may_stand, 1), std::ranges::count(open, 1));
  for (const Leeway leeway : find_narrow_places(rooms.floor, open, may_stand, 0.2)) {
    EXPECT_TRUE(leeway == Leeway::none || leeway == Leeway::open);
  }
}

TEST(Passages, AsFarAsCellsTellARobotMayNotTurnWithinHalfADiagonalMore) {
  const DrawnRooms rooms(4.0, 4.0, {});
  const auto keeps_its_heading = [&](double width_m) {
    const FloorOutline outline = rectangle(0.96, width_m);
    const PathField field = make_path_field(rooms.floor, {2.025, 0.525, 0.0}, disc_of(outline),
                                            rooms.space({.outline = outline}, {}));
    EXPECT_FALSE(field.traversable(field.start_cell));
    EXPECT_TRUE(field.reachable(Eigen::Vector2d(2.0, 2.0)));
    return !field.narrow.empty();
  };
  EXPECT_TRUE(keeps_its_heading(0.4)) << "0.520 m to a corner, and 0.035";
  EXPECT_FALSE(keeps_its_heading(0.362)) << "0.513 m, and 0.035";
}

}  // namespace
}  // namespace vantage
