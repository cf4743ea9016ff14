#include "vantage/sim/sensors/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/sensors/sensor_scene.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"

namespace vantage {
namespace {

RgbdOptions exact_options() {
  return {
      .width_px = 200, .height_px = 150, .range_min_m = 0.1, .range_max_m = 15.0, .noise = false};
}

CameraImages take(const test::MjcfModel& scene, const char* camera, const RgbdOptions& options,
                  std::uint64_t seed = 1) {
  const auto renderer = make_offscreen_renderer(*scene.model, options.width_px, options.height_px);
  Rng rng(seed);
  return rgbd(*renderer, *scene.model, *scene.data, scene.camera(camera), options, rng);
}

/// Body ids of the image that `take` makes.
std::vector<int> true_ids(const test::MjcfModel& scene, const char* camera,
                          const RgbdOptions& options) {
  const auto renderer = make_offscreen_renderer(*scene.model, options.width_px, options.height_px);
  return body_ids(*renderer, *scene.model, *scene.data, scene.camera(camera), options.fovy_rad);
}

std::size_t pixel(const CameraImages& images, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(images.width_px) +
         static_cast<std::size_t>(column);
}

struct TruePixel {
  int body = -1;
  double depth_m = 0.0;
};

/// What the ray through a point of the image meets; (column, row) in pixels.
TruePixel true_pixel(const test::MjcfModel& scene, const RayScene& rays, const Pose& T_world_camera,
                     const CameraImages& images, double column, double row) {
  const Eigen::Vector3d ray((column - 0.5 * (images.width_px - 1)) / images.focal_px,
                            (row - 0.5 * (images.height_px - 1)) / images.focal_px, 1.0);
  const RayHit hit =
      rays.cast(T_world_camera.translation(), (T_world_camera.linear() * ray).normalized(), 1e3);
  if (!hit.hit()) return {};
  return {scene.model->geom_bodyid[hit.geom_id], hit.distance_m / ray.norm()};
}

/// Away from silhouettes: the whole pixel and its surroundings show one body without a jump.
bool is_smooth(const test::MjcfModel& scene, const RayScene& rays, const Pose& T_world_camera,
               const CameraImages& images, int column, int row, const TruePixel& centre) {
  for (const double dx : {-1.0, 0.0, 1.0}) {
    for (const double dy : {-1.0, 0.0, 1.0}) {
      const TruePixel near = true_pixel(scene, rays, T_world_camera, images, column + dx, row + dy);
      if (near.body != centre.body || std::abs(near.depth_m - centre.depth_m) > 0.05) return false;
    }
  }
  return true;
}

TEST(Camera, DepthAndSegmentationAgreeWithRayCasting) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  for (const char* camera : {"oblique", "level"}) {
    const CameraImages images = take(scene, camera, exact_options());
    const std::vector<int> ids = true_ids(scene, camera, exact_options());
    const Pose T = T_world_camera(*scene.model, *scene.data, scene.camera(camera));
    int compared = 0;
    for (int row = 0; row < images.height_px; ++row) {
      for (int column = 0; column < images.width_px; ++column) {
        const TruePixel truth = true_pixel(scene, rays, T, images, column, row);
        if (truth.depth_m > 8.0) continue;
        if (!is_smooth(scene, rays, T, images, column, row, truth)) continue;
        ++compared;
        const std::size_t i = pixel(images, row, column);
        ASSERT_EQ(ids[i], truth.body) << camera << " " << row << " " << column;
        ASSERT_NEAR(images.depth_m[i], truth.depth_m, 1e-3)
            << camera << " " << row << " " << column;
      }
    }
    EXPECT_GT(compared, images.width_px * images.height_px / 2);
  }
}

TEST(Camera, LooksAlongOpenCvsAxes) {
  const auto scene = test::sensor_scene();
  const Pose T = T_world_camera(*scene.model, *scene.data, scene.camera("level"));
  EXPECT_TRUE(T.linear().col(0).isApprox(Eigen::Vector3d::UnitX(), 1e-12));   // right
  EXPECT_TRUE(T.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));  // down
  EXPECT_TRUE(T.linear().col(2).isApprox(Eigen::Vector3d::UnitY(), 1e-12));   // forward
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.0, -3.0, 0.3)));
}

/// MuJoCo adds a global ambient light of 0.3 to what the material emits.
TEST(Camera, AnEmissiveSurfaceHasItsOwnColour) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco>
      <visual><headlight active="0"/></visual>
      <asset><material name="glow" emission="0.7" specular="0" rgba="0.2 0.6 0.4 1"/></asset>
      <worldbody>
        <geom type="box" size="0.3 0.3 0.3" material="glow"/>
        <camera name="front" pos="0 -1.5 0" xyaxes="1 0 0 0 0 1"/>
      </worldbody>
    </mujoco>)");
  const CameraImages images = take(scene, "front", exact_options());
  const std::size_t centre = pixel(images, 75, 100);
  EXPECT_EQ(images.rgb[3 * centre], 51);
  EXPECT_EQ(images.rgb[3 * centre + 1], 153);
  EXPECT_EQ(images.rgb[3 * centre + 2], 102);
  EXPECT_NEAR(images.depth_m[centre], 1.2, 1e-4);
}

TEST(Camera, FieldOfViewComesFromTheOptions) {
  const auto scene = test::sensor_scene();
  RgbdOptions wide = exact_options();
  wide.fovy_rad = 1.2;
  const CameraImages images = take(scene, "level", wide);
  EXPECT_NEAR(images.focal_px, 75.0 / std::tan(0.6), 1e-9);
  const RayScene rays(*scene.model, *scene.data);
  const Pose T = T_world_camera(*scene.model, *scene.data, scene.camera("level"));
  const TruePixel corner = true_pixel(scene, rays, T, images, 199, 149);
  EXPECT_NEAR(images.depth_m[pixel(images, 149, 199)], corner.depth_m, 1e-3);
}

TEST(Camera, NothingOutsideTheRange) {
  const auto scene = test::sensor_scene();
  RgbdOptions options = exact_options();
  options.range_min_m = 2.0;
  options.range_max_m = 3.0;
  options.noise = true;
  const CameraImages images = take(scene, "level", options);
  int inside = 0;
  for (const float depth : images.depth_m) {
    if (depth == 0.0F) continue;
    ++inside;
    EXPECT_GE(depth, 2.0F);
    EXPECT_LE(depth, 3.0F);
  }
  EXPECT_GT(inside, 100);
  EXPECT_EQ(images.depth_m[pixel(images, 0, 0)], 0.0F);
}

TEST(Camera, NoiseFollowsTheModel) {
  RgbdOptions options;
  options.quantisation_per_m = 0.0;
  EXPECT_NEAR(depth_sigma_m(options, 0.4), 0.0012, 1e-15);
  EXPECT_NEAR(depth_sigma_m(options, 2.4), 0.0088, 1e-15);
  Rng rng(3);
  for (const double z : {1.0, 2.0, 3.0}) {
    double sum = 0.0;
    double squares = 0.0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double error = measured_depth_m(options, static_cast<float>(z), rng) - z;
      sum += error;
      squares += error * error;
    }
    const double sigma = depth_sigma_m(options, z);
    EXPECT_NEAR(sum / n, 0.0, 5.0 * sigma / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares / n), sigma, 0.03 * sigma);
  }
}

TEST(Camera, DepthComesInStepsOfDisparity) {
  RgbdOptions options;
  options.noise_floor_m = 0.0;
  options.noise_growth_per_m = 0.0;
  Rng rng(3);
  double previous = measured_depth_m(options, 2.0F, rng);
  double largest_step = 0.0;
  int steps = 0;
  for (double z = 2.0; z < 2.2; z += 1e-4) {
    const double read = measured_depth_m(options, static_cast<float>(z), rng);
    EXPECT_NEAR(read, z, 0.5 * 0.003 * z * z * 1.01);
    if (read != previous) ++steps;
    largest_step = std::max(largest_step, read - previous);
    previous = read;
  }
  EXPECT_GT(steps, 10);
  EXPECT_NEAR(largest_step, 0.003 * 2.2 * 2.2, 0.0005);
}

TEST(Camera, TheSameSeedTheSameImages) {
  const auto scene = test::sensor_scene();
  RgbdOptions options = exact_options();
  options.noise = true;
  const CameraImages first = take(scene, "oblique", options, 5);
  EXPECT_EQ(first.depth_m, take(scene, "oblique", options, 5).depth_m);
  EXPECT_NE(first.depth_m, take(scene, "oblique", options, 6).depth_m);
  EXPECT_EQ(first.rgb, take(scene, "oblique", options, 6).rgb);
}

TEST(Camera, ContradictoryOptionsAreErrors) {
  EXPECT_THROW(check_options(RgbdOptions{.range_min_m = 4.0}), ConfigError);
  EXPECT_THROW(check_options(RgbdOptions{.width_px = 0}), ConfigError);
}

TEST(MeasuredDepth, TellsFarFromNearOnlyIfItCan) {
  Rng rng(1);
  RgbdOptions options{.noise = false};
  const float nothing = std::numeric_limits<float>::infinity();
  for (const float z : {0.5F, 3.6F, nothing}) EXPECT_EQ(measured_depth_m(options, z, rng), 0.0F);
  options.tells_far = true;
  EXPECT_EQ(measured_depth_m(options, 0.5F, rng), 0.0F);
  EXPECT_EQ(measured_depth_m(options, 3.6F, rng), nothing);
  EXPECT_EQ(measured_depth_m(options, nothing, rng), nothing);
  EXPECT_EQ(measured_depth_m(options, 2.0F, rng), 2.0F);
}

TEST(Camera, ADepthImageIsTheDepthOfTheWhole) {
  const auto scene = test::sensor_scene();
  RgbdOptions options = exact_options();
  options.tells_far = true;
  options.noise = true;
  const CameraImages whole = take(scene, "oblique", options, 5);
  const auto renderer = make_offscreen_renderer(*scene.model, options.width_px, options.height_px);
  Rng rng(5);
  const CameraImages depth =
      depth_image(*renderer, *scene.model, *scene.data, scene.camera("oblique"), options, rng);
  EXPECT_EQ(depth.depth_m, whole.depth_m);
  EXPECT_EQ(depth.range_max_m, options.range_max_m);
  EXPECT_TRUE(depth.rgb.empty());
}

/// A post at 0.5 m before a wall at 5 m, in a scene that is drawn from 0.9 m to 3 m.
TEST(Camera, ItsRangeIsDrawnWhateverPlanesASceneSets) {
  const auto scene = test::compile_mjcf(
      "<mujoco><statistic extent='1' center='0 0 0'/><visual><map znear='.9' zfar='3'/></visual>"
      "<worldbody><camera name='ahead' xyaxes='0 -1 0 0 0 1'/>"
      "<geom type='box' size='.1 .05 1' pos='.6 0 0'/>"
      "<geom type='box' size='.1 9 9' pos='5.1 0 0'/></worldbody></mujoco>");
  RgbdOptions options = exact_options();
  options.range_min_m = 0.3;
  options.range_max_m = 6.0;
  const CameraImages images = take(scene, "ahead", options);
  EXPECT_NEAR(images.depth_m[pixel(images, 75, 100)], 0.5, 1e-3);
  EXPECT_NEAR(images.depth_m[pixel(images, 75, 20)], 5.0, 1e-2);
  options.range_min_m = 0.0;
  EXPECT_NEAR(take(scene, "ahead", options).depth_m[pixel(images, 75, 20)], 5.0, 1e-2);
}

template <class T>
concept TellsBodyIds = requires(const T& images) {
  images.segmentation;
};

TEST(Camera, ImagesCarryNoTruth) {
  EXPECT_FALSE(TellsBodyIds<CameraImages>);
  EXPECT_TRUE(TellsBodyIds<RenderedImages>) << "what a renderer gives has it";
}

}  // namespace
}  // namespace vantage
