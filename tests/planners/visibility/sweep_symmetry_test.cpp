#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/swept_gain.hpp"

namespace vantage {
namespace {

constexpr std::array kCells{24, 20, 16};

/// Clutter of every size, down to single cells, in space that was not observed.
OccupancyGrid scattered_grid(std::uint64_t seed) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {0.6, 0.5, 0.4}, kCells));
  Rng rng(seed);
  for (float& log_odds : grid.log_odds) {
    if (rng.uniform(0.0, 1.0) < 0.04) log_odds = 3.0F;
  }
  return grid;
}

OccupancyGrid mirrored_in_x(const OccupancyGrid& grid) {
  OccupancyGrid image = grid;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    Eigen::Array3i at = grid.frame.cell(i);
    at.x() = kCells[0] - 1 - at.x();
    image.log_odds[grid.frame.index(at)] = grid.log_odds[i];
  }
  return image;
}

double gain_bits(const OccupancyGrid& grid, const Eigen::Vector3d& p_m) {
  Candidate view;
  view.T_world_sensor = make_pose(p_m, 0.0);
  const FieldOfView all_round{.half_width_rad = std::numbers::pi,
                              .tilt_min_rad = -1.4,
                              .tilt_max_rad = 1.4,
                              .range_min_m = 0.0,
                              .range_max_m = 10.0};
  return swept_gains_bits(SimpleGain{}, {grid}, {&view, 1}, all_round, 1, kEveryRay).front();
}

// Cells on either side of a shadow's edge are in doubt alike.
TEST(SweptGains, OfTheMirrorImageAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OccupancyGrid grid = scattered_grid(seed);
    const double expected_bits = gain_bits(grid, {-0.0713, 0.0291, 0.0177});
    EXPECT_GT(expected_bits, 500.0);
    EXPECT_NEAR(gain_bits(mirrored_in_x(grid), {0.0713, 0.0291, 0.0177}), expected_bits,
                1e-5 * expected_bits)
        << seed;
  }
}

/// A camera that looks straight down on a floor 20 cells below: of the outermost rows it sees both
/// ends, which are farther away, and not their middles.
TEST(SweptGains, OfRowsThatAreInViewAtBothEndsAloneAreThoseOfTheirCells) {
  GridFrame frame;
  frame.cells = {41, 27, 1};
  const OccupancyGrid grid(frame);
  const FieldOfView downwards{.half_width_rad = 0.47,
                              .tilt_min_rad = -1.3,
                              .tilt_max_rad = 1.3,
                              .range_min_m = 0.0,
                              .range_max_m = 100.0};
  Candidate view;
  view.T_world_sensor = make_pose(frame.centre({20, 13, 0}) + Eigen::Vector3d(0.0, 0.0, 20.0), 0.0,
                                  0.5 * std::numbers::pi);
  const double sine = std::sin(downwards.half_width_rad);
  double in_view = 0.0;
  for (int y = -13; y <= 13; ++y) {
    for (int x = -20; x <= 20; ++x) {
      in_view += y * y <= sine * sine * (400 + x * x + y * y) ? 1.0 : 0.0;
    }
  }
  EXPECT_EQ(in_view, 961.0);
  const Gain gain = SimpleGain{};
  EXPECT_EQ(exact_gain_bits(gain, {grid}, view.T_world_sensor, downwards), in_view);
  EXPECT_NEAR(swept_gains_bits(gain, {grid}, {&view, 1}, downwards, 1, kNoRays).front(), in_view,
              1e-3);
}

}  // namespace
}  // namespace vantage
