#include "vantage/planners/swept_blocks.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "vantage/core/rng.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/tours/joint_gain.hpp"

namespace vantage {
namespace {

/// A box of 2.4 m, one third unobserved, a tenth occupied, in no order.
OccupancyGrid clutter_of_a_seed(std::uint64_t seed) {
  Rng rng(seed);
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {2.4, 2.4, 1.2}, {24, 23, 13}));
  for (float& log_odds : grid.log_odds) {
    const double draw = rng.uniform();
    log_odds = draw < 0.35 ? 0.0F : (draw < 0.45 ? 3.0F : -3.0F);
  }
  return grid;
}

std::vector<Candidate> some_views() {
  std::vector<Candidate> views(4);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double k = static_cast<double>(i);
    views[i].T_world_sensor = Pose(Eigen::Translation3d(0.3 * k - 0.5, 0.4 - 0.2 * k, 0.1) *
                                   Eigen::AngleAxisd(0.9 * k, Eigen::Vector3d::UnitZ()));
  }
  return views;
}

FieldOfView panorama() {
  FieldOfView field;
  field.range_max_m = 1.5;
  field.panorama = true;
  return field;
}

FieldOfView ahead() {
  FieldOfView field = panorama();
  field.panorama = false;
  field.half_width_rad = 0.5;
  return field;
}

class SweptBlocks : public testing::TestWithParam<FieldOfView> {};

/// A house of 8 x 6 x 2.4 m, of which the view sees a part.
TEST_P(SweptBlocks, OfOneViewAreThoseOfTheWholeGrid) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {8.0, 6.0, 2.4}, {161, 119, 24}));
  Rng rng(5);
  for (float& log_odds : grid.log_odds) {
    const double draw = rng.uniform();
    log_odds = draw < 0.3 ? 0.0F : (draw < 0.303 ? 3.0F : -3.0F);
  }
  const Attenuation attenuation = attenuation_of(BeerLambertGain{.a = 0.95}, {grid, nullptr});
  for (const int edge : {1, 4, 30}) {
    const CellBlocks blocks{grid.frame.cells, {edge, edge, edge}};
    for (const Candidate& view : some_views()) {
      Candidate moved = view;
      moved.T_world_sensor.pretranslate(Eigen::Vector3d(-3.0 + 5.0 * rng.uniform(), 2.4, 0.0));
      const ShownBlocks whole = swept_blocks(attenuation, grid, {&moved, 1}, GetParam(), blocks, 1);
      const ShownBlocks about = swept_blocks_of_view(attenuation, grid, moved, GetParam(), blocks);
      ASSERT_FALSE(whole.shows.front().block.empty());
      EXPECT_EQ(about.shows.front().block, whole.shows.front().block);
      EXPECT_EQ(about.shows.front().share, whole.shows.front().share) << "to the bit";
      for (const std::uint32_t block : about.shows.front().block) {
        EXPECT_EQ(about.cells[block], whole.cells[block]);
      }
    }
  }
}

TEST_P(SweptBlocks, SumToTheSweptGain) {
  const OccupancyGrid grid = clutter_of_a_seed(1);
  const GainContext context{grid, nullptr};
  const Gain gain = BeerLambertGain{.a = 0.95};
  const auto views = some_views();
  const auto gains_bits = swept_gains_bits(gain, context, views, GetParam(), 1, kNoRays);
  for (const int edge : {1, 3, 5, 100}) {
    const CellBlocks blocks{grid.frame.cells, {edge, edge, 2 * edge}};
    const ShownBlocks shown =
        swept_blocks(attenuation_of(gain, context), grid, views, GetParam(), blocks, 1);
    const double unobserved = std::accumulate(shown.cells.begin(), shown.cells.end(), 0.0);
    EXPECT_NEAR(unobserved, 0.35 * static_cast<double>(grid.frame.size()), 200.0);
    for (std::size_t i = 0; i < views.size(); ++i) {
      double sum = 0.0;
      const ShownShares& of_view = shown.shows[i];
      for (std::size_t k = 0; k < of_view.block.size(); ++k) {
        EXPECT_LE(of_view.share[k], 1.0F);
        sum += static_cast<double>(of_view.share[k] * shown.cells[of_view.block[k]]);
      }
      ASSERT_GT(gains_bits[i], 20.0);
      // Blocks of which a trace is seen are left out.
      EXPECT_NEAR(sum, gains_bits[i], edge == 100 ? 1e-3 * gains_bits[i] : 0.05 * gains_bits[i]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fields, SweptBlocks, testing::Values(panorama(), ahead()));

TEST(SweptBlocks, DoNotDependOnThreads) {
  const OccupancyGrid grid = clutter_of_a_seed(2);
  const GainContext context{grid, nullptr};
  const CellBlocks blocks{grid.frame.cells, {4, 4, 4}};
  const auto one = swept_blocks(attenuation_of(SimpleGain{}, context), grid, some_views(),
                                panorama(), blocks, 1);
  const auto three = swept_blocks(attenuation_of(SimpleGain{}, context), grid, some_views(),
                                  panorama(), blocks, 3);
  for (std::size_t i = 0; i < one.shows.size(); ++i) {
    EXPECT_EQ(one.shows[i].block, three.shows[i].block);
    EXPECT_EQ(one.shows[i].share, three.shows[i].share);
  }
}

TEST(SweptBlocks, AskOnceAViewWhetherToGoOn) {
  const OccupancyGrid grid = clutter_of_a_seed(3);
  const Attenuation attenuation = attenuation_of(SimpleGain{}, {grid, nullptr});
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  swept_blocks(attenuation, grid, some_views(), panorama(), {grid.frame.cells, {4, 4, 4}}, 1);
  EXPECT_EQ(asked, 4);
}

/// A wall without a gap: a view on either side shows blocks of its own side.
TEST(SweptBlocks, OfViewsOnTwoSidesOfAWallShareNothing) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {2.0, 2.0, 1.0}, {20, 20, 10}));
  for (int z = 0; z < 10; ++z) {
    for (int y = 0; y < 20; ++y) {
      for (const int x : {9, 10}) grid.log_odds[grid.frame.index({x, y, z})] = 3.0F;
    }
  }
  std::vector<Candidate> views(2);
  views[0].T_world_sensor = Pose(Eigen::Translation3d(-0.55, 0.05, 0.05));
  views[1].T_world_sensor = Pose(Eigen::Translation3d(0.55, 0.05, 0.05));
  const CellBlocks blocks{grid.frame.cells, {10, 5, 5}};
  const auto shown = swept_blocks(attenuation_of(SimpleGain{}, {grid, nullptr}), grid, views,
                                  panorama(), blocks, 2);
  for (const std::uint32_t block : shown.shows[0].block) EXPECT_EQ(block % 2, 0U);
  for (const std::uint32_t block : shown.shows[1].block) EXPECT_EQ(block % 2, 1U);
  EXPECT_EQ(shown.shows[0].block.size(), 8U);
}

TEST(SeparateBlocks, ShowEachViewsGainAlone) {
  const std::vector<double> gains{3.0, -1.0, 5.0};
  const ShownBlocks shown = separate_blocks(gains);
  EXPECT_EQ(shown.cells, (std::vector<float>{3.0F, 0.0F, 5.0F}));
  EXPECT_EQ(shown.shows[2].block, std::vector<std::uint32_t>{2});
  for (const ShownShares& of_view : shown.shows) {
    EXPECT_EQ(of_view.share, std::vector<float>{1.0F});
  }
}

TEST(SharesOfBlocks, LeaveOutLessThanAHundredthAndEndAtOne) {
  const ShownShares shown =
      shares_of_blocks({0.7F, 1.5F, 100.5F, 0.0F, 50.0F}, {100.0F, 100.0F, 100.0F, 0.0F, 100.0F});
  EXPECT_EQ(shown.block, (std::vector<std::uint32_t>{1, 2, 4}));
  ASSERT_EQ(shown.share.size(), 3U);
  EXPECT_FLOAT_EQ(shown.share[0], 0.015F);
  EXPECT_EQ(shown.share[1], 1.0F);
  EXPECT_FLOAT_EQ(shown.share[2], 0.5F);
}

}  // namespace
}  // namespace vantage
