// The parts of a sweep by themselves: rows of cells, a layer of transmittances, tables, blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/choice/partial_scans.hpp"
#include "vantage/planners/visibility/block_sums.hpp"
#include "vantage/planners/visibility/pyramid.hpp"
#include "vantage/planners/visibility/sweep_kernels.hpp"
#include "vantage/planners/visibility/sweep_tables.hpp"
#include "vantage/planners/visibility/transmittance_layer.hpp"

namespace vantage {
namespace {

using Numbers = std::vector<float>;
constexpr float kUntouched = -7.0F;

TEST(BlendRows, MixesTheCellsOfTheSpanAlone) {
  const Numbers a{1.0F, 2.0F, 4.0F, 8.0F};
  const Numbers b{5.0F, 6.0F, 0.0F, 8.0F};
  Numbers out(4, kUntouched);
  blend_rows(a.data(), b.data(), 0.25F, 1, 3, out.data());
  EXPECT_EQ(out, (Numbers{kUntouched, 3.0F, 3.0F, kUntouched}));
}

/// A row of cells of every kind, with room for what is crossed beside them.
struct RandomSweepRow {
  static constexpr int kCells = 48;
  Numbers arriving, cells, straight, slanted, straight_depth, slanted_depth;

  explicit RandomSweepRow(Rng& rng) {
    const auto number = [&](double low, double high) {
      return static_cast<float>(rng.uniform(low, high));
    };
    for (int i = 0; i < kCells; ++i) {
      arriving.push_back(i % 5 == 0 ? 0.001F : number(0.1, 1.0));
      cells.push_back(number(-0.3, 1.0));
      straight.push_back(i % 7 == 0 ? -1.0F : (i % 3 == 0 ? 0.0F : 1.0F));
      slanted.push_back(i % 11 == 0 ? -1.0F : (i % 4 == 0 ? 0.0F : 1.0F));
      straight_depth.push_back(number(0.01, 0.03));
      slanted_depth.push_back(number(0.01, 0.03));
    }
  }
  [[nodiscard]] SweepRow row(float source, float depth, float across) const {
    return {arriving.data() + 8,
            cells.data() + 8,
            straight.data() + 8,
            slanted.data() + 8,
            straight_depth.data() + 8,
            slanted_depth.data() + 8,
            source,
            depth,
            across};
  }
};

/// By the definition, in double precision.
double passed_by_definition(const SweepRow& row, int i) {
  const double along = (static_cast<double>(row.source) - i) / static_cast<double>(row.depth);
  const auto shift = static_cast<int>(std::floor(along));
  const double fraction = along - shift;
  const float* arriving = row.arriving + i + shift;
  const double arrives = (1.0 - fraction) * static_cast<double>(arriving[0]) +
                         fraction * static_cast<double>(arriving[1]);
  const int crossed = i + shift + (fraction < 0.5 ? 0 : 1);
  if (row.straight[i] < 0.0F || row.slanted[crossed] < 0.0F) return 0.0;
  double depth = 0.0;
  if (row.straight[i] > 0.0F) depth += static_cast<double>(row.straight_depth[i]);
  if (row.slanted[crossed] > 0.0F) {
    depth += (static_cast<double>(row.across) + std::abs(along)) *
             static_cast<double>(row.slanted_depth[crossed]);
  }
  return arrives * std::exp(-depth);
}

TEST(AdvanceRow, TakesTheLightWhereTheRayCameInAndWeakensIt) {
  Rng rng(5);
  for (const float source : {20.3F, -5.2F, 37.9F, 20.0F, 21.0F}) {  // the last two: half way once
    const RandomSweepRow random(rng);
    const SweepRow row = random.row(source, 20.0F, 0.6F);
    const int shift = source < 0.0F ? -1 : (source > 30.0F ? 1 : 0);
    Numbers visible(40, kUntouched);
    Numbers utility(40, kUntouched);
    advance_row(row, shift, 2, 13, visible.data(), utility.data());
    int dark = 0;
    int seen = 0;
    for (int i = 2; i < 13; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double expected = passed_by_definition(row, i);
      EXPECT_NEAR(visible[at], expected, 1e-5) << source << " " << i;
      const bool counts = visible[at] > kDark && row.cells[i] > 0.0F;
      EXPECT_FLOAT_EQ(utility[at], counts ? visible[at] * row.cells[i] : 0.0F);
      dark += expected == 0.0 ? 1 : 0;
      seen += counts ? 1 : 0;
    }
    EXPECT_GE(dark, 1);
    EXPECT_GE(seen, 2);
    for (const std::size_t beside : {0U, 1U, 18U, 19U}) EXPECT_EQ(visible[beside], kUntouched);
  }
}

TEST(AdvanceRow, WritesWholeEightsOfCells) {
  Rng rng(7);
  const RandomSweepRow random(rng);
  for (const int cells : {1, 8, 9, 16}) {
    Numbers visible(40, kUntouched);
    Numbers utility(40, kUntouched);
    advance_row(random.row(20.3F, 20.0F, 0.6F), 0, 2, 2 + cells, visible.data(), utility.data());
    const std::size_t end = cells > 8 ? 18 : 10;
    EXPECT_NE(visible[end - 1], kUntouched) << cells;
    EXPECT_EQ(visible[end], kUntouched) << cells;
    EXPECT_EQ(utility[end], kUntouched) << cells;
  }
}

TEST(AdvanceRow, LessThanATraceIsNotSeenAndOpaqueCellsStopAlmostAll) {
  Rng rng(6);
  RandomSweepRow random(rng);
  std::ranges::fill(random.cells, 1.0F);
  std::ranges::fill(random.slanted, 0.0F);
  std::ranges::fill(random.straight, 1.0F);
  std::ranges::fill(random.straight_depth, kOpaque);
  std::ranges::fill(random.arriving, 1.0F);
  Numbers visible(16);
  Numbers utility(16);
  advance_row(random.row(0.5F, 40.0F, 0.0F), 0, 0, 1, visible.data(), utility.data());
  EXPECT_NEAR(visible[0], 1.0 / 256.0, 1e-7);
  std::ranges::fill(random.straight, 0.0F);
  for (const float arrives : {0.0019F, kDark, 0.0021F}) {
    std::ranges::fill(random.arriving, arrives);
    advance_row(random.row(0.5F, 40.0F, 0.0F), 0, 0, 1, visible.data(), utility.data());
    EXPECT_FLOAT_EQ(visible[0], arrives);
    EXPECT_FLOAT_EQ(utility[0], arrives > 0.002F ? arrives : 0.0F);
  }
}

TEST(SumRuns, AddTheCellsOfTheRunThatTheViewHolds) {
  Numbers utility;
  for (int i = 0; i < 32; ++i) utility.push_back(static_cast<float>(i * i));
  EXPECT_EQ(sum_run(utility.data(), 3, 14), 819.0 - 5.0);  // squares up to 13, without those to 2
  EXPECT_EQ(sum_run(utility.data(), 4, 4), 0.0);
  ConeRow row;  // along the axis of a sensor that sees from 5 to 10
  row.step_m = {1.0F, 0.0F, 0.0F};
  row.tan_tilt_min = -1.0F;
  row.tan_tilt_max = 1.0F;
  row.range2_min_m2 = 25.0F;
  row.range2_max_m2 = 100.0F;
  Numbers kept(16, -1.0F);
  keep_in_view(row, utility.data(), 3, 14, kept.data());
  EXPECT_EQ(kept, (Numbers{-1, -1, -1, 0, 0, 25, 36, 49, 64, 81, 100, 0, 0, 0, -1, -1}));
}

bool is_span(const CellSpan& span, int begin, int end) {
  return span.begin == begin && span.end == end;
}

TEST(CellSpan, HoldsTheCellsBetween) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_span(CellSpan::between(-0.5, 2.5, 5), 0, 3));
  EXPECT_TRUE(is_span(CellSpan::between(1.0, 3.0, 5), 1, 4));
  EXPECT_TRUE(is_span(CellSpan::between(0.2, 9.0, 5), 1, 5));
  EXPECT_TRUE(is_span(CellSpan::between(-kFar, kFar, 5), 0, 5));
  EXPECT_TRUE(CellSpan::between(1.2, 1.8, 5).empty());
  EXPECT_TRUE(CellSpan::between(4.5, 9.0, 5).empty());
  EXPECT_TRUE(CellSpan::between(-9.0, -0.5, 5).empty());
  EXPECT_FALSE(CellSpan::between(-9.0, 0.0, 5).empty());
  CellSpan span;
  span.include({3, 5});
  span.include({4, 4});
  EXPECT_TRUE(is_span(span, 3, 5)) << "an empty one adds nothing";
  span.include({7, 9});
  EXPECT_TRUE(is_span(span, 3, 9));
  span.include({1, 4});
  EXPECT_TRUE(is_span(span, 1, 9));
  EXPECT_TRUE(is_span(span.cut({2, 6}), 2, 6));
  EXPECT_TRUE(is_span(span.cut({0, 20}), 1, 9));
}

TEST(TransmittanceLayer, LetsAllLightThroughAtFirst) {
  constexpr int kPadding = TransmittanceLayer::kPadding;
  TransmittanceLayer layer(4, 3);
  for (int v = -kPadding; v < 3 + kPadding; ++v) {
    for (int u = -kPadding; u < 4 + kPadding; ++u) {
      EXPECT_EQ(layer.row(v)[u], 1.0F) << u << " " << v;
    }
  }
}

/// Four columns and three rows, of which two cells were worked out.
TEST(TransmittanceLayer, GivesCellsAtItsRimTheirNeighboursLight) {
  TransmittanceLayer layer(4, 3);
  layer.set_known({1, 3}, {1, 2});
  for (int v = 0; v < 3; ++v) std::fill(layer.row(v), layer.row(v) + 4, 0.125F);
  layer.row(1)[1] = 0.5F;
  layer.row(1)[2] = 0.25F;
  layer.extend({-1, 6}, {-1, 5});
  for (int v = -1; v < 5; ++v) {
    const bool inside = v >= 0 && v < 3;
    const std::array<float, 7> expected =
        inside ? std::array{1.0F, 0.5F, 0.5F, 0.25F, 0.25F, 1.0F, 1.0F}
               : std::array{1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
    for (int u = -1; u < 6; ++u) {
      EXPECT_EQ(layer.row(v)[u], expected[static_cast<std::size_t>(u + 1)]) << u << " " << v;
    }
  }
  layer.set_known({}, {});
  layer.extend({0, 3}, {0, 2});
  EXPECT_EQ(layer.row(1)[2], 1.0F) << "nothing was worked out";
  EXPECT_EQ(layer.row(1)[3], 0.25F);
  EXPECT_EQ(layer.row(2)[2], 0.25F);
}

TEST(BlockSums, AddARowToTheBlocksItRunsThrough) {
  const CellBlocks blocks{{7, 4, 2}, {3, 2, 1}};
  ASSERT_EQ(blocks.size(), 3U * 2U * 2U);
  Numbers utility;
  for (int i = 0; i < 16; ++i) utility.push_back(static_cast<float>(1 << i));
  BlockSums sums(blocks);
  sums.add(utility.data(), 0, {1, 3, 1}, 7);
  sums.add(utility.data(), 1, {4, 0, 0}, 4);
  sums.add(utility.data(), 2, {0, 0, 0}, 2);
  Numbers expected(12, 0.0F);
  expected[9] = 2.0F + 4.0F;
  expected[10] = 8.0F + 16.0F + 32.0F;
  expected[11] = 64.0F;
  expected[1] = 1.0F + 2.0F;
  expected[4] = 4.0F + 8.0F;
  expected[0] = 1.0F;
  expected[6] = 2.0F;
  EXPECT_EQ(sums.sums(), expected);
}

TEST(SweepTables, HaveEveryCellInTheLayersOfEachAxis) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {4.0, 3.0, 2.0}, {4, 3, 2}));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    grid.log_odds[i] = i % 5 == 0 ? 3.0F : (i % 3 == 0 ? -3.0F : 0.01F * static_cast<float>(i));
  }
  BlockField transmission{.layout = {.cells = grid.frame.cells, .blocks = {2, 3, 1}},
                          .per_block = {0.9, 0.8, 0.7, 0.6, 0.5, 0.0}};
  const Attenuation attenuation{.transmission = transmission};
  const SweepTables tables(grid, attenuation, 2);
  const auto depth_at = [&](const Eigen::Array3i& at) {
    return static_cast<float>(std::min(-std::log(transmission.at_cell(at)), 64.0));
  };
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Array3i at = grid.frame.cell(i);
    const bool occupied = grid.state(i) == CellState::occupied;
    const bool free = grid.state(i) == CellState::free;
    const float utility = occupied ? -1.0F : attenuation.utility_of_cell(grid.log_odds[i]);
    for (int w = 0; w < 3; ++w) {
      const SweepAxes axes = sweep_axes(w);
      const int place =
          (at[axes.w] * grid.frame.cells[axes.v] + at[axes.v]) * grid.frame.cells[axes.u] +
          at[axes.u];
      EXPECT_EQ(tables.layers[static_cast<std::size_t>(w)][static_cast<std::size_t>(place)],
                utility);
      EXPECT_EQ(tables.row_of_depths(w, at[axes.v], at[axes.w])[at[axes.u]], depth_at(at));
    }
    EXPECT_EQ(tables.optical_depth(i), occupied ? kOpaque : (free ? 0.0F : depth_at(at)));
  }
  const float* row = tables.row_of_depths(0, 1, 3);  // along y
  EXPECT_EQ(row[-TransmittanceLayer::kPadding], depth_at({3, 0, 1}));
  EXPECT_EQ(row[2 + TransmittanceLayer::kPadding], depth_at({3, 2, 1}));
}

std::vector<bool> pyramids_seen(double half_width_rad, const Eigen::Vector3d& cell_size_m) {
  const FieldOfView field{
      .half_width_rad = half_width_rad, .tilt_min_rad = -0.3, .tilt_max_rad = 0.3};
  const ViewCone view(Pose::Identity(), field);
  std::vector<bool> seen;
  for (const Pyramid& pyramid : kPyramids) seen.push_back(may_see(view, pyramid, cell_size_m));
  return seen;
}

TEST(Pyramids, AreLookedIntoByViewsThatReachThem) {
  const Eigen::Vector3d cubes(1.0, 1.0, 1.0);
  EXPECT_EQ(pyramids_seen(0.3, cubes), (std::vector{true, false, false, false, false, false}));
  EXPECT_EQ(pyramids_seen(1.0, cubes), (std::vector{true, false, true, true, false, false}));
  EXPECT_EQ(pyramids_seen(0.3, {1.0, 1.0, 0.2}),
            (std::vector{true, false, false, false, true, true}))
      << "of flat cells many are above";
  EXPECT_EQ(pyramids_seen(1.0, {0.2, 1.0, 1.0}),
            (std::vector{true, false, false, false, false, false}));
}

TEST(BlocksOf, AnEdgeBeyondTheGridIsOneBlock) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {4.0, 3.0, 2.0}, {40, 30, 20});
  for (const double edge_m : {100.0, 1e9, 1e300}) {
    EXPECT_EQ(blocks_of(frame, edge_m).size(), 1U) << edge_m;
  }
}

TEST(RegionOfSweeps, IsAllOfTheGridForASensorThatSeesFarBeyond) {
  const GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {4.0, 6.0, 6.0}, {40, 60, 60});
  for (const double range_m : {20.0, 1e9, 1e30}) {
    const CellRegion region =
        region_of_sweeps(frame, {1.0, 1.0, 1.0}, range_m, Eigen::Array3i::Zero());
    EXPECT_TRUE((region.begin == 0).all() && (region.end == frame.cells).all()) << range_m;
  }
}

TEST(SweepTables, HaveTheDepthOfEachBlockAlongEveryAxis) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {4.0, 6.0, 6.0}, {4, 6, 6}));
  BlockField transmission{.layout = {.cells = grid.frame.cells, .blocks = {2, 3, 3}},
                          .per_block = {}};
  for (int i = 0; i < 18; ++i) transmission.per_block.push_back(0.95 - 0.05 * i);
  const Attenuation attenuation{.transmission = transmission};
  const SweepTables tables(grid, attenuation, 1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Array3i at = grid.frame.cell(i);
    const auto depth = static_cast<float>(-std::log(transmission.at_cell(at)));
    EXPECT_EQ(tables.optical_depth(i), depth) << at.transpose();
    for (int w = 0; w < 3; ++w) {
      const SweepAxes axes = sweep_axes(w);
      EXPECT_EQ(tables.row_of_depths(w, at[axes.v], at[axes.w])[at[axes.u]], depth)
          << at.transpose() << " along " << w;
    }
  }
}

bool is_region(const CellRegion& region, const Eigen::Array3i& begin, const Eigen::Array3i& end) {
  return (region.begin == begin).all() && (region.end == end).all();
}

/// Cells of 10 cm from the origin on, and 16 of them more on every side.
TEST(RegionOfSweeps, IsWhatIsSeenAndAsManyCellsRoundIt) {
  const GridFrame frame = make_grid_frame({10.0, 10.0, 10.0}, {20.0, 20.0, 20.0}, {200, 200, 200});
  const Eigen::Vector3d middle_m(10.05, 10.05, 10.05);
  const auto region = [&](const Eigen::Vector3d& p_m, const Eigen::Array3i& more) {
    return region_of_sweeps(frame, p_m, 1.0, more);
  };
  EXPECT_TRUE(is_region(region(middle_m, {0, 0, 0}), {74, 74, 74}, {127, 127, 127}));
  EXPECT_TRUE(is_region(region(middle_m, {20, 3, 17}), {70, 74, 73}, {131, 127, 128}));
  EXPECT_TRUE(is_region(region({0.55, 8.05, 19.45}, {0, 0, 0}), {0, 54, 168}, {32, 107, 200}));
  const CellRegion below = region({-30.0, 10.05, 10.05}, {0, 0, 0});
  EXPECT_EQ(below.begin.x(), 0);
  EXPECT_EQ(below.end.x(), 0);
  const CellRegion beyond = region({10.05, 50.0, 10.05}, {0, 0, 0});
  EXPECT_EQ(beyond.begin.y(), 200);
  EXPECT_EQ(beyond.end.y(), 200);
}

}  // namespace
}  // namespace vantage
