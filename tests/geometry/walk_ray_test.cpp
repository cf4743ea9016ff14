// The walk of a ray through the cells of a grid.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/grid_frame.hpp"

namespace vantage {
namespace {

/// 6 x 4 x 3 cells of 0.5 x 1.0 x 0.25 m with the corner at the origin.
GridFrame oblong_frame() { return make_grid_frame({1.5, 2.0, 0.375}, {3.0, 4.0, 0.75}, {6, 4, 3}); }

std::vector<std::size_t> walk(const GridFrame& grid, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& to) {
  std::vector<std::size_t> cells;
  const bool completed = walk_ray(grid, from, to, [&](std::size_t cell) {
    cells.push_back(cell);
    return true;
  });
  EXPECT_TRUE(completed);
  return cells;
}

int manhattan(const Eigen::Array3i& a, const Eigen::Array3i& b) { return (a - b).abs().sum(); }

Eigen::Vector3d random_point(const Eigen::AlignedBox3d& box, double beyond, Rng& rng) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) {
    const double margin = beyond * box.sizes()[axis];
    p[axis] = rng.uniform(box.min()[axis] - margin, box.max()[axis] + margin);
  }
  return p;
}

//   y cells, 0.5 m x 1 m              5 cells: one step for each face crossed
//   1  . . . # # .
//   0  . # # # . .
//      0 1 2 3 4 5   x
TEST(WalkRay, DrawnInAPlane) {
  const GridFrame grid = oblong_frame();
  const auto cells = walk(grid, {0.75, 0.25, 0.1}, {2.25, 1.5, 0.1});
  std::vector<std::size_t> expected;
  for (const auto& [x, y] : {std::pair{1, 0}, {2, 0}, {3, 0}, {3, 1}, {4, 1}}) {
    expected.push_back(grid.index({x, y, 0}));
  }
  EXPECT_EQ(cells, expected);
}

TEST(WalkRay, ParallelToEachAxisBothWays) {
  const GridFrame grid = oblong_frame();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d low = grid.centre({2, 2, 1});
    Eigen::Vector3d high = low;
    low[axis] = grid.box().min()[axis] + 1e-6;
    high[axis] = grid.box().max()[axis] - 1e-6;
    auto forth = walk(grid, low, high);
    const auto back = walk(grid, high, low);
    EXPECT_EQ(static_cast<int>(forth.size()), grid.cells[axis]);
    std::ranges::reverse(forth);
    EXPECT_EQ(forth, back);
  }
}

TEST(WalkRay, StartsAndEndsOutside) {
  const GridFrame grid = oblong_frame();
  const auto cells = walk(grid, {-5.0, 0.5, 0.1}, {50.0, 0.5, 0.1});
  ASSERT_EQ(cells.size(), 6U);
  EXPECT_EQ(cells.front(), grid.index({0, 0, 0}));
  EXPECT_EQ(cells.back(), grid.index({5, 0, 0}));
  EXPECT_TRUE(walk(grid, {-5.0, 0.5, 0.1}, {-1.0, 0.5, 0.1}).empty());
  EXPECT_TRUE(walk(grid, {-5.0, 9.0, 0.1}, {50.0, 9.0, 0.1}).empty());
}

TEST(WalkRay, APointIsOneCell) {
  const GridFrame grid = oblong_frame();
  EXPECT_EQ(walk(grid, {0.75, 0.25, 0.1}, {0.75, 0.25, 0.1}),
            std::vector<std::size_t>{grid.index({1, 0, 0})});
}

TEST(WalkRay, AlongAFaceBelongsToTheUpperCells) {
  const GridFrame grid = oblong_frame();
  const auto cells = walk(grid, {0.25, 1.0, 0.25}, {2.75, 1.0, 0.25});
  ASSERT_EQ(cells.size(), 6U);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i], grid.index({static_cast<int>(i), 1, 1}));
  }
}

// Through cell corners: still one face at a time, so neighbours only.
TEST(WalkRay, ThroughCornersStepsFaceByFace) {
  const GridFrame grid = make_grid_frame({1.5, 1.5, 1.5}, {3, 3, 3}, {3, 3, 3});
  const auto cells = walk(grid, {0, 0, 0}, {2.5, 2.5, 2.5});
  EXPECT_EQ(cells.size(), 7U);
  EXPECT_EQ(cells.back(), grid.index({2, 2, 2}));
}

TEST(WalkRay, EndsOnTheOuterFace) {
  const GridFrame grid = oblong_frame();
  const auto cells = walk(grid, {0.25, 0.5, 0.1}, {3.0, 0.5, 0.1});
  EXPECT_EQ(cells.size(), 6U);
  EXPECT_EQ(cells.back(), grid.index({5, 0, 0}));
}

TEST(WalkRay, StopsWhenAsked) {
  const GridFrame grid = oblong_frame();
  int visits = 0;
  const auto stop_at_third = [&](std::size_t) { return ++visits < 3; };
  EXPECT_FALSE(walk_ray(grid, {0.25, 0.5, 0.1}, {2.9, 0.5, 0.1}, stop_at_third));
  EXPECT_EQ(visits, 3);
  visits = -3;  // the third visit from here is the last cell
  EXPECT_FALSE(walk_ray(grid, {0.25, 0.5, 0.1}, {2.9, 0.5, 0.1}, stop_at_third));
  EXPECT_EQ(visits, 3);
}

TEST(WalkRay, TellsTheCellAsWellAsItsIndex) {
  const GridFrame grid = oblong_frame();
  for (const double up : {1.0, -1.0}) {
    const Eigen::Vector3d middle(1.5, 2.0, 0.375);
    const Eigen::Vector3d d(1.4, up * 1.8, -0.33);
    std::vector<std::size_t> cells;
    EXPECT_TRUE(
        walk_ray(grid, middle - d, middle + d, [&](std::size_t index, const Eigen::Array3i& cell) {
          EXPECT_EQ(index, grid.index(cell));
          cells.push_back(index);
          return true;
        }));
    EXPECT_EQ(cells, walk(grid, middle - d, middle + d));
    EXPECT_EQ(cells.size(), 1U + 5U + 3U + 2U);
  }
}

RC_GTEST_PROP(WalkRay, ConnectedAndAsLongAsTheManhattanDistance, (std::uint64_t seed)) {
  Rng rng(seed);
  const GridFrame grid = oblong_frame();
  const auto cells =
      walk(grid, random_point(grid.box(), 0.5, rng), random_point(grid.box(), 0.5, rng));
  if (cells.empty()) return;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    RC_ASSERT(manhattan(grid.cell(cells[i - 1]), grid.cell(cells[i])) == 1);
  }
  RC_ASSERT(static_cast<int>(cells.size()) ==
            1 + manhattan(grid.cell(cells.front()), grid.cell(cells.back())));
}

RC_GTEST_PROP(WalkRay, VisitsWhatDenseSamplesVisit, (std::uint64_t seed)) {
  Rng rng(seed);
  const GridFrame grid = oblong_frame();
  const Eigen::Vector3d from = random_point(grid.box(), 0.5, rng);
  const Eigen::Vector3d to = random_point(grid.box(), 0.5, rng);
  const auto cells = walk(grid, from, to);
  std::size_t position = 0;
  constexpr int kSamples = 3000;
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Vector3d p = from + (static_cast<double>(i) / kSamples) * (to - from);
    const Eigen::Array3d in_cell = (p - grid.min_corner_m).array() / grid.cell_size_m.array();
    const bool on_face = ((in_cell - in_cell.round()).abs() < 1e-9).any();
    const Eigen::Array3i cell = grid.cell_at(p);
    if (on_face || !grid.contains(cell)) continue;
    const auto found = std::find(cells.begin() + static_cast<std::ptrdiff_t>(position), cells.end(),
                                 grid.index(cell));
    RC_ASSERT(found != cells.end());  // visited, and in this order
    position = static_cast<std::size_t>(found - cells.begin());
  }
}

// The other way round: no cell is visited that the segment does not meet.
RC_GTEST_PROP(WalkRay, VisitsNothingElse, (std::uint64_t seed)) {
  Rng rng(seed);
  const GridFrame grid = oblong_frame();
  const Eigen::Vector3d from = random_point(grid.box(), 0.5, rng);
  const Eigen::Vector3d to = random_point(grid.box(), 0.5, rng);
  for (const std::size_t index : walk(grid, from, to)) {
    const Eigen::Vector3d half = 0.5 * grid.cell_size_m + Eigen::Vector3d::Constant(1e-9);
    const Eigen::Vector3d centre = grid.centre(grid.cell(index));
    RC_ASSERT(!clip_segment({centre - half, centre + half}, from, to).empty());
  }
}

// Ends on cell faces are where rounding would show.
RC_GTEST_PROP(WalkRay, EndsInTheCellOfItsEnd, (std::uint64_t seed)) {
  Rng rng(seed);
  const GridFrame grid = make_grid_frame({0.3, -0.7, 1.1}, {3.3, 2.1, 0.7}, {11, 7, 13});
  const Eigen::Vector3d from = random_point(grid.box(), 0.5, rng);
  const Eigen::Array3i corner(static_cast<int>(rng.uniform_index(11)),
                              static_cast<int>(rng.uniform_index(7)),
                              static_cast<int>(rng.uniform_index(13)));
  const Eigen::Vector3d to =
      grid.min_corner_m + (corner.cast<double>() * grid.cell_size_m.array()).matrix();
  if (!grid.contains(grid.cell_at(to)) || !grid.box().contains(to)) return;
  const auto cells = walk(grid, from, to);
  RC_ASSERT(!cells.empty());
  // On the outer face the clip may count rounding as leaving the box just before the end.
  if ((corner > 0).all()) RC_ASSERT(cells.back() == grid.index(grid.cell_at(to)));
}

/// Of faces that are met at once that across y comes first, and that across z last.
TEST(WalkRay, ThroughCornersStepsInThisOrder) {
  const GridFrame grid = make_grid_frame({1.5, 1.5, 1.5}, {3, 3, 3}, {3, 3, 3});
  std::vector<std::size_t> expected;
  for (const Eigen::Array3i& cell : {Eigen::Array3i(0, 0, 0),
                                     {0, 1, 0},
                                     {1, 1, 0},
                                     {1, 1, 1},
                                     {1, 2, 1},
                                     {2, 2, 1},
                                     {2, 2, 2}}) {
    expected.push_back(grid.index(cell));
  }
  EXPECT_EQ(walk(grid, {0, 0, 0}, {2.5, 2.5, 2.5}), expected);
}

TEST(WalkRay, HasNoStepsAlongAnAxisAtFirst) {
  const AxisWalk along;
  EXPECT_EQ(along.cell, 0);
  EXPECT_EQ(along.goal, 0);
  EXPECT_EQ(along.step, 0);
  EXPECT_EQ(along.stride, 0);
  EXPECT_TRUE(std::isinf(along.t_next));
  EXPECT_EQ(along.t_delta, 0.0);
}

}  // namespace
}  // namespace vantage
