#include "vantage/sim/sensors/embree_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST_F(EmbreeMeshTest, ARayThatBeginsOnTheSheetMeetsItThere) {
  EXPECT_EQ(mesh_.cast({0.2, 0.4, 0.3}, -Eigen::Vector3d::UnitZ(), 9.0), 0.0);
}

TEST_F(EmbreeMeshTest, AnEdgeBelongsToItsTriangleWhicheverWayThatTurns) {
  const std::vector<Eigen::Vector3d> corners_m{{0, -1, 0}, {0, 1, 0}, {1, 0, 0}};
  for (const std::array<int, 3>& triangle : {std::array{0, 1, 2}, std::array{0, 2, 1}}) {
    const EmbreeMesh one(device_.get(), SurfaceMesh{corners_m, {triangle}});
    EXPECT_EQ(one.cast({0.0, 0.25, 1.0}, -Eigen::Vector3d::UnitZ(), 9.0), 1.0);
  }
}

/// 2 mm from the rim, where numbers of Embree's are off by more so far away.
TEST_F(EmbreeMeshTest, ARayFromAHundredKilometresAwayMeetsTheRim) {
  Rng rng(6);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(0.002, rng.uniform(0.05, 0.8), 0.3);
    const Eigen::Vector3d d(rng.uniform(0.2, 1.0), rng.uniform(-1.0, 1.0), -1.0);
    const Eigen::Vector3d along = d.normalized();
    ASSERT_NEAR(mesh_.cast(p - 1e5 * along, along, 2e5), 1e5, 1e-6) << i;
  }
}

/// A slope whose box the ray is in from the start, but which it meets 2 m on, and a tile before it.
TEST_F(EmbreeMeshTest, WhatIsNotInRangeHidesNothingThatIs) {
  const SurfaceMesh crossed{
      {{-2, -2, -2}, {2, -2, 2}, {0, 4, 0}, {-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0, 0.5, 1}},
      {{0, 1, 2}, {3, 4, 5}}};
  const EmbreeMesh mesh(device_.get(), crossed);
  for (const double range_m : {1.5, 2.0, 2.5}) {
    const Eigen::Vector3d eye(0.0, 0.0, 2.0);
    EXPECT_EQ(mesh.cast(eye, -Eigen::Vector3d::UnitZ(), range_m), 1.0);
    EXPECT_LT(mesh.cast(eye, -Eigen::Vector3d::UnitZ(), range_m, Wanted::any), range_m);
  }
}

TEST(EmbreeRay, LeavesRoomForWhatNumbersLoseAsFloats) {
  EXPECT_FLOAT_EQ(search_limit_m(2.0), 2.00003F);
  const Eigen::AlignedBox3d box_m(Eigen::Vector3d(-3.0, 0.0, 0.5), Eigen::Vector3d(1.0, 2.0, 2.5));
  EXPECT_EQ(reach_m(box_m), 3.0);
  EXPECT_EQ(reach_m({Eigen::Vector3d(-1.0, 0.0, 0.5), box_m.max()}), 2.5);
  const RTCBounds bounds = padded_bounds(box_m, 10.0);
  EXPECT_FLOAT_EQ(bounds.lower_x, -3.00002F);
  EXPECT_FLOAT_EQ(bounds.lower_y, -0.00002F);
  EXPECT_FLOAT_EQ(bounds.lower_z, 0.49998F);
  EXPECT_FLOAT_EQ(bounds.upper_x, 1.00002F);
  EXPECT_FLOAT_EQ(bounds.upper_y, 2.00002F);
  EXPECT_FLOAT_EQ(bounds.upper_z, 2.50002F);
}

TEST(EmbreeRay, BeginsAtItsPlaceAndHasMetNothing) {
  const RTCRayHit sent = embree_ray({1.0, 2.0, 3.0}, {0.0, 0.6, 0.8}, 2.0);
  const RTCRay& ray = sent.ray;
  EXPECT_EQ(Eigen::Vector3f(ray.org_x, ray.org_y, ray.org_z), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(Eigen::Vector3f(ray.dir_x, ray.dir_y, ray.dir_z), Eigen::Vector3f(0.0F, 0.6F, 0.8F));
  EXPECT_EQ(ray.tnear, 0.0F);
  EXPECT_EQ(ray.time, 0.0F);
  EXPECT_EQ(ray.tfar, search_limit_m(2.0));
  EXPECT_EQ(sent.hit.geomID, RTC_INVALID_GEOMETRY_ID);
}

}  // namespace
}  // namespace vantage
