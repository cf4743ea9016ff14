#include "vantage/sim/sensors/embree_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr double kNoHit_m = std::numeric_limits<double>::infinity();

/// A sheet of 8 x 8 squares, each of two triangles, that is level in one half and waved in the
/// other: a ray through an edge meets two triangles at distances that differ by rounding alone.
SurfaceMesh sheet() {
  SurfaceMesh mesh;
  const auto at = [](int x, int y) { return 9 * y + x; };
  for (int y = 0; y <= 8; ++y) {
    for (int x = 0; x <= 8; ++x) {
      mesh.vertices_m.emplace_back(0.13 * x, 0.11 * y, x < 4 ? 0.3 : 0.3 + 0.05 * std::sin(x + y));
    }
  }
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

class EmbreeMeshTest : public testing::Test {
 protected:
  EmbreeDevice device_{rtcNewDevice("threads=1")};
  SurfaceMesh sheet_ = sheet();
  EmbreeMesh mesh_{device_.get(), sheet_};
};

/// From above the sheet to a place on an edge of one of its triangles, each tenth to a corner.
struct Glance {
  Eigen::Vector3d eye_m;
  Eigen::Vector3d d;
};

Glance glance(const SurfaceMesh& mesh, int i, Rng& rng) {
  const auto& triangle = mesh.triangles[rng.uniform_index(mesh.triangles.size())];
  const Eigen::Vector3d& from = mesh.vertices_m[static_cast<std::size_t>(triangle[2])];
  const Eigen::Vector3d& to = mesh.vertices_m[static_cast<std::size_t>(triangle[0])];
  const double share = i % 10 == 0 ? 0.0 : rng.uniform(0.0, 1.0);
  const Eigen::Vector3d eye(rng.uniform(-1.0, 2.0), rng.uniform(-1.0, 2.0), rng.uniform(0.5, 2.0));
  return {eye, (from + share * (to - from) - eye).normalized()};
}

/// As when every triangle is asked on its own.
TEST_F(EmbreeMeshTest, OfTwoTrianglesBesideAnEdgeTheNearerWhicheverEmbreeFindsFirst) {
  std::vector<std::unique_ptr<EmbreeMesh>> alone;
  for (const auto& triangle : sheet_.triangles) {
    alone.push_back(
        std::make_unique<EmbreeMesh>(device_.get(), SurfaceMesh{sheet_.vertices_m, {triangle}}));
  }
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const auto [eye, d] = glance(sheet_, i, rng);
    double nearest_m = kNoHit_m;
    for (const auto& one : alone) nearest_m = std::min(nearest_m, one->cast(eye, d, 9.0));
    ASSERT_EQ(mesh_.cast(eye, d, 9.0), nearest_m) << i;
  }
}

TEST_F(EmbreeMeshTest, TheSameBitsByEmbreesCodeForOldProcessors) {
  const EmbreeDevice old(rtcNewDevice("threads=1,isa=sse2"));
  ASSERT_TRUE(old);
  const EmbreeMesh by_old(old.get(), sheet_);
  Rng rng(5);
  for (int i = 0; i < 5000; ++i) {
    const auto [eye, d] = glance(sheet_, i, rng);
    ASSERT_EQ(mesh_.cast(eye, d, 9.0), by_old.cast(eye, d, 9.0)) << i;
  }
}

/// In the level part, which the other does not hide from above it.
TEST_F(EmbreeMeshTest, NoRayPassesBetweenTwoTriangles) {
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d on_edge(0.13 * static_cast<double>(1 + rng.uniform_index(2)),
                                  rng.uniform(0.05, 0.8), 0.3);
    const Eigen::Vector3d eye(rng.uniform(-1.0, 0.5), rng.uniform(-1.0, 2.0),
                              rng.uniform(0.5, 2.0));
    const Eigen::Vector3d d = (on_edge - eye).normalized();
    ASSERT_NEAR(mesh_.cast(eye, d, 9.0), (on_edge - eye).norm(), 1e-12) << i;
    ASSERT_LT(mesh_.cast(eye, d, 9.0, Wanted::any), 9.0) << i;
  }
}

TEST_F(EmbreeMeshTest, ARayInTheSheetOrAwayFromItMeetsNothing) {
  EXPECT_EQ(mesh_.cast({-1.0, 0.4, 0.3}, Eigen::Vector3d(1.0, 0.0, 0.1).normalized(), 9.0),
            kNoHit_m);
  EXPECT_EQ(mesh_.cast({0.2, 0.4, 0.5}, Eigen::Vector3d::UnitZ(), 9.0), kNoHit_m);
  EXPECT_EQ(mesh_.cast({0.2, 0.4, 0.5}, -Eigen::Vector3d::UnitZ(), 0.1999), kNoHit_m);
  EXPECT_NEAR(mesh_.cast({0.2, 0.4, 0.5}, -Eigen::Vector3d::UnitZ(), 0.2001), 0.2, 1e-15);
  const SurfaceMesh thin{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  const EmbreeMesh line(device_.get(), thin);
  EXPECT_EQ(line.cast({0.5, 0.0, 1.0}, -Eigen::Vector3d::UnitZ(), 9.0), kNoHit_m)
      << "a triangle without an area is none";
}

}  // namespace
}  // namespace vantage
