#include "vantage/belief/objects/transition.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "tests/belief/objects/recognition_world.hpp"

namespace vantage {
namespace {

constexpr double kTransitionTolerance = 1e-12;
constexpr double kFullTurn = 2.0 * std::numbers::pi;

TEST(MotionBins, AreTheTwoNextToTheMotion) {
  EXPECT_EQ(motion_bins(kFullTurn / 8.0, 8).lower, 1);
  EXPECT_EQ(motion_bins(kFullTurn / 8.0, 8).upper_share, 0.0);
  EXPECT_EQ(motion_bins(-kFullTurn / 8.0, 8).lower, 7);
  EXPECT_EQ(motion_bins(3.0 * kFullTurn, 8).lower, 0);
  const MotionBins between = motion_bins(-0.25 * kFullTurn / 8.0, 8);
  EXPECT_EQ(between.lower, 7);
  EXPECT_EQ(between.upper, 0);
  EXPECT_NEAR(between.upper_share, 0.75, kTransitionTolerance);
}

RC_GTEST_PROP(MotionBins, OfAMultipleAreTheMultipleHoweverComputed, ()) {
  const int bins = *rc::gen::inRange(1, 37);
  const int multiple = *rc::gen::inRange(-200, 200);
  const double step_rad = kFullTurn / bins;
  double motion_rad = 0.0;
  for (int i = 0; i < std::abs(multiple); ++i) motion_rad += multiple < 0 ? -step_rad : step_rad;
  const MotionBins motion = motion_bins(motion_rad, bins);
  RC_ASSERT(motion.lower == (multiple % bins + bins) % bins);
  RC_ASSERT(motion.upper_share == 0.0);
}

TEST(TableTransition, HasThePublishedMassesOfItsGroups) {
  const ObjectStates states = test::make_states({0, 0, 0, 1, 1}, 8);
  const Eigen::MatrixXd a = test::dense(states, TableTransition{}.kernel(kFullTurn / 4.0, 8));
  const Eigen::RowVectorXd row = a.row(states.state(1, 3));
  EXPECT_NEAR(row[states.state(1, 5)], 0.4, kTransitionTolerance);
  EXPECT_NEAR(row.segment(states.state(1, 0), 8).sum(), 0.7, kTransitionTolerance);
  EXPECT_NEAR(row.segment(states.state(0, 0), 8).sum(), 0.05, kTransitionTolerance);
  EXPECT_NEAR(row.segment(states.state(2, 0), 8).sum(), 0.05, kTransitionTolerance);
  EXPECT_NEAR(row.tail(16).sum(), 0.2, kTransitionTolerance);
  EXPECT_NEAR(row[states.state(1, 3)], 0.3 / 7.0, kTransitionTolerance);
}

TEST(TableTransition, RoundsTheMotion) {
  const auto right = [](double bins) {
    Eigen::Index largest = 0;
    TableTransition{}.kernel(bins * kFullTurn / 8.0, 8).bin_change.maxCoeff(&largest);
    return largest;
  };
  EXPECT_EQ(right(2.4), 2);
  EXPECT_EQ(right(2.6), 3);
  EXPECT_EQ(right(-0.4), 0);
}

TEST(TableTransition, OfASingleBinKeepsTheObject) {
  const ObjectStates states = test::make_states({0, 0, 1}, 1);
  const Eigen::MatrixXd a = test::dense(states, TableTransition{}.kernel(1.0, 1));
  EXPECT_NEAR(a(0, 0), 0.7, kTransitionTolerance);
  EXPECT_NEAR(a(2, 2), 0.8, kTransitionTolerance);
}

TEST(RigidTransition, MovesByTheCommandWithSlipToBothSides) {
  const TransitionKernel kernel = RigidTransition{.slip = 0.2}.kernel(-kFullTurn / 8.0, 8);
  EXPECT_NEAR(kernel.bin_change[7], 0.8, kTransitionTolerance);
  EXPECT_NEAR(kernel.bin_change[6], 0.1, kTransitionTolerance);
  EXPECT_NEAR(kernel.bin_change[0], 0.1, kTransitionTolerance);
  EXPECT_EQ(kernel.same_object, 1.0);
}

TEST(RigidTransition, SharesAMotionBetweenBins) {
  const TransitionKernel kernel = RigidTransition{.slip = 0.0}.kernel(2.25 * kFullTurn / 8.0, 8);
  EXPECT_NEAR(kernel.bin_change[2], 0.75, kTransitionTolerance);
  EXPECT_NEAR(kernel.bin_change[3], 0.25, kTransitionTolerance);
}

TEST(LearnedTransition, IsRigidBeforeItLearns) {
  const double motion_rad = 1.3;
  EXPECT_EQ(LearnedTransition{}.kernel(motion_rad, 8).bin_change,
            RigidTransition{}.kernel(motion_rad, 8).bin_change);
}

TEST(LearnedTransition, HasASlipForEachCommand) {
  LearnedTransition learned;
  learned.slip = {1.0, 0.0, 0.0,   // no motion
                  0.6, 0.4, 0.0,   // by one bin: 0.4 a bin too far
                  0.5, 0.0, 0.5};  // by two: 0.5 a bin short
  const TransitionKernel by_one = learned.kernel(kFullTurn / 3.0, 3);
  EXPECT_TRUE(by_one.bin_change.isApprox(Eigen::Vector3d(0.0, 0.6, 0.4), kTransitionTolerance));
  const TransitionKernel by_two = learned.kernel(2.0 * kFullTurn / 3.0, 3);
  EXPECT_TRUE(by_two.bin_change.isApprox(Eigen::Vector3d(0.0, 0.5, 0.5), kTransitionTolerance));
  const TransitionKernel between = learned.kernel(1.5 * kFullTurn / 3.0, 3);
  EXPECT_TRUE(between.bin_change.isApprox(Eigen::Vector3d(0.0, 0.55, 0.45), kTransitionTolerance));
  EXPECT_THROW(static_cast<void>(learned.kernel(kFullTurn / 3.0, 8)), ConfigError);
}

RC_GTEST_PROP(TransitionModel, EveryKernelSumsToOne, ()) {
  const int bins = *rc::gen::inRange(1, 10);
  const double motion_rad = 0.01 * *rc::gen::inRange(-2000, 2000);
  for (const std::string_view name : strategy_names<TransitionModel>()) {
    const TransitionKernel kernel =
        kernel_of(make_strategy<TransitionModel>(name), motion_rad, bins);
    RC_ASSERT(std::abs(kernel.bin_change.sum() - 1.0) < kTransitionTolerance);
    RC_ASSERT(kernel.bin_change.minCoeff() >= 0.0);
    RC_ASSERT(std::abs(kernel.same_object + kernel.other_instance + kernel.other_category - 1.0) <
              kTransitionTolerance);
  }
}

TEST(TransitionModel, ChecksThatMassesSumToOne) {
  check_options(TableTransition{});
  EXPECT_THROW(check_options(TableTransition{.right_angle = 0.5}), ConfigError);
  EXPECT_THROW(check_options(RigidTransition{.slip = 1.5}), ConfigError);
  LearnedTransition learned;
  check_options(learned);
  learned.slip = {0.5, 0.5, 1.0};
  EXPECT_THROW(check_options(learned), ConfigError);
  learned.slip = {0.5, 0.5, 0.9, 0.0};
  EXPECT_THROW(check_options(learned), ConfigError);
  learned.slip = {0.5, 0.5, 0.9, 0.1};
  check_options(learned);
  learned.same_object = 0.5;
  EXPECT_THROW(check_options(learned), ConfigError);
  learned.other_instance = 0.5;
  check_options(learned);
  learned.slip.clear();
  EXPECT_THROW(check_options(learned), ConfigError) << "the model's own would hold";
}

TEST(TransitionModel, SumsToOneWithinAMillionth) {
  for (const double off : {-9e-7, 9e-7}) {
    EXPECT_NO_THROW(check_options(TableTransition{.right_angle = 0.4 + off}));
  }
  for (const double off : {-2e-6, 2e-6}) {
    EXPECT_THROW(check_options(TableTransition{.right_angle = 0.4 + off}), ConfigError);
  }
}

/// Half a bin, to the bit.
TEST(TableTransition, RoundsHalfABinUp) {
  const TransitionKernel kernel = TableTransition{}.kernel(kFullTurn / 4.0, 2);
  EXPECT_NEAR(kernel.bin_change[0], 0.3 / 0.7, kTransitionTolerance);
  EXPECT_NEAR(kernel.bin_change[1], 0.4 / 0.7, kTransitionTolerance);
}

TEST(MotionBins, AHairIsABillionthOfABin) {
  const auto of = [](double bins) { return motion_bins(bins * kFullTurn / 8.0, 8); };
  EXPECT_EQ(of(1.0 - 7e-10).lower, 1);
  EXPECT_EQ(of(1.0 - 1.5e-9).lower, 0);
  EXPECT_EQ(of(1.0 + 7e-10).upper_share, 0.0);
  EXPECT_NEAR(of(1.0 + 1.5e-9).upper_share, 1.5e-9, 1e-12);
}

}  // namespace
}  // namespace vantage
