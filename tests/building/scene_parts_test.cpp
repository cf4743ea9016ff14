// What becomes of the parts of a building: which stay, in what colour, and where they stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/building/made_mesh.hpp"
#include "vantage/building/building_scene.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using test::MadeMesh;

/// Boxes have corners of their own: they are joined as a file's are.
BuildingMesh joined_mesh(const MadeMesh& made) {
  BuildingMesh mesh;
  mesh.colours = made.mesh.colours;
  for (const Triangle& triangle : made.mesh.triangles) {
    Triangle& joined = mesh.triangles.emplace_back();
    mesh.objects.push_back(static_cast<int>(mesh.objects.size() / 12));  // of a box
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& corner = made.mesh.corner(triangle, i);
      const auto known = std::find(mesh.vertices_m.begin(), mesh.vertices_m.end(), corner);
      joined[i] = static_cast<int>(known - mesh.vertices_m.begin());
      if (known == mesh.vertices_m.end()) mesh.vertices_m.push_back(corner);
    }
  }
  return mesh;
}

BuildingScene scene_made_of(const MadeMesh& made, const BuildingOptions& options) {
  return make_building_scene(joined_mesh(made), options, "made", [](std::string_view) {});
}

void expect_colour(const BoxShape& shape, const Eigen::Vector3f& colour) {
  EXPECT_LT((shape.colour - colour).norm(), 1e-5F) << shape.colour.transpose();
}

TEST(SceneParts, WithoutColoursGetThoseOfWhatTheyAre) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 8, 0});
  made.box({0, 0, 0}, {8, 0.2, 2.5});
  for (int i = 0; i < 5; ++i) made.box({i + 1.0, 7, 0}, {i + 1.5, 7.5, 0.8});
  made.box({0, 7.8, 0}, {8, 8, 2.06});
  BuildingMesh mesh = joined_mesh(made);
  for (std::size_t i = 12; i < 24; ++i) mesh.colours[i] = {0.25F, 0.5F, 0.75F};
  const BuildingScene scene = make_building_scene(mesh, {}, "made", [](std::string_view) {});
  ASSERT_EQ(scene.boxes.size(), 8U);
  EXPECT_TRUE(scene.hulls.empty());
  EXPECT_TRUE(scene.cell_boxes.empty());
  expect_colour(scene.boxes[0], {0.55F, 0.53F, 0.50F});
  expect_colour(scene.boxes[1], {0.25F, 0.5F, 0.75F});
  expect_colour(scene.boxes[2], {0.55F, 0.58F, 0.45F});
  expect_colour(scene.boxes[3], {0.72F, 0.62F, 0.50F});
  expect_colour(scene.boxes[4], {0.63F, 0.47F, 0.33F});
  expect_colour(scene.boxes[5], {0.42F, 0.50F, 0.56F});
  expect_colour(scene.boxes[6], {0.55F, 0.58F, 0.45F});
  expect_colour(scene.boxes[7], {0.86F, 0.85F, 0.82F});
}

TEST(SceneParts, AreThoseBetweenTheFloorAndTheHeight) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 6, 0});
  made.box({1, 1, 2.9}, {2, 2, 3.4});
  made.box({3, 1, 3.05}, {4, 2, 3.4});
  made.box({5, 1, -0.6}, {6, 2, -0.25});
  made.box({5, 3, -0.8}, {6, 4, -0.35});
  const BuildingScene scene = scene_made_of(made, {.floor_m = 0.0});
  ASSERT_EQ(scene.boxes.size(), 3U);
  EXPECT_NEAR(scene.boxes[1].box.half_m.z(), 0.25, 1e-9);
  EXPECT_NEAR(scene.boxes[2].box.half_m.z(), 0.175, 1e-9);
  const BuildingScene low = scene_made_of(made, {.floor_m = 0.0, .height_m = 2.8});
  EXPECT_EQ(low.boxes.size(), 2U);
  const BuildingScene high = scene_made_of(made, {.floor_m = 0.0, .height_m = 3.1});
  EXPECT_EQ(high.boxes.size(), 4U);
}

/// By what stands between 5 cm and 2 m above the floor; the floor itself is wider.
TEST(SceneParts, StandInTheMiddleOfTheScene) {
  MadeMesh made;
  made.box({-2, -3, 0.9}, {10, 7, 1.0});
  made.box({1, 0, 1.0}, {2, 1, 1.8});
  made.box({5, 3, 1.0}, {7, 4, 1.8});
  made.box({8, 6, 3.1}, {9, 7, 3.4});  // hangs high
  const BuildingScene scene = scene_made_of(made, {.floor_m = 1.0});
  EXPECT_LT((scene.T_scene_mesh.translation() - Eigen::Vector3d(-4.0, -2.0, -1.0)).norm(), 1e-9);
  EXPECT_NEAR(scene.extent_m.sizes().x(), 6.0, 1e-9);
  EXPECT_NEAR(scene.extent_m.sizes().y(), 4.0, 1e-9);
  EXPECT_LT(scene.extent_m.center().norm(), 1e-9);
  EXPECT_EQ(scene.cell_m, 0.05);
  ASSERT_EQ(scene.boxes.size(), 4U);
  EXPECT_LT((scene.boxes[1].box.T_mesh_box.translation() - Eigen::Vector3d(-2.5, -1.5, 0.4)).norm(),
            1e-9);
}

TEST(SceneParts, OfMoreGeomsThanAllowedAreRefused) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 6, 0});
  made.box({1, 1, 0}, {2, 2, 1});
  EXPECT_EQ(scene_made_of(made, {.max_geoms = 2}).geoms(), 2U);
  EXPECT_THROW(scene_made_of(made, {.max_geoms = 1}), ConfigError);
}

TEST(BuildingOptions, HaveTheirDefaults) {
  const BuildingOptions options;
  EXPECT_EQ(options.cell_m, 0.05);
  EXPECT_EQ(options.height_m, 3.0);
  EXPECT_EQ(options.clearance_m, 0.6);
  EXPECT_EQ(options.max_geoms, 3000);
  EXPECT_EQ(kBelowFloor_m, 0.3);
}

TEST(SceneParts, StandFromFiveCentimetresUpToTwoMetres) {
  const auto middle_x_m = [](double low_m, double high_m) {
    MadeMesh made;
    made.box({0, 0, -0.1}, {8, 6, 0});
    made.box({1, 1, 0}, {2, 2, 1});
    made.box({5, 1, low_m}, {6, 2, high_m});
    return -scene_made_of(made, {.floor_m = 0.0}).T_scene_mesh.translation().x();
  };
  EXPECT_NEAR(middle_x_m(0.0, 0.04), 1.5, 1e-9);
  EXPECT_NEAR(middle_x_m(0.0, 0.06), 3.5, 1e-9);
  EXPECT_NEAR(middle_x_m(1.9, 2.4), 3.5, 1e-9);
  EXPECT_NEAR(middle_x_m(2.1, 2.4), 1.5, 1e-9);
}

TEST(SceneParts, HaveTheColourOfTheFloorUpToACentimetre) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 6, 0});
  made.box({1, 1, 0}, {2, 2, 0.008});
  made.box({3, 1, 0}, {4, 2, 0.015});
  made.box({5, 1, 0}, {6, 2, 2.0});
  const BuildingScene scene = scene_made_of(made, {.floor_m = 0.0});
  ASSERT_EQ(scene.boxes.size(), 4U);
  expect_colour(scene.boxes[0], {0.55F, 0.53F, 0.50F});
  expect_colour(scene.boxes[1], {0.55F, 0.53F, 0.50F});
  expect_colour(scene.boxes[2], {0.55F, 0.58F, 0.45F});
  expect_colour(scene.boxes[3], {0.72F, 0.62F, 0.50F});
}

TEST(SceneParts, RefusalsSayTheNumbersThatMatter) {
  MadeMesh made;
  made.box({0, 0, 1.4}, {8, 6, 1.5});
  made.box({1, 1, 1.5}, {2, 2, 2.5});
  const auto refusal = [&](const BuildingOptions& options) -> std::string {
    try {
      scene_made_of(made, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal({}), "no error");
  EXPECT_EQ(refusal({.max_geoms = 1}),
            "--max-geoms 1: made would need 2, most of them parts of the mesh as it has them");
  EXPECT_EQ(refusal({.floor_m = 100.0}),
            "made: nothing stands on the floor at 100 m (--floor), below 3 m (--height)");
}

TEST(SceneParts, ThatOnlyTouchTheLimitsAreLeftOut) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 6, 0});
  made.box({1, 1, 0}, {2, 2, 1});
  made.box({3, 1, 3.0}, {4, 2, 3.4});
  made.box({5, 1, -0.6}, {6, 2, -0.3});
  EXPECT_EQ(scene_made_of(made, {.floor_m = 0.0}).boxes.size(), 2U);
}

TEST(SceneParts, KeepTheirOwnColourEvenIfItIsBlack) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 6, 0});
  made.box({1, 1, 0}, {2, 2, 1});
  BuildingMesh mesh = joined_mesh(made);
  for (std::size_t i = 12; i < 24; ++i) mesh.colours[i] = Eigen::Vector3f::Zero();
  const BuildingScene scene = make_building_scene(mesh, {}, "made", [](std::string_view) {});
  ASSERT_EQ(scene.boxes.size(), 2U);
  expect_colour(scene.boxes[1], {0.0F, 0.0F, 0.0F});
}

/// The floor, something of three sides, and what has its colour in turn after both.
TEST(SceneParts, HaveColoursInTurnWhateverTheirShape) {
  MadeMesh made;
  made.box({0, 0, -0.1}, {8, 6, 0});
  BuildingMesh mesh = joined_mesh(made);
  const int first = static_cast<int>(mesh.vertices_m.size());
  for (const auto& p_m : {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2, 1, 0),
                          Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(1, 1, 1)}) {
    mesh.vertices_m.push_back(p_m);
  }
  for (const Triangle& t : {Triangle{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh.colours.emplace_back(-1.0F, -1.0F, -1.0F);
    mesh.objects.push_back(1);
  }
  MadeMesh cupboard;
  cupboard.box({5, 1, 0}, {6, 2, 1.5});
  const BuildingMesh more = joined_mesh(cupboard);
  const int next = static_cast<int>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(), more.vertices_m.begin(), more.vertices_m.end());
  for (const Triangle& t : more.triangles) {
    mesh.triangles.push_back({next + t[0], next + t[1], next + t[2]});
    mesh.colours.emplace_back(-1.0F, -1.0F, -1.0F);
    mesh.objects.push_back(2);
  }
  const BuildingScene scene = make_building_scene(mesh, {}, "made", [](std::string_view) {});
  ASSERT_EQ(scene.hulls.size(), 1U);
  ASSERT_EQ(scene.boxes.size(), 2U);
  EXPECT_LT((scene.hulls[0].colour - Eigen::Vector3f(0.42F, 0.50F, 0.56F)).norm(), 1e-5F);
  expect_colour(scene.boxes[1], {0.55F, 0.58F, 0.45F});
}

/// A floor is laid, and all that there is hangs above what counts.
TEST(SceneParts, ALaidFloorAloneIsNoScene) {
  MadeMesh made;
  made.box({0, 0, 5}, {1, 1, 6});
  made.box({7, 5, 5}, {8, 6, 6});
  try {
    scene_made_of(made, {.floor_m = 0.0});
    ADD_FAILURE() << "there is nothing";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("made: nothing stands on the floor"), 0U);
  }
}

}  // namespace
}  // namespace vantage
