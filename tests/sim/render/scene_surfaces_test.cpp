#include "vantage/sim/render/scene_surfaces.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/sim/sensors/sensor_scene.hpp"

namespace vantage {
namespace {

using Colour = std::array<std::uint8_t, 3>;

SceneSurfaces drawn_of(const std::string& bodies, const std::string& assets = "") {
  const auto scene = test::compile_mjcf("<mujoco><asset>" + assets + "</asset><worldbody>" +
                                        bodies + "</worldbody></mujoco>");
  return scene_surfaces(*scene.model, *scene.data);
}

TEST(SceneSurfacesOf, ShapesHaveTheirColourAndTheirPlace) {
  const SceneSurfaces drawn = drawn_of(
      "<geom type='box' size='.1 .2 .3' pos='5 0 0' rgba='1 0 0 1'/>"
      "<geom type='box' size='.1 .2 .3' pos='1 2 3' rgba='.2 .6 .4 1'/>");
  ASSERT_EQ(drawn.vertices_m.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(drawn.colours[i], i < 8 ? (Colour{255, 0, 0}) : (Colour{51, 153, 102})) << i;
    const Eigen::Vector3f middle =
        i < 8 ? Eigen::Vector3f(5.0F, 0.0F, 0.0F) : Eigen::Vector3f(1.0F, 2.0F, 3.0F);
    const Eigen::Vector3f off = (drawn.vertices_m[i] - middle).cwiseAbs();
    EXPECT_LT((off - Eigen::Vector3f(0.1F, 0.2F, 0.3F)).norm(), 1e-5F) << i;
  }
  ASSERT_EQ(drawn.triangles[0].size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) {
    for (const std::uint32_t vertex : drawn.triangles[0][i]) EXPECT_EQ(vertex < 8, i < 12) << i;
  }
}

TEST(SceneSurfacesOf, PeopleSeeGroupsUpToTwoAndLooks) {
  for (const int group : {0, 1, 2, 3, 4, 5}) {
    const SceneSurfaces drawn =
        drawn_of("<geom type='box' size='.1 .2 .3' group='" + std::to_string(group) + "'/>");
    EXPECT_EQ(drawn.vertices_m.size(), group == 3 || group == 4 ? 0U : 8U) << group;
  }
  EXPECT_TRUE(drawn_of("<body name='robot/base'><geom type='box' size='.1 .2 .3'/></body>")
                  .vertices_m.empty());
}

TEST(SceneSurfacesOf, PlanesEndSomewhere) {
  const SceneSurfaces drawn =
      drawn_of("<geom type='plane' size='2 3 .1' pos='0 0 1'/><geom type='plane' size='0 0 1'/>");
  ASSERT_EQ(drawn.vertices_m.size(), 8U);
  EXPECT_EQ(drawn.triangles[0].size(), 4U);
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3f half = drawn.vertices_m[i].cwiseAbs();
    const Eigen::Vector3f expected =
        i < 4 ? Eigen::Vector3f(2.0F, 3.0F, 1.0F) : Eigen::Vector3f(10.0F, 10.0F, 0.0F);
    EXPECT_LT((half - expected).norm(), 1e-5F) << i;
  }
}

TEST(SceneSurfacesOf, RoundThingsHaveCornersEvery12Centimetres) {
  EXPECT_EQ(drawn_of("<geom type='cylinder' size='.5 .2'/>").vertices_m.size(), 4U * 27U);
}

TEST(SceneSurfacesOf, ATextureWithoutAMeshIsItsMeanTimesItsMaterial) {
  const SceneSurfaces drawn = drawn_of(
      "<geom type='plane' size='1 1 .1' material='tiles'/>",
      "<texture name='tiles' type='2d' builtin='checker' rgb1='1 .2 0' rgb2='0 .6 1' width='8' "
      "height='4'/><material name='tiles' texture='tiles' rgba='1 .5 .25 1'/>");
  ASSERT_EQ(drawn.colours.size(), 4U);
  EXPECT_NEAR(drawn.colours[0][0], 127.5, 1.5);
  EXPECT_NEAR(drawn.colours[0][1], 51.0, 1.5);
  EXPECT_NEAR(drawn.colours[0][2], 31.9, 1.5);
}

TEST(SceneSurfacesOf, MeshesOfMoreThan4000TrianglesAreCoarser) {
  const auto triangles = [](int rings) {
    return drawn_of("<geom type='mesh' mesh='bumpy'/>", test::bumpy_mesh(rings, 40))
        .triangles[0]
        .size();
  };
  EXPECT_EQ(triangles(50), 4000U);
  EXPECT_LE(triangles(51), 4000U);
  EXPECT_GT(triangles(51), 1000U);
  std::string one_more = test::bumpy_mesh(50, 40);  // of 2002 vertices
  one_more.insert(one_more.find("' face='"), "0 0 0 .1 0 0 0 .1 0 ");
  one_more.insert(one_more.rfind("'/>"), "2002 2003 2004 ");
  EXPECT_LE(drawn_of("<geom type='mesh' mesh='bumpy'/>", one_more).triangles[0].size(), 4000U);
}

/// Within the cells that are joined, of 8 mm at least.
TEST(SceneSurfacesOf, ACoarserMeshKeepsItsColourAndItsPlace) {
  const SceneSurfaces drawn =
      drawn_of("<geom type='mesh' mesh='bumpy' rgba='.2 .6 .4 1'/>", test::bumpy_mesh(51, 40));
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < drawn.colours.size(); ++i) {
    EXPECT_EQ(drawn.colours[i], (Colour{51, 153, 102})) << i;
    box.extend(drawn.vertices_m[i]);
  }
  const Eigen::Vector3f low(-0.3199F, -0.2415F, -0.2729F);
  const Eigen::Vector3f high(0.3199F, 0.1827F, 0.2729F);
  EXPECT_LT((box.min() - low).cwiseAbs().maxCoeff(), 0.025F);
  EXPECT_LT((box.max() - high).cwiseAbs().maxCoeff(), 0.025F);
}

TEST(SceneSurfacesOf, ATexturedMeshHasAtEachVertexWhatIsPaintedThere) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><texture name='paint' type='2d' builtin='flat' width='4' height='2'/>"
      "<material name='paint' texture='paint'/><mesh name='wedge' vertex='0 0 0  .3 0 0  0 .3 0  "
      "0 0 .3' texcoord='0 0 0 0 0 0 0 0' face='0 2 1  0 1 3  0 3 2  1 2 3'/></asset><worldbody>"
      "<geom type='mesh' mesh='wedge' material='paint'/></worldbody></mujoco>");
  ASSERT_EQ(scene.model->mesh_vertnum[0], 4);
  ASSERT_EQ(scene.model->mesh_texcoordadr[0], 0);
  for (int i = 0; i < 24; ++i) scene.model->tex_rgb[i] = static_cast<mjtByte>(10 * i);
  const std::array<float, 8> uv{0.1F, 0.2F, 0.6F, 0.2F, 0.9F, 0.7F, 1.3F, -0.3F};
  std::copy(uv.begin(), uv.end(), scene.model->mesh_texcoord);
  // Pixels 0 and 2 of the first row of four, 3 and 1 of the second.
  const std::vector<Colour> expected{{0, 10, 20}, {60, 70, 80}, {210, 220, 230}, {150, 160, 170}};
  EXPECT_EQ(scene_surfaces(*scene.model, *scene.data).colours, expected);
}

/// A square of 50 cm, a vertex every 5 mm, is cut at 63 lines each way in cells of 8 mm: 8444
/// triangles. In cells of 12 mm it is cut at 41.
TEST(SceneSurfacesOf, CellsGrowByHalfUntilTrianglesAreFew) {
  const SceneSurfaces drawn =
      drawn_of("<geom type='hfield' hfield='flat'/>",
               "<hfield name='flat' nrow='101' ncol='101' size='.25 .25 .1 .1'/>");
  EXPECT_EQ(drawn.triangles[0].size(), 2U * 41U * 41U + 4U * 2U * 41U + 2U) << "top, sides, bottom";
}

/// Two wedges, each with a material of its own, and a texture that nobody has before theirs.
test::MjcfModel painted_wedges() {
  auto scene = test::compile_mjcf(
      "<mujoco><asset><texture name='other' type='2d' builtin='flat' width='2' height='2'/>"
      "<texture name='paint' type='2d' builtin='flat' width='4' height='2'/>"
      "<material name='dull' rgba='.4 .4 .4 1'/>"
      "<material name='paint' texture='paint' rgba='1 .4 1 1'/>"
      "<mesh name='a' vertex='0 0 0  .3 0 0  0 .3 0  0 0 .3' texcoord='0 0 0 0 0 0 0 0' "
      "face='0 2 1  0 1 3  0 3 2  1 2 3'/>"
      "<mesh name='b' vertex='0 0 0  .3 0 0  0 .3 0  0 0 .3' texcoord='0 0 0 0 0 0 0 0' "
      "face='0 2 1  0 1 3  0 3 2  1 2 3'/>"
      "<mesh name='bare' vertex='0 0 0  .3 0 0  0 .3 0  0 0 .3' "
      "face='0 2 1  0 1 3  0 3 2  1 2 3'/></asset><worldbody>"
      "<geom type='mesh' mesh='a' material='dull'/><geom type='mesh' mesh='b' material='paint'/>"
      "<geom type='mesh' mesh='bare' material='paint'/>"
      "<geom type='mesh' mesh='bare' rgba='.2 .6 .4 1'/></worldbody></mujoco>");
  mjtByte* paint = scene.model->tex_rgb + scene.model->tex_adr[1];
  for (int i = 0; i < 24; ++i) paint[i] = static_cast<mjtByte>(10 * i);
  const std::array<float, 8> uv{0.1F, 0.2F, 0.6F, 0.2F, 0.9F, 0.7F, -1e-9F, 0.2F};
  std::copy(uv.begin(), uv.end(), scene.model->mesh_texcoord + 8);
  return scene;
}

TEST(SceneSurfacesOf, EveryMeshHasItsOwnPaint) {
  const auto scene = painted_wedges();
  ASSERT_EQ(scene.model->mesh_texcoordadr[1], 4);
  const auto colours = scene_surfaces(*scene.model, *scene.data).colours;
  ASSERT_EQ(colours.size(), 16U);
  const std::vector<Colour> expected{{0, 4, 20}, {60, 28, 80}, {210, 88, 230}, {90, 40, 110}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(colours[i], (Colour{102, 102, 102})) << "no paint at all " << i;
    EXPECT_EQ(colours[4 + i], expected[i]) << i;
    EXPECT_EQ(colours[8 + i], (Colour{105, 46, 125})) << "its mean, where no place is told " << i;
    EXPECT_EQ(colours[12 + i], (Colour{51, 153, 102})) << i;
  }
}

TEST(SceneSurfacesOf, ATextureRoundACubeIsNoColour) {
  const SceneSurfaces drawn =
      drawn_of("<geom type='box' size='.1 .1 .1' material='sky'/>",
               "<texture name='sky' type='cube' builtin='flat' rgb1='0 0 0' width='8' height='8'/>"
               "<material name='sky' texture='sky' rgba='2 .6 .4 1'/>");
  ASSERT_EQ(drawn.colours.size(), 8U);
  EXPECT_EQ(drawn.colours[0], (Colour{255, 153, 102})) << "at most 255";
}

TEST(SceneSurfacesOf, WhatIsNotShownHidesNothingElse) {
  EXPECT_EQ(drawn_of("<geom type='box' size='.1 .2 .3' group='3'/>"
                     "<geom type='box' size='.1 .2 .3' pos='2 0 0'/>")
                .vertices_m.size(),
            8U);
}

TEST(SceneSurfacesOf, APlaneIsTwoTrianglesThatShareAnEdge) {
  const SceneSurfaces drawn = drawn_of("<geom type='plane' size='.5 .25 .1'/>");
  ASSERT_EQ(drawn.vertices_m.size(), 4U);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& triangle : drawn.triangles[0]) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.emplace_back(std::minmax(triangle[i], triangle[(i + 1) % 3]));
    }
  }
  EXPECT_THAT(edges, testing::UnorderedElementsAre(testing::Pair(0U, 1U), testing::Pair(1U, 2U),
                                                   testing::Pair(0U, 2U), testing::Pair(0U, 2U),
                                                   testing::Pair(2U, 3U), testing::Pair(0U, 3U)));
  for (const Eigen::Vector3f& p : drawn.vertices_m) {
    EXPECT_LT((p.cwiseAbs() - Eigen::Vector3f(0.5F, 0.25F, 0.0F)).norm(), 1e-6F);
  }
}

TEST(SceneSurfacesOf, ATextureMayBeOnePixel) {
  const SceneSurfaces drawn =
      drawn_of("<geom type='plane' size='1 1 .1' material='dot'/>",
               "<texture name='dot' type='2d' builtin='flat' rgb1='.2 .6 .4' width='1' height='1'/>"
               "<material name='dot' texture='dot'/>");
  ASSERT_EQ(drawn.colours.size(), 4U);
  EXPECT_EQ(drawn.colours[0], (Colour{51, 153, 102}));
}

}  // namespace
}  // namespace vantage
