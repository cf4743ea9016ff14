// Scenes of buildings whose walls, doors and floors are known.
#include "vantage/building/building_scene.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <numbers>
#include <random>

#include "tests/building/drawn_building.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/building/scene_text.hpp"
#include "vantage/core/error.hpp"
#include "vantage/sim/world/scene.hpp"

namespace vantage {
namespace {

using testing::AllOf;
using testing::HasSubstr;

BuildingScene scene_of(const test::DrawnBuilding& building, const BuildingOptions& options = {},
                       const MeshReading& reading = {}) {
  const support::TemporaryDirectory folder;
  write_file(folder / "mesh.obj", building.obj());
  return make_building_scene(read_building_mesh(folder / "mesh.obj", reading), options, "mesh.obj",
                             [](std::string_view) {});
}

template <class Expected>
std::string refusal(const test::DrawnBuilding& building, const BuildingOptions& options = {}) {
  try {
    scene_of(building, options);
  } catch (const Expected& error) {
    return error.what();
  }
  return "";
}

bool holds(const BoxShape& shape, const Eigen::Vector3d& p_m) {
  const Eigen::Vector3d p = shape.box.T_mesh_box.inverse() * p_m;
  return (p.cwiseAbs() - shape.box.half_m).maxCoeff() <= 0.0;
}

/// Of the scene's boxes; hulls are not asked.
bool is_solid_at(const BuildingScene& scene, const Eigen::Vector3d& p_m) {
  const auto hit = [&](const BoxShape& shape) { return holds(shape, p_m); };
  return std::ranges::any_of(scene.boxes, hit) || std::ranges::any_of(scene.cell_boxes, hit);
}

/// From a point in the mesh's frame, along x of the scene: how far nothing is solid.
double opening_m(const BuildingScene& scene, const Eigen::Vector3d& p_mesh_m) {
  const Eigen::Vector3d from_m = scene.T_scene_mesh * p_mesh_m;
  double width_m = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    double way_m = 0.0;
    while (way_m < 3.0 && !is_solid_at(scene, from_m + sign * way_m * Eigen::Vector3d::UnitX())) {
      way_m += 0.0005;
    }
    width_m += way_m;
  }
  return width_m;
}

void expect_inside_the_room(const BuildingScene& scene) {
  const Pose2& start = scene.floor.start;
  const Eigen::Vector3d p_mesh_m =
      scene.T_scene_mesh.inverse() * Eigen::Vector3d(start.x_m, start.y_m, 0.0);
  EXPECT_LT(std::abs(p_mesh_m.x()), 3.0 - 0.55);
  EXPECT_LT(std::abs(p_mesh_m.y()), 2.0 - 0.55);
  EXPECT_NEAR(p_mesh_m.z(), 0.0, 1e-6);
  EXPECT_GE(scene.floor.clearance_m, 0.6);
}

TEST(BuildingScene, ADoorIsAsWideAsInTheMesh) {
  for (const double door_m : {0.85, 0.913}) {
    const BuildingScene scene = scene_of(test::room_with_door(door_m));
    EXPECT_NEAR(opening_m(scene, {0.0, -2.05, 1.0}), door_m, 0.002);
    expect_inside_the_room(scene);
    EXPECT_EQ(scene.boxes.size(), 1U) << "the floor is a box of its own";
    EXPECT_LE(scene.cell_boxes.size(), 5U) << "and so are the walls";
  }
}

TEST(BuildingScene, WallsAreWhereTheyAre) {
  const BuildingScene scene = scene_of(test::room_with_door(0.85));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-3.5, 3.5);
  std::uniform_real_distribution<double> y(-2.5, 2.5);
  std::uniform_real_distribution<double> z(0.01, 2.6);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d p(x(random), y(random), z(random));
    const bool outer = std::abs(p.x()) < 3.1 && std::abs(p.y()) < 2.1;
    const bool inner = std::abs(p.x()) < 3.0 && std::abs(p.y()) < 2.0;
    const bool door = p.y() < -2.0 && std::abs(p.x()) < 0.425;
    const bool solid = outer && !inner && !door && p.z() < 2.5;
    ASSERT_EQ(is_solid_at(scene, scene.T_scene_mesh * p), solid) << p.transpose();
  }
}

TEST(BuildingScene, ATurnedBuildingIsTurnedBack) {
  const double turn_rad = 0.5;
  const BuildingScene scene = scene_of(test::room_with_door(0.85, turn_rad));
  const Eigen::Rotation2Dd turn(turn_rad);
  const Eigen::Vector2d door_m = turn * Eigen::Vector2d(0.0, -2.05);
  EXPECT_NEAR(opening_m(scene, {door_m.x(), door_m.y(), 1.0}), 0.85, 0.01);
  EXPECT_GE(opening_m(scene, {door_m.x(), door_m.y(), 1.0}), 0.80);
  EXPECT_NEAR(scene.extent_m.sizes().x(), 6.2, 0.01);
  EXPECT_LE(scene.cell_boxes.size(), 6U);
  EXPECT_NEAR(scene.extent_m.center().norm(), 0.0, 0.01) << "in the middle of the scene";
}

/// A wall at 45 degrees through a hall that runs along the axes.
test::DrawnBuilding hall_with_oblique_walls() {
  test::DrawnBuilding hall;
  hall.box({0, 0, -0.1}, {8, 8, 0});
  hall.box({0, 0, 0}, {8, 0.2, 2.5});
  hall.box({0, 7.8, 0}, {8, 8, 2.5});
  hall.prism({{2.0, 3.0}, {2.3, 2.7}, {5.3, 5.7}, {6.0, 5.7}, {6.0, 6.1}, {5.1, 6.1}}, 0.0, 2.5);
  return hall;
}

/// Distance to the prism above from outside, or minus that to its outline from inside.
double distance_m(const Eigen::Vector2d& p) {
  const test::Outline outline{{2.0, 3.0}, {2.3, 2.7}, {5.3, 5.7},
                              {6.0, 5.7}, {6.0, 6.1}, {5.1, 6.1}};
  double nearest_m = 1e9;
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (p - a - along * (b - a)).norm());
    const bool crosses = (a.y() > p.y()) != (b.y() > p.y());
    if (crosses && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
      inside = !inside;
    }
  }
  return inside ? -nearest_m : nearest_m;
}

TEST(BuildingScene, ObliqueWallsAreOffByACellAtMost) {
  const BuildingScene scene = scene_of(hall_with_oblique_walls());
  EXPECT_EQ(scene.boxes.size(), 3U);
  EXPECT_GT(scene.cell_boxes.size(), 10U);
  double truth_m2 = 0.0;
  double scene_m2 = 0.0;
  for (double y = 2.5; y < 6.4; y += 0.013) {
    for (double x = 1.8; x < 6.3; x += 0.013) {
      const double off_m = distance_m({x, y});
      const bool solid = is_solid_at(scene, scene.T_scene_mesh * Eigen::Vector3d(x, y, 1.0));
      if (std::abs(off_m) > 0.05) {
        ASSERT_EQ(solid, off_m < 0.0) << x << " " << y;
      }
      truth_m2 += off_m < 0.0 ? 1.0 : 0.0;
      scene_m2 += solid ? 1.0 : 0.0;
    }
  }
  EXPECT_NEAR(scene_m2 / truth_m2, 1.0, 0.02) << "too much here, too little there";
}

TEST(BuildingScene, SheetsHaveTheirThicknessBehindThem) {
  test::DrawnBuilding room;  // as a scan has it: surfaces seen from inside
  room.face({{-3, -2, 0}, {3, -2, 0}, {3, 2, 0}, {-3, 2, 0}});
  room.face({{-3, 2, 0}, {-3, 2, 2.5}, {-3, -2, 2.5}, {-3, -2, 0}});
  room.face({{3, -2, 0}, {3, -2, 2.5}, {3, 2, 2.5}, {3, 2, 0}});
  room.face({{-3, -2, 0}, {-3, -2, 2.5}, {3, -2, 2.5}, {3, -2, 0}});
  room.face({{3, 2, 0}, {3, 2, 2.5}, {-3, 2, 2.5}, {-3, 2, 0}});
  const BuildingScene scene = scene_of(room);
  EXPECT_TRUE(scene.boxes.empty());
  EXPECT_LE(scene.cell_boxes.size(), 6U);
  EXPECT_NEAR(opening_m(scene, {0.0, 0.0, 1.0}), 6.0, 0.002);
  EXPECT_TRUE(is_solid_at(scene, scene.T_scene_mesh * Eigen::Vector3d(3.02, 0.5, 1.0)));
  EXPECT_TRUE(is_solid_at(scene, scene.T_scene_mesh * Eigen::Vector3d(1.0, 0.5, -0.02)));
  EXPECT_FALSE(is_solid_at(scene, scene.T_scene_mesh * Eigen::Vector3d(1.0, 0.5, 0.01)));
  expect_inside_the_room(scene);
}

TEST(BuildingScene, AScannedFloorIsRough) {
  test::DrawnBuilding room;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> rough(-0.012, 0.012);
  std::vector<std::vector<double>> z_m(31, std::vector<double>(31));
  for (auto& row : z_m) {
    for (double& z : row) z = rough(random);
  }
  const auto at = [&](int i, int j) {
    return Eigen::Vector3d(0.2 * i - 3.0, 0.2 * j - 3.0,
                           z_m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
  };
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {  // facing down
      room.face({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      room.face({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  room.face({{-3, 3, -0.1}, {-3, 3, 2.5}, {-3, -3, 2.5}, {-3, -3, -0.1}});
  const BuildingScene scene = scene_of(room);
  EXPECT_NEAR(scene.T_scene_mesh.translation().z(), 0.0, 0.012);
  EXPECT_GT(scene.floor.area_m2, 18.0);
  EXPECT_LE(scene.cell_boxes.size(), 4U);
}

TEST(BuildingScene, TheFloorIsFoundUnderRoofAndFurniture) {
  test::DrawnBuilding building = test::room_with_door(0.9);
  building.box({-3.1, -2.1, 2.5}, {3.1, 2.1, 2.7});         // a roof
  building.box({1.0, 0.5, 0.7}, {2.4, 1.5, 0.74});          // a table top
  building.box({-2.0, -1.0, 0.0}, {-1.0, -0.6, 0.9}, 0.4);  // a cupboard
  const BuildingScene scene = scene_of(building);
  EXPECT_NEAR(scene.T_scene_mesh.translation().z(), 0.0, 1e-6);
  EXPECT_EQ(scene.boxes.size(), 4U);
  expect_inside_the_room(scene);
  const auto turned = std::ranges::count_if(scene.boxes, [](const BoxShape& shape) {
    return std::abs(shape.box.T_mesh_box.linear()(0, 0) - std::cos(0.4)) < 1e-3;
  });
  EXPECT_EQ(turned, 1) << "the cupboard stays what it is";
}

TEST(BuildingScene, StoreysAreChosenByTheirFloor) {
  test::DrawnBuilding building = test::room_with_door(0.9);
  building.box({-3.1, -2.1, 2.5}, {3.1, 2.1, 2.8});
  building.box({-3.1, 2.0, 2.8}, {3.1, 2.1, 5.0});
  building.box({1.0, 1.0, 2.8}, {2.0, 2.0, 3.5});
  EXPECT_NEAR(scene_of(building).T_scene_mesh.translation().z(), 0.0, 1e-6);
  const BuildingScene upper = scene_of(building, {.floor_m = 2.8});
  EXPECT_NEAR(upper.T_scene_mesh.translation().z(), -2.8, 1e-6);
  EXPECT_FALSE(upper.laid_floor);
  EXPECT_TRUE(is_solid_at(upper, upper.T_scene_mesh * Eigen::Vector3d(1.5, 1.5, 3.0)));
}

TEST(BuildingScene, AFloorIsLaidWhereTheMeshHasNone) {
  test::DrawnBuilding walls;
  walls.box({-3.1, -2.1, 0}, {3.1, -2.0, 2.5});
  walls.box({-3.1, 2.0, 0}, {3.1, 2.1, 2.5});
  EXPECT_THAT(refusal<InputError>(walls),
              AllOf(HasSubstr("mesh.obj: no free start"), HasSubstr("--floor")));
  const BuildingScene scene = scene_of(walls, {.floor_m = 0.0});
  EXPECT_TRUE(scene.laid_floor);
  EXPECT_THAT(to_mjcf(scene, "walls", "by hand"), HasSubstr("type=\"plane\""));
}

TEST(BuildingScene, TellsWhatBegins) {
  const support::TemporaryDirectory folder;
  write_file(folder / "mesh.obj", test::room_with_door(0.9).obj());
  std::vector<std::string> begun;
  make_building_scene(read_building_mesh(folder / "mesh.obj", {}), {}, "mesh.obj",
                      [&](std::string_view step) { begun.emplace_back(step); });
  EXPECT_THAT(begun, testing::ElementsAre("parts", "floor and walls", "solid cells", "boxes"));
}

TEST(BuildingScene, WhatCannotBeASceneIsRefused) {
  test::DrawnBuilding crammed;
  crammed.box({0, 0, -0.1}, {1, 1, 0});
  EXPECT_THAT(refusal<InputError>(crammed),
              AllOf(HasSubstr("no free start"), HasSubstr("0.6 m clear")));
  EXPECT_THAT(refusal<ConfigError>(hall_with_oblique_walls(), {.max_geoms = 5}),
              AllOf(HasSubstr("--max-geoms 5"), HasSubstr("--cell 0.1")));
  EXPECT_THAT(refusal<ConfigError>(test::room_with_door(0.9), {.cell_m = 0.005}),
              HasSubstr("too many cells"));
}

/// A room that is drawn as one closed box with its normals outwards: all that can be stood on is
/// its roof.
TEST(BuildingScene, ASolidBlockIsRefused) {
  test::DrawnBuilding block;
  block.box({0, 0, 0}, {8, 6, 2.5});
  EXPECT_THAT(refusal<InputError>(block), HasSubstr("nothing stands on the floor at 2.5 m"));
}

TEST(BuildingScene, MuJoCoReadsIt) {
  test::DrawnBuilding building = test::room_with_door(0.85);
  building.prism({{-2, -1}, {-1, -1}, {-1.5, 0}}, 0.0, 0.8);
  building.box({1, 1, 0}, {2, 1.5, 0.7}, 0.3);
  const BuildingScene scene = scene_of(building);
  ASSERT_EQ(scene.hulls.size(), 1U);
  const LoadedModel loaded = load_model(to_mjcf(scene, "room", "by a test"), {}, "room.xml");
  const mjModel& model = *loaded.model;
  EXPECT_EQ(static_cast<std::size_t>(model.ngeom), scene.geoms());
  EXPECT_EQ(model.nsite, 1);
  EXPECT_NEAR(model.site_pos[0], scene.floor.start.x_m, 1e-6);
  EXPECT_TRUE(loaded.warnings.empty());
  for (int geom = 0; geom < model.ngeom; ++geom) EXPECT_EQ(model.geom_contype[geom], 1);
}

/// Round hulls have no axes of their own: MuJoCo turns their frames as rounding has it.
TEST(BuildingScene, ARobotJoinsRoundThings) {
  test::DrawnBuilding building = test::room_with_door(0.85, 0.3);
  test::Outline round_m;
  for (int i = 0; i < 16; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 16.0;
    round_m.emplace_back(1.0 + 0.2 * std::cos(angle_rad), 0.2 * std::sin(angle_rad));
  }
  building.prism(round_m, 0.0, 2.3);
  const support::TemporaryDirectory folder;
  write_file(folder / "room.xml", to_mjcf(scene_of(building), "room", "by a test"));
  const auto robot = std::filesystem::path(VANTAGE_SOURCE_DIR) / "models/robots/pr2/pr2.xml";
  EXPECT_NO_THROW(load_model({folder / "room.xml", robot}));
}

TEST(BuildingScene, TheMapHoldsTheBuilding) {
  const BuildingScene scene = scene_of(test::room_with_door(0.85));
  const BuildingMap map = map_of(scene);
  EXPECT_GE(map.size_m.x(), scene.extent_m.sizes().x());
  EXPECT_LE(map.size_m.x(), scene.extent_m.sizes().x() + 1.0);
  EXPECT_GE(map.half_size_m, 0.5 * map.size_m.maxCoeff());
  EXPECT_NEAR(map.size_m.x() / map.cells.x(), map.size_m.y() / map.cells.y(), 0.003);
  EXPECT_THAT(to_episode(scene, "room.xml"), HasSubstr("scene: room.xml"));
}

/// Flush with a ground of 20 x 20 m, as modelling programs draw it.
TEST(BuildingScene, ARobotBeginsInTheHouseNotOnTheGroundAboutIt) {
  test::DrawnBuilding house = test::room_with_door(0.9);
  house.box({-10.0, -10.0, -0.2}, {10.0, 10.0, 0.0});
  const BuildingScene scene = scene_of(house);
  const BuildingMap map = map_of(scene);
  EXPECT_LT(std::abs(scene.floor.start.x_m), 0.5 * map.size_m.x());
  EXPECT_LT(std::abs(scene.floor.start.y_m), 0.5 * map.size_m.y());
  EXPECT_LT(scene.floor.area_m2, 30.0);
}

TEST(BuildingScene, NothingAtThatHeightIsRefused) {
  EXPECT_THAT(refusal<InputError>(test::room_with_door(0.9), {.floor_m = 100.0}),
              AllOf(HasSubstr("nothing"), HasSubstr("--floor")));
}

/// A pillar that is no box goes on far below the floor and above what counts.
TEST(BuildingScene, CellsEndWithinACellOfItsHeights) {
  test::DrawnBuilding building;
  building.box({0, 0, -0.1}, {8, 8, 0});
  building.prism({{1, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}}, -2.0, 6.0);
  BuildingOptions options;
  options.floor_m = 0.0;
  const BuildingScene scene = scene_of(building, options);
  ASSERT_FALSE(scene.cell_boxes.empty());
  double lowest_m = 0.0;
  double highest_m = 0.0;
  for (const BoxShape& shape : scene.cell_boxes) {
    const double z_m = shape.box.T_mesh_box.translation().z();
    lowest_m = std::min(lowest_m, z_m - shape.box.half_m.z());
    highest_m = std::max(highest_m, z_m + shape.box.half_m.z());
  }
  EXPECT_NEAR(lowest_m, -0.35, 1e-9);
  EXPECT_NEAR(highest_m, 3.05, 1e-9);
}

TEST(BuildingScene, BoxesOfCellsHaveTheColourOfTheFloorOrOfWalls) {
  test::DrawnBuilding room;
  room.face({{-3, -2, 0}, {3, -2, 0}, {3, 2, 0}, {-3, 2, 0}});
  room.face({{-3, 2, 0}, {-3, 2, 2.5}, {-3, -2, 2.5}, {-3, -2, 0}});
  room.face({{3, -2, 0}, {3, -2, 2.5}, {3, 2, 2.5}, {3, 2, 0}});
  int floors = 0;
  int walls = 0;
  for (const BoxShape& shape : scene_of(room).cell_boxes) {
    const double top_m = shape.box.T_mesh_box.translation().z() + shape.box.half_m.z();
    const bool floor = top_m < 0.01;
    const Eigen::Vector3f expected =
        floor ? Eigen::Vector3f(0.55F, 0.53F, 0.50F) : Eigen::Vector3f(0.86F, 0.85F, 0.82F);
    EXPECT_LT((shape.colour - expected).norm(), 1e-5F) << top_m;
    ++(floor ? floors : walls);
  }
  EXPECT_GT(floors, 0);
  EXPECT_GT(walls, 0);
}

TEST(BuildingScene, PartsOfTheMeshThatFitLeaveCellsToBeMadeLarger) {
  EXPECT_THAT(refusal<ConfigError>(hall_with_oblique_walls(), {.max_geoms = 3}),
              HasSubstr("--cell 0.1"));
}

}  // namespace
}  // namespace vantage
