#include "vantage/models/catalogue/shapes/mesh.hpp"

#include <gtest/gtest.h>

#include "tests/models/catalogue/shapes/mesh_checks.hpp"

namespace vantage {
namespace {

/// The corner of a cube cut off: volume 1/6 of it.
TriangleMesh tetrahedron(double edge_m) {
  TriangleMesh mesh;
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(edge_m, 0, 0),
                                   Eigen::Vector3d(0, edge_m, 0), Eigen::Vector3d(0, 0, edge_m)}) {
    mesh.add_vertex(p, Eigen::Vector3d::UnitZ(), {0, 0});
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TEST(Mesh, TetrahedronHasItsVolumeAndIsClosed) {
  const TriangleMesh mesh = tetrahedron(0.3);
  EXPECT_NEAR(signed_volume_m3(mesh), 0.3 * 0.3 * 0.3 / 6.0, 1e-15);
  EXPECT_TRUE(is_watertight(mesh));
}

TEST(Mesh, MissingTriangleOpensIt) {
  TriangleMesh mesh = tetrahedron(0.3);
  mesh.triangles.pop_back();
  EXPECT_FALSE(is_watertight(mesh));
}

TEST(Mesh, FlippedTriangleIsNoticed) {
  TriangleMesh mesh = tetrahedron(0.3);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_FALSE(is_watertight(mesh));
}

TEST(Mesh, InsideOutHasNegativeVolume) {
  TriangleMesh mesh = tetrahedron(0.3);
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_TRUE(is_watertight(mesh));
  EXPECT_LT(signed_volume_m3(mesh), 0.0);
}

TEST(Mesh, AppendMovesThePart) {
  TriangleMesh mesh = tetrahedron(0.1);
  append(mesh, tetrahedron(0.1), make_pose({1.0, 0.0, 0.0}, 0.5));
  EXPECT_EQ(mesh.triangles.size(), 8U);
  EXPECT_TRUE(is_watertight(mesh));
  EXPECT_NEAR(signed_volume_m3(mesh), 2.0 * 1e-3 / 6.0, 1e-12);
  EXPECT_NEAR(bounds(mesh).max().x(), 1.0 + 0.1 * std::cos(0.5), 1e-12);
}

TEST(Mesh, ScalingKeepsNormalsPerpendicular) {
  TriangleMesh mesh;
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 1, 0).normalized();
  mesh.add_vertex({1, 0, 0}, normal, {0, 0});
  mesh.add_vertex({0, 1, 0}, normal, {0, 0});
  scale(mesh, {2.0, 1.0, 1.0});
  EXPECT_NEAR(mesh.normals[0].dot(mesh.positions_m[1] - mesh.positions_m[0]), 0.0, 1e-12);
  EXPECT_NEAR(mesh.normals[0].norm(), 1.0, 1e-12);
}

TEST(Mesh, WeldsWhatLiesAtOnePoint) {
  TriangleMesh mesh;
  mesh.add_vertex({0.1, 0, 0}, Eigen::Vector3d::UnitX(), {0, 0});
  mesh.add_vertex({0.2, 0, 0}, Eigen::Vector3d::UnitX(), {0, 0});
  mesh.add_vertex({0.1 + 1e-9, 0, 0}, Eigen::Vector3d::UnitZ(), {1, 0});
  EXPECT_EQ(weld(mesh), (std::vector<int>{0, 1, 0}));
}

}  // namespace
}  // namespace vantage
