// What a mesh falls into: solids, sheets and rooms, wound as they come.
#include "vantage/building/mesh_parts.hpp"

#include <gtest/gtest.h>

#include "tests/building/drawn_building.hpp"
#include "tests/support/temporary_directory.hpp"

namespace vantage {
namespace {

BuildingMesh mesh_of(const test::DrawnBuilding& building) {
  const support::TemporaryDirectory folder;
  write_file(folder / "mesh.obj", building.obj());
  return read_building_mesh(folder / "mesh.obj", {});
}

void turn_inside_out(BuildingMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

TEST(MeshParts, BoxesBesideEachOtherAreParts) {
  test::DrawnBuilding building;
  building.box({0, 0, 0}, {1, 2, 3});
  building.box({1, 0, 0}, {2, 1, 1});
  building.box({5, 5, 0}, {6, 6, 1}, 0.3);
  const BuildingMesh mesh = mesh_of(building);
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_NEAR(parts[0].volume_m3, 6.0, 1e-4);
  EXPECT_NEAR(parts[1].volume_m3, 1.0, 1e-4);
  for (const MeshPart& part : parts) EXPECT_TRUE(is_convex(mesh, part));
  OrientedBox box;
  ASSERT_TRUE(is_box(mesh, parts[2], box));
  EXPECT_NEAR((box.half_m - Eigen::Vector3d(0.5, 0.5, 0.5)).norm(), 0.0, 1e-5);
  EXPECT_NEAR((box.T_mesh_box.translation() - Eigen::Vector3d(5.5, 5.5, 0.5)).norm(), 0.0, 1e-5);
  EXPECT_NEAR(box.T_mesh_box.linear()(0, 0), std::cos(0.3), 1e-5);
  ASSERT_TRUE(is_box(mesh, parts[0], box));
  EXPECT_TRUE(box.T_mesh_box.linear().isIdentity(1e-9));
}

TEST(MeshParts, BoxesThatStandOnEachOtherAreTwo) {
  test::DrawnBuilding building;
  building.box({0, 0, 0}, {1, 2, 0.5}, 0.3);
  building.box({0, 0, 0.5}, {1, 2, 0.7}, 0.3);
  const BuildingMesh mesh = mesh_of(building);
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].volume_m3, 1.0, 1e-4);
  EXPECT_NEAR(parts[1].volume_m3, 0.4, 1e-4);
}

TEST(MeshParts, ATriangularPrismIsConvexAndNoBox) {
  test::DrawnBuilding building;
  building.prism({{0, 0}, {1, 0}, {0, 1}}, 0.0, 2.0);
  const BuildingMesh mesh = mesh_of(building);
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 1U);
  OrientedBox box;
  EXPECT_TRUE(is_convex(mesh, parts[0]));
  EXPECT_FALSE(is_box(mesh, parts[0], box));
  EXPECT_EQ(corners_of(mesh, parts[0]).size(), 6U);
}

TEST(MeshParts, WallsRoundADoorAreSolidAndConcave) {
  const BuildingMesh mesh = mesh_of(test::room_with_door(0.85));
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_TRUE(is_solid(parts[0]));
  EXPECT_FALSE(is_convex(mesh, parts[0]));
  EXPECT_NEAR(parts[0].volume_m3, 2.5 * 0.1 * (2 * 6.2 + 2 * 4.0 - 0.85), 1e-3);
  EXPECT_TRUE(is_convex(mesh, parts[1]));
}

TEST(MeshParts, WhatIsWoundInsideOutIsTurnedUnlessItIsARoom) {
  test::DrawnBuilding cupboard;
  cupboard.box({0, 0, 0}, {2, 0.6, 2});
  BuildingMesh mesh = mesh_of(cupboard);
  turn_inside_out(mesh);
  EXPECT_NEAR(mesh_parts(mesh)[0].volume_m3, 2.4, 1e-4);

  test::DrawnBuilding room;
  room.box({0, 0, 0}, {4, 5, 2.6});
  mesh = mesh_of(room);
  turn_inside_out(mesh);
  EXPECT_NEAR(mesh_parts(mesh)[0].volume_m3, -52.0, 1e-3);
  EXPECT_FALSE(is_solid(mesh_parts(mesh)[0]));
}

TEST(MeshParts, MixedWindingIsMadeOne) {
  test::DrawnBuilding building;
  building.box({0, 0, 0}, {1, 2, 1});
  BuildingMesh mesh = mesh_of(building);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].volume_m3, 2.0, 1e-4);
}

TEST(MeshParts, AnOpenSheetIsNotSolid) {
  test::DrawnBuilding building;
  building.face({{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}});
  const BuildingMesh mesh = mesh_of(building);
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_FALSE(parts[0].closed);
  EXPECT_FALSE(is_solid(parts[0]));
}

}  // namespace
}  // namespace vantage
