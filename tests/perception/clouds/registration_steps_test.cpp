// Registration of a line before a wall: steps and their information in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "vantage/perception/clouds/registration.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;

/// A wall at x = 2 that faces the base, seen 1 cm too near and turned by 2 mrad. One step does.
class LineBeforeAWall : public testing::Test {
 protected:
  LineBeforeAWall() {
    for (int i = -10; i <= 50; ++i) {
      const double y = 0.05 * i;
      wall_.points.emplace_back(2.0, y, 0.5);
      wall_.normals.emplace_back(-1.0F, 0.0F, 0.0F);
      scan_.points.emplace_back(1.99 - 0.002 * y, y, 0.5);
      level_.points.emplace_back(1.99, y, 0.5);
    }
    options_.min_correspondence_m = options_.max_correspondence_m = 0.06;
    options_.tolerance_m = options_.tolerance_rad = 1.0;  // at rest after any step
    options_.trim_fraction = 1.0;
    options_.kernel_scale_m = 0.03;
  }
  [[nodiscard]] RegistrationResult found(const Correction& plausible = {}) const {
    return register_scan(scan_, wall_, {}, options_, plausible);
  }

  PointCloud wall_;
  PointCloud scan_;
  PointCloud level_;  ///< not turned
  RegistrationOptions options_;
};

TEST_F(LineBeforeAWall, OneStepMovesAndTurns) {
  const auto result = found();
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.T_world_base.x_m, 0.01, 1e-5);
  EXPECT_NEAR(result.T_world_base.y_m, 0.0, 1e-12);
  EXPECT_NEAR(result.T_world_base.yaw_rad, -0.002, 1e-5);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_EQ(result.unconstrained, 1) << "along the wall";
  EXPECT_EQ(result.overlap, 1.0);
}

TEST_F(LineBeforeAWall, CorrectionsHaveLimits) {
  options_.max_correction_m = 0.0101;
  options_.max_correction_rad = 0.0021;
  EXPECT_TRUE(found({.shift_m = 0.0101, .turn_rad = 0.0021}).converged);
  EXPECT_THAT(found({.shift_m = 0.0099}).reason, HasSubstr("odometry explains 0.010 m"));
  EXPECT_THAT(found({.turn_rad = 0.0019}).reason, HasSubstr("moved 0.010 m and 0.002 rad"));
  options_.max_correction_rad = 0.0019;
  EXPECT_THAT(found().reason, HasSubstr("turned 0.002 rad"));
  options_.max_correction_m = 0.0099;
  EXPECT_THAT(found().reason, HasSubstr("moved 0.010 m, more than 0.0099 m"));
  EXPECT_EQ(found().T_world_base.x_m, 0.0);
  EXPECT_TRUE(found().information.isZero());
}

TEST_F(LineBeforeAWall, CorrectionsMayBeAsLargeAsTheirLimits) {
  const Pose2 pose = found().T_world_base;
  const Correction as_large{.shift_m = std::hypot(pose.x_m, pose.y_m),
                            .turn_rad = std::abs(pose.yaw_rad)};
  options_.max_correction_m = as_large.shift_m;
  options_.max_correction_rad = as_large.turn_rad;
  options_.min_overlap = 1.0;
  EXPECT_EQ(found(as_large).reason, "");
}

TEST_F(LineBeforeAWall, InformationIsOfPairsAsGoodAsAVoxel) {
  const auto result = register_scan(level_, wall_, {}, options_);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.rmse_m, 0.01, 1e-6);
  double sum_y = 0.0;
  double sum_y2 = 0.0;
  for (int i = -10; i <= 50; ++i) {
    sum_y += 0.05 * i;
    sum_y2 += 0.0025 * i * i;
  }
  const double per_m2 = 0.81 / (0.03 * 0.03);  // the kernel's weight is 1 / (1 + 1 / 9)^2
  const Eigen::Matrix3d& information = result.information;
  EXPECT_NEAR(information(0, 0), 61.0 * per_m2, 1.0);
  EXPECT_NEAR(information(0, 2), -sum_y * per_m2, 1.0);
  EXPECT_NEAR(information(2, 2), sum_y2 * per_m2, 1.0);
  EXPECT_NEAR(information(1, 1), 0.0, 1e-6);
}

TEST_F(LineBeforeAWall, NeedsPairs) {
  options_.min_correspondences = 61;
  EXPECT_TRUE(found().converged);
  options_.min_correspondences = 62;
  EXPECT_EQ(found().reason, "only 61 points have a partner in the map");
}

TEST_F(LineBeforeAWall, OverlapIsTheShareOfPointsWithAPartner) {
  for (int i = 0; i < 20; ++i) scan_.points.emplace_back(1.0, 0.1 * i, 0.5);
  EXPECT_DOUBLE_EQ(found().overlap, 61.0 / 81.0);
  options_.min_overlap = 0.753;
  EXPECT_TRUE(found().converged);
  options_.min_overlap = 0.754;
  EXPECT_THAT(found().reason, HasSubstr("overlap 0.753 is below 0.754"));
}

TEST_F(LineBeforeAWall, TheRadiusShrinksToItsLeast) {
  options_.max_correspondence_m = 0.2;  // 0.2 x 0.8^7 is above 0.04, 0.2 x 0.8^8 below
  options_.min_correspondence_m = 0.04;
  EXPECT_EQ(found().iterations, 9);
  options_.max_iterations = 9;
  EXPECT_TRUE(found().converged);
  options_.max_iterations = 8;
  EXPECT_EQ(found().reason, "no convergence in 8 iterations");
}

TEST_F(LineBeforeAWall, GoesOnUntilAStepIsShort) {
  options_.tolerance_m = 1e-4;
  EXPECT_EQ(found().iterations, 2) << "the first step is of 1 cm, the next of nothing";
  options_.tolerance_m = 1.0;
  options_.tolerance_rad = 1e-4;
  EXPECT_EQ(found().iterations, 2);
}

TEST_F(LineBeforeAWall, TheKernelIsNoNarrowerThanAThirdOfTheRadius) {
  options_.kernel_scale_m = 0.001;
  PointCloud& scan = level_;
  for (std::size_t i = 0; i < scan.size(); i += 4) scan.points[i].x() = 1.96F;
  const auto weight = [](double residual_m) {
    return std::pow(1.0 + residual_m * residual_m / (0.02 * 0.02), -2.0);
  };
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  Eigen::Vector2d wanted = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double residual_m = 2.0 - static_cast<double>(scan.points[i].x());
    const Eigen::Vector2d row(1.0, -static_cast<double>(scan.points[i].y()));
    products += weight(residual_m) * row * row.transpose();
    wanted += weight(residual_m) * residual_m * row;
  }
  const Eigen::Vector2d expected = products.ldlt().solve(wanted);
  const auto result = register_scan(scan, wall_, {}, options_);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.T_world_base.x_m, expected.x(), 1e-6);
  EXPECT_NEAR(result.T_world_base.yaw_rad, expected.y(), 1e-6);
}

/// Of 61 pairs the 6 worst are left out, not 7.
TEST_F(LineBeforeAWall, WhatIsKeptIsRoundedUp) {
  options_.trim_fraction = 0.9;
  for (std::size_t i = 0; i < 7; ++i) level_.points[8 * i].x() = 1.96F;
  const auto result = register_scan(level_, wall_, {}, options_);
  EXPECT_NEAR(result.rmse_m, std::sqrt((54.0 * 0.0001 + 0.0016) / 55.0), 1e-6);
}

TEST_F(LineBeforeAWall, NormalsMayDifferByAnAngle) {
  const auto with_normals_at = [&](double angle_rad) {
    PointCloud scan = level_;
    const Eigen::Vector3f normal(-std::cos(angle_rad), std::sin(angle_rad), 0.0F);
    scan.normals.assign(scan.size(), normal);
    return register_scan(scan, wall_, {}, options_);
  };
  EXPECT_TRUE(with_normals_at(0.79).converged);
  EXPECT_EQ(with_normals_at(0.81).reason, "only 0 points have a partner in the map");
}

TEST_F(LineBeforeAWall, FlatSurfacesAreLeftOut) {
  for (auto& normal : wall_.normals) normal = {-0.8660254F, 0.0F, 0.5F};
  EXPECT_NEAR(found().T_world_base.x_m, 0.01, 1e-5);
  for (auto& normal : wall_.normals) normal = {-0.86F, 0.0F, 0.51F};
  EXPECT_EQ(found().reason, "the map has no upright surface");
}

/// Weight 0.81 of each pair, less the 0.003 that noise says, 3 cm for a standard deviation.
TEST_F(LineBeforeAWall, APriorIsWeighedAgainstTheWall) {
  PosePrior prior;
  prior.information = Eigen::Vector3d(20000.0, 700.0, 50000.0).asDiagonal();
  const auto result = register_with_prior(level_, wall_, prior, options_);
  ASSERT_TRUE(result.converged) << result.reason;
  double mean_y = 0.0;
  double mean_y2 = 0.0;
  for (int i = -10; i <= 50; ++i) {
    mean_y += 0.05 * i / 61.0;
    mean_y2 += 0.0025 * i * i / 61.0;
  }
  const double arm2 = 1.99 * 1.99 + mean_y2;
  const double pairs = 61.0 * 0.81 / (0.03 * 0.03);
  Eigen::Matrix2d walls{{1.0 - 0.003, -mean_y}, {-mean_y, mean_y2 - 0.003 * arm2}};
  walls *= pairs;
  Eigen::Matrix2d both = walls;
  both.diagonal() += Eigen::Vector2d(20000.0, 50000.0);
  const Eigen::Vector2d expected = both.ldlt().solve(walls * Eigen::Vector2d(0.01, 0.0));
  EXPECT_NEAR(result.T_world_base.x_m, expected.x(), 1e-6);
  EXPECT_NEAR(result.T_world_base.y_m, 0.0, 1e-12);
  EXPECT_NEAR(result.T_world_base.yaw_rad, expected.y(), 1e-6);
  EXPECT_NEAR(result.information(0, 0), walls(0, 0), 1.0);
  EXPECT_NEAR(result.information(0, 2), walls(0, 1), 1.0);
  EXPECT_NEAR(result.information(2, 2), walls(1, 1), 1.0);
}

/// Where what the wall wants of the next step is what the prior wants back.
TEST_F(LineBeforeAWall, APriorPullsEveryStepBack) {
  options_.tolerance_m = options_.tolerance_rad = 1e-8;
  PosePrior prior;
  prior.T_world_base = {0.004, 0.0, 0.0};
  prior.information = Eigen::Vector3d(20000.0, 700.0, 1e12).asDiagonal();
  const auto result = register_with_prior(level_, wall_, prior, options_);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_GT(result.iterations, 1);
  const double x_m = result.T_world_base.x_m;
  const double residual_m = 0.01 - x_m;
  const double weight = std::pow(1.0 + residual_m * residual_m / 9e-4, -2.0);
  EXPECT_NEAR(0.997 * 61.0 * weight / 9e-4 * residual_m, 20000.0 * (x_m - 0.004), 0.05);
  EXPECT_NEAR(result.T_world_base.y_m, 0.0, 1e-12);
}

TEST_F(LineBeforeAWall, APriorThatIsSureIsKept) {
  PosePrior prior;
  prior.T_world_base = {0.004, -0.003, 0.01};
  prior.information = 1e12 * Eigen::Matrix3d::Identity();
  const auto result = register_with_prior(level_, wall_, prior, options_);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.T_world_base.x_m, 0.004, 1e-6);
  EXPECT_NEAR(result.T_world_base.y_m, -0.003, 1e-6);
  EXPECT_NEAR(result.T_world_base.yaw_rad, 0.01, 1e-6);
}

TEST_F(LineBeforeAWall, APriorThatIsUnsureLeavesTheStepToTheWall) {
  const auto result = register_with_prior(scan_, wall_, PosePrior{}, options_);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.T_world_base.x_m, 0.01, 1e-5);
  EXPECT_NEAR(result.T_world_base.y_m, 0.0, 1e-9);
  EXPECT_NEAR(result.T_world_base.yaw_rad, -0.002, 1e-5);
}

/// Their strongest direction is worth 1.2 times the 61 pairs.
TEST_F(LineBeforeAWall, IsRefusedWhereItSaysTooLittleOfEveryDirection) {
  options_.min_constraint_correspondences = 100.0;
  const auto result = found();
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.reason, "no surface constrains the pose");
  EXPECT_EQ(result.unconstrained, 3);
}

}  // namespace
}  // namespace vantage
