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

SurfaceMesh surface_of(const std::string& geom, double max_edge_m) {
  const auto scene =
      test::compile_mjcf("<mujoco><worldbody><geom " + geom + "/></worldbody></mujoco>");
  return geom_triangles(*scene.model, 0, max_edge_m);
}

TEST(MeshSurface, RoundThingsHaveAsManySegmentsAsTheirEdgesNeed) {
  const SurfaceMesh cylinder = surface_of("type='cylinder' size='.5 .4'", 0.05);
  EXPECT_EQ(cylinder.vertices_m.size(), 4U * 63U);
  EXPECT_EQ(cylinder.triangles.size(), 3U * 63U * 2U);
  EXPECT_EQ(surface_of("type='cylinder' size='.01 .4'", 0.1).vertices_m.size(), 4U * 16U);
  EXPECT_EQ(surface_of("type='cylinder' size='100 .4'", 0.1).vertices_m.size(), 4U * 512U);
  const SurfaceMesh ball = surface_of("type='sphere' size='.25'", 0.1);
  EXPECT_EQ(ball.vertices_m.size(), 10U * 16U);
  EXPECT_EQ(ball.triangles.size(), 9U * 16U * 2U);
  EXPECT_EQ(surface_of("type='sphere' size='.5'", 0.1).vertices_m.size(), 18U * 32U);
  EXPECT_EQ(surface_of("type='capsule' size='.5 .3'", 0.1).vertices_m.size(), 18U * 32U);
  EXPECT_EQ(surface_of("type='ellipsoid' size='.1 .5 .2'", 0.1).vertices_m.size(), 18U * 32U);
}

TEST(MeshSurface, VerticesOfRoundThingsLieOnThem) {
  for (const Eigen::Vector3d& p : surface_of("type='capsule' size='.2 .3'", 0.1).vertices_m) {
    const Eigen::Vector3d middle(0.0, 0.0, std::clamp(p.z(), -0.3, 0.3));
    EXPECT_NEAR((p - middle).norm(), 0.2, 1e-9);
  }
  for (const Eigen::Vector3d& p : surface_of("type='ellipsoid' size='.1 .5 .2'", 0.1).vertices_m) {
    EXPECT_NEAR(p.cwiseQuotient(Eigen::Vector3d(0.1, 0.5, 0.2)).norm(), 1.0, 1e-9);
  }
}

TEST(MeshSurface, AHeightFieldIsClosedBelow) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><hfield name='h' nrow='3' ncol='4' size='.6 .4 .5 .1'/></asset>"
      "<worldbody><geom type='hfield' hfield='h'/></worldbody></mujoco>");
  std::fill_n(scene.model->hfield_data, 12, 0.5F);
  const SurfaceMesh flat = geom_triangles(*scene.model, 0, 1.0);
  EXPECT_EQ(flat.vertices_m.size(), 24U);
  EXPECT_EQ(flat.triangles.size(), 34U);
  EXPECT_NEAR(area(flat), 2.0 * (1.2 * 0.8) + 2.0 * (1.2 + 0.8) * 0.35, 1e-9);

  for (int i = 0; i < 12; ++i) scene.model->hfield_data[i] = 0.0625F * static_cast<float>(i);
  const SurfaceMesh slope = geom_triangles(*scene.model, 0, 1.0);
  const auto vertex = [&](std::size_t i) { return slope.vertices_m[i]; };
  EXPECT_LT((vertex(3) - Eigen::Vector3d(0.6, -0.4, 0.09375)).norm(), 1e-12);
  EXPECT_LT((vertex(6) - Eigen::Vector3d(0.2, 0.0, 0.1875)).norm(), 1e-12);
  EXPECT_LT((vertex(8) - Eigen::Vector3d(-0.6, 0.4, 0.25)).norm(), 1e-12);
  EXPECT_LT((vertex(12 + 6) - Eigen::Vector3d(0.2, 0.0, -0.1)).norm(), 1e-12);
}

TEST(MeshSurface, EveryAssetHasItsOwnSurface) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset>"
      "<mesh name='small' vertex='0 0 0 .2 0 0 0 .2 0 0 0 .2' face='0 2 1 0 1 3 0 3 2 1 2 3'/>"
      "<mesh name='large' vertex='0 0 0 .4 0 0 0 .4 0 0 0 .4' face='0 2 1 0 1 3 0 3 2 1 2 3'/>"
      "<hfield name='low' nrow='3' ncol='4' size='.6 .4 .5 .1'/>"
      "<hfield name='high' nrow='2' ncol='3' size='.2 .3 .4 .05'/></asset><worldbody>"
      "<geom type='mesh' mesh='small'/><geom type='mesh' mesh='large'/>"
      "<geom type='hfield' hfield='low'/><geom type='hfield' hfield='high'/></worldbody></mujoco>");
  std::fill_n(scene.model->hfield_data, 12, 0.125F);
  std::fill_n(scene.model->hfield_data + 12, 6, 0.5F);
  const SurfaceMesh small = geom_triangles(*scene.model, 0, 1.0);
  const SurfaceMesh large = geom_triangles(*scene.model, 1, 1.0);
  EXPECT_EQ(large.vertices_m.size(), 4U);
  EXPECT_EQ(large.triangles.size(), 4U);
  EXPECT_NEAR(area(small), 0.06 + 0.02 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(area(large), 4.0 * area(small), 1e-6);
  const SurfaceMesh high = geom_triangles(*scene.model, 3, 1.0);
  ASSERT_EQ(high.vertices_m.size(), 12U);
  EXPECT_LT((high.vertices_m[0] - Eigen::Vector3d(-0.2, -0.3, 0.2)).norm(), 1e-12);
  EXPECT_LT((high.vertices_m[11] - Eigen::Vector3d(0.2, 0.3, -0.05)).norm(), 1e-12);
}

TEST(MeshSurface, ABoxHasEightCorners) {
  EXPECT_EQ(surface_of("type='box' size='.1 .2 .3'", 1.0).vertices_m.size(), 8U);
}

TEST(MeshSurface, WhatIsThereForItsLooksAloneIsNotSolid) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom size='.1' group='4'/><geom size='.1' group='5'/></worldbody>"
      "</mujoco>");
  EXPECT_EQ(solid_geoms(*scene.model), std::vector<int>{0});
}

TEST(MeshSurface, AnInvisibleMaterialMayBeTheFirst) {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset><material name='air' rgba='1 1 1 0'/></asset><worldbody>"
      "<geom size='.1' material='air'/><geom size='.1'/></worldbody></mujoco>");
  EXPECT_EQ(solid_geoms(*scene.model), std::vector<int>{1});
}

}  // namespace
}  // namespace vantage
