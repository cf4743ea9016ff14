#include "vantage/models/catalogue/shapes/mesh_builders.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/models/catalogue/shapes/mesh_checks.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;
using support::expect_valid;
using support::share_shaded_inside_out;

void expect_closed(const TriangleMesh& mesh, double volume_m3, double relative_error) {
  expect_valid(mesh);
  EXPECT_TRUE(is_watertight(mesh));
  EXPECT_NEAR(signed_volume_m3(mesh), volume_m3, relative_error * volume_m3);
  EXPECT_LT(share_shaded_inside_out(mesh), 1e-3);
}

TEST(MeshBuilders, LatheTurnsACylinderWithAHole) {
  //        z
  //  0.1 --+---+      the profile right of the axis: out along the base, up, in along the
  //        |   |      top to r = 0.02, down the inner wall to a floor at 0.03
  //  0.0 --+---+ r
  TriangleMesh mesh;
  const Vector2d base(0.05, 0.0);
  const Vector2d rim(0.05, 0.1);
  const Vector2d inner_rim(0.02, 0.1);
  const Vector2d floor(0.02, 0.03);
  const Vector2d below(0.0, 0.0);
  const Vector2d centre(0.0, 0.03);
  const std::array<std::array<Vector2d, 2>, 5> strips{
      {{below, base}, {base, rim}, {rim, inner_rim}, {inner_rim, floor}, {floor, centre}}};
  for (const auto& strip : strips) add_lathe(mesh, strip, 96, {});
  expect_closed(mesh, pi * (0.05 * 0.05 * 0.1 - 0.02 * 0.02 * 0.07), 2e-3);
}

TEST(MeshBuilders, LatheMapsTextureCounterClockwiseAndUp) {
  TriangleMesh mesh;
  add_lathe(mesh, std::array<Vector2d, 2>{Vector2d(1, 0), Vector2d(1, 2)}, 4, {0.0, 0.5, 1.0, 1.0});
  EXPECT_TRUE(mesh.uvs[1].isApprox(Vector2d(0.25, 0.5)));
  EXPECT_TRUE(mesh.positions_m[1].isApprox(Vector3d(0, 1, 0)));
  EXPECT_TRUE(mesh.uvs.back().isApprox(Vector2d(1.0, 1.0)));
  EXPECT_EQ(mesh.positions_m[0], mesh.positions_m[4]);  // the seam closes bit for bit
}

TEST(MeshBuilders, StraightTubeIsAnEllipticCylinder) {
  const std::array<Vector3d, 3> path{Vector3d(0, 0, 0), Vector3d(0, 0, 0.1), Vector3d(0, 0, 0.3)};
  const std::array<Vector2d, 3> radii{Vector2d(0.02, 0.01), Vector2d(0.02, 0.01),
                                      Vector2d(0.02, 0.01)};
  const TriangleMesh tube = make_tube(path, radii, Vector3d::UnitX(), 128, {});
  expect_closed(tube, pi * 0.02 * 0.01 * 0.3, 2e-3);
  EXPECT_NEAR(bounds(tube).sizes().x(), 0.04, 1e-12);
  EXPECT_NEAR(bounds(tube).sizes().y(), 0.02, 1e-12);
}

TEST(MeshBuilders, BentTubeFollowsPappus) {
  std::vector<Vector3d> path;
  for (int i = 0; i <= 60; ++i)
    path.emplace_back(0.1 * std::cos(pi * i / 60), 0.1 * std::sin(pi * i / 60), 0);
  const std::vector<Vector2d> radii(path.size(), Vector2d::Constant(0.01));
  expect_closed(make_tube(path, radii, Vector3d::UnitZ(), 64, {}), pi * 0.01 * 0.01 * pi * 0.1,
                5e-3);
}

RC_GTEST_PROP(MeshBuilders, RoundedBoxIsTheMinkowskiSumOfBoxAndBall, ()) {
  const auto millimetres = [](int low, int high) { return 1e-3 * *rc::gen::inRange(low, high); };
  const Vector3d size(millimetres(40, 200), millimetres(40, 200), millimetres(40, 200));
  const double r = millimetres(2, 18);
  const TriangleMesh box = make_rounded_box(size, r, 6, unfold_box(size));
  expect_valid(box);
  RC_ASSERT(is_watertight(box));
  const Vector3d core = size.array() - 2.0 * r;
  const double faces = 2.0 * r * (core.x() * core.y() + core.y() * core.z() + core.z() * core.x());
  const double edges = pi * r * r * core.sum();
  const double expected = core.prod() + faces + edges + 4.0 / 3.0 * pi * r * r * r;
  RC_ASSERT(std::abs(signed_volume_m3(box) / expected - 1.0) < 5e-3);
  RC_ASSERT(bounds(box).sizes().isApprox(size, 1e-9));
  RC_ASSERT(share_shaded_inside_out(box) < 1e-9);
}

TEST(MeshBuilders, UnfoldedFacesKeepApart) {
  const BoxUv uv = unfold_box({0.15, 0.05, 0.25});
  for (std::size_t a = 0; a < uv.size(); ++a) {
    EXPECT_LT(uv[a].u0, uv[a].u1);
    EXPECT_LT(uv[a].v0, uv[a].v1);
    EXPECT_GE(std::min(uv[a].u0, uv[a].v0), 0.0);
    EXPECT_LE(std::max(uv[a].u1, uv[a].v1), 1.0);
    for (std::size_t b = 0; b < a; ++b) {
      const bool apart = uv[a].u1 <= uv[b].u0 || uv[b].u1 <= uv[a].u0 || uv[a].v1 <= uv[b].v0 ||
                         uv[b].v1 <= uv[a].v0;
      EXPECT_TRUE(apart) << a << " and " << b;
    }
  }
}

TEST(MeshBuilders, FrontOfABoxReadsFromLeftToRight) {
  //   seen from -y:  u grows with +x, v with +z
  const Vector3d size(0.2, 0.1, 0.3);
  const BoxUv uv = unfold_box(size);
  const TriangleMesh box = make_rounded_box(size, 0.01, 1, uv);
  for (std::size_t i = 0; i < box.uvs.size(); ++i) {
    if (!box.normals[i].isApprox(-Vector3d::UnitY(), 1e-9)) continue;
    const Vector2d expected =
        uv[3].at(0.5 + box.positions_m[i].x() / size.x(), 0.5 + box.positions_m[i].z() / size.z());
    EXPECT_TRUE(box.uvs[i].isApprox(expected, 1e-9));
  }
}

TEST(MeshBuilders, SuperellipsoidRunsFromBallToBox) {
  const Vector3d radii(0.05, 0.04, 0.03);
  const double ball = 4.0 / 3.0 * pi * radii.prod();
  expect_closed(make_superellipsoid(radii, 1.0, 1.0, 64, 48, {}), ball, 5e-3);
  const TriangleMesh boxy = make_superellipsoid(radii, 0.2, 0.2, 64, 48, {});
  expect_valid(boxy);
  EXPECT_TRUE(is_watertight(boxy));
  EXPECT_GT(signed_volume_m3(boxy), 1.6 * ball);
  EXPECT_LT(signed_volume_m3(boxy), 8.0 * radii.prod());
}

TEST(MeshBuilders, ExtrudesAConcaveOutline) {
  //  +--+        an L of area 3 cm x 1 cm + 1 cm x 2 cm = 5 cm^2
  //  |  |
  //  |  +-----+
  //  +--------+
  const std::array<Vector2d, 6> ell{Vector2d(0, 0),       Vector2d(0.03, 0),
                                    Vector2d(0.03, 0.01), Vector2d(0.01, 0.01),
                                    Vector2d(0.01, 0.03), Vector2d(0, 0.03)};
  expect_closed(make_extrusion(ell, 0.02, 0.0, {}), 5e-4 * 0.02, 1e-9);
  const TriangleMesh bevelled = make_extrusion(ell, 0.02, 0.002, {});
  expect_valid(bevelled);
  EXPECT_TRUE(is_watertight(bevelled));
  EXPECT_LT(signed_volume_m3(bevelled), 5e-4 * 0.02);
  EXPECT_GT(signed_volume_m3(bevelled), 0.95 * 5e-4 * 0.02);
}

TEST(MeshBuilders, SmoothCurvePassesItsControlPoints) {
  const std::array<Vector2d, 4> control{Vector2d(0, 0), Vector2d(1, 0), Vector2d(2, 1),
                                        Vector2d(3, 3)};
  const auto curve = smooth_curve<Vector2d>(control, 5);
  ASSERT_EQ(curve.size(), 16U);
  for (std::size_t i = 0; i < control.size(); ++i)
    EXPECT_TRUE(curve[5 * i].isApprox(control[i], 1e-12));
}

}  // namespace
}  // namespace vantage
