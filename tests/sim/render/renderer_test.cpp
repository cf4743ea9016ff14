#include "vantage/sim/render/renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "tests/sim/sensors/sensor_scene.hpp"
#include "vantage/sim/sensors/camera.hpp"

namespace vantage {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 121;  // odd: no accidental symmetry of rows

RenderedImages draw(const test::MjcfModel& scene, const CameraView& view,
                    const RenderRequest& request = {}) {
  RenderedImages images;
  make_offscreen_renderer(*scene.model, kWidth, kHeight)
      ->render(*scene.model, *scene.data, view, request, images);
  return images;
}

std::size_t at(int row, int column) {
  return static_cast<std::size_t>(row) * kWidth + static_cast<std::size_t>(column);
}

TEST(Renderer, NamesTheDriver) { EXPECT_NE(renderer_name().find("OpenGL"), std::string::npos); }

TEST(Renderer, TopRowFirst) {
  const auto scene = test::sensor_scene();
  const RenderedImages images = draw(scene, FixedCamera{scene.camera("level")});
  EXPECT_EQ(images.segmentation[at(0, 1)], -1);
  EXPECT_EQ(images.depth_m[at(0, 1)], 0.0F);
  EXPECT_EQ(images.segmentation[at(kHeight - 1, 1)], scene.geom("floor"));
}

TEST(Renderer, TheSamePictureBitForBit) {
  const auto scene = test::sensor_scene();
  const FixedCamera oblique{scene.camera("oblique")};
  const RenderedImages first = draw(scene, oblique);
  const auto renderer = make_offscreen_renderer(*scene.model, kWidth, kHeight);
  RenderedImages again;
  renderer->render(*scene.model, *scene.data, FreeCamera{}, {}, again);
  EXPECT_NE(again.rgb, first.rgb);
  EXPECT_FALSE(renderer_name().empty());  // makes another context on the way
  renderer->render(*scene.model, *scene.data, oblique, {}, again);
  EXPECT_EQ(again.rgb, first.rgb);
  EXPECT_EQ(again.depth_m, first.depth_m);
  EXPECT_EQ(again.segmentation, first.segmentation);
}

TEST(Renderer, LeavesTheDataAndWhatFollowsAlone) {
  const auto scene = test::sensor_scene();
  const mjModel* model = scene.model.get();
  const std::unique_ptr<mjData, test::FreeMujoco> near_duplicate(
      mj_copyData(nullptr, model, scene.data.get()));
  const auto* bytes = static_cast<const char*>(scene.data->buffer);
  const std::vector<char> before(bytes, bytes + scene.data->nbuffer);
  draw(scene, FixedCamera{scene.camera("oblique")}, {.shadows = true});
  EXPECT_TRUE(std::equal(before.begin(), before.end(), bytes));
  for (int i = 0; i < 100; ++i) {
    mj_step(model, scene.data.get());
    mj_step(model, near_duplicate.get());
  }
  EXPECT_EQ(scene.data->time, near_duplicate->time);
  EXPECT_EQ(std::memcmp(scene.data->qpos, near_duplicate->qpos, sizeof(mjtNum) * model->nq), 0);
  EXPECT_EQ(std::memcmp(scene.data->qvel, near_duplicate->qvel, sizeof(mjtNum) * model->nv), 0);
}

TEST(Renderer, OneContextPerThread) {
  const auto scene = test::sensor_scene();
  const FixedCamera oblique{scene.camera("oblique")};
  RenderedImages here;
  RenderedImages there;
  std::thread other([&] { there = draw(scene, oblique); });
  here = draw(scene, oblique);
  other.join();
  EXPECT_EQ(here.rgb, there.rgb);
  EXPECT_EQ(here.depth_m, there.depth_m);
}

TEST(Renderer, TwoRenderersInOneThread) {
  const auto scene = test::sensor_scene();
  const FixedCamera oblique{scene.camera("oblique")};
  const auto large = make_offscreen_renderer(*scene.model, kWidth, kHeight);
  const auto small = make_offscreen_renderer(*scene.model, 32, 24);
  RenderedImages a;
  RenderedImages b;
  large->render(*scene.model, *scene.data, oblique, {}, a);
  small->render(*scene.model, *scene.data, oblique, {}, b);
  large->render(*scene.model, *scene.data, oblique, {}, b);
  EXPECT_EQ(a.rgb, b.rgb);
}

TEST(Renderer, OnlyWhatWasRequested) {
  const auto scene = test::sensor_scene();
  const FixedCamera oblique{scene.camera("oblique")};
  const RenderedImages depth = draw(scene, oblique, {.rgb = false});
  EXPECT_TRUE(depth.rgb.empty());
  EXPECT_EQ(depth.depth_m.size(), static_cast<std::size_t>(kWidth * kHeight));
  const RenderedImages colour = draw(scene, oblique, {.depth_and_segmentation = false});
  EXPECT_TRUE(colour.depth_m.empty());
  EXPECT_EQ(colour.rgb.size(), static_cast<std::size_t>(3 * kWidth * kHeight));
}

TEST(Renderer, MarkersAreSeenInColourOnly) {
  const auto scene = test::sensor_scene();
  const FixedCamera level{scene.camera("level")};
  const Eigen::Vector3d ahead(0.0, -2.0, 0.3);
  const Eigen::Vector4f red(1.0F, 0.0F, 0.0F, 1.0F);
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();
  T_world_box.translation() = ahead;
  const std::vector<Marker> markers{
      SphereMarker{ahead, 0.1, red}, BoxMarker{T_world_box, Eigen::Vector3d::Constant(0.1), red},
      LineMarker{ahead - Eigen::Vector3d::UnitX(), ahead + Eigen::Vector3d::UnitX(), 0.1, red}};
  const RenderedImages plain = draw(scene, level);
  const std::size_t centre = at(kHeight / 2, kWidth / 2);
  ASSERT_GT(plain.rgb[3 * centre + 1], 0);
  for (const Marker& marker : markers) {
    const RenderedImages marked = draw(scene, level, {.markers = {marker}});
    EXPECT_GT(marked.rgb[3 * centre], 60);
    EXPECT_EQ(marked.rgb[3 * centre + 1], 0);
    EXPECT_EQ(marked.depth_m, plain.depth_m);
    EXPECT_EQ(marked.segmentation, plain.segmentation);
  }
}

TEST(Renderer, HigherGroupsAreHidden) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom type="sphere" size="0.2" group="3"/>
      <camera pos="0 -1 0" xyaxes="1 0 0 0 0 1"/>
    </worldbody></mujoco>)");
  const std::size_t centre = at(kHeight / 2, kWidth / 2);
  EXPECT_EQ(draw(scene, FixedCamera{0}).segmentation[centre], -1);
  EXPECT_EQ(draw(scene, FixedCamera{0}, {.max_group = 3}).segmentation[centre], 0);
}

TEST(Renderer, FreeCameraLooksAtItsPoint) {
  const auto scene = test::sensor_scene();
  const FreeCamera camera{.lookat_m = {0.0, 1.0, 0.5},
                          .distance_m = 2.0,
                          .azimuth_rad = -M_PI / 2,
                          .elevation_rad = -0.3};
  const RenderedImages images = draw(scene, camera);
  const std::size_t centre = at(kHeight / 2, kWidth / 2);
  EXPECT_EQ(images.segmentation[centre], scene.geom("sphere"));
  EXPECT_NEAR(images.depth_m[centre], 1.75, 2e-3);
}

TEST(Renderer, CutsAwayWhatIsBeforeThePoint) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom name="wall" type="box" size="0.05 2 2" pos="2 0 0"/>
      <geom name="ball" type="sphere" size="0.3"/>
    </worldbody></mujoco>)");
  FreeCamera camera{.distance_m = 4.0, .azimuth_rad = M_PI, .elevation_rad = 0.0};
  const std::size_t centre = at(kHeight / 2, kWidth / 2);
  EXPECT_EQ(draw(scene, camera).segmentation[centre], scene.geom("wall"));
  camera.cutaway_m = 1.5;
  const RenderedImages images = draw(scene, camera);
  EXPECT_EQ(images.segmentation[centre], scene.geom("ball"));
  EXPECT_NEAR(images.depth_m[centre], 3.7, 2e-3);
  camera.distance_m = 1.0;  // the point is nearer than what may stand before it
  EXPECT_EQ(draw(scene, camera).segmentation[centre], scene.geom("ball"));
}

TEST(Renderer, SaysWhatCameraTookThePicture) {
  const auto scene = test::sensor_scene();
  const Eigen::Vector3d p_world(0.2, 1.1, 0.7);
  const FreeCamera from_above{.lookat_m = {0.0, 1.0, 0.5}, .azimuth_rad = 0.4, .fovy_rad = 0.6};
  const FixedCamera oblique{scene.camera("oblique")};
  for (const CameraView& view : {CameraView(from_above), CameraView(oblique)}) {
    const RenderedImages plain = draw(scene, view);
    const Eigen::Vector3d p_camera = plain.T_world_camera.inverse() * p_world;
    const double u = 0.5 * kWidth + plain.focal_px * p_camera.x() / p_camera.z();
    const double v = 0.5 * kHeight + plain.focal_px * p_camera.y() / p_camera.z();
    // A marker at the near plane of whatever stands between: seen in the direction of the point.
    const Eigen::Vector3d p_near =
        plain.T_world_camera * Eigen::Vector3d(p_camera * 0.3 / p_camera.z());
    const RenderedImages marked =
        draw(scene, view, {.markers = {SphereMarker{p_near, 0.01, {0.0F, 1.0F, 0.0F, 1.0F}}}});
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int pixels = 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        if (std::equal(&marked.rgb[3 * at(row, column)], &marked.rgb[3 * at(row, column)] + 3,
                       &plain.rgb[3 * at(row, column)])) {
          continue;
        }
        sum += Eigen::Vector2d(column + 0.5, row + 0.5);
        ++pixels;
      }
    }
    ASSERT_GT(pixels, 10);
    EXPECT_NEAR(sum.x() / pixels, u, 0.6);
    EXPECT_NEAR(sum.y() / pixels, v, 0.6);
  }
}

TEST(Renderer, TellsHundredsOfGeomsApart) {
  const auto place = [](int i) {
    const int row = i / 20;
    return Eigen::Vector3d(0.5 * (i % 20) - 4.75, 0.5 * row - 3.5, 0.0);
  };
  std::string geoms;
  for (int i = 0; i < 300; ++i) {
    geoms += "<geom type='box' size='.2 .2 .2' pos='" + std::to_string(place(i).x()) + " " +
             std::to_string(place(i).y()) + " 0'/>";
  }
  const auto scene = test::compile_mjcf("<mujoco><worldbody>" + geoms +
                                        "<camera pos='0 0 10'/></worldbody></mujoco>");
  const RenderedImages images = draw(scene, FixedCamera{0}, {.rgb = false});
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d top(place(i).x(), place(i).y(), 0.2);
    const Eigen::Vector3d p = images.T_world_camera.inverse() * top;
    const double u = 0.5 * kWidth + images.focal_px * p.x() / p.z();
    const double v = 0.5 * kHeight + images.focal_px * p.y() / p.z();
    EXPECT_EQ(images.segmentation[at(static_cast<int>(v), static_cast<int>(u))], i);
  }
}

}  // namespace
}  // namespace vantage
