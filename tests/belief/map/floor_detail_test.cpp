#include "vantage/belief/map/floor_detail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

FloorMap floor_of_20cm() { return make_floor_map({.cell_m = 0.2, .half_size_m = 3.0}); }

/// Of a wall across x, as seen from the origin.
PlanarScan wall_at(double x_m, double sigma_m, Rng& rng) {
  PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 10.0};
  for (double azimuth = -0.6; azimuth <= 0.6; azimuth += 0.004) {
    scan.azimuth_rad.push_back(azimuth);
    scan.range_m.push_back(static_cast<float>(x_m / std::cos(azimuth) + sigma_m * rng.normal()));
  }
  return scan;
}

TEST(FloorDetail, PartsOfACellAreExactlyInIt) {
  const FloorMap floor = floor_of_20cm();
  const FloorMap detail = make_floor_detail(floor, {.parts = 5});
  EXPECT_EQ(detail.nx, 5 * floor.nx);
  EXPECT_NEAR(detail.cell_m, 0.04, 1e-12);
  const Eigen::Array2i cell(7, 12);
  EXPECT_NEAR((detail.centre(cell * 5 + 2) - floor.centre(cell)).norm(), 0.0, 1e-12);
  EXPECT_THROW(make_floor_detail(floor, {.parts = 4}), ConfigError);
}

TEST(FloorDetail, HasNoMoreCellsThanAFloorMay) {
  const FloorMapOptions floor{.half_size_m = 200.0};
  EXPECT_NO_THROW(floor.check());
  EXPECT_NO_THROW(check_floor_detail(floor, {.parts = 1}));
  EXPECT_THROW(check_floor_detail(floor, {.parts = 15}), ConfigError);
}

/// Noise of the beams makes no obstacle of what is before the wall.
TEST(FloorDetail, AFaceIsMeasuredToACell) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {.parts = 15});
  Rng rng(4);
  for (int i = 0; i < 10; ++i) add_beams(detail, wall_at(1.5, 0.01, rng), {}, {.parts = 15});
  int off = 0;
  for (double y_m = -0.6; y_m <= 0.6; y_m += 0.01) {
    double face_m = 0.0;
    while (detail.state_at({face_m, y_m}) != CellState::occupied && face_m < 2.0) face_m += 0.002;
    off += std::abs(face_m - 1.5) > 0.02 ? 1 : 0;
    EXPECT_EQ(detail.state_at({1.4, y_m}), CellState::free);
    EXPECT_EQ(detail.state_at({1.6, y_m}), CellState::unobserved);
  }
  EXPECT_LE(off, 3);
}

TEST(FloorDetail, KnowsNothingBeyondItsRange) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {});
  Rng rng(4);
  const FloorDetailOptions options{.range_m = 1.0};
  for (int i = 0; i < 3; ++i) add_beams(detail, wall_at(1.5, 0.0, rng), {}, options);
  EXPECT_EQ(detail.state_at({0.9, 0.0}), CellState::free);
  EXPECT_EQ(detail.state_at({1.2, 0.0}), CellState::unobserved);
  EXPECT_EQ(detail.state_at({1.5, 0.0}), CellState::unobserved);
}

TEST(FloorDetail, GoesByThePoseOfBaseAndSensor) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {});
  const PlanarScan scan{.T_base_sensor = {0.5, 0.0, 0.0},
                        .azimuth_rad = {0.0},
                        .range_m = {1.01F},
                        .range_max_m = 10.0};
  for (int i = 0; i < 3; ++i) add_beams(detail, scan, {1.01, -1.0, M_PI / 2.0}, {});
  EXPECT_EQ(detail.state_at({1.01, 0.0}), CellState::free);
  EXPECT_EQ(detail.state_at({1.01, 0.51}), CellState::occupied);
  EXPECT_EQ(detail.state_at({1.01, -0.7}), CellState::unobserved) << "behind the sensor";
}

TEST(FloorDetail, WhatTheRobotStandsOnIsFree) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {});
  detail.blocked[detail.index(detail.cell_at({0.5, 0.5}))] = 1;
  const FloorOutline square{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  clear_outline(detail, square);
  EXPECT_EQ(detail.state_at({0.1, 0.9}), CellState::free);
  EXPECT_EQ(detail.state_at({0.5, 0.5}), CellState::occupied);
  EXPECT_EQ(detail.state_at({-0.2, 0.5}), CellState::unobserved);
  for (std::size_t cell = 0; cell < detail.size(); ++cell) {
    EXPECT_EQ(is_free(detail, cell), detail.state(cell) == CellState::free);
    EXPECT_EQ(is_occupied(detail, cell), detail.state(cell) == CellState::occupied);
  }
}

TEST(FloorDetail, WhatOfTheRobotIsOffTheMapIsLeftOut) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {});  // 3 m to each side
  clear_outline(detail, FloorOutline{{-3.4, -3.4}, {-2.5, -3.4}, {-2.5, 3.4}, {-3.4, 3.4}});
  for (const double y_m : {-2.9, 0.0, 2.9}) {
    EXPECT_EQ(detail.state_at({-2.9, y_m}), CellState::free);
    EXPECT_EQ(detail.state_at({-2.3, y_m}), CellState::unobserved);
  }
}

/// Log odds of 0.7 for a beam that ends, -0.3 for one that goes on, up to 6: occupied from three
/// ends in ten on.
TEST(FloorDetail, CountsEachBeam) {
  FloorMap detail =
      make_floor_detail(make_floor_map({.cell_m = 1.0, .half_size_m = 4.0}), {.parts = 1});
  const FloorDetailOptions options{.parts = 1, .range_m = 3.0};
  const auto beams_to = [&](float range_m, int count) {
    const PlanarScan scan{.T_base_sensor = {},
                          .azimuth_rad = std::vector<double>(static_cast<std::size_t>(count), 0.0),
                          .range_m = std::vector<float>(static_cast<std::size_t>(count), range_m),
                          .range_max_m = 10.0};
    add_beams(detail, scan, {0.5, 0.5, 0.0}, options);
  };
  const auto log_odds = [&](double x_m) {
    return detail.log_odds[detail.index(detail.cell_at({x_m, 0.5}))];
  };
  beams_to(1.0F, 1);
  EXPECT_NEAR(log_odds(0.5), -0.3, 1e-6);
  EXPECT_NEAR(log_odds(1.5), 0.7, 1e-6);
  EXPECT_EQ(log_odds(2.5), 0.0F);
  beams_to(2.0F, 2);
  EXPECT_NEAR(log_odds(1.5), 0.7 - 0.6, 1e-6) << "one in three";
  EXPECT_NEAR(log_odds(2.5), 1.4, 1e-6);
  beams_to(3.0F, 1);
  EXPECT_NEAR(log_odds(3.5), 0.7, 1e-6) << "just at the range";
  beams_to(3.5F, 1);
  EXPECT_NEAR(log_odds(3.5), 0.4, 1e-6) << "beyond it";
  beams_to(1.0F, 20);
  EXPECT_EQ(log_odds(1.5), 6.0F);
  EXPECT_EQ(log_odds(0.5), -6.0F);
  const FloorOutline round{{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}};
  clear_outline(detail, round);
  EXPECT_EQ(log_odds(1.5), -2.0F);
  EXPECT_EQ(log_odds(0.5), -6.0F);
}

TEST(FloorDetail, OfAFloorThatIsNotSquareIsNoneEither) {
  const FloorMap floor(Eigen::Vector2d(-1.0, -2.0), 0.2, 7, 4);
  const FloorMap detail = make_floor_detail(floor, {.parts = 5});
  EXPECT_EQ(detail.nx, 35);
  EXPECT_EQ(detail.ny, 20);
  EXPECT_NEAR((detail.centre({32, 17}) - floor.centre({6, 3})).norm(), 0.0, 1e-12);
}

TEST(FloorDetail, MayHaveAsManyCellsAsAFloor) {
  EXPECT_NO_THROW(check_floor_detail({.half_size_m = 204.8}, {.parts = 1}));
  EXPECT_THROW(check_floor_detail({.half_size_m = 204.9}, {.parts = 1}), ConfigError);
  EXPECT_NO_THROW(check_floor_detail({.half_size_m = 68.2}, {.parts = 3}));
  try {
    check_floor_detail({.half_size_m = 68.3}, {.parts = 3});
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "floor_detail.parts 3, floor_map.half_size_m 68.3 and floor_map.cell_m 0.05 make "
                 "6.72e+07 cells, more than 2^26");
  }
}

TEST(FloorDetail, IsFreeOrOccupiedFromTheOddsOfTheStatesOn) {
  FloorMap map(Eigen::Vector2d::Zero(), 1.0, 201, 1);
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    map.log_odds[cell] = 0.01F * (static_cast<float>(cell) - 100.0F);
    EXPECT_EQ(is_free(map, cell), map.state(cell) == CellState::free) << map.log_odds[cell];
    EXPECT_EQ(is_occupied(map, cell), map.state(cell) == CellState::occupied) << map.log_odds[cell];
  }
}

TEST(FloorDetail, ABeamTurnsToTheLeftByItsAzimuth) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {});
  const PlanarScan scan{
      .T_base_sensor = {}, .azimuth_rad = {0.7}, .range_m = {1.5F}, .range_max_m = 10.0};
  for (int i = 0; i < 3; ++i) add_beams(detail, scan, {}, {});
  const Eigen::Vector2d end_m = 1.5 * Eigen::Vector2d(std::cos(0.7), std::sin(0.7));
  EXPECT_EQ(detail.state_at(end_m), CellState::occupied);
  EXPECT_EQ(detail.state_at(0.5 * end_m), CellState::free);
  EXPECT_EQ(detail.state_at({end_m.x(), -end_m.y()}), CellState::unobserved);
}

TEST(FloorDetail, BeamsBehindAnInvalidOneCount) {
  FloorMap detail = make_floor_detail(floor_of_20cm(), {});
  const PlanarScan scan{.T_base_sensor = {},
                        .azimuth_rad = {0.0, 0.0},
                        .range_m = {std::numeric_limits<float>::quiet_NaN(), 1.0F},
                        .range_max_m = 10.0};
  add_beams(detail, scan, {0.0, 0.0, 0.0}, {});
  EXPECT_EQ(detail.state_at({1.0, 0.0}), CellState::occupied);
}

}  // namespace
}  // namespace vantage
