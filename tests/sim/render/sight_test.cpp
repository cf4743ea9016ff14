// What is left out because it is out of sight changes no image.
#include "vantage/sim/render/sight.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/mjcf.hpp"
#include "vantage/sim/sensors/camera.hpp"

namespace vantage {
namespace {

/// A camera at (1, 2, 3) that looks along x, with an image 90 deg wide and 2:1.
mjvGLCamera camera_along_x() {
  mjvGLCamera camera{};
  camera.pos[0] = 1.0F;
  camera.pos[1] = 2.0F;
  camera.pos[2] = 3.0F;
  camera.forward[0] = 1.0F;
  camera.up[2] = 1.0F;
  camera.frustum_near = 0.1F;
  camera.frustum_far = 50.0F;
  camera.frustum_top = 0.05F;
  camera.frustum_bottom = -0.05F;
  return camera;
}

TEST(Sight, ShowsWhatIsBeforeTheCamera) {
  const Sight sight(camera_along_x(), 200, 100);
  EXPECT_TRUE(sight.may_show({5, 2, 3}, 0.1));
  EXPECT_TRUE(sight.may_show({5, 5.9, 3}, 0.1));
  EXPECT_FALSE(sight.may_show({5, 6.3, 3}, 0.1));
  EXPECT_TRUE(sight.may_show({5, 6.3, 3}, 0.5));
  EXPECT_FALSE(sight.may_show({5, 2, 5.3}, 0.1));
  EXPECT_FALSE(sight.may_show({0.5, 2, 3}, 0.1));
  EXPECT_TRUE(sight.may_show({0.5, 2, 3}, 0.8));
  EXPECT_FALSE(sight.may_show({60, 2, 3}, 0.5));
}

TEST(Sight, EndsAtTheRangeThatIsAskedFor) {
  const Sight sight(camera_along_x(), 200, 100, 4.0);
  EXPECT_TRUE(sight.may_show({4.9, 2, 3}, 0.1));
  EXPECT_TRUE(sight.may_show({5.2, 2, 3}, 0.3));
  EXPECT_FALSE(sight.may_show({5.2, 2, 3}, 0.1));
}

/// A sphere that any ray through the image meets may be shown.
TEST(Sight, NothingThatIsInTheImageIsLeftOut) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Sight sight(camera_along_x(), 200, 100);
  for (int i = 0; i < 20000; ++i) {
    const double ahead_m = 0.2 + 10.0 * (unit(random) + 1.0);
    const Eigen::Vector3d seen(1.0 + ahead_m, 2.0 + ahead_m * unit(random),
                               3.0 + 0.5 * ahead_m * unit(random));
    const double radius_m = unit(random) + 1.001;
    const Eigen::Vector3d off = Eigen::Vector3d(unit(random), unit(random), unit(random));
    ASSERT_TRUE(sight.may_show(seen + radius_m * off.normalized(), radius_m));
  }
}

/// @param mirror whether a board that no camera sees reflects: nothing is left out then
test::MjcfModel crowded_room(bool mirror = false) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::string text =
      "<mujoco><statistic extent='1' center='0 0 0'/><visual><map znear='.05' zfar='40'/>"
      "</visual><asset><material name='glass' rgba='.2 .9 .4 .5'/>"
      "<material name='mirror' reflectance='.6'/></asset><worldbody>"
      "<light pos='1 1 4' dir='-.2 -.1 -1'/><geom type='plane' size='9 9 .1'/>"
      "<geom type='box' size='1 1 .01' pos='0 0 -30' material='mirror'/>";
  const char* const types[] = {"box", "sphere", "capsule", "cylinder", "ellipsoid"};
  for (int i = 0; i < 300; ++i) {
    text += fmt::format(
        "<geom type='{}' size='{} .2 .1' pos='{} {} {}' euler='{} {} 0' {}/>", types[i % 5],
        0.1 + 0.05 * unit(random), 6.0 * unit(random), 6.0 * unit(random), 1.0 + unit(random),
        90.0 * unit(random), 90.0 * unit(random),
        i % 9 == 0 ? "material='glass'" : fmt::format("rgba='.{} .5 .{} 1'", i % 10, i % 7));
  }
  for (int i = 0; i < 4; ++i) {
    text += fmt::format("<camera name='c{}' pos='{} {} 1' euler='90 0 {}'/>", i, 2.0 * unit(random),
                        2.0 * unit(random), 90 * i);
  }
  test::MjcfModel scene = test::compile_mjcf(text + "</worldbody></mujoco>");
  if (!mirror) scene.model->mat_reflectance[1] = 0.0F;
  return scene;
}

/// What each camera of the scene sees.
std::vector<RenderedImages> drawn(const test::MjcfModel& scene, const RenderRequest& request = {}) {
  const auto renderer = make_offscreen_renderer(*scene.model, 160, 121);
  std::vector<RenderedImages> images(static_cast<std::size_t>(scene.model->ncam));
  for (int camera = 0; camera < scene.model->ncam; ++camera) {
    renderer->render(*scene.model, *scene.data, FixedCamera{camera}, request,
                     images[static_cast<std::size_t>(camera)]);
  }
  return images;
}

TEST(Sight, ImagesAreTheSameWithoutWhatIsUnseen) {
  const auto all = drawn(crowded_room(true));
  const auto seen = drawn(crowded_room());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].rgb, seen[i].rgb);
    EXPECT_EQ(all[i].depth_m, seen[i].depth_m);
    EXPECT_EQ(all[i].segmentation, seen[i].segmentation);
  }
}

TEST(Sight, MostOfARoomIsUnseen) {
  for (const bool mirror : {false, true}) {
    const auto room = crowded_room(mirror);
    mjvScene scene;
    mjv_defaultScene(&scene);
    mjv_makeScene(room.model.get(), &scene, 1000);
    mjvOption option;
    mjv_defaultOption(&option);
    mjvCamera camera;
    mjv_defaultCamera(&camera);
    camera.type = mjCAMERA_FIXED;
    camera.fixedcamid = 0;
    mjv_updateScene(room.model.get(), room.data.get(), &option, nullptr, &camera, mjCAT_ALL,
                    &scene);
    const int all = scene.ngeom;
    leave_out_unseen(*room.model, Sight(scene.camera[0], 160, 121), scene);
    EXPECT_GT(all, 300);
    EXPECT_EQ(scene.ngeom < all / 2, !mirror) << scene.ngeom << " of " << all;
    mjv_freeScene(&scene);
  }
}

TEST(Sight, WithinRangeDepthIsTheSame) {
  RenderRequest near{.rgb = false};
  near.range_m = 3.0;
  const auto all = drawn(crowded_room(), {.rgb = false});
  const auto seen = drawn(crowded_room(), near);
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t pixel = 0; pixel < all[i].depth_m.size(); ++pixel) {
      const float depth_m = all[i].depth_m[pixel];
      if (depth_m > 0.0F && depth_m <= 3.0F) {
        ASSERT_EQ(seen[i].depth_m[pixel], depth_m);
      }
      if (seen[i].depth_m[pixel] != depth_m) ++left_out;
    }
  }
  EXPECT_GT(left_out, 100U);
}

/// What the camera measures is the same to the bit, its random numbers too.
TEST(Sight, MeasuredDepthIsTheSame) {
  const auto scene = crowded_room();
  const RgbdOptions options{.width_px = 160, .height_px = 121, .tells_far = true};
  const auto renderer = make_offscreen_renderer(*scene.model, 160, 121);
  for (int camera = 0; camera < scene.model->ncam; ++camera) {
    Rng rng = Rng::stream(1, "camera");
    const CameraImages measured =
        depth_image(*renderer, *scene.model, *scene.data, camera, options, rng);
    RenderedImages all;
    renderer->render(*scene.model, *scene.data, FixedCamera{camera, options.fovy_rad},
                     {.rgb = false}, all);
    Rng same = Rng::stream(1, "camera");
    for (std::size_t i = 0; i < all.depth_m.size(); ++i) {
      const float z_m = all.depth_m[i];
      const float read = measured_depth_m(
          options, z_m == 0.0F ? std::numeric_limits<float>::infinity() : z_m, same);
      ASSERT_EQ(measured.depth_m[i], read);
    }
  }
}

/// Its image reaches from half as far to the left as ahead to one and a half times as far to the
/// right, from a fifth below to a half above.
TEST(Sight, ItsImageMayLieAside) {
  mjvGLCamera camera = camera_along_x();
  camera.frustum_center = 0.05F;
  camera.frustum_bottom = -0.02F;
  const Sight sight(camera, 20, 7);
  const auto shows = [&](double left_m, double up_m) {
    return sight.may_show({5.0, 2.0 + left_m, 3.0 + up_m}, 0.1);
  };
  EXPECT_TRUE(shows(1.9, 0.0));
  EXPECT_FALSE(shows(2.3, 0.0));
  EXPECT_TRUE(shows(-5.9, 0.0));
  EXPECT_FALSE(shows(-6.4, 0.0));
  EXPECT_TRUE(shows(0.0, 1.9));
  EXPECT_FALSE(shows(0.0, 2.3));
  EXPECT_TRUE(shows(0.0, -0.7));
  EXPECT_FALSE(shows(0.0, -1.1));
}

TEST(Sight, GeomsThatAreToldApartGoByTheirPlace) {
  std::array<mjvGeom, 4> geoms{};
  geoms[0].segid = 5;
  geoms[1].segid = -1;
  geoms[2].segid = 0;
  geoms[3].segid = 9;
  mjvScene scene{};
  scene.geoms = geoms.data();
  scene.ngeom = 3;
  number_anew(scene);
  EXPECT_EQ(geoms[0].segid, 0);
  EXPECT_EQ(geoms[1].segid, -1);
  EXPECT_EQ(geoms[2].segid, 2);
  EXPECT_EQ(geoms[3].segid, 9);
}

TEST(Sight, ASphereJustOutsideIsNotShown) {
  const Sight sight(camera_along_x(), 200, 100);
  EXPECT_TRUE(sight.may_show({5, 6.69, 3}, 0.5)) << "0.49 m from the edge";
  EXPECT_FALSE(sight.may_show({5, 6.74, 3}, 0.5)) << "0.52 m from it";
}

}  // namespace
}  // namespace vantage
