#include "vantage/sim/robots/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace vantage {
namespace {

struct Spread {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// Root mean square error after driving a straight line in steps.
Spread spread_after(double length_m, double step_m, const OdometryOptions& options) {
  constexpr int kRuns = 600;
  Spread sum;
  for (int run = 0; run < kRuns; ++run) {
    Odometry odometry(options, Rng(static_cast<std::uint64_t>(run)), {});
    for (double x_m = step_m; x_m <= length_m + 1e-9; x_m += step_m) odometry.update({x_m, 0, 0});
    const Pose2& end = odometry.estimate();
    sum.x_m += (end.x_m - length_m) * (end.x_m - length_m) / kRuns;
    sum.y_m += end.y_m * end.y_m / kRuns;
    sum.yaw_rad += end.yaw_rad * end.yaw_rad / kRuns;
  }
  return {std::sqrt(sum.x_m), std::sqrt(sum.y_m), std::sqrt(sum.yaw_rad)};
}

OdometryOptions only_noise() {
  OdometryOptions options = OdometryOptions::perfect();
  options.sigma_translation_m = 0.02;
  options.sigma_yaw_rad = 0.01;
  return options;
}

TEST(Odometry, PerfectOdometryIsTheTruth) {
  Odometry odometry(OdometryOptions::perfect(), Rng(1), {1.0, 2.0, 0.3});
  for (int i = 1; i <= 200; ++i) {
    const double t = 0.05 * i;
    const Pose2 truth{std::cos(t), std::sin(2.0 * t), 0.3 + t};
    odometry.update(truth);
    EXPECT_NEAR(odometry.estimate().x_m, truth.x_m, 1e-9);
    EXPECT_NEAR(odometry.estimate().y_m, truth.y_m, 1e-9);
    EXPECT_NEAR(wrap_angle(odometry.estimate().yaw_rad - truth.yaw_rad), 0.0, 1e-9);
  }
}

TEST(Odometry, ARobotAtRestMakesNoError) {
  Odometry odometry({}, Rng(1), {1.0, 2.0, 0.3});
  for (int i = 0; i < 1000; ++i) odometry.update({1.0, 2.0, 0.3});
  EXPECT_NEAR(odometry.estimate().x_m, 1.0, 1e-8);
  EXPECT_NEAR(odometry.estimate().y_m, 2.0, 1e-8);
  EXPECT_NEAR(odometry.estimate().yaw_rad, 0.3, 1e-8);
}

TEST(Odometry, NoiseGrowsWithTheRootOfTheDistanceWhateverTheTick) {
  const Spread short_way = spread_after(1.0, 0.02, only_noise());
  EXPECT_NEAR(short_way.x_m, 0.02, 0.002);
  EXPECT_NEAR(short_way.yaw_rad, 0.01, 0.001);
  EXPECT_NEAR(spread_after(4.0, 0.02, only_noise()).x_m, 0.04, 0.004);
  EXPECT_NEAR(spread_after(1.0, 0.005, only_noise()).x_m, 0.02, 0.002);
}

TEST(Odometry, TurningAddsHeadingError) {
  OdometryOptions options = OdometryOptions::perfect();
  options.sigma_turn_rad = 0.03;
  double sum = 0.0;
  for (std::uint64_t run = 0; run < 600; ++run) {
    Odometry odometry(options, Rng(run), {});
    for (int i = 1; i <= 50; ++i) odometry.update({0.0, 0.0, 0.02 * i});
    const double error_rad = wrap_angle(odometry.estimate().yaw_rad - 1.0);
    sum += error_rad * error_rad / 600.0;
  }
  EXPECT_NEAR(std::sqrt(sum), 0.03, 0.003);
}

TEST(Odometry, BiasGrowsWithTheDistanceAndWanders) {
  OdometryOptions options = OdometryOptions::perfect();
  options.bias_translation_m_per_m = 0.02;
  options.bias_length_m = 100.0;
  EXPECT_NEAR(spread_after(4.0, 0.02, options).x_m, 0.08, 0.008) << "hardly changes over 4 m";

  // Stationary: its size stays the same however far the robot goes.
  options.bias_length_m = 1.0;
  double sum = 0.0;
  for (std::uint64_t run = 0; run < 1000; ++run) {
    Odometry odometry(options, Rng(run), {});
    for (int i = 1; i <= 50; ++i) odometry.update({0.1 * i, 0.0, 0.0});
    sum += odometry.bias().y_m_per_m * odometry.bias().y_m_per_m / 1000.0;
  }
  EXPECT_NEAR(std::sqrt(sum), 0.02, 0.002);
}

TEST(Odometry, SameSeedSameBits) {
  Odometry a({}, Rng::stream(3, "odometry"), {});
  Odometry b({}, Rng::stream(3, "odometry"), {});
  Odometry c({}, Rng::stream(4, "odometry"), {});
  for (int i = 1; i <= 50; ++i) {
    const Pose2 truth{0.02 * i, 0.01 * i, 0.01 * i};
    a.update(truth);
    b.update(truth);
    c.update(truth);
  }
  EXPECT_EQ(a.estimate().x_m, b.estimate().x_m);
  EXPECT_EQ(a.estimate().yaw_rad, b.estimate().yaw_rad);
  EXPECT_NE(a.estimate().x_m, c.estimate().x_m);
}

TEST(Odometry, ACorrectionReplacesTheEstimate) {
  Odometry odometry(OdometryOptions::perfect(), Rng(1), {});
  odometry.update({1.0, 0.0, 0.0});
  odometry.correct({5.0, 5.0, std::numbers::pi / 2.0});
  const Pose2 increment = odometry.update({1.5, 0.0, 0.0});
  EXPECT_NEAR(increment.x_m, 0.5, 1e-12);
  EXPECT_NEAR(odometry.estimate().x_m, 5.0, 1e-12);
  EXPECT_NEAR(odometry.estimate().y_m, 5.5, 1e-12);
}

TEST(Odometry, RejectsOptionsOutOfRange) {
  OdometryOptions options;
  options.sigma_yaw_rad = -1.0;
  EXPECT_THROW(Odometry(options, Rng(1), {}), ConfigError);
}

}  // namespace
}  // namespace vantage
