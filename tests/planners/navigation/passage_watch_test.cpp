// What stands in the way of a robot that goes through a passage.
#include "vantage/planners/navigation/passage_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/planners/navigation/drawn_rooms.hpp"

namespace vantage {
namespace {

bool passage_blocked_by(const Eigen::Vector2d& p_m, const PathLeg& leg, const Pose2& base,
                        const FloorOutline& outline) {
  DrawnRooms rooms(4.0, 4.0, {});
  rooms.detail.log_odds[rooms.detail.index(rooms.detail.cell_at(p_m))] = 3.0F;
  return is_passage_blocked(rooms.detail, leg, base, {.outline = outline});
}
constexpr double kQuarter_rad = 0.5 * std::numbers::pi;

/// A tenth of a radian, or three centimetres, hides nothing from a corner.
TEST(PassageWatch, LooksOftenEnoughForACorner) {
  const FloorOutline square = rectangle(0.6, 0.6);
  const PathLeg turn{.waypoints = {{2.0, 1.5, 0.0}, {2.0, 1.5, kQuarter_rad}}, .narrow = true};
  EXPECT_TRUE(passage_blocked_by({2.035, 1.895}, turn, {2.0, 1.5, 0.0}, square));
  const double half_rad = 0.5 * kQuarter_rad;
  const PathLeg ahead{.waypoints = {{1.0, 1.5, half_rad}, {1.91, 1.5, half_rad}}, .narrow = true};
  EXPECT_TRUE(passage_blocked_by({1.425, 1.905}, ahead, {1.0, 1.5, half_rad}, square));
}

TEST(PassageWatch, ATurnMayMoveItByFiveCentimetres) {
  const FloorOutline square = rectangle(0.6, 0.6);
  const auto turning = [&](double moved_m, double x_m) {
    const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {2.0 + moved_m, 1.5, kQuarter_rad}},
                      .narrow = true};
    return passage_blocked_by({x_m, 1.895}, leg, {2.0, 1.5, 0.0}, square);
  };
  EXPECT_TRUE(turning(0.04, 2.025)) << "a corner passes it";
  EXPECT_FALSE(turning(0.07, 2.035)) << "it goes there at the last heading";
}

TEST(PassageWatch, AHeadingCountsByThirtyCentimetresARadian) {
  const FloorOutline outline = rectangle(0.6, 0.4);
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {3.0, 1.5, 0.0}, {3.0, 2.5, kQuarter_rad}},
                    .narrow = true};
  EXPECT_FALSE(passage_blocked_by({3.255, 1.505}, leg, {2.9, 1.5, 1.0}, outline))
      << "0.27 against 0.31";
  EXPECT_TRUE(passage_blocked_by({3.255, 1.505}, leg, {2.8, 1.5, 1.0}, outline))
      << "0.37 against 0.31";
}

/// Two and a half centimetres on, however far that is from the end of the leg.
TEST(PassageWatch, WhereItDoesNotGetOnSomethingIsBeforeItsOutline) {
  const DrawnRooms rooms(4.0, 4.0, {});
  const RobotOutline robot{.outline = rectangle(0.6, 0.6)};
  const auto before = [&](const PathLeg& leg, const Pose2& base) {
    return cells_before(rooms.detail, leg, base, robot);
  };
  const PathLeg ahead{.waypoints = {{1.0, 1.5, 0.0}, {2.0, 1.5, 0.0}}, .narrow = true};
  const double column = 0.6 / rooms.detail.cell_m;
  for (const double x_m : {1.5, 1.99}) {
    const auto cells = before(ahead, {x_m, 1.5, 0.0});
    EXPECT_NEAR(static_cast<double>(cells.size()), 0.025 / rooms.detail.cell_m * column, column);
    EXPECT_FALSE(cells.empty());
    for (const Eigen::Vector2d& cell_m : cells) {
      EXPECT_GE(cell_m.x(), x_m + 0.3);
      EXPECT_LE(cell_m.x(), x_m + 0.326);
      EXPECT_LE(std::abs(cell_m.y() - 1.5), 0.3001);
    }
  }
  const PathLeg turn{.waypoints = {{2.0, 1.5, 0.0}, {2.0, 1.5, kQuarter_rad}}, .narrow = true};
  const auto corners = before(turn, {2.0, 1.5, 0.0});
  EXPECT_FALSE(corners.empty());
  for (const Eigen::Vector2d& cell_m : corners) {
    const Eigen::Vector2d from_middle_m = cell_m - Eigen::Vector2d(2.0, 1.5);
    EXPECT_GT(from_middle_m.norm(), 0.3);
    EXPECT_GT(from_middle_m.cwiseAbs().maxCoeff(), 0.299) << "beyond a side, behind a corner";
  }
}

TEST(PassageWatch, TheWayBackIsTenCentimetresOfTheWayItCame) {
  const PathLeg leg{.waypoints = {{1.0, 1.5, 0.0},
                                  {2.0, 1.5, 0.0},
                                  {2.0, 1.5, kQuarter_rad},
                                  {2.0, 1.7, kQuarter_rad}},
                    .narrow = true};
  const Pose2 along = pose_behind(leg, {1.5, 1.49, 0.0});
  EXPECT_NEAR(along.x_m, 1.4, 0.04);
  EXPECT_EQ(along.y_m, 1.5);
  const Pose2 turned = pose_behind(leg, {2.0, 1.5, 1.0});
  EXPECT_EQ(turned.x_m, 2.0);
  EXPECT_NEAR(turned.yaw_rad, 1.0 - 0.1 / 0.3, 0.03);
  const Pose2 sideways = pose_behind(leg, {2.0, 1.62, kQuarter_rad});
  EXPECT_NEAR(sideways.y_m, 1.52, 0.031);
  EXPECT_EQ(sideways.yaw_rad, kQuarter_rad);
  EXPECT_EQ(pose_behind(leg, {1.03, 1.5, 0.0}).x_m, 1.0) << "no farther than its begin";
}

TEST(PassageWatch, SeesWhatIsInTheWayOfAShortMotion) {
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {2.02, 1.5, 0.0}}, .narrow = true};
  EXPECT_TRUE(passage_blocked_by({2.315, 1.505}, leg, {2.0, 1.5, 0.0}, rectangle(0.6, 0.6)));
}

/// A bar of 0.6 x 0.2 m that turns in place, and something new 0.27 m from its middle.
TEST(PassageWatch, ATurnGoesTheShorterWayFromOneHeadingToTheOther) {
  const auto passes = [](double from_rad, double to_rad, double bearing_rad) {
    const Pose2 begin{2.0, 1.5, from_rad};
    const PathLeg turn{.waypoints = {begin, {2.0, 1.5, to_rad}}, .narrow = true};
    const Eigen::Vector2d p_m(2.0 + 0.27 * std::cos(bearing_rad),
                              1.5 + 0.27 * std::sin(bearing_rad));
    return passage_blocked_by(p_m, turn, begin, rectangle(0.6, 0.2));
  };
  EXPECT_TRUE(passes(0.4, 1.0, 0.9));
  EXPECT_FALSE(passes(0.4, 1.0, 1.8));
  EXPECT_TRUE(passes(1.0, 0.4, 0.5));
  EXPECT_FALSE(passes(1.0, 0.4, 2.0));
  EXPECT_TRUE(passes(2.6, -2.6, std::numbers::pi)) << "by way of half a turn";
  EXPECT_FALSE(passes(2.6, -2.6, kQuarter_rad));
}

/// Something new 2 cm behind its tail, where that was when the leg began.
TEST(PassageWatch, WhatIsJustBehindItIsNotInItsWay) {
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {3.0, 1.5, 0.0}}, .narrow = true};
  EXPECT_FALSE(passage_blocked_by({1.705, 1.505}, leg, {2.025, 1.5, 0.0}, rectangle(0.6, 0.6)));
}

/// It stands 4 cm beside where the leg begins. What is ahead of it from there on is clear, not what
/// the leg begins on.
TEST(PassageWatch, WhatIsWhereTheLegBeginsIsInItsWayWhileItIsThere) {
  const PathLeg leg{.waypoints = {{2.0, 1.5, 0.0}, {3.0, 1.5, 0.0}}, .narrow = true};
  EXPECT_TRUE(passage_blocked_by({1.715, 1.215}, leg, {2.0, 1.54, 0.0}, rectangle(0.6, 0.6)));
}

/// Cells that a robot of 0.6 x 0.4 m covers at one pose and not at another, in the map's order.
std::vector<Eigen::Vector2d> covered_anew(const FloorMap& detail, const Pose2& now,
                                          const Pose2& then) {
  const auto covers = [](const Pose2& base, const Eigen::Vector2d& p_m) {
    const Eigen::Vector2d at = Eigen::Rotation2Dd(-base.yaw_rad) * (p_m - position(base));
    return std::abs(at.x()) <= 0.3 && std::abs(at.y()) <= 0.2;
  };
  std::vector<Eigen::Vector2d> cells;
  for (std::size_t cell = 0; cell < detail.size(); ++cell) {
    const Eigen::Vector2d p_m = detail.centre(detail.cell(cell));
    if (covers(then, p_m) && !covers(now, p_m)) cells.push_back(p_m);
  }
  return cells;
}

void expect_before(const PathLeg& leg, const Pose2& now, const Pose2& then) {
  const DrawnRooms rooms(4.0, 4.0, {});
  const auto expected = covered_anew(rooms.detail, now, then);
  const auto cells = cells_before(rooms.detail, leg, now, {.outline = rectangle(0.6, 0.4)});
  EXPECT_GT(expected.size(), 10U);
  ASSERT_EQ(cells.size(), expected.size());
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i], expected[i]) << i;
}

/// A corner is taken to be 30 cm away: 2.5 cm of its way are a twelfth of a radian.
TEST(PassageWatch, BeforeItInATurnIsWhatItTurnsTo) {
  const Pose2 now{2.003, 1.501, 0.4};
  const double turn_rad = 0.025 / 0.3;
  expect_before({.waypoints = {now, {2.003, 1.501, 1.6}}, .narrow = true}, now,
                {2.003, 1.501, 0.4 + turn_rad});
  expect_before({.waypoints = {now, {2.003, 1.501, -0.8}}, .narrow = true}, now,
                {2.003, 1.501, 0.4 - turn_rad});
  const Pose2 back{2.003, 1.501, 3.12};
  expect_before({.waypoints = {back, {2.003, 1.501, -2.0}}, .narrow = true}, back,
                {2.003, 1.501, 3.12 + turn_rad});
}

/// It is beside its leg, of which there are poses every 34th of a metre: it makes for the second
/// one from where it is, as that is the first one that is 2.5 cm off.
TEST(PassageWatch, BeforeItBesideItsLegIsTheWayBackToIt) {
  const PathLeg leg{.waypoints = {{1.0, 1.5, 0.0}, {2.0, 1.5, 0.0}}, .narrow = true};
  const Pose2 now{1.5, 1.492, 0.03};
  const double ahead_m = 1.0 / 34.0;
  const double share = 0.025 / (std::hypot(ahead_m, 0.008) + 0.3 * 0.03);
  expect_before(leg, now, {1.5 + share * ahead_m, 1.492 + share * 0.008, (1.0 - share) * 0.03});
}

/// The last centimetre ends nowhere else than where the leg does; there nothing is before it.
TEST(PassageWatch, NothingIsBeforeItAtTheEndOfItsLeg) {
  const DrawnRooms rooms(4.0, 4.0, {});
  const PathLeg leg{.waypoints = {{1.0, 1.5, 0.0}, {2.0, 1.5, 0.0}}, .narrow = true};
  EXPECT_TRUE(
      cells_before(rooms.detail, leg, {2.0, 1.5, 0.0}, {.outline = rectangle(0.6, 0.4)}).empty());
}

/// Of poses every 34th of a metre the fourth is the first one that is 10 cm back; of those every
/// 23rd of a turn the 18th, by 30 cm.
TEST(PassageWatch, TheWayBackEndsAtTheFirstPoseThatIsFarEnough) {
  const PathLeg ahead{.waypoints = {{1.0, 1.5, 0.0}, {2.0, 1.5, 0.0}}, .narrow = true};
  EXPECT_NEAR(pose_behind(ahead, {1.5, 1.5, 0.0}).x_m, 1.0 + 13.0 / 34.0, 1e-9);
  const PathLeg turn{.waypoints = {{2.0, 1.5, 0.0}, {2.0, 1.5, 0.445}}, .narrow = true};
  EXPECT_NEAR(pose_behind(turn, {2.0, 1.5, 0.445 * 22.0 / 23.0}).yaw_rad, 0.445 * 4.0 / 23.0, 1e-9);
}

/// Two poses are as near to it. What only the one behind it covers is half a centimetre behind its
/// tail.
TEST(PassageWatch, OfTwoPosesAsNearTheOneAheadCounts) {
  const double begin_m = 2.0 + 1.0 / 512.0;
  const PathLeg leg{.waypoints = {{begin_m, 1.5, 0.0}, {begin_m + 15.0 / 512.0, 1.5, 0.0}},
                    .narrow = true};
  const FloorOutline square = rectangle(0.6, 0.6);
  EXPECT_TRUE(passage_blocked_by({1.705, 1.505}, leg, {begin_m + 7.0 / 512.0, 1.5, 0.0}, square));
  EXPECT_FALSE(passage_blocked_by({1.705, 1.505}, leg, {begin_m + 7.5 / 512.0, 1.5, 0.0}, square));
}

}  // namespace
}  // namespace vantage
