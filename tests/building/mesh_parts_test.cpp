// What a mesh falls into: solids, sheets and rooms, wound as they come.
#include "vantage/building/mesh_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// Of a box inside out, 0 if it is none.
double inside_out_m3(double x_m, double y_m, double z_m) {
  test::DrawnBuilding building;
  building.box({0, 0, 0}, {x_m, y_m, z_m});
  BuildingMesh mesh = mesh_of(building);
  turn_inside_out(mesh);
  const auto parts = mesh_parts(mesh);
  return parts.size() == 1 ? parts[0].volume_m3 : 0.0;
}

TEST(MeshParts, ARoomIsOneAndAHalfMetresWideAndThick) {
  EXPECT_NEAR(inside_out_m3(1.49, 4.0, 5.0), 29.8, 1e-3);
  EXPECT_NEAR(inside_out_m3(1.51, 4.0, 5.0), -30.2, 1e-3);
  EXPECT_NEAR(inside_out_m3(1.6, 1.6, 2.3), 5.888, 1e-3) << "0.594 m of volume for its area";
  EXPECT_NEAR(inside_out_m3(1.6, 1.6, 2.5), -6.4, 1e-3) << "0.606 m";
}

MeshPart solid_of(std::vector<Triangle> triangles) {
  MeshPart part;
  part.triangles = std::move(triangles);
  part.closed = true;
  part.volume_m3 = 1.0;
  return part;
}

TEST(MeshParts, AreSolidIfClosedRoundSomething) {
  MeshPart part = solid_of({});
  EXPECT_TRUE(is_solid(part));
  part.volume_m3 = 0.0;
  EXPECT_FALSE(is_solid(part));
  part.volume_m3 = 1.0;
  part.closed = false;
  EXPECT_FALSE(is_solid(part));
}

/// A level face, and another that stands out of it.
TEST(MeshParts, AreConvexWithinAMillimetre) {
  for (const double out_m : {0.0009, 0.0011}) {
    BuildingMesh mesh;
    mesh.vertices_m = {{0, 0, 0},         {1, 0, 0},         {0, 1, 0},
                       {0.2, 0.2, out_m}, {0.4, 0.2, out_m}, {0.2, 0.4, out_m}};
    EXPECT_EQ(is_convex(mesh, solid_of({{0, 1, 2}, {3, 4, 5}})), out_m < 0.001) << out_m;
  }
}

TEST(MeshParts, OfManyTrianglesAreNotTakenForConvex) {
  BuildingMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(is_convex(mesh, solid_of(std::vector<Triangle>(512, {0, 1, 2}))));
  EXPECT_FALSE(is_convex(mesh, solid_of(std::vector<Triangle>(513, {0, 1, 2}))));
}

/// Faces across x and y, and one across z but for a tilt.
TEST(MeshParts, AreBoxesOfSquareFaces) {
  for (const double tilt_rad : {0.0, 0.0009, 0.0011}) {
    BuildingMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1},
                       {0, 0, 2}, {3, 0, 0}, {0, std::cos(tilt_rad), -std::sin(tilt_rad)}};
    OrientedBox box;
    EXPECT_FALSE(is_box(mesh, solid_of({{0, 1, 2}, {0, 3, 4}}), box)) << "two directions";
    ASSERT_EQ(is_box(mesh, solid_of({{0, 1, 2}, {0, 3, 4}, {0, 4, 5}}), box), tilt_rad < 0.001)
        << tilt_rad;
    if (tilt_rad > 0.0) continue;
    EXPECT_LT((box.half_m - Eigen::Vector3d(1.5, 0.5, 1.0)).norm(), 1e-12);
    EXPECT_LT((box.T_mesh_box.translation() - Eigen::Vector3d(1.5, 0.5, 1.0)).norm(), 1e-12);
    EXPECT_TRUE(box.T_mesh_box.linear().isIdentity(1e-12));
  }
}

TEST(MeshParts, BoxesThatLeanALittleHaveSquareAxesAllTheSame) {
  const double lean_rad = 0.0009;
  const Eigen::Vector3d across(-std::sin(lean_rad), std::cos(lean_rad), 0.0);
  BuildingMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, across, {0, 0, 1}, {0, 0, 2}, {3, 0, 0}, {0, 1, 0}};
  OrientedBox box;
  ASSERT_TRUE(is_box(mesh, solid_of({{0, 1, 2}, {0, 3, 4}, {0, 4, 5}}), box));
  const Eigen::Matrix3d R = box.T_mesh_box.linear();
  EXPECT_TRUE((R.transpose() * R).isIdentity(1e-12));
  const Eigen::Vector3d first(std::cos(lean_rad), std::sin(lean_rad), 0.0);
  EXPECT_LT((R.col(0) - first).norm(), 1e-12);
}

/// Two roofs over one ridge, each of two faces that hang together there alone.
TEST(MeshParts, HangTogetherByAnEdgeThatOthersHaveToo) {
  BuildingMesh mesh;
  mesh.vertices_m = {{0, 0, 2},  {3, 0, 2}, {0, -1, 1}, {3, -1, 1},
                     {0, -2, 1}, {0, 1, 1}, {0, 2, 1},  {3, 2, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 4}, {1, 0, 5}, {1, 0, 6}};
  mesh.objects = {0, 1, 0, 1};
  mesh.colours.assign(4, Eigen::Vector3f::Zero());
  EXPECT_EQ(mesh_parts(mesh).size(), 2U);
  mesh.triangles.pop_back();
  mesh.objects.pop_back();
  mesh.colours.pop_back();
  EXPECT_EQ(mesh_parts(mesh).size(), 2U) << "and one of a face alone";
}

TEST(MeshParts, ThatAreTurnedFaceOutwards) {
  test::DrawnBuilding cupboard;
  cupboard.box({0, 0, 0}, {2, 0.6, 2});
  BuildingMesh mesh = mesh_of(cupboard);
  turn_inside_out(mesh);
  const auto parts = mesh_parts(mesh);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_TRUE(is_convex(mesh, parts[0]));
  OrientedBox box;
  EXPECT_TRUE(is_box(mesh, parts[0], box));
}

/// None of whose axes is near one of the mesh's; two are nearest to the same one.
TEST(MeshParts, AreBoxesHoweverTheyLean) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
  const Eigen::Vector3d u = turn * Eigen::Vector3d(2, 2, 1) / 3.0;
  const Eigen::Vector3d v = turn * Eigen::Vector3d(1, -2, 2) / 3.0;
  const Eigen::Vector3d w = turn * Eigen::Vector3d(2, -1, -2) / 3.0;
  BuildingMesh mesh;
  mesh.vertices_m = {Eigen::Vector3d::Zero(), 3.0 * u, v, 2.0 * w};
  OrientedBox box;
  ASSERT_TRUE(is_box(mesh, solid_of({{0, 2, 3}, {0, 3, 1}, {0, 1, 2}}), box));
  EXPECT_NEAR(box.half_m.prod(), 1.5 * 0.5 * 1.0, 1e-12);
  EXPECT_LT((box.T_mesh_box.translation() - (1.5 * u + 0.5 * v + w)).norm(), 1e-12);
  const Eigen::Matrix3d R = box.T_mesh_box.linear();
  EXPECT_TRUE((R.transpose() * R).isIdentity(1e-12));
}

TEST(MeshParts, ThatAreOpenHaveNoVolume) {
  test::DrawnBuilding building;
  building.face({{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}});
  EXPECT_EQ(mesh_parts(mesh_of(building)).at(0).volume_m3, 0.0);
}

}  // namespace
}  // namespace vantage
