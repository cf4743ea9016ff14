#include "vantage/belief/map/hole_filling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/belief/map/voxel_scene.hpp"

namespace vantage {
namespace {

using test::draw;
using test::Drawing;
using test::parse;
using test::random_grid;

/// E(S, O) as printed, over ordered pairs of neighbours, from the states of two grids.
double energy(const OccupancyGrid& hidden, const OccupancyGrid& observed,
              const HoleFilling& options) {
  const auto node = [](const OccupancyGrid& grid, const Eigen::Array3i& cell) {
    if (!grid.frame.contains(cell)) return 0;
    switch (grid.state(grid.frame.index(cell))) {
      case CellState::free: return 0;
      case CellState::unobserved: return -1;
      case CellState::occupied: return 1;
    }
    return 0;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    const Eigen::Array3i cell = hidden.frame.cell(i);
    const int s = node(hidden, cell);
    sum -= options.data_weight * s * node(observed, cell);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Eigen::Array3i neighbour = cell;
        neighbour[axis] += step;
        sum -= options.smoothness_weight * s * node(hidden, neighbour);
      }
    }
  }
  return sum;
}

TEST(HoleFilling, ClosesAPinholeInAWallButNotTheSpaceBehind) {
  // A wall across x = 2 in 3-D: free before it, unobserved behind it, one cell of it missed.
  GridFrame frame;
  frame.cells = {6, 5, 5};
  OccupancyGrid grid(frame);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const int x = frame.cell(i).x();
    grid.log_odds[i] = x < 2 ? -1.0F : (x == 2 ? 2.0F : 0.0F);
  }
  const std::size_t hole = frame.index({2, 2, 2});
  grid.log_odds[hole] = 0.0F;
  const FilledGrid filled = fill_holes(grid, {});
  EXPECT_EQ(filled.filled_cells, 1U);
  EXPECT_NEAR(filled.grid.p_occupied(hole), 0.7, 1e-6);
  EXPECT_TRUE(filled.converged);
  EXPECT_EQ(filled.passes, 2);
}

TEST(HoleFilling, DrawnScene) {
  const Drawing before{"....?????",  //
                       "..##?####",  //
                       "....?????",  //
                       "....?????"};
  // The gap: two occupied, two unobserved neighbours, sum 0, stays. No cell has more.
  EXPECT_EQ(draw(fill_holes(parse(before), {}).grid), before);
  const Drawing gap_before_free{".........",  //
                                "..##?####",  //
                                "....?????",  //
                                "....?????"};
  // Now two occupied against one unobserved: filled; then the cells below it pull the other way.
  EXPECT_EQ(draw(fill_holes(parse(gap_before_free), {}).grid), (Drawing{".........",  //
                                                                        "..#######",  //
                                                                        "....?????",  //
                                                                        "....?????"}));
}

TEST(HoleFilling, DataWeightHoldsCellsAsObserved) {
  const OccupancyGrid grid = parse({".#?#."});
  EXPECT_EQ(fill_holes(grid, {}).filled_cells, 1U);
  HoleFilling cautious;
  cautious.data_weight = 4.5;  // 2 * 1 * (1 + 1) < 4.5
  EXPECT_EQ(fill_holes(grid, cautious).filled_cells, 0U);
  HoleFilling indifferent;
  indifferent.smoothness_weight = 0.0;
  EXPECT_EQ(fill_holes(grid, indifferent).filled_cells, 0U);
}

TEST(HoleFilling, StopsWhenAPassChangesNothing) {
  const FilledGrid nothing = fill_holes(parse({"????", "????"}), {});
  EXPECT_EQ(nothing.passes, 1);
  EXPECT_TRUE(nothing.converged);
  HoleFilling one_pass;
  one_pass.max_passes = 1;
  const FilledGrid cut = fill_holes(parse({".#?#."}), one_pass);
  EXPECT_EQ(cut.passes, 1);
  EXPECT_FALSE(cut.converged);
}

TEST(HoleFilling, RejectsOptionsOutOfRange) {
  HoleFilling options;
  options.p_occupied_filled = 0.55;
  EXPECT_THROW(fill_holes(parse({"??"}), options), ConfigError);
}

struct RandomHoles {
  OccupancyGrid grid;
  HoleFilling options;
};
RandomHoles random_case(std::uint64_t seed) {
  Rng rng(seed);
  GridFrame frame;
  frame.cells = {1 + static_cast<int>(rng.uniform_index(5)),
                 1 + static_cast<int>(rng.uniform_index(5)),
                 1 + static_cast<int>(rng.uniform_index(5))};
  RandomHoles c{random_grid(frame, rng.uniform(0.1, 0.6), rng.uniform(0.0, 0.4), rng), {}};
  c.options.data_weight = rng.uniform(0.0, 3.0);
  c.options.smoothness_weight = rng.uniform(0.0, 3.0);
  return c;
}

RC_GTEST_PROP(HoleFillingProperty, OnlyUnobservedCellsFlip, (std::uint64_t seed)) {
  const auto [grid, options] = random_case(seed);
  const FilledGrid filled = fill_holes(grid, options);
  std::size_t flipped = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (filled.grid.log_odds[i] == grid.log_odds[i]) continue;
    RC_ASSERT(grid.state(i) == CellState::unobserved);
    RC_ASSERT(filled.grid.state(i) == CellState::occupied);
    ++flipped;
  }
  RC_ASSERT(flipped == filled.filled_cells);
}

RC_GTEST_PROP(HoleFillingProperty, EnergyNeverRisesAndIsTheOnePrinted, (std::uint64_t seed)) {
  const auto [grid, options] = random_case(seed);
  const FilledGrid filled = fill_holes(grid, options);
  RC_ASSERT(filled.energy.size() == static_cast<std::size_t>(filled.passes) + 1);
  RC_ASSERT(std::abs(filled.energy.front() - energy(grid, grid, options)) < 1e-9);
  RC_ASSERT(std::abs(filled.energy.back() - energy(filled.grid, grid, options)) < 1e-9);
  for (std::size_t pass = 1; pass < filled.energy.size(); ++pass) {
    RC_ASSERT(filled.energy[pass] <= filled.energy[pass - 1] + 1e-9);
  }
}

// Replays the passes in plain code: a cell flips exactly when that lowers the energy.
RC_GTEST_PROP(HoleFillingProperty, EachFlipLowersTheEnergy, (std::uint64_t seed)) {
  const auto [grid, options] = random_case(seed);
  OccupancyGrid hidden = grid;
  const auto occupied = static_cast<float>(log_odds_of(options.p_occupied_filled));
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (grid.state(i) != CellState::unobserved) continue;
      OccupancyGrid flipped = hidden;
      flipped.log_odds[i] = hidden.state(i) == CellState::occupied ? 0.0F : occupied;
      if (energy(flipped, grid, options) >= energy(hidden, grid, options) - 1e-9) continue;
      hidden = flipped;
      changed = true;
    }
  }
  RC_ASSERT(fill_holes(grid, options).grid.log_odds == hidden.log_odds);
}

TEST(HoleFilling, ACellThatNothingPullsStaysAsObserved) {
  HoleFilling options;
  options.data_weight = 0.0;  // the middle one has an occupied and an unobserved neighbour
  const FilledGrid filled = fill_holes(parse({"#??"}), options);
  EXPECT_EQ(filled.filled_cells, 0U);
  EXPECT_EQ(filled.passes, 1);
  EXPECT_TRUE(filled.converged);
}

/// The middle of the lower row waits for that of the upper one, and the last cell for both: it is
/// filled in the second pass, too.
TEST(HoleFilling, LaterPassesGoOnInIndexOrder) {
  const Drawing before{"#?#",  //
                       "#??"};
  const FilledGrid filled = fill_holes(parse(before), {});
  EXPECT_EQ(filled.filled_cells, 3U);
  EXPECT_EQ(filled.passes, 3);
  EXPECT_EQ(filled.energy, (std::vector{-4.0, -6.0, -14.0, -14.0}));
}

}  // namespace
}  // namespace vantage
