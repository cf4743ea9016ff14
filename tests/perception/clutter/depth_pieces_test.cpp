// Pieces of depth on images of a few pixels, seen from straight above.
#include "vantage/perception/clutter/depth_pieces.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

namespace vantage {
namespace {

using testing::ElementsAre;

DepthPiece piece_at(const std::vector<Eigen::Vector2d>& points) {
  DepthPiece piece;
  piece.points = points;
  piece.hull = convex_hull(points);
  return piece;
}

TEST(DepthStep, GrowsWithTheSquareOfTheDistance) {
  EXPECT_NEAR(DepthStep{}.at_m(0.0F), 0.015, 1e-12);
  EXPECT_NEAR(DepthStep{}.at_m(1.5F), 0.015 + 0.004 * 2.25, 1e-12);
  EXPECT_NEAR((DepthStep{0.02, 0.01}.at_m(2.0F)), 0.06, 1e-12);
}

TEST(DepthPiece, DistancesAreToItsPointsAndToItsHull) {
  const DepthPiece piece = piece_at({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  EXPECT_NEAR(piece.nearest_m({1.0, 1.0}), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(piece.nearest_m({7.0, 7.0}), 5.0, 1e-12);
  EXPECT_EQ(piece.distance_m({1.0, 1.0}), 0.0);
  EXPECT_NEAR(piece.distance_m({1.0, -0.5}), 0.5, 1e-12);
  EXPECT_NEAR(piece.distance_m({-2.0, 1.5}), 2.0, 1e-12);
  EXPECT_NEAR(piece.distance_m({7.0, 7.0}), 5.0, 1e-12);
  EXPECT_NEAR(piece_at({{1, 2}}).distance_m({4.0, 6.0}), 5.0, 1e-12);
  EXPECT_NEAR(piece_at({{0, 0}, {2, 0}}).distance_m({1.5, 0.25}), 0.25, 1e-12);
}

/// 12 x 6 px from 2 m above the table at z = 0.5, a pixel 2 cm wide there.
class PiecesFromAbove : public testing::Test {
 protected:
  PiecesFromAbove() {
    images_.width_px = 12;
    images_.height_px = 6;
    images_.focal_px = 100.0;
    T_world_camera_ = Pose::Identity();
    T_world_camera_.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    T_world_camera_.translation() = Eigen::Vector3d(0.0, 0.0, 2.5);
    column_.patch.place = cv::Rect(0, 0, 12, 6);
    column_.patch.depth_m = cv::Mat1f(6, 12, 2.0F);
    column_.heights_m = cv::Mat1f(6, 12, 0.0F);
    column_.rises = cv::Mat1b(6, 12, static_cast<unsigned char>(0));
  }
  void rise(const cv::Rect& where, float height_m) {
    column_.patch.depth_m(where) = 2.0F - height_m;
    column_.heights_m(where) = height_m;
    column_.rises(where) = static_cast<unsigned char>(255);
  }
  [[nodiscard]] DepthPieces scene() const {
    return {images_, T_world_camera_, column_, {0.015, 0.0}};
  }

  CameraImages images_;
  Pose T_world_camera_;
  RisingColumn column_;
};

TEST_F(PiecesFromAbove, APixelIsAPlaceInTheWorld) {
  EXPECT_LT((scene().p_world({0, 0}) - Eigen::Vector3d(-0.11, 0.05, 0.5)).norm(), 1e-6);
  rise({7, 4, 1, 1}, 0.5F);
  EXPECT_LT((scene().p_world({7, 4}) - Eigen::Vector3d(0.0225, -0.0225, 1.0)).norm(), 1e-6);
  column_.patch.place = cv::Rect(3, 2, 12, 6);
  EXPECT_LT((scene().p_world({0, 0}) - Eigen::Vector3d(-0.05, 0.01, 0.5)).norm(), 1e-6);
}

TEST_F(PiecesFromAbove, ThePatchEndsAtItsLastPixel) {
  EXPECT_TRUE(scene().inside({0, 0}));
  EXPECT_TRUE(scene().inside({11, 5}));
  EXPECT_FALSE(scene().inside({-1, 2}));
  EXPECT_FALSE(scene().inside({2, -1}));
  EXPECT_FALSE(scene().inside({12, 2}));
  EXPECT_FALSE(scene().inside({2, 6}));
}

TEST_F(PiecesFromAbove, NearerIsByAStep) {
  rise({1, 1, 1, 1}, 0.016F);
  rise({2, 1, 1, 1}, 0.014F);
  column_.patch.depth_m(1, 3) = 0.0F;
  EXPECT_TRUE(scene().nearer({1, 1}, {0, 1}));
  EXPECT_FALSE(scene().nearer({0, 1}, {1, 1}));
  EXPECT_FALSE(scene().nearer({2, 1}, {0, 1}));
  EXPECT_FALSE(scene().nearer({3, 1}, {0, 1})) << "it has no depth";
}

TEST_F(PiecesFromAbove, PiecesGoOnWhereDepthDoes) {
  rise({0, 0, 4, 3}, 0.1F);
  rise({4, 0, 4, 3}, 0.2F);
  rise({0, 4, 11, 1}, 0.1F);  // a pixel too few
  const auto pieces = scene().all();
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].pixels.size(), 12U);
  EXPECT_EQ(pieces[0].points.size(), 12U);
  EXPECT_EQ(pieces[0].pixels[0], cv::Point(0, 0));
  EXPECT_EQ(pieces[1].pixels[0], cv::Point(4, 0));
  EXPECT_EQ(pieces[1].hull.size(), 4U);
  // At a depth of 1.8 m, columns 4 to 7 of the middle 5.5 and rows 0 to 2 of 2.5.
  EXPECT_NEAR(pieces[1].nearest_m({0.0, 0.0}), 1.8 * std::hypot(0.005, 0.005), 1e-6);
  EXPECT_NEAR(pieces[1].nearest_m({-0.027, 0.045}), 0.0, 1e-6);
}

TEST_F(PiecesFromAbove, BesideWhatIsTooSmallAPieceBeginsWithItsFirstPixel) {
  rise({0, 0, 3, 3}, 0.1F);
  rise({5, 0, 4, 3}, 0.1F);
  const auto pieces = scene().all();
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].pixels.size(), 12U);
  EXPECT_EQ(pieces[0].pixels[0], cv::Point(5, 0));
}

TEST_F(PiecesFromAbove, NoPieceGoesOnAcrossACorner) {
  rise({0, 0, 4, 3}, 0.1F);
  rise({4, 3, 4, 3}, 0.1F);
  EXPECT_EQ(scene().all().size(), 2U);
  rise({4, 2, 1, 1}, 0.1F);
  const auto joined = scene().all();
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_EQ(joined[0].pixels.size(), 25U);
}

TEST_F(PiecesFromAbove, APlaceIsBareWhereTheTableIsSeen) {
  const Eigen::Vector3d place(0.05, -0.03, 0.5);  // column 8, row 4
  EXPECT_TRUE(scene().is_bare(place, 0.05));
  EXPECT_FALSE(scene().is_bare({0.05, -0.03, 4.5}, 0.2)) << "behind the camera";
  column_.heights_m(4, 8) = kOutside;
  EXPECT_FALSE(scene().is_bare(place, 0.05));
  rise({8, 4, 1, 1}, 0.02F);
  EXPECT_FALSE(scene().is_bare(place, 0.05));
  EXPECT_FALSE(scene().is_bare({0.5, 0.0, 0.5}, 0.05)) << "beside the patch";
}

TEST_F(PiecesFromAbove, APlaceIsAskedOfThePixelThatShowsIt) {
  column_.heights_m.setTo(kOutside);
  column_.heights_m(4, 8) = 0.0F;  // 2 cm wide round (0.05, -0.03)
  for (const auto& [x, y] : {std::pair{0.041, -0.021}, {0.059, -0.021}, {0.059, -0.039}}) {
    EXPECT_TRUE(scene().is_bare({x, y, 0.5}, 0.05)) << x << " " << y;
  }
  for (const auto& [x, y] :
       {std::pair{0.039, -0.03}, {0.061, -0.03}, {0.05, -0.019}, {0.05, -0.041}}) {
    EXPECT_FALSE(scene().is_bare({x, y, 0.5}, 0.05)) << x << " " << y;
  }
}

TEST_F(PiecesFromAbove, APlaceIsNotBareWhereSomethingFarBelowIsSeen) {
  column_.patch.depth_m(4, 8) = 3.0F;  // at x = 0.075, y = -0.045: 2.9 cm off
  EXPECT_TRUE(scene().is_bare({0.05, -0.03, 0.5}, 0.03));
  EXPECT_FALSE(scene().is_bare({0.05, -0.03, 0.5}, 0.028));
}

std::vector<std::size_t> round_origin(const std::vector<DepthPiece>& pieces, double reach_m,
                                      bool is_bare) {
  std::vector<std::size_t> found;
  for (const DepthPiece* piece : round_place(pieces, {0.0, 0.0}, reach_m, is_bare)) {
    found.push_back(static_cast<std::size_t>(piece - pieces.data()));
  }
  return found;
}

DepthPiece box_piece(double x, double y, double half) {
  return piece_at(
      {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}});
}

TEST(RoundPlace, IsTheNearestPieceWithinReach) {
  const std::vector<DepthPiece> pieces{box_piece(0.5, 0.1, 0.05), box_piece(0.13, 0.1, 0.05)};
  // The second one's nearest corner is (0.08, 0.05): 9.43 cm away.
  EXPECT_THAT(round_origin(pieces, 0.0944, false), ElementsAre(1U));
  EXPECT_THAT(round_origin(pieces, 0.0943, false), ElementsAre());
  EXPECT_THAT(round_origin({}, 1.0, true), ElementsAre());
}

TEST(RoundPlace, WhatIsWithinHalfTheReachIsOfItToo) {
  const std::vector<DepthPiece> pieces{piece_at({{0.01, 0.0}}), piece_at({{-0.125, 0.0}}),
                                       piece_at({{0.0, -0.126}})};
  EXPECT_THAT(round_origin(pieces, 0.25, false), ElementsAre(0U, 1U));
}

TEST(RoundPlace, WhatEnclosesABarePlaceIsThere) {
  const std::vector<DepthPiece> pieces{box_piece(0.5, 0.0, 0.05), box_piece(0.02, 0.01, 0.3)};
  EXPECT_THAT(round_origin(pieces, 0.1, true), ElementsAre(1U));
  EXPECT_THAT(round_origin(pieces, 0.1, false), ElementsAre());
  const std::vector<DepthPiece> beside{box_piece(0.5, 0.0, 0.35)};
  EXPECT_THAT(round_origin(beside, 0.16, true), ElementsAre(0U));
  EXPECT_THAT(round_origin(beside, 0.14, true), ElementsAre()) << "its hull is 15 cm away";
}

TEST(RoundPlace, WhatIsMostlyOverItIsAPartOfIt) {
  const DepthPiece base = box_piece(0.05, 0.05, 0.1);
  const auto with = [&](const std::vector<Eigen::Vector2d>& points) {
    return round_origin({base, piece_at(points)}, 0.1, false);
  };
  EXPECT_THAT(with({{0.14, 0.14}, {0.16, 0.05}, {0.4, 0.4}}), ElementsAre(0U, 1U))
      << "one inside, one within 1.5 cm of its hull";
  EXPECT_THAT(with({{0.14, 0.14}, {0.17, 0.05}, {0.4, 0.4}}), ElementsAre(0U));
  EXPECT_THAT(with({{0.14, 0.14}, {0.4, 0.4}}), ElementsAre(0U)) << "half of it is not most";
}

TEST_F(PiecesFromAbove, WhatIsNearerThanAMetreCountsAsWell) {
  column_.patch.depth_m(1, 1) = 0.5F;
  EXPECT_TRUE(scene().nearer({1, 1}, {0, 1}));
  EXPECT_TRUE(scene().is_bare({0.0, 0.0, 2.0}, 0.05)) << "half a metre before the camera";
}

TEST(DepthPiece, ItsHullIsNearestAnywhereOnAnEdge) {
  const DepthPiece piece = piece_at({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  EXPECT_NEAR(piece.distance_m({3.5, -0.5}), 0.5, 1e-12);
  EXPECT_NEAR(piece.distance_m({0.5, 3.25}), 0.25, 1e-12);
  EXPECT_NEAR(piece.distance_m({4.5, 2.5}), 0.5, 1e-12);
}

TEST_F(PiecesFromAbove, NoPieceGoesOnAcrossAGap) {
  const auto sizes = [&](const std::vector<cv::Rect>& rising) {
    column_.patch.depth_m.setTo(2.0F);
    column_.rises.setTo(0);
    for (const cv::Rect& where : rising) rise(where, 0.1F);
    std::vector<std::size_t> found;
    for (const DepthPiece& piece : scene().all()) found.push_back(piece.pixels.size());
    return found;
  };
  EXPECT_THAT(sizes({{0, 0, 4, 3}, {5, 0, 4, 3}}), ElementsAre(12U, 12U)) << "to the right";
  EXPECT_THAT(sizes({{5, 0, 4, 3}, {0, 1, 4, 3}}), ElementsAre(12U, 12U)) << "to the left";
  EXPECT_THAT(sizes({{0, 0, 6, 2}, {0, 3, 6, 2}}), ElementsAre(12U, 12U)) << "down";
  EXPECT_THAT(sizes({{0, 0, 1, 6}, {1, 5, 7, 1}, {3, 1, 4, 3}}), ElementsAre(13U, 12U)) << "up";
}

/// Down, right, up and left again.
TEST_F(PiecesFromAbove, APieceGoesOnInEachDirection) {
  rise({0, 0, 1, 6}, 0.1F);
  rise({1, 5, 7, 1}, 0.1F);
  rise({7, 1, 1, 4}, 0.1F);
  rise({4, 1, 3, 1}, 0.1F);
  const auto pieces = scene().all();
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].pixels.size(), 20U);
}

}  // namespace
}  // namespace vantage
