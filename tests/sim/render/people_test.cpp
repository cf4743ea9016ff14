// What people see of a scene and sensors do not, and that they see it at all.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <regex>
#include <utility>
#include <vector>

#include "tests/support/mjcf.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/sim/render/overview.hpp"
#include "vantage/sim/render/scene_surfaces.hpp"
#include "vantage/sim/world/mesh_surface.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr int kPeopleWidth = 160;
constexpr int kPeopleHeight = 120;
const fs::path kScenes = fs::path(VANTAGE_SOURCE_DIR) / "models/scenes";

RenderedImages draw(const mjModel& model, const mjData& data, const CameraView& view,
                    bool for_people) {
  RenderRequest request;
  request.for_people = for_people;
  RenderedImages images;
  make_offscreen_renderer(model, kPeopleWidth, kPeopleHeight)
      ->render(model, data, view, request, images);
  return images;
}

double mean_brightness(const RenderedImages& images) {
  return std::accumulate(images.rgb.begin(), images.rgb.end(), 0.0) /
         static_cast<double>(images.rgb.size());
}

bool shows(const RenderedImages& images, int geom) {
  return std::ranges::find(images.segmentation, geom) != images.segmentation.end();
}

/// A room of 4 x 4 m, closed above, with a box in its middle and a picture on a wall.
constexpr const char* kClosedRoom = R"(
  <mujoco><worldbody>
    <geom name="floor" type="plane" size="2 2 .1" rgba=".6 .5 .4 1"/>
    <geom name="east" type="box" pos="2.05 0 1.25" size=".05 2 1.25"/>
    <geom name="west" type="box" pos="-2.05 0 1.25" size=".05 2 1.25"/>
    <geom name="north" type="box" pos="0 2.05 1.25" size="2 .05 1.25"/>
    <geom name="south" type="box" pos="0 -2.05 1.25" size="2 .05 1.25"/>
    <geom name="ceiling" type="box" pos="0 0 2.55" size="2.1 2.1 .05" rgba="0 0 0 1"/>
    <geom name="box" type="box" pos="0 0 .4" size=".4 .4 .4" rgba="1 0 0 1"/>
    <geom name="picture" type="box" pos="0 1.999 1.5" size=".4 .002 .3" rgba="0 0 1 1"
          group="5" contype="0" conaffinity="0"/>
    <camera name="in" pos="0 -1.8 1.5" xyaxes="1 0 0 0 0 1"/>
    <camera name="out" pos="0 -6 1.5" xyaxes="1 0 0 0 0 1"/>
  </worldbody></mujoco>)";

TEST(ForPeople, NoSensorSeesWhatIsThereToBeLookedAt) {
  const auto room = test::compile_mjcf(kClosedRoom);
  const FixedCamera in{room.camera("in")};
  EXPECT_FALSE(shows(draw(*room.model, *room.data, in, false), room.geom("picture")));
  EXPECT_TRUE(shows(draw(*room.model, *room.data, in, true), room.geom("picture")));
  const std::vector<int> sensed = solid_geoms(*room.model);
  EXPECT_EQ(std::ranges::find(sensed, room.geom("picture")), sensed.end());
  EXPECT_NE(std::ranges::find(sensed, room.geom("box")), sensed.end());
}

TEST(ForPeople, AWallBeforeTheEyeIsLeftOut) {
  const auto room = test::compile_mjcf(kClosedRoom);
  const FixedCamera out{room.camera("out")};
  EXPECT_FALSE(shows(draw(*room.model, *room.data, out, false), room.geom("box")));
  const RenderedImages seen = draw(*room.model, *room.data, out, true);
  EXPECT_TRUE(shows(seen, room.geom("box")));
  EXPECT_TRUE(shows(seen, room.geom("north"))) << "the wall behind it stays";
  EXPECT_FALSE(shows(seen, room.geom("south")));
}

TEST(ForPeople, ATableIsNoRoom) {
  const auto table = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom name="top" type="box" pos="0 0 .7" size=".5 .5 .02"/>
      <geom name="leg" type="box" pos="-.45 -.45 .34" size=".03 .03 .34"/>
      <camera name="out" pos="0 -3 1" xyaxes="1 0 0 0 .2 1"/>
    </worldbody></mujoco>)");
  EXPECT_TRUE(shows(draw(*table.model, *table.data, FixedCamera{table.camera("out")}, true),
                    table.geom("leg")));
}

/// A ball without walls round it, 1.8 m from the eye, and a marker at 0.5 m.
TEST(ForPeople, WithoutWallsNothingBeforeASceneIsCutAway) {
  const auto ball = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom size=".2" rgba="0 0 1 1"/>
      <camera pos="0 -2 0" xyaxes="1 0 0 0 0 1"/>
    </worldbody></mujoco>)");
  RenderRequest request;
  request.for_people = true;
  request.markers = {SphereMarker{.p_world_m = {0.0, -1.5, 0.0}}};
  RenderedImages images;
  make_offscreen_renderer(*ball.model, kPeopleWidth, kPeopleHeight)
      ->render(*ball.model, *ball.data, FixedCamera{0}, request, images);
  const std::size_t centre = kPeopleHeight / 2 * kPeopleWidth + kPeopleWidth / 2;
  EXPECT_GT(images.rgb[3 * centre], 60);
  EXPECT_EQ(images.rgb[3 * centre + 2], 0) << "the marker is red, the ball blue";
}

TEST(Overview, LooksIntoAClosedRoomThatHasNoCameraForIt) {
  const auto room = test::compile_mjcf(kClosedRoom);
  const CameraView overview = overview_camera(*room.model);
  const RenderedImages seen = draw(*room.model, *room.data, overview, true);
  EXPECT_TRUE(shows(seen, room.geom("box")));
  EXPECT_GT(mean_brightness(seen), 20.0) << "what is round the room is black here";
  EXPECT_FALSE(shows(draw(*room.model, *room.data, overview, false), room.geom("box")))
      << "a black ceiling, otherwise";
}

TEST(Overview, ASceneWithoutAnyLightIsNotDark) {
  const auto dark = test::compile_mjcf(R"(
    <mujoco>
      <visual><headlight active="0"/></visual>
      <worldbody><geom type="box" size="1 1 1" rgba=".8 .8 .8 1"/></worldbody>
    </mujoco>)");
  const FreeCamera near{.distance_m = 2.5};
  EXPECT_GT(mean_brightness(draw(*dark.model, *dark.data, near, true)), 60.0);
}

/// A grey side that faces the eye: of the lamp are 0.4 on all sides and 0.5 from the eye.
TEST(ForPeople, ASceneWithoutAnyLightIsLitFromTheEye) {
  const auto dark = test::compile_mjcf(R"(
    <mujoco>
      <visual><headlight active="0"/></visual>
      <worldbody><geom type="box" size=".5 .5 .5" rgba=".5 .5 .5 1"/></worldbody>
    </mujoco>)");
  const FreeCamera ahead{.distance_m = 2.0, .azimuth_rad = 0.0, .elevation_rad = 0.0};
  const RenderedImages images = draw(*dark.model, *dark.data, ahead, true);
  const std::size_t centre = kPeopleHeight / 2 * kPeopleWidth + kPeopleWidth / 2;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(images.rgb[3 * centre + c], 0.5 * (0.4 + 0.5) * 255.0, 4.0);
  }
}

class OverviewOfScene : public testing::TestWithParam<const char*> {};

TEST_P(OverviewOfScene, IsBright) {
  const auto path = kScenes / GetParam() / "scene.xml";
  std::array<char, 500> why{};
  const ModelPtr model(mj_loadXML(path.c_str(), nullptr, why.data(), why.size()));
  ASSERT_NE(model, nullptr) << why.data();
  const DataPtr data(mj_makeData(model.get()));
  mj_forward(model.get(), data.get());
  EXPECT_GT(mean_brightness(draw(*model, *data, overview_camera(*model), true)), 80.0);
}

INSTANTIATE_TEST_SUITE_P(All, OverviewOfScene,
                         testing::Values("tabletop_8", "office_small_2", "recognition",
                                         "trajectory_1", "trajectory_2", "trajectory_3",
                                         "trajectory_4"));

/// The scene without all that is for people alone.
std::string without_looks(const fs::path& scene) {
  const std::string text = read_file(scene);
  return std::regex_replace(text, std::regex("[^\n]*class=\"looks\" type[^\n]*\n"), "");
}

TEST(ForPeople, TheCameraOfAFlightSeesTheSameBitsWithAndWithoutTheLooksOfTheRoom) {
  const fs::path scene = kScenes / "trajectory_3/scene.xml";
  const std::string objects = read_file(scene.parent_path() / "objects.xml");
  const MemoryFile file{"objects.xml", objects};
  const LoadedModel plain = load_model(without_looks(scene), std::span(&file, 1), "plain");
  const LoadedModel furnished = load_model(read_file(scene), std::span(&file, 1), "furnished");
  ASSERT_GT(furnished.model->ngeom, plain.model->ngeom + 100);
  const auto seen = [](const mjModel& model, double azimuth_rad) {
    const DataPtr data(mj_makeData(&model));
    mj_forward(&model, data.get());
    const FreeCamera along{.lookat_m = {0.5, -1.0, 0.8},
                           .distance_m = 2.0,
                           .azimuth_rad = azimuth_rad,
                           .elevation_rad = -0.65,
                           .fovy_rad = 0.8};
    return draw(model, *data, along, false);
  };
  for (const double azimuth_rad : {0.0, 1.3, 2.9, 4.4}) {
    const RenderedImages a = seen(*plain.model, azimuth_rad);
    const RenderedImages b = seen(*furnished.model, azimuth_rad);
    EXPECT_EQ(a.rgb, b.rgb) << azimuth_rad;
    EXPECT_EQ(a.depth_m, b.depth_m) << azimuth_rad;
  }
}

TEST(SceneSurfaces, WallsAreApartByTheirSide) {
  const auto room = test::compile_mjcf(kClosedRoom);
  const SceneSurfaces surfaces = scene_surfaces(*room.model, *room.data);
  ASSERT_EQ(surfaces.vertices_m.size(), surfaces.colours.size());
  const std::size_t box = 12;
  EXPECT_EQ(surfaces.triangles[0].size(), 2 + box) << "floor, box";
  for (const std::size_t side : {1U, 2U, 3U, 5U}) EXPECT_EQ(surfaces.triangles[side].size(), box);
  EXPECT_EQ(surfaces.triangles[4].size(), 2 * box) << "the picture hangs on the north wall";
  EXPECT_NEAR(surfaces.extent_m.max().z(), 2.6, 1e-9);
  EXPECT_NE(std::ranges::find(surfaces.colours, std::array<std::uint8_t, 3>{255, 0, 0}),
            surfaces.colours.end());
}

TEST(ForPeople, ARoomBeyondTheFarPlaneIsSeen) {
  std::string text = kClosedRoom;
  text.insert(text.find("<worldbody>"),
              "<statistic extent='.5'/><visual><map znear='.01' zfar='4'/></visual>");
  const auto room = test::compile_mjcf(text);
  const FixedCamera out{room.camera("out")};
  EXPECT_FALSE(shows(draw(*room.model, *room.data, out, false), room.geom("south")))
      << "it is 3.9 m away, the far plane 2 m";
  const RenderedImages seen = draw(*room.model, *room.data, out, true);
  EXPECT_TRUE(shows(seen, room.geom("box")));
  EXPECT_TRUE(shows(seen, room.geom("north")));
}

/// Of the 3.9 m from the eye to the room.
TEST(ForPeople, HalfOfTheWayToARoomIsCutAway) {
  const auto room = test::compile_mjcf(kClosedRoom);
  const auto drawn_with = [&](const std::vector<Marker>& markers) {
    RenderRequest request;
    request.for_people = true;
    request.markers = markers;
    RenderedImages images;
    make_offscreen_renderer(*room.model, kPeopleWidth, kPeopleHeight)
        ->render(*room.model, *room.data, FixedCamera{room.camera("out")}, request, images);
    return images.rgb;
  };
  const auto plain = drawn_with({});
  EXPECT_EQ(drawn_with({SphereMarker{.p_world_m = {0.0, -4.5, 1.5}}}), plain) << "1.5 m";
  EXPECT_NE(drawn_with({SphereMarker{.p_world_m = {0.0, -3.5, 1.5}}}), plain) << "2.5 m";
}

/// Images of one scene for people or not, from several places.
std::vector<RenderedImages> drawn_from(const test::MjcfModel& scene,
                                       const std::vector<std::pair<FreeCamera, bool>>& views) {
  const auto renderer = make_offscreen_renderer(*scene.model, kPeopleWidth, kPeopleHeight);
  std::vector<RenderedImages> images(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    RenderRequest request;
    request.depth_and_segmentation = false;
    request.for_people = views[i].second;
    renderer->render(*scene.model, *scene.data, views[i].first, request, images[i]);
  }
  return images;
}

TEST(ForPeople, ASceneWithALightOfItsOwnIsLitByThatAlone) {
  const auto lit = test::compile_mjcf(R"(
    <mujoco>
      <visual><headlight active="0"/></visual>
      <worldbody>
        <light pos="0 0 4" dir="0 0 -1" diffuse=".2 .2 .2"/>
        <geom type="box" size=".5 .5 .5" rgba=".8 .8 .8 1"/>
      </worldbody>
    </mujoco>)");
  const FreeCamera near{.distance_m = 2.5};
  const auto images = drawn_from(lit, {{near, true}, {near, false}});
  EXPECT_EQ(images[0].rgb, images[1].rgb);
}

/// The upper side of a wall from straight above, and its front, of which the eye sees a part.
TEST(ForPeople, TheLampAtTheEyeShinesAlongItsSightAndEvenly) {
  const auto dark = test::compile_mjcf(R"(
    <mujoco>
      <visual><headlight active="0"/></visual>
      <worldbody><geom type="box" size=".5 3 3" rgba=".5 .5 .5 1"/></worldbody>
    </mujoco>)");
  const FreeCamera above{
      .distance_m = 4.5, .azimuth_rad = 0.0, .elevation_rad = -std::numbers::pi / 2.0};
  const FreeCamera ahead{.distance_m = 2.0, .azimuth_rad = 0.0, .elevation_rad = 0.0};
  const auto images = drawn_from(dark, {{above, true}, {ahead, true}});
  const auto red = [&](std::size_t image, int row, int column) {
    return images[image].rgb[3 * static_cast<std::size_t>(row * kPeopleWidth + column)];
  };
  constexpr int kMiddleRow = kPeopleHeight / 2;
  constexpr int kMiddleColumn = kPeopleWidth / 2;
  // Half grey, lit by 0.4 from everywhere and by 0.5 along the sight.
  EXPECT_NEAR(red(0, kMiddleRow, kMiddleColumn), 0.5 * (0.4 + 0.5) * 255.0, 4.0);
  EXPECT_NEAR(red(1, kMiddleRow, 2), red(1, kMiddleRow, kMiddleColumn), 2);
  EXPECT_NEAR(red(1, 2, kMiddleColumn), red(1, kMiddleRow, kMiddleColumn), 2);
}

}  // namespace
}  // namespace vantage
