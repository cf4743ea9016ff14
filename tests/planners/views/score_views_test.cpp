#include "vantage/planners/views/score_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "tests/support/octomap_bytes.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/views/sampled_views.hpp"

namespace vantage {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Gt;
using ::testing::HasSubstr;

FieldOfView camera(double range_max_m) {
  return {.half_width_rad = 0.5,
          .tilt_min_rad = -0.4,
          .tilt_max_rad = 0.4,
          .range_min_m = 0.0,
          .range_max_m = range_max_m};
}

Candidate view_at(int id, const Eigen::Vector3d& p_m, double yaw_rad = 0.0) {
  Candidate view;
  view.id = id;
  view.T_world_sensor = make_pose(p_m, yaw_rad);
  return view;
}

/// All but `adaptive`, with their defaults.
std::vector<Gain> gains_of_maps() {
  std::vector<Gain> gains;
  for (const std::string_view name : strategy_names<Gain>()) {
    if (name != AdaptiveGain::name) gains.push_back(make_strategy<Gain>(name));
  }
  return gains;
}

std::vector<Candidate> views_in_the_map(Rng& rng) {
  std::vector<Candidate> views;
  for (int i = 0; i < 8; ++i) {
    views.push_back(
        view_at(i, {rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5), rng.uniform(0.2, 1.4)}, i));
  }
  return views;
}

class ScoreViews : public ::testing::Test {
 protected:
  /// 32 x 32 x 16 cells of 10 cm; those in two corners are known, so that all are its region.
  OctomapFile random_map(double p_free, Rng& rng) {
    OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.8}, {3.2, 3.2, 1.6}, {32, 32, 16}));
    for (float& log_odds : grid.log_odds) {
      const double u = rng.uniform();
      log_odds = u < 0.01 ? 3.0F : (u < 0.01 + p_free ? -2.0F : 0.0F);
    }
    grid.log_odds.front() = grid.log_odds.back() = -2.0F;
    write_octomap(grid, directory_ / "map.ot");
    return OctomapFile(directory_ / "map.ot");
  }
  OctomapFile map(const std::vector<support::MapCube>& cubes, double resolution_m) {
    std::ofstream(directory_ / "map.bt", std::ios::binary)
        << support::octomap_bytes(cubes, resolution_m);
    return OctomapFile(directory_ / "map.bt");
  }
  support::TemporaryDirectory directory_;
};

TEST_F(ScoreViews, ARegionAllInViewCountsItsUnobservedCells) {
  const auto one = map({{{0, 0, 0}, 4, false}}, 0.1);
  const ScoredRegion region{.min_m = {{0.0, 0.0, 0.0}}, .max_m = {{0.8, 0.4, 0.4}}};
  const std::vector<Candidate> views{view_at(0, {-3.0, 0.2, 0.2}),
                                     view_at(1, {-3.0, 0.2, 0.2}, std::numbers::pi)};
  const auto gains = score_views(one, region, SimpleGain{}, views, camera(5.0), 1);
  EXPECT_NEAR(gains[0], 4 * 4 * 4, 1e-3);  // the other half is free
  EXPECT_EQ(gains[1], 0.0);                // looks away
  const auto known = score_views(one, {}, SimpleGain{}, views, camera(5.0), 1);
  EXPECT_EQ(known[0], 0.0);  // by default, what lies round the known cells does not count
}

TEST_F(ScoreViews, AViewThatDoesNotReachTheRegionIsWorthNothing) {
  const auto one = map({{{0, 0, 0}, 4, false}}, 0.1);
  const ScoredRegion region{.min_m = {{0.0, 0.0, 0.0}}, .max_m = {{0.8, 0.4, 0.4}}};
  const std::vector<Candidate> views{view_at(0, {-50.0, 0.2, 0.2}), view_at(1, {-1.0, 0.2, 0.2})};
  const auto gains = score_views(one, region, SimpleGain{}, views, camera(2.0), 1);
  EXPECT_EQ(gains[0], 0.0);
  EXPECT_GT(gains[1], 20.0);
  EXPECT_EQ(score_views(one, region, SimpleGain{}, {&views[0], 1}, camera(2.0), 1).front(), 0.0);
}

TEST(ScoreViewsOfAMeasuredMap, NoViewIsWorthLessThanNothing) {
  const std::filesystem::path path = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const OctomapFile corridor(path);
  const Eigen::AlignedBox3d box_m = corridor.box_of(corridor.known());
  Rng rng = Rng::stream(1, "sampled views");
  const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(3.5);
  const auto views =
      sample_views({}, corridor, {box_m.min() - reach_m, box_m.max() + reach_m}, rng);
  FieldOfView sensor = camera(3.5);
  sensor.half_width_rad = 0.5044;
  sensor.tilt_min_rad = -0.3927;
  sensor.tilt_max_rad = 0.3927;
  const Gain gain = BeerLambertGain{.a = std::pow(0.5, corridor.resolution_m())};
  const auto gains = score_views(corridor, {}, gain, views, sensor, 2);
  EXPECT_THAT(gains, Each(Ge(0.0)));
  EXPECT_THAT(gains, Contains(Gt(1000.0)));
}

TEST_F(ScoreViews, SameAsOnTheWholeGridWhicheverViewsAreListed) {
  struct Case {
    double p_free;
    int coarsen;
  };
  Rng rng(4);
  for (const auto& [p_free, coarsen] : {Case{0.48, 1}, Case{0.9, 1}, Case{0.48, 3}}) {
    const OctomapFile file = random_map(p_free, rng);
    const ScoredRegion region{.coarsen = coarsen};
    const OccupancyGrid whole = file.grid_of(region.cells(file), coarsen);
    const auto views = views_in_the_map(rng);
    const FieldOfView sensor = camera(1.2);  // its reach is less than the map
    for (const Gain& gain : gains_of_maps()) {
      const auto expected = view_gains_bits(gain, {whole}, views, sensor, 1);
      const auto together = score_views(file, region, gain, views, sensor, 2);
      for (std::size_t i = 0; i < views.size(); ++i) {
        const auto alone = score_views(file, region, gain, {&views[i], 1}, sensor, 1).front();
        const double rounding = (can_sweep(gain) ? 1e-4 : 1e-6) * std::abs(expected[i]) + 1e-9;
        EXPECT_NEAR(alone, expected[i], rounding) << strategy_name_of(gain) << i << p_free;
        EXPECT_NEAR(together[i], expected[i], rounding) << strategy_name_of(gain) << i << p_free;
      }
    }
  }
}

TEST_F(ScoreViews, ReadsBeyondTheReachWhatTheGainLooksAt) {
  const ScoredRegion region{.min_m = {{0.0, 0.0, 0.0}}, .max_m = {{3.2, 1.6, 1.6}}};
  const std::vector<Candidate> views{view_at(0, {0.35, 0.85, 0.85})};
  const FieldOfView sensor = camera(1.22);  // up to cell 15
  const auto free = map({{{0, 0, 0}, 16, false}}, 0.1);
  EXPECT_EQ(score_views(free, region, FrontierCellsGain{}, views, sensor, 1).front(), 13.0);
  const auto wall = map({{{16, 0, 0}, 16, true}}, 0.1);
  EXPECT_GT(score_views(wall, region, ProximityCountGain{}, views, sensor, 1).front(), 0.0);
}

TEST_F(ScoreViews, ViewsKilometresApartOnAMapThatNoGridHolds) {
  // Free cells of 5 cm at two ends of a map 3 km wide, before a wall each.
  const auto far = map({{{-32000, 0, 0}, 16, false},
                        {{-31984, 0, 0}, 16, true},
                        {{32000, 0, 0}, 16, false},
                        {{32032, 0, 0}, 16, false}},
                       0.05);
  ASSERT_GT(far.known().count(), 1e6);
  const std::vector<Candidate> views{view_at(0, {-1599.8, 0.4, 0.4}), view_at(1, {0.0, 0.4, 0.4}),
                                     view_at(2, {1600.2, 0.4, 0.4})};
  const ScoredRegion region{.min_m = {{-1700.0, -40.0, -40.0}}, .max_m = {{1700.0, 40.0, 40.0}}};
  const auto gains = score_views(far, region, SimpleGain{}, views, camera(2.0), 2);
  const double cone = gains[1];  // all unobserved
  EXPECT_GT(cone, 10'000.0);
  EXPECT_LT(gains[0], 0.6 * cone);  // behind the wall nothing counts
  EXPECT_GT(gains[2], gains[0]);
  EXPECT_LT(gains[2], cone);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto alone = score_views(far, region, SimpleGain{}, {&views[i], 1}, camera(2.0), 1);
    EXPECT_NEAR(alone.front(), gains[i], 1e-3 * cone) << i;
  }
}

TEST_F(ScoreViews, CoarserCellsHoldTheSameVolume) {
  const auto one = map({{{0, 0, 0}, 16, false}}, 0.1);
  ScoredRegion region{.min_m = {{0.0, 0.0, 0.0}}, .max_m = {{3.2, 1.6, 1.6}}};
  const std::vector<Candidate> views{view_at(0, {-8.0, 0.8, 0.8})};
  for (const int coarsen : {1, 2, 4}) {
    region.coarsen = coarsen;
    const auto gain = score_views(one, region, UnmappedVolumeGain{}, views, camera(20.0), 1);
    EXPECT_NEAR(gain.front(), 1.6 * 1.6 * 1.6, 1e-3) << coarsen;
  }
}

TEST_F(ScoreViews, NamesTheKeysWhereAViewReachesTooFar) {
  const auto one = map({{{0, 0, 0}, 1, false}}, 0.01);
  ScoredRegion region{.min_m = {{-5.0, -5.0, -5.0}}, .max_m = {{5.0, 5.0, 5.0}}};
  const std::vector<Candidate> views{view_at(7, {0.0, 0.0, 0.0})};
  const auto error_of = [&](const auto& gain) -> std::string {
    try {
      score_views(one, region, gain, views, camera(10.0), 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  for (const char* part :
       {"map.bt", "view 7", "1000 x 1000 x 1000 cells of 0.01 m, more than", "sensor.range_max_m",
        "region.min_m", "region.max_m", "region.coarsen"}) {
    EXPECT_THAT(error_of(SimpleGain{}), HasSubstr(part));
  }
  EXPECT_THAT(error_of(ProximityCountGain{}),
              HasSubstr("cells of 0.01 m, 9 on each side for the gain alone, more than"));
  region.coarsen = 2;
  EXPECT_THAT(error_of(SimpleGain{}), HasSubstr("500 x 500 x 500 cells of 0.02 m, more than"));
  region.coarsen = 16;
  EXPECT_GT(score_views(one, region, SimpleGain{}, views, camera(10.0), 1).front(), 0.0);
}

TEST_F(ScoreViews, RefusesASensorOrARegionOutOfRange) {
  const auto one = map({{{0, 0, 0}, 1, false}}, 0.1);
  EXPECT_THROW(score_views(one, {}, SimpleGain{}, {}, camera(-1.0), 1), ConfigError);
  EXPECT_THROW(score_views(one, {.coarsen = 0}, SimpleGain{}, {}, camera(1.0), 1), ConfigError);
}

TEST(ScoredRegion, HasCornersOfThreeNumbers) {
  ScoredRegion region;
  read_into(parse_yaml("min_m: [0.5, 0.25, 1.0]\nmax_m: [1.25, 1.5, 2.0]\n", "test"), region);
  EXPECT_THAT(region.min_m, ::testing::Optional(::testing::ElementsAre(0.5, 0.25, 1.0)));
  EXPECT_THAT(region.max_m, ::testing::Optional(::testing::ElementsAre(1.25, 1.5, 2.0)));
  for (const char* text : {"min_m: [0.5, 0.25]", "min_m: [0.5, 0.25, 1.0, 2.0]",
                           "max_m: [0.5, 0.25]", "max_m: [0.5, 0.25, 1.0, 2.0]"}) {
    EXPECT_THROW(read_into(parse_yaml(text, "test"), region), ConfigError) << text;
  }
}

/// Of eight cells of 0.25 m a side the view reaches into the five from the third on.
TEST_F(ScoreViews, GridsHoldWhatTheSensorReachesAndTheHaloRoundIt) {
  const auto one = map({{{0, 0, 0}, 8, false}}, 0.25);
  const std::vector<Candidate> views{view_at(0, {50.0, 0.0, 0.0}),
                                     view_at(1, {1.125, 1.125, 1.125})};
  std::size_t cells = 0;
  const GridGains gains_on = [&](const OccupancyGrid& grid, std::span<const Candidate> on_grid) {
    cells = grid.size();
    return std::vector<double>(on_grid.size(), 7.0);
  };
  EXPECT_EQ(score_views(one, {}, gains_on, views, camera(0.5)), (std::vector{0.0, 7.0}));
  EXPECT_EQ(cells, 5U * 5U * 5U);
  score_views(one, {}, gains_on, views, camera(0.5), 1);
  EXPECT_EQ(cells, 7U * 7U * 7U);
  score_views(one, {}, gains_on, views, camera(0.5), 2);
  EXPECT_EQ(cells, 8U * 8U * 8U);
  score_views(one, {.coarsen = 2}, gains_on, views, camera(0.5));
  EXPECT_EQ(cells, 3U * 3U * 3U);
}

/// Eight cells of 0.25 m a side are known.
TEST_F(ScoreViews, ARegionIsTheKnownCellsButForWhatIsGiven) {
  const auto one = map({{{0, 0, 0}, 8, false}}, 0.25);
  const auto expect_cells = [&](const ScoredRegion& region, const Eigen::Array3i& begin,
                                const Eigen::Array3i& end) {
    const CellBlock cells = region.cells(one);
    EXPECT_TRUE((cells.begin == begin).all()) << cells.begin.transpose();
    EXPECT_TRUE((cells.end == end).all()) << cells.end.transpose();
  };
  expect_cells({}, {0, 0, 0}, {8, 8, 8});
  expect_cells({.min_m = {{0.5, 0.25, 1.0}}}, {2, 1, 4}, {8, 8, 8});
  expect_cells({.max_m = {{1.25, 1.5, 0.75}}}, {0, 0, 0}, {5, 6, 3});
}

/// On either end of 3.2 km, which no grid holds.
TEST_F(ScoreViews, ViewsNextToEachOtherInTheListShareAGridIfItFits) {
  const auto far = map({{{-32000, 0, 0}, 16, false}, {{32000, 0, 0}, 16, false}}, 0.05);
  const ScoredRegion region{.min_m = {{-1700.0, -40.0, -40.0}}, .max_m = {{1700.0, 40.0, 40.0}}};
  const std::vector<Candidate> views{view_at(4, {-1599.8, 0.4, 0.4}), view_at(5, {0.0, 900.0, 0.4}),
                                     view_at(6, {-1599.0, 0.4, 0.4}),
                                     view_at(7, {1600.2, 0.4, 0.4}),
                                     view_at(8, {-1599.4, 0.4, 0.4})};
  std::vector<std::vector<int>> asked;
  const GridGains gains_on = [&](const OccupancyGrid&, std::span<const Candidate> on_grid) {
    std::vector<double> gains;
    asked.emplace_back();
    for (const Candidate& view : on_grid) {
      asked.back().push_back(view.id);
      gains.push_back(10.0 * view.id);
    }
    return gains;
  };
  EXPECT_EQ(score_views(far, region, gains_on, views, camera(2.0)),
            (std::vector{40.0, 0.0, 60.0, 70.0, 80.0}));
  EXPECT_EQ(asked, (std::vector<std::vector<int>>{{4, 6}, {7}, {8}}));
}

}  // namespace
}  // namespace vantage
