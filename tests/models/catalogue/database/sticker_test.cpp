#include "vantage/models/catalogue/database/sticker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/models/catalogue/shapes/mesh_checks.hpp"
#include "vantage/models/catalogue/shapes/mesh_builders.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

const RgbColour kRed{1, 0, 0};
const RgbColour kGreen{0, 1, 0};

/// Radius 5 cm, 10 cm high, base at z = 0.
GeneratedObject cylinder() {
  GeneratedObject object;
  add_lathe(object.mesh, std::vector<Vector2d>{{0.05, 0.0}, {0.05, 0.1}}, 64, {});
  object.texture = Image(64, 64, kGreen);
  object.height_m = 0.1;
  return object;
}

Sticker sticker(double heading_rad, double size_m) {
  return {.heading_rad = heading_rad,
          .middle = 0.5,
          .width_m = size_m,
          .height_m = size_m,
          .sticker_image = Image(32, 32, kRed)};
}

TEST(Stickers, LieOnTheSideTheyAreSeenFrom) {
  for (const double heading : {0.0, 1.0, 0.5 * pi, -2.5}) {
    GeneratedObject object = cylinder();
    const std::size_t before = object.mesh.positions_m.size();
    EXPECT_DOUBLE_EQ(apply_sticker(object, sticker(heading, 0.04)), 1.0);
    support::expect_valid(object.mesh);
    const Vector3d out(std::cos(heading), std::sin(heading), 0.0);
    ASSERT_GT(object.mesh.positions_m.size(), before);
    for (std::size_t i = before; i < object.mesh.positions_m.size(); ++i) {
      const Vector3d& p = object.mesh.positions_m[i];
      EXPECT_NEAR(p.head<2>().norm(), 0.0504, 2e-4);  // on the surface, lifted
      EXPECT_LE(std::abs(p.z() - 0.05), 0.02 + 1e-9);
      EXPECT_GT(p.head<2>().normalized().dot(out.head<2>()), 0.9);
    }
  }
}

TEST(Stickers, FaceOutward) {
  GeneratedObject object = cylinder();
  const std::size_t before = object.mesh.triangles.size();
  apply_sticker(object, sticker(2.0, 0.04));
  for (std::size_t t = before; t < object.mesh.triangles.size(); ++t) {
    const auto& triangle = object.mesh.triangles[t];
    const auto& p = object.mesh.positions_m[static_cast<std::size_t>(triangle[0])];
    EXPECT_GT(support::face_normal(object.mesh, triangle).head<2>().dot(p.head<2>()), 0.0);
  }
}

TEST(Stickers, LeaveTheOldTextureWhereItWas) {
  GeneratedObject object = cylinder();
  const std::size_t before = object.mesh.positions_m.size();
  apply_sticker(object, sticker(0.0, 0.04));
  const auto colour_at = [&](const Vector2d& uv) {
    const int x = std::min(static_cast<int>(uv.x() * 64), 63);
    return object.texture.at(x, std::min(static_cast<int>((1.0 - uv.y()) * 96), 95));
  };
  EXPECT_EQ(object.texture.height_px, 96);
  for (std::size_t i = 0; i < object.mesh.uvs.size(); ++i) {
    const Vector2d& uv = object.mesh.uvs[i];
    if (i < before) {
      EXPECT_GE(uv.y(), 1.0 / 3.0);
      EXPECT_EQ(colour_at({uv.x(), std::max(uv.y(), 0.34)}), kGreen);
    } else {
      EXPECT_EQ(colour_at(uv), kRed);
    }
  }
}

TEST(Stickers, EndWhereTheSurfaceTurnsAway) {
  GeneratedObject object = cylinder();
  const double share = apply_sticker(object, sticker(0.0, 0.12));  // wider and higher
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 0.85);
}

TEST(Stickers, FindNothingBesideTheObject) {
  GeneratedObject object = cylinder();
  object.height_m = 10.0;  // its middle is far above
  EXPECT_DOUBLE_EQ(apply_sticker(object, sticker(0.0, 0.04)), 0.0);
}

}  // namespace
}  // namespace vantage
