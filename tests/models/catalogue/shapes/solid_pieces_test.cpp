#include "vantage/models/catalogue/shapes/solid_pieces.hpp"

#include <gtest/gtest.h>

#include "vantage/models/catalogue/office/office_furniture.hpp"
#include "vantage/models/catalogue/shapes/mesh_builders.hpp"

namespace vantage {
namespace {

constexpr double kSlack_m = 0.03;

TriangleMesh box(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& size_m) {
  TriangleMesh mesh = make_rounded_box(size_m, 1e-3, 1, unfold_box(size_m));
  Pose T = Pose::Identity();
  T.translation() = centre_m;
  transform(mesh, T);
  return mesh;
}

//  foot   screen   foot        from above: the screen is thin, its feet are long
//   |                |
//   |================|
//   |                |
TEST(SolidPieces, TheSpaceBetweenFeetStaysOpen) {
  TriangleMesh mesh = box({0.0, 0.0, 0.7}, {1.6, 0.05, 1.3});
  append(mesh, box({-0.78, 0.0, 0.03}, {0.05, 0.4, 0.05}));
  append(mesh, box({0.78, 0.0, 0.03}, {0.05, 0.4, 0.05}));
  const auto pieces = solid_pieces(mesh, kSlack_m);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_NEAR(bounds(pieces[0]).sizes().y(), 0.05, 1e-6) << "the largest first: the screen";
  for (int foot : {1, 2}) EXPECT_LT(bounds(pieces[foot]).sizes().x(), 0.06);
}

TEST(SolidPieces, WhatStandsUnderATopIsOneWithIt) {
  TriangleMesh mesh = box({0.0, 0.0, 0.72}, {1.4, 0.8, 0.03});
  for (const double x : {-0.6, 0.6}) append(mesh, box({x, 0.0, 0.35}, {0.05, 0.7, 0.7}));
  append(mesh, box({0.2, 0.1, 0.8}, {0.3, 0.3, 0.1}));
  const auto pieces = solid_pieces(mesh, kSlack_m);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].triangles.size(), mesh.triangles.size()) << "nothing is lost";
}

/// Furniture as it stands in the scenes: every triangle is in one piece, and pieces end where the
/// mesh does.
TEST(SolidPieces, MissNothingOfTheFurniture) {
  for (const auto item : {OfficeItem::office_chair, OfficeItem::partition, OfficeItem::plant}) {
    const TriangleMesh mesh = make_office_item(item, 1);
    const auto pieces = solid_pieces(mesh, kSlack_m);
    EXPECT_GT(pieces.size(), 1U);
    EXPECT_LT(pieces.size(), 9U);
    std::size_t triangles = 0;
    Eigen::AlignedBox3d box;
    for (const TriangleMesh& piece : pieces) {
      triangles += piece.triangles.size();
      box.extend(bounds(piece));
    }
    EXPECT_EQ(triangles, mesh.triangles.size());
    EXPECT_TRUE(box.isApprox(bounds(mesh), 1e-9));
  }
}

TEST(SolidPieces, OnlyTheSlackIsFilledIn) {
  const TriangleMesh screen = make_office_item(OfficeItem::partition, 1);
  const double reach_m = bounds(screen).max().x();
  ASSERT_GT(reach_m, 0.15);
  const Outline beside_the_screen{{0.06, -0.1}, {reach_m, -0.1}, {reach_m, 0.1}, {0.06, 0.1}};
  EXPECT_TRUE(too_close(convex_footprint(screen), beside_the_screen, 0.0));
  for (const TriangleMesh& piece : solid_pieces(screen, kSlack_m)) {
    EXPECT_FALSE(too_close(convex_footprint(piece), beside_the_screen, 0.0));
  }
}

}  // namespace
}  // namespace vantage
