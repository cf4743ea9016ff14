#include "vantage/sim/robots/pose_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace vantage {
namespace {

const Eigen::Matrix3d kNothing = Eigen::Matrix3d::Zero();

Eigen::Matrix3d information(double x_m, double y_m, double yaw_rad) {
  return Eigen::Vector3d(1.0 / (x_m * x_m), 1.0 / (y_m * y_m), 1.0 / (yaw_rad * yaw_rad))
      .asDiagonal();
}

TEST(PoseUncertainty, AMetreStraightOnIsTheModelsOwnNumbers) {
  const OdometryOptions odometry;
  PoseUncertainty uncertainty(odometry, {});
  EXPECT_EQ(mapped_sigma_m({}, uncertainty.covariance(), {1.0, 1.0}), 0.0)
      << "the start is where the world is";
  const Pose2 there{1.0, 0.0, 0.0};
  uncertainty.move_to(there);
  const Eigen::Matrix3d& covariance = uncertainty.covariance();
  EXPECT_NEAR(covariance(0, 0), 0.01 * 0.01 + 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.01 * 0.01 + 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.01 * 0.01 + 0.005 * 0.005, 1e-12);
  EXPECT_NEAR(mapped_sigma_m(there, covariance, {1.0, 0.0}), std::sqrt(4e-4), 1e-9);
  EXPECT_GT(mapped_sigma_m(there, covariance, {3.0, 0.0}), 0.029)
      << "a wrong heading tells far away";
}

/// Along a circle of 1.2 m with the wheels' own noise, drawn many times.
TEST(PoseUncertainty, IsThatOfTheSimulatedWheels) {
  const OdometryOptions options;
  constexpr int kDraws = 400;
  constexpr int kSteps = 300;
  const Pose2 step{0.02, 0.0, 0.02 / 1.2};
  Eigen::Matrix3d drawn = Eigen::Matrix3d::Zero();
  PoseUncertainty uncertainty(options, {});
  Pose2 truth;
  for (int i = 0; i < kSteps; ++i) uncertainty.move_to(truth = compose(truth, step));
  for (int draw = 0; draw < kDraws; ++draw) {
    Odometry odometry(options, Rng(static_cast<std::uint64_t>(draw) + 1), {});
    Pose2 now;
    for (int i = 0; i < kSteps; ++i) odometry.update(now = compose(now, step));
    const Pose2 believed = odometry.estimate();
    const Eigen::Vector3d off(believed.x_m - truth.x_m, believed.y_m - truth.y_m,
                              wrap_angle(believed.yaw_rad - truth.yaw_rad));
    drawn += off * off.transpose() / kDraws;
  }
  for (int i = 0; i < 3; ++i) {
    const double ratio = std::sqrt(uncertainty.covariance()(i, i) / drawn(i, i));
    EXPECT_GT(ratio, 0.8) << i;
    EXPECT_LT(ratio, 1.6) << i;
  }
}

TEST(PoseUncertainty, ARegistrationTakesAwayWhatItMeasures) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({4.0, 0.0, 0.0});
  const double along_m2 = uncertainty.covariance()(0, 0);
  Eigen::Matrix3d corridor = information(1.0, 0.002, 0.002);
  corridor(0, 0) = 0.0;
  uncertainty.correct({4.0, 0.0, 0.0}, corridor);
  EXPECT_NEAR(uncertainty.covariance()(0, 0), along_m2, 1e-9) << "nothing said of its length";
  EXPECT_NEAR(std::sqrt(uncertainty.covariance()(1, 1)), 0.002, 1e-5);
  uncertainty.correct({4.0, 0.0, 0.0}, kNothing);
  EXPECT_NEAR(uncertainty.covariance()(0, 0), along_m2, 1e-9);
}

TEST(PoseUncertainty, AskingAgainMakesNoSurer) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({4.0, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) uncertainty.correct({4.0, 0.0, 0.0}, information(0.01, 0.01, 0.01));
  EXPECT_NEAR(std::sqrt(uncertainty.covariance()(0, 0)), 0.01, 1e-5);
}

TEST(PoseUncertainty, IsNoBetterThanWhatItGoesBy) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({9.0, 0.0, 0.0});
  const double lost_m = std::sqrt(uncertainty.covariance()(0, 0));
  ASSERT_GT(lost_m, 0.05);
  uncertainty.remember();
  uncertainty.correct({9.0, 0.0, 0.0}, information(0.001, 0.001, 0.001));
  EXPECT_GT(std::sqrt(uncertainty.covariance()(0, 0)), 0.9 * lost_m);
}

TEST(PoseUncertainty, KnowsHowFarOdometryMayHaveDrifted) {
  PoseUncertainty uncertainty({}, {});
  EXPECT_LT(uncertainty.plausible_turn_rad(), 0.05) << "where it started";
  uncertainty.move_to({0.0, 0.0, 3.0});
  EXPECT_NEAR(uncertainty.plausible_turn_rad(), 0.03 + 5.0 * 0.02 * std::sqrt(3.0), 1e-6);
  EXPECT_LT(uncertainty.plausible_shift_m(), 0.05) << "it only turned";
}

TEST(PoseUncertainty, ABiasAddsUpUntilItIsForgotten) {
  PoseUncertainty uncertainty({}, {});
  double before_m2 = 0.0;
  for (const auto& [x_m, grown_m2] :
       {std::pair(1.0, 2e-4), {2.0, 4e-4}, {6.0, 3.6e-3}, {7.0, 1.1e-3}}) {
    uncertainty.move_to({x_m, 0.0, 0.0});
    EXPECT_NEAR(uncertainty.covariance()(0, 0) - before_m2, grown_m2, 1e-12) << x_m;
    before_m2 = uncertainty.covariance()(0, 0);
  }
}

/// A wrong heading becomes a wrong place across the way that is driven next.
PoseUncertainty after_two_ways() {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({1.0, 0.0, 0.0});
  uncertainty.move_to({1.5, 2.0, 0.3});
  return uncertainty;
}

TEST(PoseUncertainty, AWrongHeadingLeadsAstray) {
  const Eigen::Matrix3d covariance = after_two_ways().covariance();
  EXPECT_NEAR(covariance(0, 0), 0.0017434658438426494, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.0012747158438426495, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.0006604829219213247, 1e-12);
  EXPECT_NEAR(covariance(0, 1), -1.25e-4, 1e-12);
  EXPECT_NEAR(covariance(0, 2), -2.5e-4, 1e-12);
  EXPECT_NEAR(covariance(1, 2), 6.25e-5, 1e-12);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-12));
}

TEST(PoseUncertainty, TellsHowFarOffAPointAndACorrectionMayBe) {
  const PoseUncertainty uncertainty = after_two_ways();
  EXPECT_NEAR(mapped_sigma_m({1.5, 2.0, 0.3}, uncertainty.covariance(), {3.5, 1.0}),
              0.0779140314532108, 1e-12);
  EXPECT_NEAR(uncertainty.plausible_shift_m(), 0.3046899018750643, 1e-12);
  EXPECT_NEAR(uncertainty.plausible_turn_rad(), 0.15849931146910134, 1e-12);
}

TEST(PoseUncertainty, ATurnGoesTheShortWay) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({0.0, 0.0, 3.0});
  uncertainty.move_to({0.0, 0.0, -3.0});
  EXPECT_NEAR(uncertainty.covariance()(2, 2), 0.0013132741228718346, 1e-12);
}

TEST(PoseUncertainty, ADirectionKnownToTenMetresIsMeasured) {
  for (const auto& [weakest, grown_m2] : {std::pair(0.015, 2e-4), std::pair(0.007, 6e-4)}) {
    PoseUncertainty uncertainty({}, {});
    uncertainty.move_to({2.0, 0.0, 0.0});
    uncertainty.correct({2.0, 0.0, 0.0}, Eigen::Vector3d(1e4, 1e4, weakest).asDiagonal());
    const double before_m2 = uncertainty.covariance()(0, 0);
    uncertainty.move_to({3.0, 0.0, 0.0});
    EXPECT_NEAR(uncertainty.covariance()(0, 0) - before_m2, grown_m2, 1e-12)
        << "a bias is forgotten where all three are measured";
  }
}

TEST(PoseUncertainty, GoesByTheMeanOfWhatItRemembers) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({1.0, 0.0, 0.0});  // 2e-4 m2
  uncertainty.remember();
  uncertainty.move_to({9.0, 0.0, 0.0});  // 9e-3 m2
  uncertainty.remember();
  uncertainty.remember();
  EXPECT_NEAR(uncertainty.covariance()(0, 0), 9e-3, 1e-12);
  uncertainty.correct({9.0, 0.0, 0.0}, 1e9 * Eigen::Matrix3d::Identity());
  EXPECT_NEAR(uncertainty.covariance()(0, 0), 1.82e-2 / 3.0, 1e-7);
}

TEST(PoseUncertainty, IsAsSureAsItIsToldToBe) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({3.0, 0.0, 0.0});
  const Eigen::Matrix3d told = Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal();
  uncertainty.assume({4.0, 5.0, 0.0}, told);
  EXPECT_TRUE(uncertainty.covariance() == told);
  EXPECT_NEAR(mapped_sigma_m({4.0, 5.0, 0.0}, told, {4.0, 5.0}), std::sqrt(0.03), 1e-12);
  uncertainty.correct({4.0, 5.0, 0.0}, 1e9 * Eigen::Matrix3d::Identity());
  EXPECT_TRUE(uncertainty.covariance().isApprox(told, 1e-6)) << "so is what it goes by";
  const double before_m2 = uncertainty.covariance()(0, 0);
  uncertainty.move_to({5.0, 5.0, 0.0});
  EXPECT_NEAR(uncertainty.covariance()(0, 0) - before_m2, 2e-4, 1e-12);
}

TEST(PoseUncertainty, ARegistrationMayTellOfOneDirectionAlone) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.move_to({4.0, 0.0, 0.0});
  const double across_m2 = uncertainty.covariance()(1, 1);
  uncertainty.correct({4.0, 0.0, 0.0}, Eigen::Vector3d(1e4, 0.0, 0.0).asDiagonal());
  EXPECT_NEAR(uncertainty.covariance()(0, 0), 1e-4, 1e-8);
  EXPECT_NEAR(uncertainty.covariance()(1, 1), across_m2, 1e-9);
}

TEST(PoseUncertainty, WhatIsKnownExactlyMayBeRegistered) {
  PoseUncertainty uncertainty({}, {});
  uncertainty.correct({}, information(0.01, 0.01, 0.01));
  EXPECT_LT(uncertainty.covariance().norm(), 1e-9);
}

}  // namespace
}  // namespace vantage
