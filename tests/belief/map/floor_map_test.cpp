#include "vantage/belief/map/floor_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace vantage {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Twelve cells of 1 m from x = -6, one row of them at y in [0, 1) drawn.
FloorMapOptions metre_cells() { return {.cell_m = 1.0, .half_size_m = 6.0}; }

std::string row(const FloorMap& map, double y_m) {
  std::string drawn;
  for (int x = 0; x < map.nx; ++x) {
    const CellState state = map.state_at({map.centre({x, 0}).x(), y_m});
    drawn += state == CellState::free ? '.' : (state == CellState::occupied ? '#' : '?');
  }
  return drawn;
}

PlanarScan one_beam(float range_m, double azimuth_rad = 0.0) {
  return {
      .T_base_sensor = {}, .azimuth_rad = {azimuth_rad}, .range_m = {range_m}, .range_max_m = 4.0};
}

TEST(FloorMap, KnowsNothingAtFirst) {
  const FloorMap map = make_floor_map({});
  EXPECT_EQ(map.nx, 240);
  EXPECT_EQ(map.ny, 240);
  EXPECT_TRUE(map.min_corner_m.isApprox(Eigen::Vector2d(-6.0, -6.0)));
  for (std::size_t cell = 0; cell < map.size(); cell += 97) {
    EXPECT_EQ(map.state(cell), CellState::unobserved);
    EXPECT_EQ(map.index(map.cell(cell)), cell);
  }
  EXPECT_EQ(map.state_at({100.0, 0.0}), CellState::unobserved);
}

TEST(AddPlanarScan, FreesAlongTheBeamAndOccupiesItsEnd) {
  FloorMap map = make_floor_map(metre_cells());
  add_planar_scan(map, one_beam(3.0F), {-0.5, 0.5, 0.0}, metre_cells());
  //                                  x = 0
  EXPECT_EQ(row(map, 0.5), "?????...#???");
  EXPECT_EQ(row(map, 1.5), "????????????");
}

TEST(AddPlanarScan, FreesUpToTheRangeWithoutAReturn) {
  FloorMap map = make_floor_map(metre_cells());
  add_planar_scan(map, one_beam(kNothing), {-0.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(row(map, 0.5), "?????.....??");
}

TEST(AddPlanarScan, SkipsInvalidBeamsAndStopsAtTheBorder) {
  FloorMap map = make_floor_map(metre_cells());
  add_planar_scan(map, one_beam(std::nanf("")), {-0.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(row(map, 0.5), "????????????");
  add_planar_scan(map, one_beam(3.5F), {4.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(row(map, 0.5), "??????????..");
}

TEST(AddPlanarScan, GoesByThePoseOfBaseAndSensor) {
  FloorMap map = make_floor_map(metre_cells());
  PlanarScan scan = one_beam(2.0F, -std::numbers::pi / 2.0);
  scan.T_base_sensor = {1.0, 0.0, std::numbers::pi / 2.0};
  add_planar_scan(map, scan, {-2.5, 0.5, 0.0}, metre_cells());  // looks along x from x = -1.5
  EXPECT_EQ(row(map, 0.5), "????..#?????");
}

TEST(AddPlanarScan, AReturnOutweighsBeamsOfTheSameScan) {
  FloorMap map = make_floor_map(metre_cells());
  const PlanarScan scan{.T_base_sensor = {},
                        .azimuth_rad = {0.0, 0.0, 0.0},
                        .range_m = {4.0F, 2.0F, 4.0F},
                        .range_max_m = 10.0};
  add_planar_scan(map, scan, {-0.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(row(map, 0.5), "?????..#.#??");
}

TEST(AddPlanarScan, ForgetsWhatWentAwayAndStaysWithinTheLimit) {
  FloorMap map = make_floor_map(metre_cells());
  const Pose2 base{-0.5, 0.5, 0.0};
  for (int i = 0; i < 100; ++i) add_planar_scan(map, one_beam(2.0F), base, metre_cells());
  EXPECT_EQ(row(map, 0.5), "?????..#????");
  for (int i = 0; i < 8; ++i) add_planar_scan(map, one_beam(3.0F), base, metre_cells());
  EXPECT_EQ(row(map, 0.5), "?????...#???");
}

TEST(AddPlanarScan, DoesNotDependOnThreads) {
  FloorMap one = make_floor_map(metre_cells());
  FloorMap three = one;
  PlanarScan fan = one_beam(0.0F);
  fan.azimuth_rad.clear();
  fan.range_m.clear();
  for (int beam = 0; beam < 50; ++beam) {
    fan.azimuth_rad.push_back(-1.5 + 0.06 * beam);
    fan.range_m.push_back(beam % 9 == 0 ? kNothing : 1.0F + 0.05F * static_cast<float>(beam));
  }
  add_planar_scan(one, fan, {-0.5, 0.5, 0.2}, metre_cells(), 1);
  add_planar_scan(three, fan, {-0.5, 0.5, 0.2}, metre_cells(), 3);
  EXPECT_EQ(three.log_odds, one.log_odds);
}

TEST(BlockBox, OverridesEverything) {
  FloorMap map = make_floor_map(metre_cells());
  block_box(map, {Eigen::Vector2d(0.2, 0.2), Eigen::Vector2d(1.2, 0.8)});
  for (int i = 0; i < 5; ++i) {
    add_planar_scan(map, one_beam(kNothing), {-0.5, 0.5, 0.0}, metre_cells());
  }
  clear_footprint(map, {0.5, 0.5, 0.0}, 0.6);
  EXPECT_EQ(row(map, 0.5), "?????.##..??");
  EXPECT_EQ(row(map, 1.5), "????????????");
  block_box(map, {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(50.0, 50.0)});
  EXPECT_EQ(row(map, -5.5), "############");
}

TEST(BlockBox, OfNoExtentOrOffTheMapBlocksNothing) {
  FloorMap map = make_floor_map(metre_cells());
  block_box(map, {Eigen::Vector2d(0.8, 0.2), Eigen::Vector2d(0.2, 0.8)});  // within one cell
  block_box(map, {Eigen::Vector2d(0.2, 0.8), Eigen::Vector2d(0.8, 0.2)});
  block_box(map, {Eigen::Vector2d(6.5, -50.0), Eigen::Vector2d(50.0, 50.0)});
  block_box(map, {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(-6.5, 50.0)});
  block_box(map, {Eigen::Vector2d(-50.0, 6.5), Eigen::Vector2d(50.0, 50.0)});
  block_box(map, {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(50.0, -6.5)});
  EXPECT_EQ(std::ranges::count(map.blocked, std::uint8_t{1}), 0);
}

TEST(ClearFootprint, FreesTheDiscTheRobotStandsOn) {
  FloorMap map = make_floor_map(metre_cells());
  add_planar_scan(map, one_beam(1.0F), {-0.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(row(map, 0.5), "?????.#?????");
  clear_footprint(map, {0.5, 0.5, 0.0}, 1.1);
  EXPECT_EQ(row(map, 0.5), "?????...????");
  EXPECT_EQ(row(map, 1.5), "??????.?????");
  EXPECT_EQ(row(map, 2.5), "????????????");
}

TEST(FloorMapOptions, RejectWeightsThatNeverDecide) {
  EXPECT_THROW(make_floor_map({.log_odds_miss = 0.3}), ConfigError);
  EXPECT_THROW(make_floor_map({.cell_m = 0.0}), ConfigError);
}

TEST(FloorMapOptions, MakeACellAtLeastAndNoMoreThanMemoryHolds) {
  EXPECT_THROW(make_floor_map({.half_size_m = 1e-12}), ConfigError);
  EXPECT_EQ(make_floor_map({.half_size_m = 1e-3}).size(), 1U);
  EXPECT_NO_THROW(FloorMapOptions({.half_size_m = 204.8}).check());
  EXPECT_THROW(FloorMapOptions({.half_size_m = 205.0}).check(), ConfigError);
}

/// By default a return adds 1.5, a passing beam takes 0.5, and neither goes beyond 3.
TEST(AddPlanarScan, AddsAndTakesWhatItIsSaidTo) {
  FloorMap map = make_floor_map(metre_cells());
  const Pose2 base{-0.5, 0.5, 0.0};
  const auto log_odds = [&](double x_m) {
    return map.log_odds[map.index(map.cell_at({x_m, 0.5}))];
  };
  add_planar_scan(map, one_beam(2.0F), base, metre_cells());
  EXPECT_EQ(log_odds(1.5), 1.5F);
  EXPECT_EQ(log_odds(0.5), -0.5F);
  EXPECT_EQ(log_odds(-0.5), -0.5F) << "the robot's own cell";
  EXPECT_EQ(log_odds(2.5), 0.0F);
  for (int i = 0; i < 9; ++i) add_planar_scan(map, one_beam(2.0F), base, metre_cells());
  EXPECT_EQ(log_odds(1.5), 3.0F);
  EXPECT_EQ(log_odds(0.5), -3.0F);
  add_planar_scan(map, one_beam(4.0F), base, metre_cells());
  EXPECT_EQ(log_odds(3.5), 1.5F) << "a return at the greatest range is one";
  EXPECT_EQ(log_odds(1.5), 2.5F);
  clear_footprint(map, {1.5, 0.5, 0.0}, 1.0);
  EXPECT_EQ(log_odds(1.5), -2.0F);
  EXPECT_EQ(log_odds(2.5), -2.0F) << "just within the radius";
  EXPECT_EQ(log_odds(0.5), -3.0F) << "it was surer than that";
}

TEST(BlockBox, ReachesTheRimOfAMapThatIsNotSquareAndNoFarther) {
  FloorMap map(Eigen::Vector2d(-1.0, -2.0), 1.0, 5, 3);
  block_box(map, {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(50.0, 50.0)});
  EXPECT_EQ(std::ranges::count(map.blocked, std::uint8_t{1}), 15);
  for (const Eigen::Vector2d& outside : {Eigen::Vector2d(4.5, -0.5), Eigen::Vector2d(-1.5, -0.5),
                                         Eigen::Vector2d(1.5, 1.5), Eigen::Vector2d(1.5, -2.5)}) {
    EXPECT_EQ(map.state_at(outside), CellState::unobserved) << outside.transpose();
  }
}

TEST(FloorMapOptions, RejectAWeightThatIsOnlyJustTooSmall) {
  const double too_small = log_odds_of(kOccupiedAbove);
  for (double FloorMapOptions::*weight :
       {&FloorMapOptions::log_odds_hit, &FloorMapOptions::log_odds_miss,
        &FloorMapOptions::log_odds_limit}) {
    FloorMapOptions options = metre_cells();
    options.*weight = too_small;
    EXPECT_THROW(options.check(), ConfigError);
    options.*weight = too_small + 1e-3;
    EXPECT_NO_THROW(options.check());
  }
}

TEST(AddPlanarScan, AnInvalidBeamChangesNoCellAtAll) {
  const FloorMap before = make_floor_map(metre_cells());
  FloorMap map = before;
  add_planar_scan(map, one_beam(std::nanf("")), {-0.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(map.log_odds, before.log_odds);
}

TEST(AddPlanarScan, AReturnJustInRangeIsOneAndBeamsBehindAnInvalidOneCount) {
  FloorMap map = make_floor_map(metre_cells());
  const PlanarScan scan{.T_base_sensor = {},
                        .azimuth_rad = {0.0, 0.0},
                        .range_m = {std::nanf(""), 4.0F},
                        .range_max_m = 4.0};
  add_planar_scan(map, scan, {-5.5, 0.5, 0.0}, metre_cells());
  EXPECT_EQ(row(map, 0.5), "....#???????");
}

TEST(ClearFootprint, FreesACellWhoseCentreIsJustInReachAndTakesNoneBack) {
  FloorMap map = make_floor_map(metre_cells());
  const std::size_t freer = map.index(map.cell_at({0.5, 1.5}));
  map.log_odds[freer] = -2.5F;
  clear_footprint(map, {0.5, 0.5, 0.0}, 1.0);
  EXPECT_EQ(row(map, 0.5), "?????...????");
  EXPECT_EQ(map.log_odds[freer], -2.5F);
  EXPECT_EQ(map.log_odds[map.index(map.cell_at({0.5, 0.5}))], -2.0F);
}

TEST(FloorMapOptions, SayWhetherThereAreTooManyCellsOrNone) {
  const auto error_of = [](const FloorMapOptions& options) -> std::string {
    try {
      options.check();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(error_of({.half_size_m = 1e-12}).find("0 cells, not one"), std::string::npos);
  EXPECT_NE(error_of({.half_size_m = 205.0}).find("cells, more than 2^26"), std::string::npos);
}

}  // namespace
}  // namespace vantage
