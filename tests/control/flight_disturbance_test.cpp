#include "vantage/control/flight_disturbance.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

TEST(Gust, PushesForItsTime) {
  const Gust gust{.force_N = 4.0, .direction = {3.0, 0.0, 4.0}, .start_s = 1.0, .duration_s = 0.5};
  EXPECT_TRUE(gust.force_world_N(1.2).isApprox(Eigen::Vector3d(2.4, 0.0, 3.2), 1e-12));
  EXPECT_TRUE(gust.force_world_N(1.0).isApprox(Eigen::Vector3d(2.4, 0.0, 3.2), 1e-12));
  EXPECT_EQ(gust.force_world_N(0.999), Eigen::Vector3d::Zero());
  EXPECT_EQ(gust.force_world_N(1.5), Eigen::Vector3d::Zero());
}

TEST(Gust, NeedsADirection) {
  EXPECT_THROW(check_options(Gust{.direction = {0.0, 0.0, 0.0}}, "gust"), ConfigError);
}

TEST(PoseEstimate, IsExactWithoutNoise) {
  PoseEstimate estimate(PoseNoiseOptions::perfect(), Rng(1));
  FlightState truth;
  truth.T_world_body = make_pose({1.0, 2.0, 3.0}, 0.4, 0.2);
  estimate.update(0.1);
  EXPECT_EQ(estimate.of(truth).T_world_body.matrix(), truth.T_world_body.matrix());
}

TEST(PoseEstimate, ErrorsAreGaussianOfTheirSizeAndForgetInTime) {
  const PoseNoiseOptions options{.sigma_position_m = 0.02,
                                 .sigma_yaw_rad = 0.03,
                                 .sigma_tilt_rad = 0.004,
                                 .correlation_s = 0.5};
  FlightState truth;
  truth.T_world_body = make_pose({1.0, 2.0, 3.0}, 0.4);
  constexpr int kDraws = 4000;
  double x2 = 0.0;
  double yaw2 = 0.0;
  double tilt2 = 0.0;
  double kept = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    PoseEstimate estimate(options, Rng(static_cast<std::uint64_t>(i)));
    const Pose first = estimate.of(truth).T_world_body;
    for (int k = 0; k < 10; ++k) estimate.update(0.05);
    const Pose T = estimate.of(truth).T_world_body;
    const double x = T.translation().x() - 1.0;
    x2 += x * x / kDraws;
    kept += x * (first.translation().x() - 1.0) / kDraws;
    yaw2 += std::pow(project_to_se2(T).yaw_rad - 0.4, 2) / kDraws;
    tilt2 += std::pow(std::acos(std::min(1.0, T.linear()(2, 2))), 2) / kDraws;
  }
  // Four standard errors of a variance from that many draws.
  const double tolerance = 4.0 * std::sqrt(2.0 / kDraws);
  EXPECT_NEAR(x2 / (0.02 * 0.02), 1.0, tolerance);
  EXPECT_NEAR(yaw2 / (0.03 * 0.03), 1.0, tolerance);
  EXPECT_NEAR(tilt2 / (2.0 * 0.004 * 0.004), 1.0, tolerance);
  EXPECT_NEAR(kept / x2, std::exp(-1.0), tolerance) << "after 0.5 s";
}

/// Of the same random numbers both errors together are one after the other.
TEST(PoseEstimate, MayBeOffInHeadingAloneOrInTiltAlone) {
  FlightState truth;
  truth.T_world_body = make_pose({1.0, 2.0, 3.0}, 0.4, 0.2);
  const auto estimate = [](double sigma_yaw_rad, double sigma_tilt_rad) {
    return PoseEstimate(
        {.sigma_position_m = 0.0, .sigma_yaw_rad = sigma_yaw_rad, .sigma_tilt_rad = sigma_tilt_rad},
        Rng(1));
  };
  const PoseEstimate turned = estimate(0.1, 0.0);
  const PoseEstimate tilted = estimate(0.0, 0.05);
  const Pose both = estimate(0.1, 0.05).of(truth).T_world_body;
  EXPECT_GT((turned.of(truth).T_world_body.linear() - truth.T_world_body.linear()).norm(), 1e-3);
  EXPECT_GT((tilted.of(truth).T_world_body.linear() - truth.T_world_body.linear()).norm(), 1e-3);
  EXPECT_TRUE(turned.of(tilted.of(truth)).T_world_body.isApprox(both, 1e-12));
  EXPECT_TRUE(both.translation() == truth.T_world_body.translation());
}

TEST(Gust, ADirectionIsLongerThanANanometre) {
  Gust gust;
  gust.direction = {0.0, 1.2e-9, 0.0};
  EXPECT_NO_THROW(check_options(gust, "gust"));
  gust.direction = {0.0, 0.8e-9, 0.0};
  EXPECT_THROW(check_options(gust, "gust"), ConfigError);
}

TEST(PoseEstimate, RefusesOptionsOutOfRange) {
  PoseNoiseOptions options;
  options.correlation_s = 0.0;
  EXPECT_THROW(PoseEstimate(options, Rng(1)), ConfigError);
}

/// Six draws at first and six each time: x, y, z, yaw, about x, about y.
TEST(PoseEstimate, ErrorsAreTheDrawsOfItsGenerator) {
  const PoseNoiseOptions options{.sigma_position_m = 0.02,
                                 .sigma_yaw_rad = 0.03,
                                 .sigma_tilt_rad = 0.004,
                                 .correlation_s = 0.5};
  Rng rng(7);
  std::array<double, 6> error{};
  for (double& e : error) e = rng.normal();
  PoseEstimate estimate(options, Rng(7));
  const auto expect_off_by_the_errors = [&] {
    const Pose T = estimate.of(FlightState{}).T_world_body;
    const Eigen::Vector3d off_m = 0.02 * Eigen::Vector3d(error[0], error[1], error[2]);
    EXPECT_LT((T.translation() - off_m).norm(), 1e-12);
    const Eigen::Vector3d tilt = 0.004 * Eigen::Vector3d(error[4], error[5], 0.0);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.03 * error[3], Eigen::Vector3d::UnitZ()).toRotationMatrix() *
        Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
    EXPECT_LT((T.linear() - R).norm(), 1e-12);
  };
  expect_off_by_the_errors();
  estimate.update(0.1);
  const double keep = std::exp(-0.2);
  for (double& e : error) e = keep * e + std::sqrt(1.0 - keep * keep) * rng.normal();
  expect_off_by_the_errors();
}

}  // namespace
}  // namespace vantage
