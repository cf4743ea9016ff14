#include "vantage/sim/render/posed_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr auto kScene = R"(<mujoco>
  <asset><mesh name="wedge" file="wedge.obj"/></asset>
  <statistic extent="1"/>
  <visual><map znear="0.05" zfar="20"/></visual>
  <worldbody>
    <body name="thing" mocap="true">
      <geom name="wedge" type="mesh" mesh="wedge"/>
    </body>
    <camera name="above" pos="0 0 2" fovy="45"/>
  </worldbody>
</mujoco>)";

/// A tetrahedron with its point at (0.2, 0, 0.5) above a base at z = 0.
constexpr auto kObj =
    "v -0.3 -0.3 0\nv 0.3 -0.3 0\nv 0 0.3 0\nv 0.2 0 0.5\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

ModelPtr model() {
  const std::array<MemoryFile, 1> files{MemoryFile{"wedge.obj", kObj}};
  return load_model(kScene, files, "wedge").model;
}

float nearest_m(const RenderedImages& images) {
  float nearest = 100.0F;
  for (const float z : images.depth_m) nearest = z > 0.0F ? std::min(nearest, z) : nearest;
  return nearest;
}

TEST(PosedScene, DrawsAModelFromMemoryWhereItWasPut) {
  PosedScene scene(model(), 101, 101);
  RenderedImages images;
  scene.render("above", {}, images);
  EXPECT_NEAR(nearest_m(images), 1.5, 0.02);
  scene.set_pose("thing", make_pose({0.0, 0.0, 0.3}, 1.0));
  scene.render("above", {}, images);
  EXPECT_NEAR(nearest_m(images), 1.2, 0.02);
  EXPECT_EQ(images.segmentation[50 * 101 + 50], scene.geom_id("wedge"));
}

TEST(PosedScene, OneContextDrawsOneSceneAfterAnotherAsContextsOfTheirOwn) {
  const auto context = make_offscreen_context();
  for (const int side_px : {101, 51, 151}) {
    PosedScene shared(model(), side_px, side_px, context);
    PosedScene alone(model(), side_px, side_px);
    RenderedImages a;
    RenderedImages b;
    shared.render("above", {}, a);
    alone.render("above", {}, b);
    EXPECT_EQ(a.rgb, b.rgb);
    EXPECT_EQ(a.depth_m, b.depth_m);
    EXPECT_EQ(a.segmentation, b.segmentation);
  }
}

TEST(PosedScene, HalfATurnMirrorsThePicture) {
  PosedScene scene(model(), 101, 101);
  RenderedImages before;
  RenderedImages after;
  scene.render("above", {}, before);
  scene.set_pose("thing", make_pose(Eigen::Vector3d::Zero(), std::numbers::pi));
  scene.render("above", {}, after);
  int differing = 0;
  for (std::size_t i = 0; i < before.segmentation.size(); ++i) {
    differing += before.segmentation[i] != after.segmentation[before.segmentation.size() - 1 - i];
  }
  EXPECT_LT(differing, 60);  // of some 1000 on the edge and inside
  EXPECT_NE(before.segmentation, after.segmentation);
}

TEST(ModelsFromMemory, ErrorsAreNamed) {
  try {
    load_model("<mujoco><worldbody><geom/></worldbody></mujoco>", {}, "my thing");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("my thing: ", 0), 0U) << error.what();
  }
}

TEST(PosedScene, EachThingIsWhereItWasPut) {
  PosedScene scene(
      load_model("<mujoco><statistic extent='1'/><visual><map znear='.05' zfar='20'/></visual>"
                 "<worldbody><body name='first' mocap='true' pos='5 0 0'><geom size='.1'/></body>"
                 "<body name='second' mocap='true' pos='-5 0 0'>"
                 "<geom name='bar' type='box' size='.5 .05 .1'/></body>"
                 "<camera name='above' pos='0 0 2'/></worldbody></mujoco>",
                 {}, "things")
          .model,
      101, 101);
  scene.set_pose("second", make_pose({0.0, 0.0, 0.3}, std::numbers::pi / 2.0));
  RenderedImages images;
  scene.render("above", {}, images);
  EXPECT_NEAR(nearest_m(images), 1.6, 0.02);
  const int bar = scene.geom_id("bar");
  EXPECT_EQ(images.segmentation[50 * 101 + 50], bar);
  EXPECT_EQ(images.segmentation[30 * 101 + 50], bar) << "it lies along y";
  EXPECT_EQ(images.segmentation[50 * 101 + 30], -1);
}

}  // namespace
}  // namespace vantage
