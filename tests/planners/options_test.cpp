// Defaults and ranges of what the planners are told, by number.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/option_numbers.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/choice/view_problem.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/navigation/footprint_space.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/planners/objects/feature_choice.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"
#include "vantage/planners/objects/orbit.hpp"
#include "vantage/planners/prediction_bands.hpp"
#include "vantage/planners/views/forecast_calibration.hpp"
#include "vantage/planners/views/forecast_interval.hpp"
#include "vantage/planners/views/frontiers.hpp"
#include "vantage/planners/views/left_forecast.hpp"
#include "vantage/planners/views/sampled_views.hpp"
#include "vantage/planners/views/score_views.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/planners/visibility/partly_seen.hpp"
#include "vantage/planners/visibility/sweep_kernels.hpp"
#include "vantage/planners/visibility/visibility_sweep.hpp"

namespace vantage {
namespace {

using support::expect_numbers;
using support::kNull;

constexpr Range kShareOption = between(0.0, 1.0);
constexpr Range kPositiveShareOption{0.0, 1.0, true};
constexpr Range kNotNegativeOption = at_least(0.0);

TEST(PlannerOptions, OfNavigation) {
  expect_numbers(NavigationOptions{}, {{"footprint_radius_m", 0.48, kNotNegativeOption},
                                       {"margin_m", 0.04, kNotNegativeOption},
                                       {"clearance_weight", 1.0, kNotNegativeOption},
                                       {"comfort_m", 0.3, above(0.0)},
                                       {"escape_radius_m", 0.6, kNotNegativeOption},
                                       {"watch_m", 1.0, kNotNegativeOption}});
  expect_numbers(PassageOptions{}, {{"use", 1},
                                    {"margin_m", 0.02, kNotNegativeOption},
                                    {"preferred_margin_m", 0.05, between(0.0, 0.2)},
                                    {"headings", 48, between(4, 360)},
                                    {"speed_m_s", 0.2, kPositiveShareOption},
                                    {"least_area_m2", 0.2, kNotNegativeOption}});
  EXPECT_TRUE(RobotOutline{}.goes_sideways);
  EXPECT_EQ(RobotOutline{}.speed_m_s, 0.6);
}

TEST(PlannerOptions, OfChoices) {
  expect_numbers(RandomView{}, {{"draw", 0, kNotNegativeOption}});
  expect_numbers(GainOverDistance{}, {{"lambda_per_m", 0.2, kNotNegativeOption}});
  expect_numbers(OracleLookahead{},
                 {{"width", 32, between(1, 100000)}, {"depth", 1000, between(1, 1000)}});
  expect_numbers(ExternalChoice{}, {{"timeout_s", 10.0, between(0.01, 86400.0)},
                                    {"startup_timeout_s", 30.0, between(0.01, 86400.0)}});
  expect_numbers(RecedingHorizon{},
                 {{"lambda_per_s", 0.05, kNotNegativeOption}, {"nodes", 1000, between(1, 1000)}});
  expect_numbers(TwoLevelTour{}, {{"horizon_s", 12.0, above(0.0)},
                                  {"cover", 0.9, kPositiveShareOption},
                                  {"region_m", 4.0, at_least(0.01)}});
  expect_numbers(TourChoice{}, {{"finish_weight", 0.5, kShareOption},
                                {"worth_s", 3000.0, kNotNegativeOption},
                                {"scan_weight", 1.5, between(1.0, 100.0)},
                                {"first_moves", 8, between(1, 1000)},
                                {"keep_s", 10.0, kNotNegativeOption}});
  expect_numbers(Rollout{}, {{"finish_weight", 0.5, kShareOption},
                             {"worth_s", 3000.0, kNotNegativeOption},
                             {"scan_weight", 1.5, between(1.0, 100.0)},
                             {"first_moves", 8, between(1, 1000)},
                             {"keep_s", 10.0, kNotNegativeOption},
                             {"draws", 8, between(1, 10000)}});
  expect_numbers(ViewPlanningOptions{}, {{"block_m", 0.4, above(0.0)},
                                         {"drawn_cells", 3, between(1, 100)},
                                         {"beyond_m", 0.0, kNotNegativeOption}});
}

TEST(PlannerOptions, OfTourSearches) {
  EXPECT_EQ(TourObjective{}.finish_weight, 0.5);
  EXPECT_EQ(TourObjective{}.worth_s, 3000.0);
  EXPECT_EQ(TourObjective{}.scan_weight, 1.0);
  EXPECT_EQ(TourSearchOptions{}.first_moves, 8U);
  EXPECT_EQ(TourSearchOptions{}.rounds, 6U);
  EXPECT_EQ(TourSearchOptions{}.keep_s, 0.0);
  const TourOptions told{.finish_weight = 0.2, .worth_s = 7.0, .scan_weight = 3.0};
  EXPECT_EQ(told.objective().finish_weight, 0.2);
  EXPECT_EQ(told.objective().worth_s, 7.0);
  EXPECT_EQ(told.objective().scan_weight, 3.0);
  EXPECT_EQ(TourOptions{.first_moves = 3}.search().first_moves, 3U);
  EXPECT_EQ(TourOptions{.keep_s = 4.0}.search().keep_s, 4.0);
}

TEST(PlannerOptions, OfGains) {
  const Range opacity = between(0.0, 0.5);
  const support::OptionNumber step{"step_rad", 0.01, between(0.001, 1.5)};
  expect_numbers(BeerLambertGain{}, {{"a", 0.995, kShareOption}});
  expect_numbers(VisibilityWeightedGain{},
                 {{"a", 0.997, kShareOption}, {"p_reappear", 0.1, kShareOption}});
  expect_numbers(PosteriorChainGain{}, {{"visibility.a", 0.997, kShareOption},
                                        {"visibility.p_reappear", 0.1, kShareOption},
                                        {"p_occupied_at_sensor", 0.05, kShareOption}});
  expect_numbers(OcclusionAwareGain{}, {step, {"opacity_unobserved", 0.01, opacity}});
  expect_numbers(UnobservedVoxelGain{}, {step, {"opacity_unobserved", 0.01, opacity}});
  expect_numbers(RearSideEntropyGain{}, {step, {"opacity_unobserved", 0.01, opacity}});
  expect_numbers(RearSideVoxelGain{}, {step});
  expect_numbers(AverageEntropyGain{}, {step});
  expect_numbers(ProximityCountGain{}, {step, {"d_max_cells", 10, between(2, 1000)}});
  expect_numbers(AreaFactorGain{}, {step,
                                    {"target_occupied", 0.2, between(0.01, 0.99)},
                                    {"target_occplane", 0.8, between(0.01, 0.99)}});
  expect_numbers(FsmiGain{}, {step,
                              {"opacity_unobserved", 0.01, opacity},
                              {"d_occ", 4.0, at_least(1.0)},
                              {"d_emp", 3.0 / 7.0, kPositiveShareOption}});
  EXPECT_EQ(transmission_unobserved(FsmiGain{}), 0.99);
  EXPECT_EQ(transmission_unobserved(OcclusionAwareGain{.opacity_unobserved = 0.25}), 0.75);
  EXPECT_EQ(transmission_unobserved(UnobservedVoxelGain{.opacity_unobserved = 0.25}), 0.75);
  EXPECT_EQ(transmission_unobserved(RearSideEntropyGain{.opacity_unobserved = 0.25}), 0.75);
  EXPECT_EQ(transmission_unobserved(SimpleGain{}), std::nullopt);
  EXPECT_EQ(SweepOptions{}.rays_per_view, 4096);
  EXPECT_EQ(SweepOptions{}.tolerance, 0.0014);
  EXPECT_EQ(SweepOptions{}.first_share, 16);
  EXPECT_EQ(kNoRays.rays_per_view, 0);
  EXPECT_EQ(kEveryRay.first_share, 1);
}

TEST(PlannerOptions, OfViews) {
  constexpr double kPi = std::numbers::pi;
  expect_numbers(FrontierOptions{}, {{"min_cells", 20, at_least(1)},
                                     {"max_extent_m", 3.0, above(0.0)},
                                     {"height_m", 1.05, between(-1e6, 1e6)},
                                     {"height_band_m", kNull}});
  expect_numbers(SampledViews{}, {{"positions", 30, between(1, 1000)},
                                  {"headings", 8, between(1, 20)},
                                  {"height_m", kNull, between(-1e6, 1e6)},
                                  {"clearance_m", 0.2, between(0.0, 1e6)},
                                  {"pitch_rad", 0.0, between(-kPi / 2.0, kPi / 2.0)}});
  expect_numbers(ScoredRegion{}, {{"min_m", kNull, between(-1e9, 1e9)},
                                  {"max_m", kNull, between(-1e9, 1e9)},
                                  {"coarsen", 1, between(1, 1024)}});
  expect_numbers(RingOfViews{}, {{"positions", 10, between(1, 100000)},
                                 {"radius_m", 1.2, above(0.0)},
                                 {"height_m", 1.05, above(0.0)},
                                 {"start_angle_rad", 0.0},
                                 {"yaw_offsets_rad[0]", -kPi / 12.0, between(-kPi, kPi)},
                                 {"yaw_offsets_rad[1]", 0.0, between(-kPi, kPi)},
                                 {"yaw_offsets_rad[2]", kPi / 12.0, between(-kPi, kPi)}});
  EXPECT_EQ(kMaxScoredCells, 1 << 25);
}

TEST(PlannerOptions, OfACandidateNothingIsKnownAtFirst) {
  const Candidate view{};
  EXPECT_EQ(view.id, 0);
  EXPECT_TRUE(view.T_world_sensor.isApprox(Pose::Identity()));
  EXPECT_EQ(view.path_length_m, 0.0);
  EXPECT_TRUE(view.reachable);
  EXPECT_FALSE(view.exhausted);
  EXPECT_EQ(view.gain_bits, 0.0);
  EXPECT_EQ(view.true_new_cells, std::nullopt);
  EXPECT_EQ(view.true_new_cell_set, nullptr);
}

TEST(PlannerOptions, OfPartsOfGainsAndSweepsNothingIsCountedAtFirst) {
  EXPECT_EQ(FsmiGain::Cell{}.p_hit, 0.0F);
  EXPECT_EQ(FsmiGain::Cell{}.hit_bits, 0.0F);
  EXPECT_EQ(FsmiGain::Cell{}.pass_bits, 0.0F);
  EXPECT_EQ(PartlySeen::Cell{}.order, 0U);
  EXPECT_EQ(PartlySeen::Cell{}.visible, 0.0F);
  EXPECT_EQ(PartlySeen::Cell{}.weight, 0.0F);
  EXPECT_EQ(SampledSum{}.estimate, 0.0);
  EXPECT_EQ(SampledSum::Half{}.estimate, 0.0);
  EXPECT_EQ(SampledSum::Half{}.variance, 0.0);
  EXPECT_EQ(PredictionBand{}.from_m, 0.0);
  EXPECT_EQ(PredictionBand{}.to_m, 0.0);
  EXPECT_EQ(PredictionBand{}.predicted_cells, 0.0);
  EXPECT_EQ(PredictionBand{}.actual_cells, 0U);
  EXPECT_EQ(PredictionBand{}.outside_cells, 0U);
  EXPECT_EQ(CellInterval{}.low, 0.0);
  EXPECT_EQ(CellInterval{}.high, 0.0);
}

TEST(PlannerOptions, OfSweeps) {
  EXPECT_EQ(SweepAxes{}.u, 0);
  EXPECT_EQ(SweepAxes{}.v, 1);
  EXPECT_EQ(SweepAxes{}.w, 2);
  EXPECT_EQ(Pyramid{}.axis, 0);
  EXPECT_TRUE(Pyramid{}.ascending);
  EXPECT_EQ(CellSpan{}.begin, 0);
  EXPECT_EQ(CellSpan{}.end, 0);
  EXPECT_EQ(SweepRow{}.source, 0.0F);
  EXPECT_EQ(SweepRow{}.depth, 1.0F);
  EXPECT_EQ(SweepRow{}.across, 0.0F);
  EXPECT_EQ(Attenuation{}.utility, 1.0);
  EXPECT_TRUE(Attenuation{}.by_entropy);
}

TEST(PlannerOptions, OfForecasts) {
  expect_numbers(ForecastCalibrationOptions{},
                 {{"calibrate", 0}, {"prior_scans", 1.0, above(0.0)}});
  expect_numbers(ForecastIntervalOptions{},
                 {{"confidence", 0.9, between(0.01, 0.99)}, {"rate", 0.03, kShareOption}});
  expect_numbers(StopOptions{},
                 {{"share", 0.0, kShareOption}, {"confidence", 0.9, between(0.5, 0.999)}});
}

TEST(PlannerOptions, OfRecognition) {
  expect_numbers(FeatureChoice{},
                 {{"states", 48, between(1, 100'000)}, {"about_object", 1}, {"per_cost", 0}});
  expect_numbers(GainBelow{}, {{"threshold", 0.02, kNotNegativeOption}});
  expect_numbers(MonteCarloInformation{}, {{"samples", 1000, between(2, 1'000'000)}});
  expect_numbers(LossOfEntropy{}, {{"samples", 64, between(2, 1'000'000)}, {"at_mean", 0}});
  expect_numbers(RandomObjectView{}, {{"draw", 0, kNotNegativeOption}});
  expect_numbers(NearestFreeView{}, {{"min_visible", 0.5, kShareOption}});
  expect_numbers(ObjectViewOptions{}, {{"states", 48, between(1, 100'000)},
                                       {"about_object", 1},
                                       {"by_visibility", 1},
                                       {"weight_per_s", 0.0, kNotNegativeOption},
                                       {"weight_per_m", 0.0, kNotNegativeOption},
                                       {"weight_per_j", 0.0, kNotNegativeOption},
                                       {"visited_weight", 0.0, kShareOption}});
  expect_numbers(EnoughViews{}, {{"object_probability", 0.9, kPositiveShareOption},
                                 {"entropy_bits", 0.1, kNotNegativeOption}});
  EXPECT_EQ(ObjectViewAction{}.visible, 1.0);
  EXPECT_EQ(ObjectViewAction{}.yaw_rad, 0.0);
  EXPECT_EQ(Orbit{}.radius_m, 1.0);
  EXPECT_EQ(Orbit{}.height_m, 1.0);
}

}  // namespace
}  // namespace vantage
