#include "vantage/planners/swept_gain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"

namespace vantage {
namespace {

FieldOfView all_round(double tilt_rad = 1.4) {
  return {.half_width_rad = std::numbers::pi,
          .tilt_min_rad = -tilt_rad,
          .tilt_max_rad = tilt_rad,
          .range_min_m = 0.0,
          .range_max_m = 10.0};
}

FieldOfView sector() {
  return {.half_width_rad = 0.3, .tilt_min_rad = -0.4, .tilt_max_rad = 0.7, .range_max_m = 3.0};
}

OccupancyGrid unobserved_grid() {
  return OccupancyGrid(make_grid_frame({0.0, 0.0, 0.0}, {1.0, 1.2, 0.6}, {40, 30, 24}));
}

/// Boxes of occupied cells in space of which half is free.
OccupancyGrid cluttered_grid(std::uint64_t seed) {
  OccupancyGrid grid = unobserved_grid();
  const Eigen::Array3i n = grid.frame.cells;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.frame.cell(i).x() < n.x() / 2) grid.log_odds[i] = -2.0F;
  }
  Rng rng(seed);
  for (int box = 0; box < 12; ++box) {
    Eigen::Array3i from;
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = static_cast<int>(rng.uniform_index(static_cast<std::size_t>(n[axis] - 5)));
    }
    for (int k = 0; k < 125; ++k) {
      const Eigen::Array3i at = from + Eigen::Array3i(k % 5, k / 5 % 5, k / 25);
      grid.log_odds[grid.frame.index(at)] = 3.0F;
    }
  }
  return grid;
}

/// Blocks of very different transmission.
BlockField patchy_field(const Eigen::Array3i& cells) {
  BlockField field{.layout = {.cells = cells, .blocks = {5, 4, 3}}, .per_block = {}};
  Rng rng(7);
  while (field.per_block.size() < field.layout.size()) {
    field.per_block.push_back(rng.uniform(0.94, 1.0));
  }
  return field;
}

std::vector<Candidate> ring() {
  return ring_of_views({.positions = 7, .radius_m = 1.3, .height_m = 0.2}, Eigen::Vector3d::Zero());
}

Candidate view_at(const Eigen::Vector3d& p_m, double yaw_rad = 0.0) {
  Candidate view;
  view.T_world_sensor = make_pose(p_m, yaw_rad);
  return view;
}

double swept(const Gain& gain, const GainContext& context, const Candidate& view,
             const FieldOfView& field, int rays = 0) {
  return swept_gains_bits(gain, context, {&view, 1}, field, 1, {.rays_per_view = rays}).front();
}

double exact(const Gain& gain, const GainContext& context, const Candidate& view,
             const FieldOfView& field) {
  return exact_gain_bits(gain, context, view.T_world_sensor, field);
}

TEST(SweptGain, CountsEveryCellInViewOnceWhereNothingIsInTheWay) {
  const OccupancyGrid grid = unobserved_grid();
  const GridFrame& frame = grid.frame;
  const Eigen::Vector3d half_cell = 0.5 * frame.cell_size_m;
  for (const Eigen::Vector3d& p :
       {frame.centre({20, 15, 12}), frame.centre({0, 29, 3}), Eigen::Vector3d(0.013, 0.021, -0.107),
        Eigen::Vector3d(frame.centre({11, 7, 20}) + half_cell)}) {
    const Candidate view = view_at(p);
    EXPECT_EQ(swept(SimpleGain{}, {grid}, view, all_round()),
              exact(SimpleGain{}, {grid}, view, all_round()))
        << p.transpose();
  }
}

TEST(SweptGain, OfAPanoramaInClutterIsCloseToExact) {
  FieldOfView field = all_round();
  field.tilt_min_rad = -0.4;
  field.tilt_max_rad = 1.0;
  field.panorama = true;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OccupancyGrid grid = cluttered_grid(seed);
    const Candidate view = view_at({-0.21, 0.13, 0.05}, 0.7);
    const double expected = exact(SimpleGain{}, {grid}, view, field);
    EXPECT_GT(expected, 1000.0);
    EXPECT_NEAR(swept(SimpleGain{}, {grid}, view, field, 1024), expected, 0.04 * expected) << seed;
  }
}

TEST(SweptGain, OfViewsFromOutsideIsExactInEmptySpace) {
  const OccupancyGrid grid = unobserved_grid();
  for (const Candidate& view : ring()) {
    const double expected = exact(SimpleGain{}, {grid}, view, sector());
    EXPECT_GT(expected, 1000.0);
    EXPECT_NEAR(swept(SimpleGain{}, {grid}, view, sector()), expected, 2.0);
  }
}

TEST(SweptGain, SeesNothingBehindAWall) {
  OccupancyGrid grid = unobserved_grid();
  const GridFrame& frame = grid.frame;
  for (int y = 0; y < frame.cells.y(); ++y) {
    for (int z = 0; z < frame.cells.z(); ++z) grid.log_odds[frame.index({10, y, z})] = 3.0F;
  }
  const Candidate view = view_at({-1.5, 0.0, 0.0});
  const double in_front = 10.0 * 30.0 * 24.0;
  EXPECT_NEAR(swept(SimpleGain{}, {grid}, view, all_round()), in_front, 1e-6 * in_front);
}

TEST(SweptGain, FollowsBeerLambertInAnEvenMedium) {
  const OccupancyGrid grid = unobserved_grid();
  for (const double a : {0.999, 0.99, 0.95}) {
    const Gain gain = BeerLambertGain{.a = a};
    for (const Candidate& view : ring()) {
      const double expected = exact(gain, {grid}, view, sector());
      const double tolerance = 0.8 * (1.0 - a);
      EXPECT_NEAR(swept(gain, {grid}, view, sector()), expected, tolerance * expected) << a;
    }
  }
}

TEST(SweptGain, IsNearExactRaysInClutter) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const OccupancyGrid grid = cluttered_grid(seed);
    const BlockField transmission = patchy_field(grid.frame.cells);
    for (const Gain& gain : {Gain(SimpleGain{}), Gain(AdaptiveGain{})}) {
      for (const Candidate& view : ring()) {
        const double expected = exact(gain, {grid, &transmission}, view, sector());
        EXPECT_NEAR(swept(gain, {grid, &transmission}, view, sector(), 0), expected,
                    0.25 * expected);
        EXPECT_NEAR(swept(gain, {grid, &transmission}, view, sector(), 1024), expected,
                    0.05 * expected);
      }
    }
  }
}

TEST(SweptGain, ComesCloserToExactWithMoreRays) {
  const OccupancyGrid grid = cluttered_grid(4);
  const auto mean_error = [&](int rays) {
    double sum = 0.0;
    for (const Candidate& view : ring()) {
      sum += std::abs(swept(SimpleGain{}, {grid}, view, sector(), rays) -
                      exact(SimpleGain{}, {grid}, view, sector()));
    }
    return sum;
  };
  EXPECT_LT(mean_error(1 << 20), 0.3 * mean_error(0));
}

TEST(SweptGains, AreTheSameBitsForEveryNumberOfThreadsAndCompany) {
  const OccupancyGrid grid = cluttered_grid(5);
  const BlockField transmission = patchy_field(grid.frame.cells);
  const auto views = ring();
  const Gain gain = AdaptiveGain{};
  const auto one = swept_gains_bits(gain, {grid, &transmission}, views, sector(), 1);
  EXPECT_EQ(swept_gains_bits(gain, {grid, &transmission}, views, sector(), 2), one);
  EXPECT_EQ(swept_gains_bits(gain, {grid, &transmission}, views, sector(), 64), one);
}

TEST(SweptGain, OfAViewFarAwayIsZero) {
  const OccupancyGrid grid = cluttered_grid(6);
  for (const double distance_m : {5.0, 1e6, 1e12}) {
    EXPECT_EQ(swept(SimpleGain{}, {grid}, view_at({distance_m, 0.0, 0.0}), sector()), 0.0);
  }
}

TEST(SweptGains, OfNoCandidatesAreNone) {
  const OccupancyGrid grid = unobserved_grid();
  EXPECT_TRUE(swept_gains_bits(SimpleGain{}, {grid}, {}, sector(), 2).empty());
}

TEST(CanSweep, TheGainsWhoseLightOnlyFades) {
  EXPECT_TRUE(can_sweep(SimpleGain{}));
  EXPECT_TRUE(can_sweep(BeerLambertGain{}));
  EXPECT_TRUE(can_sweep(AdaptiveGain{}));
  EXPECT_TRUE(can_sweep(UnmappedVolumeGain{}));
  EXPECT_FALSE(can_sweep(PosteriorChainGain{}));
  EXPECT_FALSE(can_sweep(FsmiGain{}));
}

}  // namespace
}  // namespace vantage
