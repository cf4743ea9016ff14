// What sensors are by default, what they may be, and what they read: by numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/mjcf.hpp"
#include "tests/support/option_numbers.hpp"
#include "vantage/sim/faults/outside_faults.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/render/window.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/sim/sensors/laser.hpp"
#include "vantage/sim/world/collision_surfaces.hpp"
#include "vantage/sim/world/level_surfaces.hpp"
#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

using support::expect_numbers;
constexpr double kPi = std::numbers::pi;

TEST(SensorOptions, OfCameras) {
  expect_numbers(RgbdOptions{}, {{"width_px", 640, between(1, 8192)},
                                 {"height_px", 480, between(1, 8192)},
                                 {"fovy_rad", kPi / 4.0, between(0.01, 3.0)},
                                 {"range_min_m", 0.8, at_least(0.0)},
                                 {"range_max_m", 3.5, above(0.0)},
                                 {"tells_far", 0},
                                 {"noise", 1},
                                 {"noise_floor_m", 0.0012, at_least(0.0)},
                                 {"noise_growth_per_m", 0.0019, at_least(0.0)},
                                 {"noise_nearest_m", 0.4, at_least(0.0)},
                                 {"quantisation_per_m", 0.003, at_least(0.0)}});
  expect_numbers(ExposureOptions{},
                 {{"exposure_s", 0.004, between(0.0, 0.1)}, {"samples", 4, between(1, 64)}});
}

TEST(SensorOptions, OfLasers) {
  expect_numbers(LaserOptions{}, {{"sector_rad", kPi / 12.0, Range{0.0, 3.1416, true}},
                                  {"step_rad", kPi / 720.0, above(0.0)},
                                  {"line_rate_hz", 40.0, above(0.0)},
                                  {"tilt_min_rad", -0.36, between(-1.5, 1.5)},
                                  {"tilt_max_rad", 0.62, between(-1.5, 1.5)},
                                  {"scan_duration_s", 15.0, between(0.1, 3600.0)},
                                  {"range_min_m", 0.08, at_least(0.0)},
                                  {"range_max_m", 10.0, above(0.0)},
                                  {"noise_sigma_m", 0.005, at_least(0.0)}});
  expect_numbers(PlanarScannerOptions{}, {{"sector_rad", 1.5 * kPi, Range{0.0, 6.2832, true}},
                                          {"step_rad", kPi / 360.0, above(0.0)},
                                          {"range_min_m", 0.05, at_least(0.0)},
                                          {"range_max_m", 10.0, above(0.0)},
                                          {"noise_sigma_m", 0.01, at_least(0.0)}});
}

TEST(SensorOptions, LimitsMustNotMeet) {
  EXPECT_THROW((RgbdOptions{.range_min_m = 2.0, .range_max_m = 2.0}.check()), ConfigError);
  EXPECT_NO_THROW((RgbdOptions{.range_min_m = 2.0, .range_max_m = 2.1}.check()));
  EXPECT_THROW((LaserOptions{.range_min_m = 2.0, .range_max_m = 2.0}.check()), ConfigError);
  EXPECT_NO_THROW((LaserOptions{.range_min_m = 2.0, .range_max_m = 2.1}.check()));
  EXPECT_THROW((LaserOptions{.tilt_min_rad = 0.5, .tilt_max_rad = 0.5}.check()), ConfigError);
  EXPECT_NO_THROW((LaserOptions{.tilt_min_rad = 0.5, .tilt_max_rad = 0.6}.check()));
  EXPECT_THROW((LaserOptions{.sector_rad = 0.5, .step_rad = 0.6}.check()), ConfigError);
  EXPECT_NO_THROW((LaserOptions{.sector_rad = 0.5, .step_rad = 0.5}.check()));
  EXPECT_THROW((PlanarScannerOptions{.sector_rad = 0.5, .step_rad = 0.6}.check()), ConfigError);
  EXPECT_NO_THROW((PlanarScannerOptions{.sector_rad = 0.5, .step_rad = 0.5}.check()));
}

TEST(SensorOptions, AScanHasTenMillionBeamsAtMost) {
  const auto laser = [](double line_rate_hz) {
    return LaserOptions{.sector_rad = 0.2,
                        .step_rad = 0.001,
                        .line_rate_hz = line_rate_hz,
                        .scan_duration_s = 100.0};
  };
  EXPECT_NO_THROW(laser(450.0).check());
  EXPECT_THROW(laser(550.0).check(), ConfigError);
  EXPECT_NO_THROW((PlanarScannerOptions{.sector_rad = 4.5, .step_rad = 5e-7}.check()));
  EXPECT_THROW((PlanarScannerOptions{.sector_rad = 5.5, .step_rad = 5e-7}.check()), ConfigError);
  LaserOptions most;
  most.sector_rad = most.step_rad = 0.5;
  most.scan_duration_s = 1000.0;
  most.line_rate_hz = 10000.0;
  EXPECT_NO_THROW(most.check());
  most.line_rate_hz = 10001.0;
  EXPECT_THROW(most.check(), ConfigError);
}

TEST(SensorOptions, AScanSweepsWhatItsOptionsSay) {
  const FieldOfView swept = field_of_view({.sector_rad = 0.5,
                                           .step_rad = 0.125,
                                           .tilt_min_rad = -0.25,
                                           .tilt_max_rad = 0.75,
                                           .range_min_m = 0.3,
                                           .range_max_m = 7.0});
  EXPECT_DOUBLE_EQ(swept.half_width_rad, 0.25);
  EXPECT_EQ(swept.tilt_min_rad, -0.25);
  EXPECT_EQ(swept.tilt_max_rad, 0.75);
  EXPECT_EQ(swept.range_min_m, 0.3);
  EXPECT_EQ(swept.range_max_m, 7.0);
}

TEST(DepthErrors, AreThoseOfNoiseAndOfSteps) {
  const RgbdOptions options;
  EXPECT_NEAR(depth_sigma_m(options, 2.0), 0.006064, 1e-12);
  EXPECT_NEAR(depth_error_m(options, 2.0), std::sqrt(0.006064 * 0.006064 + 0.012 * 0.012 / 12.0),
              1e-12);
  EXPECT_EQ(depth_error_m({.noise = false}, 2.0), 0.0);
  EXPECT_NEAR(focal_length_px({.height_px = 300, .fovy_rad = kPi / 2.0}), 150.0, 1e-9);
}

RgbdOptions only_steps(double range_min_m, double range_max_m) {
  return {.range_min_m = range_min_m,
          .range_max_m = range_max_m,
          .noise_floor_m = 0.0,
          .noise_growth_per_m = 0.0};
}

TEST(DepthErrors, AReadingIsAWholeNumberOfSteps) {
  Rng rng(1);
  // 1 / 0.003 z is 166.7 at 2 m and 220.2 at 1.514 m.
  const RgbdOptions options = only_steps(0.8, 3.5);
  EXPECT_NEAR(measured_depth_m(options, 2.0F, rng), 1.0 / (0.003 * 167.0), 1e-6);
  EXPECT_NEAR(measured_depth_m(options, 1.514F, rng), 1.0 / (0.003 * 220.0), 1e-6);
}

TEST(DepthErrors, AReadingBeyondTheRangeIsNone) {
  Rng rng(1);
  const float infinity = std::numeric_limits<float>::infinity();
  // 2.0025 m reads as 2.008 m, 1.9986 m as 1.996 m.
  RgbdOptions far = only_steps(0.8, 2.003);
  EXPECT_EQ(measured_depth_m(far, 2.0025F, rng), 0.0F);
  far.tells_far = true;
  EXPECT_EQ(measured_depth_m(far, 2.0025F, rng), infinity);
  RgbdOptions near = only_steps(1.9985, 3.5);
  near.tells_far = true;
  EXPECT_EQ(measured_depth_m(near, 1.9986F, rng), 0.0F);
}

TEST(DepthErrors, TheRangeHoldsItsEnds) {
  Rng rng(1);
  const RgbdOptions options{.range_min_m = 0.5, .range_max_m = 3.5, .noise = false};
  EXPECT_EQ(measured_depth_m(options, 0.5F, rng), 0.5F);
  EXPECT_EQ(measured_depth_m(options, 3.5F, rng), 3.5F);
  EXPECT_EQ(measured_depth_m(options, 0.49F, rng), 0.0F);
  EXPECT_EQ(measured_depth_m(options, 3.51F, rng), 0.0F);
}

TEST(DepthErrors, WhereNothingIsDrawnNothingIsRead) {
  Rng rng(1);
  RgbdOptions options{.noise = false};
  CameraImages images;
  images.depth_m = {0.0F, 2.0F, 0.5F, 4.0F};
  measure_depth(images, options, rng);
  EXPECT_EQ(images.depth_m, (std::vector<float>{0.0F, 2.0F, 0.0F, 0.0F}));
  options.tells_far = true;
  images.depth_m = {0.0F, 2.0F, 0.5F, 4.0F};
  measure_depth(images, options, rng);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(images.depth_m, (std::vector<float>{infinity, 2.0F, 0.0F, infinity}));
}

/// A wall 2 m ahead.
test::MjcfModel wall_ahead() {
  return test::compile_mjcf(
      "<mujoco><worldbody><geom type='box' size='.5 20 20' pos='2.5 0 0'/></worldbody></mujoco>");
}

TEST(LaserLines, AMicroradianApartAreOne) {
  const auto scene = wall_ahead();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  ScanBuilder builder{LaserOptions{}};
  for (const double tilt_rad : {1.5e-6, 0.0, 7e-7}) {
    builder.add_line(rays, Pose::Identity(), tilt_rad, -1, rng);
  }
  EXPECT_EQ(builder.finish().tilt_rad, (std::vector<double>{0.0, 1.5e-6}));
}

TEST(LaserLines, AreSpoiltAsTheyAreTaken) {
  const auto scene = wall_ahead();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  ScanBuilder builder(LaserOptions{.sector_rad = 0.5, .step_rad = 0.25, .noise_sigma_m = 0.0});
  builder.add_line(rays, Pose::Identity(), 0.0, -1, rng);
  builder.add_line(rays, Pose::Identity(), 0.1, -1, rng,
                   [](std::vector<float>& range_m) { range_m[1] = 7.0F; });
  const RangeScan scan = builder.finish();
  ASSERT_EQ(scan.beams(), 3U);
  EXPECT_NEAR(scan.range(0, 1), 2.0, 1e-6);
  EXPECT_NEAR(scan.range(1, 0), 2.0 / std::cos(0.25), 1e-6);
  EXPECT_EQ(scan.range(1, 1), 7.0F);
}

TEST(PlanarScans, SayTheirRangeAndWhatIsTooNear) {
  const auto scene = wall_ahead();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  PlanarScannerOptions options{
      .sector_rad = 1.0, .step_rad = 0.5, .range_max_m = 2.2, .noise_sigma_m = 0.0};
  const PlanarScan scan = planar_scan(rays, Pose::Identity(), {0.1, 0.2, 0.3}, -1, options, rng);
  EXPECT_EQ(scan.range_max_m, 2.2);
  ASSERT_EQ(scan.range_m.size(), 3U);
  EXPECT_TRUE(std::isinf(scan.range_m[0])) << "2.28 m";
  EXPECT_NEAR(scan.range_m[1], 2.0, 1e-6);
  options.range_min_m = 2.1;
  EXPECT_TRUE(std::isnan(planar_scan(rays, Pose::Identity(), {}, -1, options, rng).range_m[1]));
}

TEST(SimDefaults, OfWhatIsFoundAreOfNothing) {
  EXPECT_EQ(OutsideForce{}.body_id, 0);
  EXPECT_EQ(MovedObject{}.body_id, 0);
  EXPECT_FALSE(FaultyParts{}.laser || FaultyParts{}.wheels);
  EXPECT_FALSE(FaultyParts{}.colour || FaultyParts{}.rotors);
  EXPECT_EQ(RayHit{}.distance_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(RayHit{}.geom_id, -1);
  EXPECT_EQ(SurfacePoint{}.geom_id, 0);
  EXPECT_EQ(LevelSurface{}.height_m + LevelSurface{}.area_m2, 0.0);
  const NearSurface near;
  EXPECT_EQ(near.height_m + near.area_m2 + near.tilt_rad, 0.0);
  const MapScore score;
  EXPECT_EQ(score.precision, 1.0);
  EXPECT_EQ(score.recall, 1.0);
  EXPECT_EQ(score.occupied_cells + score.correct_cells, 0U);
  EXPECT_EQ(score.observable_surface_cells + score.found_cells, 0U);
}

TEST(SimDefaults, OfRobotsAreOfNothing) {
  const DrivenJoint joint;
  for (const int id : {joint.joint, joint.qpos, joint.dof, joint.actuator}) EXPECT_EQ(id, 0);
  EXPECT_EQ(joint.min, 0.0);
  EXPECT_EQ(joint.max, 0.0);
  EXPECT_EQ(AngleRange{}.min_rad, 0.0);
  EXPECT_EQ(AngleRange{}.max_rad, 0.0);
  const OdometryBias bias;
  EXPECT_EQ(bias.x_m_per_m, 0.0);
  EXPECT_EQ(bias.y_m_per_m, 0.0);
  EXPECT_EQ(bias.yaw_rad_per_m, 0.0);
  EXPECT_EQ(SurfaceSpacing{}.robot_m, 0.03);
  EXPECT_EQ(SurfaceSpacing{}.scene_m, 0.03);
}

TEST(SimDefaults, OfImagesAreWhatPeopleSeeFirst) {
  EXPECT_EQ(FixedCamera{}.camera_id, 0);
  EXPECT_EQ(FreeCamera{}.distance_m, 3.0);
  EXPECT_EQ(FreeCamera{}.azimuth_rad, kPi / 2.0);
  EXPECT_EQ(FreeCamera{}.elevation_rad, -kPi / 4.0);
  EXPECT_EQ(SphereMarker{}.radius_m, 0.05);
  EXPECT_EQ(LineMarker{}.width_m, 0.01);
  const Eigen::Vector4f red(1.0F, 0.0F, 0.0F, 1.0F);
  EXPECT_EQ(SphereMarker{}.rgba, red);
  EXPECT_EQ(BoxMarker{}.rgba, red);
  EXPECT_EQ(LineMarker{}.rgba, red);
  const RenderRequest request;
  EXPECT_TRUE(request.rgb && request.depth_and_segmentation);
  EXPECT_FALSE(request.shadows || request.for_people);
  EXPECT_EQ(request.max_group, 2);
  EXPECT_EQ(request.range_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(RenderedImages{}.width_px, 0);
  EXPECT_EQ(RenderedImages{}.height_px, 0);
  EXPECT_EQ(RenderedImages{}.focal_px, 0.0);
  EXPECT_EQ(WheelTurned{}.notches, 0.0);
  EXPECT_EQ(PixelSize{}, (PixelSize{0, 0}));
}

TEST(SensorOptions, ASectorMayBeABillionthOfAStepShortOfItsBeams) {
  const auto half_width_rad = [](double sector_rad) {
    return field_of_view(LaserOptions{.sector_rad = sector_rad, .step_rad = 0.25}).half_width_rad;
  };
  EXPECT_EQ(half_width_rad(1.0 - 1.75e-10), 0.5) << "5 beams";
  EXPECT_EQ(half_width_rad(1.0 - 3.75e-10), 0.375) << "4 beams";
}

TEST(DepthErrors, AreInStepsFromZeroOn) {
  Rng rng(1);
  // 1 / 0.003 z is 370.4 at 0.9 m.
  EXPECT_NEAR(measured_depth_m(only_steps(0.8, 3.5), 0.9F, rng), 1.0 / (0.003 * 370.0), 1e-6);
}

TEST(DepthErrors, TheRangeHoldsItsEndsWhateverTheNoise) {
  Rng rng(1);
  RgbdOptions options = only_steps(0.5, 3.5);
  options.quantisation_per_m = 0.0;
  EXPECT_EQ(measured_depth_m(options, 0.5F, rng), 0.5F);
  EXPECT_EQ(measured_depth_m(options, 3.5F, rng), 3.5F);
}

TEST(LaserLines, TheRangeHoldsItsEnds) {
  const auto scene = wall_ahead();
  const RayScene rays(*scene.model, *scene.data);
  Rng rng(1);
  for (const LaserOptions& options :
       {LaserOptions{.sector_rad = 0.5, .step_rad = 0.25, .range_min_m = 2.0, .noise_sigma_m = 0.0},
        LaserOptions{
            .sector_rad = 0.5, .step_rad = 0.25, .range_max_m = 2.0, .noise_sigma_m = 0.0}}) {
    ScanBuilder builder(options);
    builder.add_line(rays, Pose::Identity(), 0.0, -1, rng);
    EXPECT_EQ(builder.finish().range(0, 1), 2.0F);
  }
}

TEST(SimDefaults, OfWhatIsDrawnAreLimits) {
  EXPECT_EQ(kMaxMarkers, 5000U);
  EXPECT_EQ(kLooksGroup, 5);
  EXPECT_NE(keys::end, '\t') << "a key that is typed";
}

}  // namespace
}  // namespace vantage
