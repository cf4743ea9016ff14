#include "vantage/sim/world/mesh_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/sim/sensors/sensor_scene.hpp"

namespace vantage {
namespace {

double area(const SurfaceMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto p = [&](int i) { return mesh.vertices_m[static_cast<std::size_t>(i)]; };
    sum += 0.5 * (p(b) - p(a)).cross(p(c) - p(a)).norm();
  }
  return sum;
}

/// A surface without holes: every edge belongs to an even number of triangles.
bool is_closed(const SurfaceMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[std::minmax(triangle[i], triangle[(i + 1) % 3])];
    }
  }
  // The rings at the poles have no area: they may be open.
  for (const auto& [edge, uses] : edges) {
    const auto length = (mesh.vertices_m[static_cast<std::size_t>(edge.first)] -
                         mesh.vertices_m[static_cast<std::size_t>(edge.second)])
                            .norm();
    if (uses % 2 != 0 && length > 1e-12) return false;
  }
  return true;
}

TEST(MeshSurface, PrimitivesHaveTheirArea) {
  const auto scene = test::sensor_scene();
  const auto area_of = [&](const char* name) {
    return area(geom_triangles(*scene.model, scene.geom(name), 0.005));
  };
  EXPECT_NEAR(area_of("box"), 8.0 * (0.2 * 0.3 + 0.3 * 0.25 + 0.25 * 0.2), 1e-12);
  EXPECT_NEAR(area_of("sphere"), 4.0 * M_PI * 0.25 * 0.25, 1e-3);
  EXPECT_NEAR(area_of("capsule"), 4.0 * M_PI * 0.01 + 2.0 * M_PI * 0.1 * 0.6, 1e-3);
  EXPECT_NEAR(area_of("cylinder"), 2.0 * M_PI * 0.04 + 2.0 * M_PI * 0.2 * 0.5, 1e-3);
  const auto power = [](double a, double b) { return std::pow(a * b, 1.6075); };
  const double thomsen =
      4.0 * M_PI *
      std::pow((power(0.3, 0.15) + power(0.15, 0.2) + power(0.3, 0.2)) / 3.0, 1.0 / 1.6075);
  EXPECT_NEAR(area_of("ellipsoid"), thomsen, 0.01 * thomsen);  // itself good to 1 %
}

TEST(MeshSurface, SolidsAreClosedAndInsideTheirExtent) {
  const auto scene = test::sensor_scene();
  for (const char* name : {"box", "sphere", "capsule", "cylinder", "ellipsoid", "mesh"}) {
    EXPECT_TRUE(is_closed(geom_triangles(*scene.model, scene.geom(name), 0.02))) << name;
  }
  for (const char* name : {"box", "sphere", "capsule", "cylinder", "ellipsoid"}) {
    const Eigen::Vector3d half = primitive_half_extent(*scene.model, scene.geom(name));
    Eigen::Vector3d reached = Eigen::Vector3d::Zero();
    for (const auto& p : geom_triangles(*scene.model, scene.geom(name), 0.02).vertices_m) {
      reached = reached.cwiseMax(p.cwiseAbs());
    }
    EXPECT_TRUE((reached.array() <= half.array() + 1e-12).all()) << name;
    EXPECT_TRUE((reached.array() >= 0.99 * half.array()).all()) << name;
  }
}

TEST(MeshSurface, InvisibleGeomsAreNotSolid) {
  const auto scene = test::sensor_scene();
  const auto solid = solid_geoms(*scene.model);
  EXPECT_EQ(solid.size(), static_cast<std::size_t>(scene.model->ngeom) - 2);
  for (const char* name : {"unseen", "unseen_material"}) {
    EXPECT_EQ(std::ranges::count(solid, scene.geom(name)), 0) << name;
  }
}

TEST(MeshSurface, OnlyBodiesWithJointsMove) {
  const auto scene = test::sensor_scene();
  for (const char* name : {"floor", "mesh", "lamp"}) {
    EXPECT_FALSE(is_moving_geom(*scene.model, scene.geom(name))) << name;
  }
  for (const char* name : {"shell", "arm_mesh"}) {
    EXPECT_TRUE(is_moving_geom(*scene.model, scene.geom(name))) << name;
  }
}

}  // namespace
}  // namespace vantage
