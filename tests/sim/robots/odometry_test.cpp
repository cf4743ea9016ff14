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

TEST(Odometry, BiasesFadeWithTheDistanceAndMoveWhatIsMeasured) {
  OdometryOptions options = OdometryOptions::perfect();
  options.bias_length_m = 2.0;
  OdometryBias bias{.x_m_per_m = 0.1, .y_m_per_m = -0.2, .yaw_rad_per_m = 0.3};
  Rng rng(1);
  const Pose2 measured = measure_increment({0.3, 0.4, -0.7}, bias, options, rng);
  const double left = 0.7788007830714049;  // exp(-0.5 / 2)
  EXPECT_NEAR(bias.x_m_per_m, 0.1 * left, 1e-12);
  EXPECT_NEAR(bias.y_m_per_m, -0.2 * left, 1e-12);
  EXPECT_NEAR(bias.yaw_rad_per_m, 0.3 * left, 1e-12);
  EXPECT_NEAR(measured.x_m, 0.33894003915357024, 1e-12);
  EXPECT_NEAR(measured.y_m, 0.3221199216928595, 1e-12);
  EXPECT_NEAR(measured.yaw_rad, -0.5831798825392892, 1e-12);
}

/// What is added to an increment, with always the same random numbers.
Pose2 error_of(const OdometryOptions& options, const Pose2& step) {
  OdometryBias bias;
  Rng rng(7);
  const Pose2 measured = measure_increment(step, bias, options, rng);
  return {measured.x_m - step.x_m, measured.y_m - step.y_m, measured.yaw_rad - step.yaw_rad};
}

TEST(Odometry, NoiseScalesWithItsSigmaAndTheRootOfTheWay) {
  const Pose2 one = error_of(only_noise(), {0.6, 0.8, 0.0});
  EXPECT_GT(std::abs(one.x_m), 1e-6);
  EXPECT_GT(std::abs(one.y_m), 1e-6);
  EXPECT_GT(std::abs(one.yaw_rad), 1e-6);
  const Pose2 four = error_of(only_noise(), {-2.4, 3.2, 0.0});
  EXPECT_NEAR(four.x_m, 2.0 * one.x_m, 1e-12);
  EXPECT_NEAR(four.y_m, 2.0 * one.y_m, 1e-12);
  EXPECT_NEAR(four.yaw_rad, 2.0 * one.yaw_rad, 1e-12);
  OdometryOptions rough = only_noise();
  rough.sigma_translation_m *= 3.0;
  const Pose2 wide = error_of(rough, {0.6, 0.8, 0.0});
  EXPECT_NEAR(wide.x_m, 3.0 * one.x_m, 1e-12);
  EXPECT_NEAR(wide.y_m, 3.0 * one.y_m, 1e-12);
  EXPECT_NEAR(wide.yaw_rad, one.yaw_rad, 1e-12);
}

TEST(Odometry, WayAndTurnAddTheirVariancesToTheHeading) {
  OdometryOptions options = only_noise();  // 0.01 rad after a metre
  options.sigma_turn_rad = 0.03;
  const double metre_rad = error_of(options, {1.0, 0.0, 0.0}).yaw_rad;
  for (const double turn_rad : {-0.5, 0.5}) {
    EXPECT_NEAR(error_of(options, {0.0, 0.0, turn_rad}).yaw_rad, 3.0 * std::sqrt(0.5) * metre_rad,
                1e-12);
    EXPECT_NEAR(error_of(options, {1.0, 0.0, turn_rad}).yaw_rad, std::sqrt(5.5) * metre_rad, 1e-12);
  }
}

TEST(Odometry, BiasesStartAsLargeAsTheirOptionsSay) {
  const auto biases = [](double translation, double yaw) {
    OdometryOptions options;
    options.bias_translation_m_per_m = translation;
    options.bias_yaw_rad_per_m = yaw;
    return Odometry(options, Rng(5), {}).bias();
  };
  const OdometryBias one = biases(1.0, 1.0);
  EXPECT_NE(one.x_m_per_m, one.y_m_per_m);
  EXPECT_NE(one.x_m_per_m, one.yaw_rad_per_m);
  const OdometryBias other = biases(0.25, 3.0);
  EXPECT_NEAR(other.x_m_per_m, 0.25 * one.x_m_per_m, 1e-12);
  EXPECT_NEAR(other.y_m_per_m, 0.25 * one.y_m_per_m, 1e-12);
  EXPECT_NEAR(other.yaw_rad_per_m, 3.0 * one.yaw_rad_per_m, 1e-12);
}

}  // namespace
}  // namespace vantage
