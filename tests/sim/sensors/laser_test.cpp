#include "vantage/sim/sensors/laser.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/mjcf.hpp"

namespace vantage {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// Seen from above; the sensor S looks along x at a wall 2 m ahead, itself inside a body.
///
///      S ->      |
///                |  wall, x = 2
test::MjcfModel wall_scene() {
  return test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom type="box" size="0.5 20 20" pos="2.5 0 0"/>
      <body name="sensor"><geom type="sphere" size="0.05"/></body>
    </worldbody></mujoco>)");
}

Pose tilted(double tilt_rad) { return make_pose(Eigen::Vector3d::Zero(), 0.0, tilt_rad); }

TEST(Laser, BeamsAreSymmetricAboutZeroAndSpanTheSector) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  ScanBuilder builder{LaserOptions{}};
  builder.add_line(rays, tilted(0.0), 0.0, scene.body("sensor"), rng);
  const RangeScan scan = builder.finish();
  ASSERT_EQ(scan.beams(), 61U);
  EXPECT_NEAR(scan.azimuth_rad.front(), -7.5 * kDegree, 1e-12);
  EXPECT_NEAR(scan.field_of_view.half_width_rad, 7.5 * kDegree, 1e-12);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    EXPECT_DOUBLE_EQ(scan.azimuth_rad[i], -scan.azimuth_rad[scan.beams() - 1 - i]);
  }
}

TEST(Laser, AStepThatDoesNotDivideTheSectorStaysInsideIt) {
  const LaserOptions options{.sector_rad = 10.0 * kDegree, .step_rad = 4.0 * kDegree};
  EXPECT_NEAR(field_of_view(options).half_width_rad, 4.0 * kDegree, 1e-12);
}

TEST(Laser, NoiseFreeRangesFollowTheWall) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  ScanBuilder builder(LaserOptions{.noise_sigma_m = 0.0});
  for (const double tilt : {-0.3, 0.0, 0.5}) {
    builder.add_line(rays, tilted(tilt), tilt, scene.body("sensor"), rng);
  }
  const RangeScan scan = builder.finish();
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      const Eigen::Vector3d d = beam_direction({scan.azimuth_rad[beam], scan.tilt_rad[line]});
      EXPECT_NEAR(scan.range(line, beam), 2.0 / d.x(), 1e-6);
    }
  }
}

TEST(Laser, LinesAreSortedAndDuplicatesDropped) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  ScanBuilder builder{LaserOptions{}};
  for (const double tilt : {0.2, 0.2, -0.1, 0.2 + 1e-9, 0.0}) {
    builder.add_line(rays, tilted(tilt), tilt, scene.body("sensor"), rng);
  }
  const RangeScan scan = builder.finish();
  EXPECT_EQ(scan.tilt_rad, (std::vector<double>{-0.1, 0.0, 0.2}));
  EXPECT_EQ(scan.range_m.size(), scan.lines() * scan.beams());
  EXPECT_EQ(builder.finish().lines(), 0U);
}

TEST(Laser, NothingWithinRangeIsInfinityTooNearIsNaN) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  const int sensor = scene.body("sensor");
  ScanBuilder far(LaserOptions{.range_max_m = 1.9});
  far.add_line(rays, tilted(0.0), 0.0, sensor, rng);
  for (const float range : far.finish().range_m) EXPECT_TRUE(std::isinf(range));
  ScanBuilder near(LaserOptions{.range_min_m = 2.2});
  near.add_line(rays, tilted(0.0), 0.0, sensor, rng);
  for (const float range : near.finish().range_m) EXPECT_TRUE(std::isnan(range));
}

TEST(Laser, WithoutExclusionItSeesItsOwnHousing) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  ScanBuilder builder(LaserOptions{.range_min_m = 0.0, .noise_sigma_m = 0.0});
  builder.add_line(rays, tilted(0.0), 0.0, -1, rng);
  EXPECT_NEAR(builder.finish().range(0, 30), 0.05, 1e-6);
}

TEST(Laser, NoiseHasTheConfiguredSpreadAndRepeats) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  const auto measure = [&](std::uint64_t seed) {
    Rng rng(seed);
    ScanBuilder builder(LaserOptions{.noise_sigma_m = 0.02});
    for (int line = 0; line < 300; ++line) {
      builder.add_line(rays, tilted(0.0), 1e-3 * line, scene.body("sensor"), rng);
    }
    return builder.finish();
  };
  const RangeScan scan = measure(7);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      const double error = scan.range(line, beam) - 2.0 / std::cos(scan.azimuth_rad[beam]);
      sum += error;
      squares += error * error;
    }
  }
  const auto n = static_cast<double>(scan.range_m.size());
  EXPECT_NEAR(sum / n, 0.0, 5.0 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 0.0005);
  EXPECT_EQ(scan.range_m, measure(7).range_m);
  EXPECT_NE(scan.range_m, measure(8).range_m);
}

TEST(Laser, ContradictoryOptionsAreErrors) {
  EXPECT_THROW(ScanBuilder(LaserOptions{.range_min_m = 11.0}), ConfigError);
  EXPECT_THROW(ScanBuilder(LaserOptions{.tilt_min_rad = 1.0}), ConfigError);
  EXPECT_THROW(ScanBuilder(LaserOptions{.step_rad = 1.0}), ConfigError);
  EXPECT_THROW(ScanBuilder(LaserOptions{.noise_sigma_m = -1.0}), ConfigError);
  EXPECT_THROW(check_options(PlanarScannerOptions{.range_min_m = 11.0}), ConfigError);
}

TEST(PlanarScanner, SeesAllRoundButBehind) {
  const auto scene = wall_scene();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  const PlanarScannerOptions options{.noise_sigma_m = 0.0};
  const PlanarScan scan =
      planar_scan(rays, tilted(0.0), {0.3, 0.0, 0.0}, scene.body("sensor"), options, rng);
  ASSERT_EQ(scan.azimuth_rad.size(), 541U);
  EXPECT_NEAR(scan.azimuth_rad.back(), 135.0 * kDegree, 1e-9);
  EXPECT_EQ(scan.T_base_sensor.x_m, 0.3);
  for (std::size_t i = 0; i < scan.azimuth_rad.size(); ++i) {
    const double ahead = std::cos(scan.azimuth_rad[i]);
    if (ahead > 0.0 && 2.0 / ahead < options.range_max_m) {
      EXPECT_NEAR(scan.range_m[i], 2.0 / ahead, 1e-6);
    } else {
      EXPECT_TRUE(std::isinf(scan.range_m[i]));
    }
  }
}

}  // namespace
}  // namespace vantage
