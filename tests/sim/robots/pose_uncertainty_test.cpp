#include "vantage/sim/robots/pose_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_EQ(uncertainty.sigma_m({1.0, 1.0}), 0.0) << "the start is where the world is";
  uncertainty.move_to({1.0, 0.0, 0.0});
  const Eigen::Matrix3d& covariance = uncertainty.covariance();
  EXPECT_NEAR(covariance(0, 0), 0.01 * 0.01 + 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.01 * 0.01 + 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.01 * 0.01 + 0.005 * 0.005, 1e-12);
  EXPECT_NEAR(uncertainty.sigma_m({1.0, 0.0}), std::sqrt(4e-4), 1e-9);
  EXPECT_GT(uncertainty.sigma_m({3.0, 0.0}), 0.029) << "a wrong heading tells far away";
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

}  // namespace
}  // namespace vantage
