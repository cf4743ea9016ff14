// Where an outline fits in cells of 1 cm, to the cell.
#include "vantage/planners/navigation/footprint_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <utility>

#include "tests/planners/navigation/drawn_rooms.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

const Eigen::Array2i kMiddleCell(100, 100);

/// A room of 2 x 2 m, free but for one cell so many cells from that in its middle.
std::shared_ptr<const FootprintSpace> space_with_a_post(const Eigen::Array2i& off,
                                                        const RobotOutline& robot,
                                                        const PassageOptions& options) {
  DrawnRooms rooms(2.0, 2.0, {});
  rooms.detail.log_odds[rooms.detail.index(kMiddleCell + off)] = 3.0F;
  return rooms.space(robot, options);
}

/// 0.4075 m ahead and 0.25 m to the side.
RobotOutline long_robot() { return {.outline = rectangle(0.815, 0.5)}; }

TEST(FootprintSpace, ReachesAsFarAsTheOutlineAndItsMargin) {
  const auto fits = [](const Eigen::Array2i& off, double margin_m, Margin margin, int heading = 0) {
    return space_with_a_post(off, long_robot(), {.margin_m = margin_m})
        ->fits(kMiddleCell, heading, margin);
  };
  for (const int side : {-1, 1}) {
    EXPECT_FALSE(fits({43 * side, 0}, 0.03, Margin::least));
    EXPECT_TRUE(fits({44 * side, 0}, 0.03, Margin::least));
    EXPECT_FALSE(fits({41 * side, 0}, 0.03, Margin::tight)) << "half a centimetre is kept";
    EXPECT_TRUE(fits({42 * side, 0}, 0.03, Margin::tight));
    EXPECT_FALSE(fits({0, 25 * side}, 0.03, Margin::tight));
    EXPECT_TRUE(fits({0, 26 * side}, 0.03, Margin::tight));
    for (const Margin margin : {Margin::least, Margin::tight}) {
      EXPECT_FALSE(fits({40 * side, 0}, 0.002, margin));
      EXPECT_TRUE(fits({41 * side, 0}, 0.002, margin)) << "or the margin, if it is less";
    }
    EXPECT_FALSE(fits({0, 43 * side}, 0.03, Margin::least, 12)) << "a quarter of a turn";
    EXPECT_TRUE(fits({0, 44 * side}, 0.03, Margin::least, 12));
    EXPECT_TRUE(fits({43 * side, 0}, 0.03, Margin::least, 12));
  }
}

TEST(FootprintSpace, KeepsHalfACentimetreWhereItIsTight) {
  const auto fits = [](const Eigen::Array2i& off, double length_m) {
    return space_with_a_post(off, {.outline = rectangle(length_m, 0.5)}, {.margin_m = 0.03})
        ->fits(kMiddleCell, 0, Margin::tight);
  };
  EXPECT_FALSE(fits({41, 0}, 0.813)) << "3.5 mm";
  EXPECT_TRUE(fits({42, 0}, 0.826)) << "7 mm";
}

/// Wherever within two cells it is put, what is covered in any case must be free.
TEST(FootprintSpace, MayFitUnlessWhatIsCoveredInAnyCaseIsNot) {
  const auto may_fit = [](const Eigen::Array2i& off, Margin margin) {
    return space_with_a_post(off, long_robot(), {.margin_m = 0.03})
        ->may_fit(kMiddleCell, 0, margin);
  };
  for (const int side : {-1, 1}) {
    EXPECT_FALSE(may_fit({41 * side, 0}, Margin::least));
    EXPECT_TRUE(may_fit({42 * side, 0}, Margin::least));
    EXPECT_FALSE(may_fit({39 * side, 0}, Margin::tight));
    EXPECT_TRUE(may_fit({40 * side, 0}, Margin::tight));
    EXPECT_FALSE(may_fit({0, 23 * side}, Margin::tight));
    EXPECT_TRUE(may_fit({0, 24 * side}, Margin::tight));
  }
}

TEST(FootprintSpace, MayFitWhereAPlaceWithinTwoCellsFits) {
  Rng rng(7);
  int fitting = 0;
  int ruled_out = 0;
  for (int scene = 0; scene < 4; ++scene) {
    std::vector<Eigen::AlignedBox2d> walls;
    for (int i = 0; i < 6; ++i) {
      const double x = rng.uniform(0.0, 2.0);
      const double y = rng.uniform(0.0, 2.0);
      walls.push_back(wall(x, y, x + rng.uniform(0.02, 0.3), y + rng.uniform(0.02, 0.3)));
    }
    const auto space =
        DrawnRooms(2.0, 2.0, walls).space({.outline = rectangle(0.5, 0.3)}, {.headings = 12});
    for (int place = 0; place < 400; ++place) {
      const Eigen::Array2i middle(10 * (place % 20) + 2, 10 * (place / 20) + 2);
      for (int heading = 0; heading < 12; ++heading) {
        for (const Margin margin : {Margin::least, Margin::tight}) {
          bool fits = false;
          for (int k = 0; k < 25; ++k) {
            fits =
                fits || space->fits(middle + Eigen::Array2i(k % 5 - 2, k / 5 - 2), heading, margin);
          }
          const bool may_fit = space->may_fit(middle, heading, margin);
          EXPECT_TRUE(may_fit || !fits) << middle.transpose() << " at " << heading;
          fitting += fits ? 1 : 0;
          ruled_out += may_fit ? 0 : 1;
        }
      }
    }
  }
  EXPECT_GT(fitting, 100);
  EXPECT_GT(ruled_out, 100);
}

/// After half a turn it comes back the way it went: what is ahead and to its left on one way is
/// behind and to its right on the other.
TEST(FootprintSpace, OfWhatGoesAlongItsHeadingIsForBothWays) {
  const auto robot = [](bool goes_sideways) {
    return RobotOutline{.outline = {{-0.2, -0.1}, {0.4, -0.1}, {0.4, 0.2}, {-0.2, 0.2}},
                        .goes_sideways = goes_sideways};
  };
  const auto fits = [&](const Eigen::Array2i& off, bool goes_sideways) {
    return space_with_a_post(off, robot(goes_sideways), {.margin_m = 0.001})->fits(kMiddleCell, 0);
  };
  for (const bool goes_sideways : {false, true}) {
    EXPECT_FALSE(fits({30, 0}, goes_sideways));
    EXPECT_FALSE(fits({30, 18}, goes_sideways));
    EXPECT_EQ(fits({-30, 0}, goes_sideways), goes_sideways);
    EXPECT_EQ(fits({30, -12}, goes_sideways), goes_sideways);
    EXPECT_TRUE(fits({30, -18}, goes_sideways)) << "beside the corner between both";
    const auto space = space_with_a_post({50, 50}, robot(goes_sideways), {});
    EXPECT_NEAR(space->circumscribed_m(), std::hypot(0.4, 0.2), 1e-12);
  }
}

TEST(FootprintSpace, ARobotMayStandWhereItsInscribedDiscDoes) {
  const auto may_stand = [](const Eigen::Array2i& off, const RobotOutline& robot) {
    return space_with_a_post(off, robot, {})->may_stand(kMiddleCell);
  };
  EXPECT_FALSE(may_stand({24, 0}, long_robot()));
  EXPECT_TRUE(may_stand({26, 0}, long_robot()));
  EXPECT_FALSE(may_stand({0, -24}, long_robot()));
  EXPECT_TRUE(may_stand({0, -26}, long_robot()));
  EXPECT_FALSE(may_stand({17, -17}, long_robot())) << "0.240 m";
  EXPECT_TRUE(may_stand({18, -18}, long_robot())) << "0.255 m";
  const RobotOutline uneven{.outline = {{-0.2, -0.1}, {0.4, -0.1}, {0.4, 0.2}, {-0.2, 0.2}}};
  EXPECT_FALSE(may_stand({9, 0}, uneven));
  EXPECT_TRUE(may_stand({12, 0}, uneven));
  const RobotOutline wider{.outline = rectangle(0.815, 0.505)};
  for (const Eigen::Array2i& side :
       {Eigen::Array2i(1, 0), Eigen::Array2i(0, 1), Eigen::Array2i(-1, 0), Eigen::Array2i(0, -1)}) {
    EXPECT_FALSE(may_stand(25 * side, wider)) << "0.2525 m";
    EXPECT_TRUE(may_stand(26 * side, wider));
  }
}

TEST(FootprintSpace, SeesAPostAnywhereUnderALongOutline) {
  DrawnRooms rooms(3.0, 0.5, {});
  const RobotOutline robot{.outline = rectangle(1.51, 0.2)};
  for (int x = 0; x < 300; ++x) {
    float& log_odds = rooms.detail.log_odds[rooms.detail.index({x, 20})];
    log_odds = 3.0F;
    const auto space = rooms.space(robot, {.margin_m = 0.001, .headings = 4});
    EXPECT_EQ(space->fits({150, 25}, 0), std::abs(x - 150) > 75) << x;
    log_odds = -3.0F;
  }
}

TEST(FootprintSpace, EndsWithTheMapOnEverySide) {
  const DrawnRooms rooms(2.0, 2.0, {});
  const auto space = rooms.space(long_robot(), {.margin_m = 0.001});
  EXPECT_TRUE(space->fits({40, 100}, 0));
  EXPECT_FALSE(space->fits({39, 100}, 0));
  EXPECT_TRUE(space->fits({159, 100}, 0));
  EXPECT_FALSE(space->fits({160, 100}, 0));
  EXPECT_TRUE(space->fits({100, 25}, 0));
  EXPECT_FALSE(space->fits({100, 24}, 0));
  EXPECT_TRUE(space->fits({100, 174}, 0));
  EXPECT_FALSE(space->fits({100, 175}, 0));
  const auto with_a_post = [](const Eigen::Array2i& off) {
    return space_with_a_post(off, long_robot(), {.margin_m = 0.001});
  };
  EXPECT_TRUE(space->fits({40, 25}, 0));
  EXPECT_FALSE(with_a_post({-100, -100})->fits({40, 25}, 0)) << "in the first cell";
  EXPECT_TRUE(space->fits({159, 174}, 0));
  EXPECT_FALSE(with_a_post({99, 99})->fits({159, 174}, 0)) << "in the last cell";
}

TEST(FootprintSpace, HeadingsGoRound) {
  const auto space = DrawnRooms(2.0, 2.0, {}).space(long_robot(), {});
  EXPECT_EQ(space->headings(), 48);
  EXPECT_NEAR(space->heading_rad(12), 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(space->heading_rad(36), -0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(space->heading_rad(1), std::numbers::pi / 24.0, 1e-12);
  EXPECT_EQ(space->nearest_heading(0.064), 0);
  EXPECT_EQ(space->nearest_heading(0.067), 1);
  EXPECT_EQ(space->nearest_heading(-0.064), 0);
  EXPECT_EQ(space->nearest_heading(-0.067), 47);
  EXPECT_EQ(space->nearest_heading(3.1), 24);
  EXPECT_EQ(space->nearest_heading(-3.1), 24);
  EXPECT_EQ(space->nearest_heading(7.0), 5);
}

TEST(FootprintSpace, TheDiscThatARobotStandsOnReachesAsFarAlongEitherAxis) {
  const RobotOutline robot{.outline = rectangle(0.815, 0.501)};
  for (const Eigen::Array2i& side :
       {Eigen::Array2i(1, 0), Eigen::Array2i(0, 1), Eigen::Array2i(-1, 0), Eigen::Array2i(0, -1)}) {
    EXPECT_FALSE(space_with_a_post(25 * side, robot, {})->may_stand(kMiddleCell)) << "0.2505 m";
    EXPECT_TRUE(space_with_a_post(26 * side, robot, {})->may_stand(kMiddleCell));
  }
}

/// Against every point of the floor, at headings a tenth of a degree apart. Rows are whole, and
/// between the headings of the mask up to half a cell of a corner is left.
TEST(FootprintSpace, TurnsWhereNoHeadingOnTheWayMeetsAPost) {
  const FloorOutline outline = rectangle(0.815, 0.5);
  const double margin_m = 0.02;
  const double step_rad = 2.0 * std::numbers::pi / 48.0;
  Rng rng(5);
  int met_on_the_way_alone = 0;
  for (int post = 0; post < 400; ++post) {
    const double at_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double away_m = rng.uniform(0.4, 0.52);
    const Eigen::Array2i off =
        (100.0 * away_m * Eigen::Array2d(std::cos(at_rad), std::sin(at_rad))).round().cast<int>();
    const auto space = space_with_a_post(off, long_robot(), {.margin_m = margin_m});
    const Eigen::Vector2d p_m = 0.01 * off.cast<double>().matrix();
    const auto meets = [&](double yaw_rad, double more_m) {
      bool inside = false;
      for_each_row_inside(moved(grown(outline, margin_m + more_m), {0.0, 0.0, yaw_rad}), p_m, 1.0,
                          [&](int row, int first, int last) {
                            inside = inside || (row == 0 && first <= 0 && last >= 0);
                          });
      return inside;
    };
    for (const int heading : {0, 5, 47}) {
      bool surely = false;
      bool perhaps = false;
      for (int k = 0; k <= 75; ++k) {
        const double yaw_rad = (heading + k / 75.0) * step_rad;
        surely = surely || meets(yaw_rad, -0.005);
        perhaps = perhaps || meets(yaw_rad, 0.005);
      }
      const bool fits = space->fits_turning(kMiddleCell, heading);
      EXPECT_TRUE(perhaps || fits) << off.transpose() << " at " << heading;
      EXPECT_TRUE(!surely || !fits) << off.transpose() << " at " << heading;
      const bool at_ends =
          space->fits(kMiddleCell, heading) && space->fits(kMiddleCell, (heading + 1) % 48);
      EXPECT_TRUE(at_ends || !fits);
      met_on_the_way_alone += at_ends && !fits ? 1 : 0;
    }
  }
  EXPECT_GT(met_on_the_way_alone, 5);
}

TEST(HeadingAlong, OfAWayOfLessThanAMicrometreIsTheOneGiven) {
  const RobotOutline robot{.outline = rectangle(0.3, 0.2), .goes_sideways = false};
  const auto heading_rad = [&](double length_m) {
    return heading_along(robot, {0.0, 0.0}, {0.0, length_m}, 0.3);
  };
  EXPECT_EQ(heading_rad(0.8e-6), 0.3);
  EXPECT_NEAR(heading_rad(1.5e-6), 0.5 * std::numbers::pi, 1e-9);
}

/// Rows of 65 cells take two words of 64 bits each.
TEST(FootprintSpace, TellsTheLastCellOfARowFromTheFirstOfTheNextOne) {
  for (const bool first : {false, true}) {
    DrawnRooms rooms(0.65, 0.2, {});
    const Eigen::Array2i post = first ? Eigen::Array2i(0, 10) : Eigen::Array2i(64, 9);
    rooms.detail.log_odds[rooms.detail.index(post)] = 3.0F;
    const auto space =
        rooms.space({.outline = rectangle(0.025, 0.025)}, {.margin_m = 0.001, .headings = 4});
    EXPECT_EQ(space->fits({63, 9}, 0), first);
    EXPECT_EQ(space->fits({1, 10}, 0), !first);
  }
}

/// Where words of 64 cells meet, and at both ends of the row.
TEST(FootprintSpace, SeesAPostWhereverTheOutlineBeginsAndEnds) {
  for (const int reach : {5, 75}) {
    const RobotOutline robot{.outline = rectangle(0.02 * reach + 0.01, 0.2)};
    for (const int post : {0, 1, 62, 63, 64, 65, 126, 127, 128, 129, 191, 192, 255, 256, 299}) {
      DrawnRooms rooms(3.0, 0.5, {});
      rooms.detail.log_odds[rooms.detail.index({post, 20})] = 3.0F;
      const auto space = rooms.space(robot, {.margin_m = 0.001, .headings = 4});
      for (int x = reach; x < 300 - reach; ++x) {
        EXPECT_EQ(space->fits({x, 25}, 0), std::abs(x - post) > reach) << x << " " << post;
      }
    }
  }
}

/// Rows are whole, from the leftmost to the rightmost cell of nine headings.
TEST(FootprintSpace, ATurnIsLookedAtInEightSteps) {
  DrawnRooms rooms(3.0, 3.0, {});
  const Eigen::Array2i post(150, 150);
  rooms.detail.log_odds[rooms.detail.index(post)] = 3.0F;
  const RobotOutline robot{.outline = rectangle(0.906, 0.5042)};
  const auto space = rooms.space(robot, {.margin_m = 0.001});
  const FloorOutline kept = grown(robot.outline, 0.001);
  for (int heading = 2; heading < 48; heading += 5) {
    std::map<int, std::pair<int, int>> rows;
    for (int step = 0; step <= 8; ++step) {
      const double yaw_rad = (heading + step / 8.0) * std::numbers::pi / 24.0;
      for_each_row_inside(moved(kept, {0.0, 0.0, yaw_rad}), Eigen::Vector2d::Zero(), 0.01,
                          [&](int row, int first, int last) {
                            auto& ends = rows.try_emplace(row, first, last).first->second;
                            ends.first = std::min(ends.first, first);
                            ends.second = std::max(ends.second, last);
                          });
    }
    for (int y = -53; y <= 53; ++y) {
      const auto row = rows.find(y);
      for (int x = -53; x <= 53; ++x) {
        const bool meets = row != rows.end() && x >= row->second.first && x <= row->second.second;
        EXPECT_EQ(space->fits_turning(post - Eigen::Array2i(x, y), heading), !meets)
            << x << " " << y << " at " << heading;
      }
    }
  }
}

/// What 5 x 5 cells have in common wherever within two cells they are put is one cell.
TEST(FootprintSpace, MayFitUnlessTheOneCellThatIsCoveredInAnyCaseIsNot) {
  const auto may_fit = [](const Eigen::Array2i& off) {
    return space_with_a_post(off, {.outline = rectangle(0.048, 0.048)}, {.margin_m = 0.001})
        ->may_fit(kMiddleCell, 0);
  };
  EXPECT_FALSE(may_fit({0, 0}));
  for (const int side : {-1, 1}) {
    EXPECT_TRUE(may_fit({side, 0}));
    EXPECT_TRUE(may_fit({0, side}));
  }
}

TEST(FootprintSpace, FitsAlongAShortWayOnlyIfAtBothEnds) {
  const auto space = space_with_a_post({42, 0}, long_robot(), {});
  const FloorOutline outline = long_robot().outline;
  const Eigen::Vector2d from_m = space->centre(kMiddleCell);
  const Eigen::Vector2d to_m = from_m + Eigen::Vector2d(0.015, 0.0);
  EXPECT_TRUE(space->fits_along(outline, from_m, from_m, 0.0));
  EXPECT_FALSE(space->fits_along(outline, from_m, to_m, 0.0));
  EXPECT_FALSE(space->fits_along(outline, to_m, from_m, 0.0));
}

TEST(FootprintSpace, RejectsOptionsOutOfRange) {
  const DrawnRooms rooms(2.0, 2.0, {});
  EXPECT_NO_THROW(static_cast<void>(rooms.space(long_robot(), {.headings = 4})));
  EXPECT_THROW(static_cast<void>(rooms.space(long_robot(), {.headings = 3})), ConfigError);
}

/// It is 8 mm wide where the post is, and the way of 5.9 cm is looked at at both ends and in its
/// middle.
TEST(FootprintSpace, FitsAlongAWayWhereItFitsEveryThreeCentimetres) {
  const FloorOutline diamond{{-0.004, 0.0}, {0.0, -0.1}, {0.004, 0.0}, {0.0, 0.1}};
  const auto space = space_with_a_post({0, 0}, long_robot(), {});
  const auto fits = [&](double begins_m) {
    const Eigen::Vector2d from_m = space->centre(kMiddleCell) + Eigen::Vector2d(begins_m, 0.0);
    return space->fits_along(diamond, from_m, from_m + Eigen::Vector2d(0.059, 0.0), 0.0);
  };
  EXPECT_TRUE(fits(-0.01475)) << "half way to its middle";
  EXPECT_FALSE(fits(-0.0295)) << "in its middle";
  EXPECT_FALSE(fits(0.0));
  EXPECT_FALSE(fits(-0.059));
}

TEST(FootprintSpace, TurnsAnywhereIfItsCornersReachNoFartherThanTheMargin) {
  const FloorOutline outline = rectangle(0.5, 0.48);
  const double corners_m = circumscribed_radius_m(outline) - inscribed_radius_m(outline);
  const auto turns = [&](double margin_m) {
    return DrawnRooms(2.0, 2.0, {})
        .space({.outline = outline}, {.margin_m = margin_m, .headings = 4})
        ->turns_anywhere();
  };
  EXPECT_TRUE(turns(corners_m));
  EXPECT_FALSE(turns(corners_m - 1e-9));
}

}  // namespace
}  // namespace vantage
