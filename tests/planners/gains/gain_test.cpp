#include "vantage/planners/gain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include "tests/planners/gains/gain_along.hpp"
#include "vantage/core/names.hpp"
#include "vantage/planners/exact_gain.hpp"

namespace vantage {
namespace {

constexpr double kTolerance = 1e-5;  // tables are single precision

TEST(SimpleGain, CountsUnobservedCellsInFrontOfTheFirstOccupiedOne) {
  EXPECT_DOUBLE_EQ(along(SimpleGain{}, "..??.?#??"), 3.0);
  EXPECT_DOUBLE_EQ(along(SimpleGain{}, "????????"), 8.0);
  EXPECT_DOUBLE_EQ(along(SimpleGain{}, "#???"), 0.0);
  EXPECT_DOUBLE_EQ(along(SimpleGain{}, "...#"), 0.0);
}

TEST(BeerLambertGain, IsAGeometricSeriesInUnobservedSpace) {
  const double a = 0.75;
  EXPECT_NEAR(along(BeerLambertGain{.a = a}, "????????"), (1.0 - std::pow(a, 8)) / (1.0 - a),
              kTolerance);
  EXPECT_NEAR(along(BeerLambertGain{.a = a}, "..?..?.?"), 1.0 + a + a * a, kTolerance);
  EXPECT_NEAR(along(BeerLambertGain{.a = a}, "??#????"), 1.0 + a, kTolerance);
  EXPECT_NEAR(along(BeerLambertGain{.a = 0.0}, "????"), 1.0, kTolerance);
}

TEST(BeerLambertGain, OfTransparentSpaceIsTheSimpleGain) {
  EXPECT_NEAR(along(BeerLambertGain{.a = 1.0}, "?.??#??"), along(SimpleGain{}, "?.??#??"),
              kTolerance);
}

TEST(AdaptiveGain, TakesTheTransmissionOfTheContext) {
  EXPECT_NEAR(along(AdaptiveGain{}, "???.?", 0.25), along(BeerLambertGain{.a = 0.25}, "???.?"),
              kTolerance);
}

TEST(AdaptiveGain, TakesTheTransmissionOfEachBlock) {
  // Two layers of three cells; the sensor sees both level from afar, one ray never leaves a layer.
  GridFrame frame;
  frame.min_corner_m = {0.0, -0.5, -1.0};
  frame.cells = {3, 1, 2};
  const OccupancyGrid grid(frame);
  FieldOfView fov;
  fov.range_max_m = 1e4;
  const BlockField blocks{.layout = {.cells = frame.cells, .blocks = {3, 1, 2}},
                          .per_block = {0.5, 0.75, 1.0, 0.25, 0.125, 1.0}};
  const double gain =
      exact_gain_bits(AdaptiveGain{}, {grid, &blocks}, make_pose({-1000.0, 0.0, 0.0}, 0.0), fov);
  EXPECT_NEAR(gain, (1.0 + 0.5 + 0.5 * 0.75) + (1.0 + 0.25 + 0.25 * 0.125), kTolerance);
}

TEST(VisibilityWeightedGain, SumsVisibilityOverUnobservedCells) {
  const std::string_view ray = ".??#?..?";
  const auto p_visible = visibility_along_ray(p_occupied_of(ray));
  double expected = 0.0;
  for (std::size_t m = 0; m < ray.size(); ++m) expected += ray[m] == '?' ? p_visible[m] : 0.0;
  EXPECT_NEAR(along(VisibilityWeightedGain{}, ray), expected, 0.02);  // 1 - 1e-6 as a float
}

TEST(VisibilityWeightedGain, WithoutLossIsTheNumberOfUnobservedCells) {
  VisibilityWeightedGain gain;
  gain.model = {.a = 1.0, .p_reappear = 0.0};
  EXPECT_NEAR(along(gain, "?.???.?"), 5.0, kTolerance);
}

/// p(o) = 0.41, so the cell is still unobserved.
TEST(Gain, OfACellOfLittleEvidenceIsItsEntropyWhereTheGainIsOfEntropy) {
  OccupancyGrid row = row_of_cells("??");
  row.log_odds[1] = static_cast<float>(log_odds_of(0.41));
  const double bits = binary_entropy_bits(0.41);
  EXPECT_NEAR(along(BeerLambertGain{.a = 0.75}, row), 1.0 + 0.75 * bits, kTolerance);
  EXPECT_NEAR(along(AdaptiveGain{}, row, 0.75), 1.0 + 0.75 * bits, kTolerance);
  EXPECT_NEAR(along(OcclusionAwareGain{.opacity_unobserved = 0.25}, row), 1.0 + 0.75 * bits,
              kTolerance);
  EXPECT_NEAR(along(UnobservedVoxelGain{.opacity_unobserved = 0.25}, row), 1.0 + 0.75 * bits,
              kTolerance);
  const double p_visible = visibility_along_ray(std::vector{0.5, 0.41})[1];
  EXPECT_NEAR(along(VisibilityWeightedGain{}, row), 1.0 + p_visible * bits, kTolerance);
  EXPECT_EQ(along(SimpleGain{}, row), 2.0);
  EXPECT_NEAR(along(UnmappedVolumeGain{}, row), 2.0, kTolerance);
}

TEST(PosteriorChainGain, SumsTheEntropyLostOverAllCells) {
  const std::string_view ray = "..?..??";
  const auto p_occupied = p_occupied_of(ray);
  const auto posterior = posterior_along_ray(p_occupied);
  double expected = 0.0;
  for (std::size_t m = 0; m < ray.size(); ++m) {
    expected += binary_entropy_bits(p_occupied[m]) - binary_entropy_bits(posterior[m]);
  }
  EXPECT_NEAR(along(PosteriorChainGain{}, ray), expected, 1e-4);
}

TEST(PosteriorChainGain, ReachesOnlyTheRimOfTheUnknown) {
  const double rim = along(PosteriorChainGain{}, std::string(40, '?'));
  EXPECT_GT(rim, 1.0);
  EXPECT_NEAR(along(PosteriorChainGain{}, std::string(80, '?')), rim, 1e-3);
}

template <class G>
class EveryGain : public testing::Test {};
template <class Variant>
struct TypesOf;
template <class... G>
struct TypesOf<std::variant<G...>> {
  using type = testing::Types<G...>;
};
TYPED_TEST_SUITE(EveryGain, TypesOf<Gain>::type);

/// Whether more unobserved cells in view are worth more.
template <class G>
inline constexpr bool kGrowsWithTheUnknown =
    !std::is_same_v<G, AreaFactorGain> && !std::is_same_v<G, FrontierCellsGain>;

TYPED_TEST(EveryGain, SumsOverCellsOrOverBeamsAndHasANameThatReadsBack) {
  static_assert(RayGain<TypeParam> != BeamGain<TypeParam>);
  const Gain made = make_strategy<Gain>(TypeParam::name);
  EXPECT_EQ(strategy_name_of(made), TypeParam::name);
  Gain read;
  read_into(write_node(made), read);
  EXPECT_EQ(strategy_name_of(read), TypeParam::name);
}

/// Nothing but the little that is left to learn of the cells in sight.
TYPED_TEST(EveryGain, PromisesNextToNothingOfAFullyKnownMapBehindAWall) {
  double left_bits = 0.0;
  for (const double p : p_occupied_of("....#")) left_bits += binary_entropy_bits(p);
  const bool in_bits =
      unit_of(TypeParam{}) == "bits" || std::is_same_v<TypeParam, AverageEntropyGain>;
  const double gain = along(TypeParam{}, "....####");
  EXPECT_GE(gain, 0.0);
  EXPECT_LE(gain, (in_bits ? left_bits : 0.0) + kTolerance);
}

TYPED_TEST(EveryGain, PromisesAtMostOneBitPerCell) {
  const double gain = along(TypeParam{}, "????????????????#");
  if (kGrowsWithTheUnknown<TypeParam>) {
    EXPECT_GT(gain, 0.0);
  }
  if (unit_of(TypeParam{}) == "bits") {
    EXPECT_LE(gain, 17.0);
  }
}

TYPED_TEST(EveryGain, PrefersMoreUnobservedCellsInSight) {
  if (kGrowsWithTheUnknown<TypeParam>) {
    EXPECT_GT(along(TypeParam{}, "..???#"), along(TypeParam{}, "..?..#"));
  }
}

/// As it is made, and after start() again, a ray or beam stands at the sensor.
TYPED_TEST(EveryGain, BeginsEachRayAnew) {
  const TypeParam gain{};
  for (const char* cells : {"???#", "?.??"}) {
    const OccupancyGrid row = row_of_cells(cells);
    const BlockField even = uniform_field(row.frame.cells, 0.9);
    const auto tables = gain.prepare({row, &even});
    const auto expect_same_again = [&](auto& ray, const auto& worth) {
      const double first = worth();
      ray.start();
      EXPECT_EQ(worth(), first) << cells;
    };
    if constexpr (BeamGain<TypeParam>) {
      auto beam = gain.beam(tables);
      expect_same_again(beam, [&] {
        for (std::size_t cell = 0; cell < row.size() && beam.enter(cell);) ++cell;
        auto view = view_of_beams(gain);
        view.add(beam);
        return view.total();
      });
    } else {
      auto ray = gain.ray(tables);
      expect_same_again(ray, [&] {
        ray.pass(0);
        ray.pass(1);
        return ray.utility(2);
      });
    }
  }
}

TYPED_TEST(EveryGain, SeesFromAllSidesAlikeInEmptyUnknownSpace) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {1.1, 1.1, 1.1}, {11, 11, 11}));
  const BlockField even = uniform_field(grid.frame.cells, 0.9);
  const auto from = [&](const Eigen::Vector3d& p, double yaw_rad) {
    const FieldOfView fov{.half_width_rad = 0.4, .tilt_min_rad = -0.4, .tilt_max_rad = 0.4};
    return exact_gain_bits(TypeParam{}, {grid, &even}, make_pose(p, yaw_rad), fov);
  };
  const double front = from({-1.03, 0.0, 0.0}, 0.0);
  EXPECT_NEAR(from({0.0, 1.03, 0.0}, -0.5 * std::numbers::pi), front, 0.01 * front);
}

TEST(Gain, OfCellsIsRecordedAsAPrediction) {
  std::vector<std::string> labels;
  for (const Gain& gain : cell_predictors()) labels.push_back(strategy_label(gain));
  EXPECT_THAT(labels, testing::ElementsAre("simple", "posterior_chain", "visibility_weighted",
                                           "beer_lambert", "adaptive"));
}

TEST(Gain, IsLabelledByWhatIsNotItsDefault) {
  EXPECT_EQ(strategy_label(Gain(BeerLambertGain{.a = 0.99})), "beer_lambert a=0.99");
  PosteriorChainGain chain;
  chain.model.visibility.a = 0.9997;
  chain.model.p_occupied_at_sensor = 0.1;
  EXPECT_EQ(strategy_label(Gain(chain)),
            "posterior_chain visibility.a=0.9997 p_occupied_at_sensor=0.1");
}

TEST(Gain, NamesItsKindInErrors) {
  try {
    make_strategy<Gain>("adaptiv");
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown gain 'adaptiv'; did you mean adaptive? known: simple, posterior_chain, "
                 "visibility_weighted, "
                 "beer_lambert, adaptive, occlusion_aware, unobserved_voxel, rear_side_voxel, "
                 "rear_side_entropy, proximity_count, average_entropy, area_factor, "
                 "unmapped_volume, fsmi, frontier_cells");
  }
}

}  // namespace
}  // namespace vantage
