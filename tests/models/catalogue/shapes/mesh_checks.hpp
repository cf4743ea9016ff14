/// What every generated mesh must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "vantage/models/catalogue/shapes/mesh.hpp"

namespace vantage::support {

inline void expect_valid(const TriangleMesh& mesh) {
  const auto count = static_cast<int>(mesh.positions_m.size());
  ASSERT_EQ(mesh.normals.size(), mesh.positions_m.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions_m.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      ASSERT_GE(corner, 0);
      ASSERT_LT(corner, count);
    }
  }
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    ASSERT_TRUE(mesh.positions_m[i].allFinite()) << "vertex " << i;
    ASSERT_TRUE(mesh.uvs[i].allFinite()) << "vertex " << i;
    ASSERT_NEAR(mesh.normals[i].norm(), 1.0, 1e-9) << "vertex " << i;
  }
}

inline Eigen::Vector3d face_normal(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  const auto& p = mesh.positions_m;
  const Eigen::Vector3d& a = p[static_cast<std::size_t>(triangle[0])];
  return (p[static_cast<std::size_t>(triangle[1])] - a)
      .cross(p[static_cast<std::size_t>(triangle[2])] - a);
}

/// Share of the surface whose vertex normals point away from the side the triangles face.
inline double share_shaded_inside_out(const TriangleMesh& mesh) {
  double wrong = 0.0;
  double total = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d face = face_normal(mesh, triangle);
    total += face.norm();
    for (const int corner : triangle) {
      if (face.dot(mesh.normals[static_cast<std::size_t>(corner)]) < 0.0)
        wrong += face.norm() / 3.0;
    }
  }
  return wrong / total;
}

}  // namespace vantage::support
