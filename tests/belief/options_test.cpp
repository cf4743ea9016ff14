// Defaults and ranges of what the belief goes by, by number.
#include <gtest/gtest.h>

#include "tests/support/option_numbers.hpp"
#include "vantage/belief/map/block_field.hpp"
#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/flight_map.hpp"
#include "vantage/belief/map/floor_detail.hpp"
#include "vantage/belief/map/floor_map.hpp"
#include "vantage/belief/map/headroom.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/octomap/octomap_format.hpp"
#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/belief/objects/baum_welch.hpp"
#include "vantage/belief/objects/object_belief.hpp"
#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/belief/observation/gaussian_statistics.hpp"
#include "vantage/belief/observation/psi_rule.hpp"
#include "vantage/belief/tracking/object_tracker.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

constexpr Range kShareOption = between(0.0, 1.0);
constexpr Range kPositiveShareOption{0.0, 1.0, true};
constexpr Range kNotNegativeOption = at_least(0.0);

TEST(BeliefOptions, OfMaps) {
  expect_numbers(InverseSensorModel{}, {{"sigma_m", 0.005, above(0.0)},
                                        {"p_occupied_peak", 0.8, between(0.55, 0.999)},
                                        {"spread_sigmas", 2.0, between(0.0, 4.0)},
                                        {"max_abs_log_odds", 5.0, at_least(0.5)}});
  expect_numbers(FreeSpaceUpdate{}, {{"p_free_given_pass", 0.7, between(0.7, 0.999)}});
  expect_numbers(HoleFilling{}, {{"data_weight", 1.0, kNotNegativeOption},
                                 {"smoothness_weight", 1.0, kNotNegativeOption},
                                 {"max_passes", 100, at_least(1)},
                                 {"p_occupied_filled", 0.7, between(0.61, 0.999)}});
  expect_numbers(ClutterHazardOptions{}, {{"layers", 13, between(1, 4096)},
                                          {"prior_crossings", 300.0, kNotNegativeOption},
                                          {"block_cells", 6, between(1, 4096)},
                                          {"reach_cells", 20.0, between(0.0, 4096.0)},
                                          {"block_crossings", 1000.0, above(0.0)},
                                          {"prior_hazard", 0.005, between(1e-6, 0.999)},
                                          {"prior_weight", 300.0, above(0.0)}});
  expect_numbers(FlightMapOptions{}, {{"cell_m", 0.1, between(0.01, 1.0)},
                                      {"columns", 100, between(8, 4096)},
                                      {"noise_m", 0.03, above(0.0)},
                                      {"rise_m", 0.3, kNotNegativeOption},
                                      {"free_space.p_free_given_pass", 0.7, between(0.7, 0.999)}});
}

TEST(BeliefOptions, OfFloors) {
  expect_numbers(FloorMapOptions{}, {{"cell_m", 0.05, above(0.0)},
                                     {"half_size_m", 6.0, above(0.0)},
                                     {"log_odds_hit", 1.5, above(0.0)},
                                     {"log_odds_miss", 0.5, above(0.0)},
                                     {"log_odds_limit", 3.0, above(0.0)}});
  expect_numbers(FloorDetailOptions{},
                 {{"parts", 3, between(1, 15)}, {"range_m", 3.0, {0.0, 100.0, true}}});
  expect_numbers(
      HeadroomOptions{},
      {{"low_m", 0.03}, {"high_m", 1.65}, {"seen_low_m", 0.3}, {"max_unseen", 0.25, kShareOption}});
}

TEST(BeliefOptions, OfTransitions) {
  expect_numbers(TableTransition{}, {{"right_angle", 0.4, kPositiveShareOption},
                                     {"wrong_angle", 0.3, kShareOption},
                                     {"other_instance", 0.1, kShareOption},
                                     {"other_category", 0.2, kShareOption}});
  expect_numbers(RigidTransition{}, {{"slip", 0.1, kShareOption}});
  LearnedTransition of_one_bin;
  of_one_bin.slip = {1.0};
  expect_numbers(of_one_bin, {{"same_object", 1.0, kShareOption},
                              {"other_instance", 0.0, kShareOption},
                              {"other_category", 0.0, kShareOption},
                              {"slip[0]", 1.0, kShareOption}});
  expect_numbers(BaumWelchOptions{}, {{"prior_moves", 0.0, kNotNegativeOption},
                                      {"max_iterations", 100, between(1, 10000)},
                                      {"tolerance", 1e-6, above(0.0)}});
}

TEST(BeliefOptions, OfObservations) {
  expect_numbers(ShrunkVariance{}, {{"nu0", 5.0, above(0.0)}, {"floor", 0.01, above(0.0)}});
  expect_numbers(LiteralVariance{}, {{"floor", 0.01, above(0.0)}});
  expect_numbers(CalibratedPsi{}, {{"about_object", 1}, {"joint_rounds", 0, between(0, 100)}});
  expect_numbers(DissertationPsi{}, {{"colour", 1.0, kNotNegativeOption},
                                     {"bounding_box", 0.02, kNotNegativeOption},
                                     {"sift", 0.2, kNotNegativeOption},
                                     {"vfh", 0.001, kNotNegativeOption},
                                     {"other", 1.0, kNotNegativeOption}});
  EXPECT_EQ(ObservationModel{}.psi, 1.0);
  EXPECT_EQ(ObservationModel{}.cost_s, 0.0);
  EXPECT_EQ(ObjectStates{}.bins, 8);
}

TEST(BeliefOptions, OfTracking) {
  expect_numbers(ObjectTrackerOptions{}, {{"gate_m", 0.35, {0.0, 2.0, true}},
                                          {"partial_weight", 0.1, kPositiveShareOption},
                                          {"min_detections", 3, at_least(1)}});
}

TEST(BeliefDefaults, AreOfNothingSeenYet) {
  const TrackedObject object{};
  EXPECT_EQ(object.id, 0);
  EXPECT_TRUE(object.p_world_object_m.isZero(0.0));
  EXPECT_EQ(object.support_z_m, 0.0);
  EXPECT_EQ(object.radius_m, 0.0);
  EXPECT_EQ(object.height_m, 0.0);
  EXPECT_EQ(object.weight, 0.0);
  EXPECT_EQ(object.detections, 0);
  EXPECT_EQ(object.whole_detections, 0);
  EXPECT_FALSE(object.confirmed);
  EXPECT_EQ(ObjectEstimate{}.probability, 0.0);
  EXPECT_EQ(EvidenceResult{}.log_evidence, 0.0);
  EXPECT_EQ(FeatureModel{}.psi, 1.0);
  EXPECT_EQ(FeatureModel{}.cost_s, 0.0);
}

TEST(BeliefDefaults, OfMapsAreOfNoCells) {
  const OctomapContent content{};
  EXPECT_EQ(content.resolution_m, 0.0);
  EXPECT_EQ(content.occupied, 0U);
  EXPECT_EQ(content.free, 0U);
  EXPECT_TRUE(content.box.isEmpty());
  EXPECT_TRUE((CellBlock{}.begin == 0).all() && (CellBlock{}.end == 0).all());
  const OctomapLeaf leaf{};
  EXPECT_TRUE((leaf.first == 0).all());
  EXPECT_EQ(leaf.edge_cells, 1);
  EXPECT_EQ(leaf.log_odds, 0.0F);
  const FloorMap floor{};
  EXPECT_TRUE(floor.min_corner_m.isZero(0.0));
  EXPECT_EQ(floor.cell_m, 1.0);
  EXPECT_EQ(floor.nx, 0);
  EXPECT_EQ(floor.ny, 0);
  const FilledGrid filled{};
  EXPECT_EQ(filled.filled_cells, 0U);
  EXPECT_EQ(filled.passes, 0);
  EXPECT_FALSE(filled.converged);
  EXPECT_EQ(BlockLayout{}.size(), 1U);
  EXPECT_EQ(BlockLayout{}.block_of(0, 5), 5);
}

TEST(BeliefDefaults, OfMovesAreOfNone) {
  EXPECT_EQ(MotionBins{}.lower, 0);
  EXPECT_EQ(MotionBins{}.upper, 0);
  EXPECT_EQ(MotionBins{}.upper_share, 0.0);
  EXPECT_EQ(TransitionKernel{}.same_object, 1.0);
  EXPECT_EQ(TransitionKernel{}.other_instance, 0.0);
  EXPECT_EQ(TransitionKernel{}.other_category, 0.0);
  EXPECT_EQ(ExpectedMoves{}.same_object, 0.0);
  EXPECT_EQ(ExpectedMoves{}.other_instance, 0.0);
  EXPECT_EQ(ExpectedMoves{}.other_category, 0.0);
  EXPECT_EQ(ViewStep{}.motion_rad, 0.0);
  EXPECT_EQ(SmoothedSequence{}.log_likelihood, 0.0);
  EXPECT_EQ(BaumWelchResult{}.unexplained, 0);
  EXPECT_FALSE(BaumWelchResult{}.converged);
  EXPECT_EQ(UnknownFactors{}.instance, 0.0);
  EXPECT_EQ(UnknownFactors{}.category, 0.0);
  EXPECT_EQ(HeldOutViews{}.bins, 1);
  EXPECT_EQ(PreparedObservationModel{}.psi, 1.0);
}

}  // namespace
}  // namespace vantage
