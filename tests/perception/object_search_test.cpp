// Against images of stands, objects, columns and walls, drawn ray by ray.
#include "vantage/perception/search/object_search.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/drawn_room.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;
using support::box_on;
using support::draw_room;
using support::drawn_camera;
using support::DrawnBox;

constexpr double kPitch_rad = 0.7853981633974483;
/// Sees level ground from 0.4 m to 2.2 m ahead, 0.95 m below it.
const Pose kCamera = drawn_camera({0.0, 0.0, 1.75}, 0.0, kPitch_rad);

DrawnBox pedestal(double x_m, double y_m, double top_m = 0.8) {
  return box_on(0.0, x_m, y_m, {0.5, 0.5, top_m});
}

std::vector<SeenObject> found_in(const std::vector<DrawnBox>& boxes,
                                 const Pose& T_world_camera = kCamera) {
  return find_objects(draw_room(boxes, T_world_camera), T_world_camera);
}

double level_error_m(const SeenObject& seen, double x_m, double y_m) {
  return (seen.detection.p_world_object_m.head<2>() - Eigen::Vector2d(x_m, y_m)).norm();
}

TEST(ObjectSearch, FindsTwoObjectsOnStandsOfDifferentHeights) {
  const auto seen = found_in({pedestal(1.3, 0.45), box_on(0.8, 1.3, 0.45, {0.08, 0.1, 0.15}),
                              pedestal(1.5, -0.5, 0.7), box_on(0.7, 1.5, -0.5, {0.12, 0.12, 0.1})});
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_LE(seen[0].detection.distance_m, seen[1].detection.distance_m) << "nearest first";
  EXPECT_LT(level_error_m(seen[0], 1.3, 0.45), 0.02);
  EXPECT_LT(level_error_m(seen[1], 1.5, -0.5), 0.02);
  EXPECT_NEAR(seen[0].detection.support_z_m, 0.8, 0.01);
  EXPECT_NEAR(seen[1].detection.support_z_m, 0.7, 0.01);
  EXPECT_NEAR(seen[0].detection.height_m, 0.15, 0.02);
  EXPECT_NEAR(seen[0].detection.radius_m, 0.064, 0.02);
  EXPECT_NEAR(seen[0].detection.p_world_object_m.z(), 0.875, 0.02);
  EXPECT_TRUE(seen[0].detection.whole);
  EXPECT_TRUE(seen[1].detection.whole);
}

TEST(ObjectSearch, GivesTheRecogniserTheCutOut) {
  const std::vector<DrawnBox> room{pedestal(1.2, 0.1), box_on(0.8, 1.2, 0.1, {0.1, 0.1, 0.12})};
  const auto seen = found_in(room);
  ASSERT_EQ(seen.size(), 1U);
  const ObjectView& view = seen[0].view;
  std::size_t on = 0;
  std::size_t right = 0;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (view.mask[view.index(row, column)] == 0) continue;
      const Vector3d p = kCamera * view.point(row, column);
      ++on;
      right += p.z() > 0.79 && (p.head<2>() - Eigen::Vector2d(1.2, 0.1)).norm() < 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(on, 1500U);
  EXPECT_GT(right, on * 9 / 10) << "the mask may reach a pixel over the edge";
  EXPECT_NEAR((kCamera.linear() * view.up - Vector3d::UnitZ()).norm(), 0.0, 1e-9);
}

TEST(ObjectSearch, TellsWhatTheFrameCuts) {
  // Half of the field of view at that place: 0.552 x depth along the axis, 1.66 m.
  const double edge_m = 0.552 * (1.4 + 0.85) / std::sqrt(2.0);
  const auto seen = found_in({pedestal(1.4, edge_m), box_on(0.8, 1.4, edge_m, {0.1, 0.14, 0.2})});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_FALSE(seen[0].detection.whole);
  EXPECT_LT(level_error_m(seen[0], 1.4, edge_m), 0.1);
}

TEST(ObjectSearch, AnEmptyStandHoldsNothing) {
  EXPECT_TRUE(found_in({pedestal(1.3, 0.2), pedestal(1.6, -0.6, 0.7)}).empty());
  EXPECT_TRUE(found_in({}).empty());
}

TEST(ObjectSearch, ColumnsWallsAndCupboardsAreNoObjects) {
  const DrawnBox column = box_on(0.0, 1.5, -0.3, {0.25, 0.25, 2.5});
  const DrawnBox wall = box_on(0.0, 2.4, 0.0, {0.1, 6.0, 2.5});
  const DrawnBox sideboard = box_on(0.0, 2.0, 0.8, {0.5, 1.2, 0.75});
  EXPECT_TRUE(found_in({column, wall, sideboard}).empty());
}

TEST(ObjectSearch, AColumnBehindAStandIsNotOnIt) {
  const auto seen = found_in({pedestal(1.2, 0.0), box_on(0.8, 1.2, 0.0, {0.1, 0.1, 0.12}),
                              box_on(0.0, 1.7, 0.0, {0.2, 0.2, 2.5})});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT(level_error_m(seen[0], 1.2, 0.0), 0.03);
  EXPECT_LT(seen[0].detection.height_m, 0.16);
}

TEST(ObjectSearch, WhatStandsInFrontMakesAnObjectPartial) {
  const std::vector<DrawnBox> room{pedestal(1.5, 0.0), box_on(0.8, 1.5, 0.0, {0.1, 0.2, 0.15})};
  std::vector<DrawnBox> hidden = room;
  hidden.push_back(box_on(0.0, 1.0, 0.1, {0.1, 0.12, 1.3}));
  ASSERT_EQ(found_in(room).size(), 1U);
  EXPECT_TRUE(found_in(room)[0].detection.whole);
  const auto seen = found_in(hidden);
  ASSERT_EQ(seen.size(), 1U) << "what is in front is too narrow for a support surface";
  EXPECT_LT(level_error_m(seen[0], 1.5, 0.0), 0.06);
  EXPECT_FALSE(seen[0].detection.whole);
}

TEST(ObjectSearch, ABookIsNoStand) {
  const auto seen = found_in({pedestal(1.3, 0.0), box_on(0.8, 1.3, 0.0, {0.2, 0.26, 0.04})});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT(level_error_m(seen[0], 1.3, 0.0), 0.02);
  EXPECT_NEAR(seen[0].detection.height_m, 0.04, 0.015);
}

TEST(ObjectSearch, BearsTheErrorsOfAnEstimatedPose) {
  const std::vector<DrawnBox> room{pedestal(1.5, 0.2), box_on(0.8, 1.5, 0.2, {0.1, 0.1, 0.06})};
  Pose T_estimated = kCamera * Eigen::AngleAxisd(0.015, Vector3d::UnitX());
  T_estimated.translation() += Vector3d(0.02, -0.02, 0.03);
  const auto seen = find_objects(draw_room(room, kCamera), T_estimated);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT(level_error_m(seen[0], 1.5, 0.2), 0.07);
  EXPECT_NEAR(seen[0].detection.height_m, 0.06, 0.02);
}

TEST(ObjectSearch, ReportsNothingBeyondItsRange) {
  const Pose level = drawn_camera({0.0, 0.0, 1.75}, 0.0, 0.45);
  const std::vector<DrawnBox> room{pedestal(2.6, 0.0), box_on(0.8, 2.6, 0.0, {0.12, 0.12, 0.2})};
  const CameraImages images = draw_room(room, level);
  EXPECT_EQ(find_objects(images, level).size(), 1U);
  EXPECT_TRUE(find_objects(images, level, {.range_m = 2.5}).empty());
}

TEST(ObjectSearch, TheSameImageGivesTheSameBits) {
  const std::vector<DrawnBox> room{pedestal(1.5, 0.2), box_on(0.8, 1.5, 0.2, {0.1, 0.1, 0.06})};
  const auto a = found_in(room);
  const auto b = found_in(room);
  ASSERT_EQ(a.size(), 1U);
  ASSERT_EQ(b.size(), 1U);
  EXPECT_EQ(a[0].detection.p_world_object_m, b[0].detection.p_world_object_m);
  EXPECT_EQ(a[0].view.mask, b[0].view.mask);
}

TEST(ObjectSearch, SmallImagesDoAsWell) {
  const std::vector<DrawnBox> room{pedestal(1.3, 0.1), box_on(0.8, 1.3, 0.1, {0.1, 0.1, 0.1})};
  const auto seen = find_objects(draw_room(room, kCamera, true, 320), kCamera);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT(level_error_m(seen[0], 1.3, 0.1), 0.03);
}

TEST(SupportSearch, GivesLevelSurfacesFromTheLowestUp) {
  const CameraImages images = draw_room({pedestal(1.3, 0.4), pedestal(1.5, -0.4, 0.6)}, kCamera);
  const PointCloud world = transform(to_cloud(images, 4), kCamera);
  const auto supports = find_supports(world, {});
  ASSERT_EQ(supports.size(), 2U);
  EXPECT_NEAR(supports[0].height_m, 0.6, 0.01);
  EXPECT_NEAR(supports[1].height_m, 0.8, 0.01);
  EXPECT_TRUE(inside_hull(supports[1].hull, {1.3, 0.4}));
  EXPECT_FALSE(inside_hull(supports[1].hull, {1.5, -0.4}));
}

TEST(ObjectSearch, RejectsOptionsOutOfRange) {
  ObjectSearchOptions options;
  options.gap_m = 0.0;
  EXPECT_THROW(find_objects(draw_room({}, kCamera), kCamera, options), ConfigError);
  options = {};
  options.support.max_height_m = options.support.min_height_m;
  EXPECT_THROW(find_objects(draw_room({}, kCamera), kCamera, options), ConfigError);
  options.support = {.max_height_m = 200.0};
  EXPECT_THROW(find_objects(draw_room({}, kCamera), kCamera, options), ConfigError);
  options.support = {.min_height_m = -1e9};
  EXPECT_THROW(find_objects(draw_room({}, kCamera), kCamera, options), ConfigError);
}

TEST(ObjectSearch, ObjectsAreSmallAndStandOutAsOptionsSay) {
  const CameraImages images =
      draw_room({pedestal(1.3, 0.1), box_on(0.8, 1.3, 0.1, {0.08, 0.1, 0.15})}, kCamera);
  const auto seen = find_objects(images, kCamera);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_TRUE(seen[0].detection.whole);
  ObjectSearchOptions options;
  options.cut.max_height_m = 0.1;
  EXPECT_TRUE(find_objects(images, kCamera, options).empty());
  options = {};
  options.cut.radius_m = 0.03;
  EXPECT_TRUE(find_objects(images, kCamera, options).empty());
  options = {.noise_per_m = 0.1};
  EXPECT_TRUE(find_objects(images, kCamera, options).empty());
  options = {.nearest_m = 5.0};
  const auto near = find_objects(images, kCamera, options);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_FALSE(near[0].detection.whole);
  EXPECT_EQ(near[0].detection.distance_m, seen[0].detection.distance_m);
}

}  // namespace
}  // namespace vantage
