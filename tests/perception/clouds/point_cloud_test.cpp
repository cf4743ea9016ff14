#include "vantage/perception/clouds/point_cloud.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void expect_near(const Eigen::Vector3f& actual, const Eigen::Vector3d& expected, double tolerance) {
  EXPECT_LT((actual.cast<double>() - expected).norm(), tolerance)
      << actual.transpose() << " instead of " << expected.transpose();
}

PointCloud random_cloud(std::size_t count, Rng& rng) {
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.points.emplace_back(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  }
  return cloud;
}

TEST(ToCloud, KeepsReturnsOnlyInTheSensorFrame) {
  RangeScan scan;
  scan.tilt_rad = {0.0, 0.5};
  scan.azimuth_rad = {-0.3, 0.0, 0.3};
  scan.range_m = {1.0F, kInf, 2.0F, kNan, 3.0F, 0.0F};
  const PointCloud cloud = to_cloud(scan);
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_FALSE(cloud.has_normals());
  expect_near(cloud.points[0], {std::cos(0.3), -std::sin(0.3), 0.0}, 1e-6);
  expect_near(cloud.points[1], {2.0 * std::cos(0.3), 2.0 * std::sin(0.3), 0.0}, 1e-6);
  expect_near(cloud.points[2], {3.0 * std::cos(0.5), 0.0, -3.0 * std::sin(0.5)}, 1e-6);
}

TEST(ToCloud, PlanarScanStandsAtItsPlaceOnTheBase) {
  PlanarScan scan;
  scan.T_base_sensor = {0.275, 0.0, std::numbers::pi / 2.0};
  scan.azimuth_rad = {0.0, std::numbers::pi / 2.0, 2.0};
  scan.range_m = {1.0F, 2.0F, kInf};
  const PointCloud cloud = to_cloud(scan, 0.25);
  ASSERT_EQ(cloud.size(), 2U);
  expect_near(cloud.points[0], {0.275, 1.0, 0.25}, 1e-6);
  expect_near(cloud.points[1], {0.275 - 2.0, 0.0, 0.25}, 1e-6);
}

TEST(Transform, TurnsNormalsWithoutMovingThem) {
  PointCloud cloud;
  cloud.points.emplace_back(1.0F, 0.0F, 0.0F);
  cloud.normals.emplace_back(1.0F, 0.0F, 0.0F);
  const PointCloud moved = transform(cloud, make_pose({5, 6, 7}, std::numbers::pi / 2.0));
  expect_near(moved.points[0], {5, 7, 7}, 1e-6);
  expect_near(moved.normals[0], {0, 1, 0}, 1e-6);
}

TEST(Append, NormalsSurviveOnlyIfBothHaveThem) {
  PointCloud with;
  with.points.emplace_back(1, 0, 0);
  with.normals.emplace_back(0, 0, 1);
  PointCloud without;
  without.points.emplace_back(2, 0, 0);

  PointCloud both = with;
  append(both, with);
  EXPECT_EQ(both.size(), 2U);
  EXPECT_TRUE(both.has_normals());

  PointCloud from_nothing;
  append(from_nothing, with);
  EXPECT_TRUE(from_nothing.has_normals());

  append(both, PointCloud{});
  EXPECT_TRUE(both.has_normals());

  append(both, without);
  EXPECT_EQ(both.size(), 3U);
  EXPECT_TRUE(both.normals.empty());
}

//   y
//   1 | c |   |
//   0 |ab |  d|      a, b share a cube of edge 1
//       0   1   x
TEST(VoxelDownsample, MeanOfEachCubeInOrderOfAppearance) {
  PointCloud cloud;
  cloud.points = {{0.1F, 0.5F, 0.5F}, {1.9F, 0.5F, 0.5F}, {0.3F, 0.5F, 0.5F}, {0.5F, 1.5F, 0.5F}};
  cloud.normals = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}};
  const PointCloud down = voxel_downsample(cloud, 1.0);
  ASSERT_EQ(down.size(), 3U);
  expect_near(down.points[0], {0.2, 0.5, 0.5}, 1e-6);
  expect_near(down.normals[0], {std::sqrt(0.5), std::sqrt(0.5), 0}, 1e-6);
  expect_near(down.points[1], {1.9, 0.5, 0.5}, 1e-6);
  expect_near(down.points[2], {0.5, 1.5, 0.5}, 1e-6);
}

TEST(VoxelDownsample, CubesDoNotMeetAcrossZero) {
  PointCloud cloud;
  cloud.points = {{-0.1F, 0, 0}, {0.1F, 0, 0}};
  EXPECT_EQ(voxel_downsample(cloud, 1.0).size(), 2U);
}

TEST(VoxelDownsample, OppositeNormalsCancelToUnknown) {
  PointCloud cloud;
  cloud.points = {{0.1F, 0.1F, 0.1F}, {0.2F, 0.1F, 0.1F}};
  cloud.normals = {{1, 0, 0}, {-1, 0, 0}};
  EXPECT_TRUE(voxel_downsample(cloud, 1.0).normals[0].isZero());
  cloud.normals[1].x() = -0.9999992F;
  EXPECT_TRUE(voxel_downsample(cloud, 1.0).normals[0].isZero());
  cloud.normals[1].x() = -0.9999988F;
  EXPECT_EQ(voxel_downsample(cloud, 1.0).normals[0], Eigen::Vector3f(1, 0, 0))
      << "more than a millionth is left";
}

RC_GTEST_PROP(VoxelDownsample, StaysInTheHullAndNeverGrows, (std::uint64_t seed)) {
  Rng rng(seed);
  const PointCloud cloud = random_cloud(1 + rng.uniform_index(200), rng);
  const double cell_m = rng.uniform(0.01, 3.0);
  const PointCloud down = voxel_downsample(cloud, cell_m);
  RC_ASSERT(!down.empty());
  RC_ASSERT(down.size() <= cloud.size());
  Eigen::AlignedBox3f box;
  for (const auto& p : cloud.points) box.extend(p);
  for (const auto& p : down.points) RC_ASSERT(box.exteriorDistance(p) < 1e-5F);
}

TEST(Crop, KeepsOrderNormalsAndFaces) {
  PointCloud cloud;
  cloud.points = {{2, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 1.5F}};
  cloud.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  const PointCloud inside = crop(cloud, {Eigen::Vector3d(0, -1, -1), Eigen::Vector3d(1, 1, 1)});
  ASSERT_EQ(inside.size(), 2U);
  EXPECT_EQ(inside.points[0], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(inside.normals[0], Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(inside.points[1], Eigen::Vector3f(0, 0, 0));
}

TEST(ToCloud, KeepsEveryNthPixelOfAnImageThatReturned) {
  CameraImages image;
  image.width_px = 3;
  image.height_px = 3;
  image.focal_px = 2.0;
  image.depth_m = {2.0F, 9.0F, kInf, 9.0F, 9.0F, 9.0F, 0.0F, 9.0F, 4.0F};
  const PointCloud cloud = to_cloud(image, 2);
  ASSERT_EQ(cloud.size(), 2U);
  expect_near(cloud.points[0], {-1.0, -1.0, 2.0}, 1e-6);
  expect_near(cloud.points[1], {2.0, 2.0, 4.0}, 1e-6);
}

TEST(ToCloud, ReturnsAreAboveZero) {
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0, 0.1, 0.2};
  scan.range_m = {-1.0F, 0.0F, 0.5F};
  EXPECT_EQ(to_cloud(scan).size(), 1U);
  PlanarScan planar;
  planar.azimuth_rad = {0.0, 0.1, 0.2, 0.3};
  planar.range_m = {-1.0F, 0.0F, 0.5F, kNan};
  EXPECT_EQ(to_cloud(planar, 0.1).size(), 1U);
}

TEST(ToCloud, EveryPixelOfAnImageWithStrideOne) {
  CameraImages image;
  image.width_px = 3;
  image.height_px = 2;
  image.focal_px = 4.0;
  image.depth_m = {1.0F, 2.0F, 3.0F, 4.0F, kNan, 6.0F};
  const PointCloud cloud = to_cloud(image, 1);
  ASSERT_EQ(cloud.size(), 5U);
  expect_near(cloud.points[2], {0.75, -0.375, 3.0}, 1e-6);
  expect_near(cloud.points[3], {-1.0, 0.5, 4.0}, 1e-6);
}

TEST(Select, TakesPointsAndNormalsInTheOrderOfTheIndices) {
  PointCloud cloud;
  cloud.points = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  cloud.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PointCloud chosen = select(cloud, {2, 0});
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen.points[0], Eigen::Vector3f(3, 0, 0));
  EXPECT_EQ(chosen.normals[0], Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(chosen.points[1], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(chosen.normals[1], Eigen::Vector3f(1, 0, 0));
}

TEST(Append, NothingBehindSomethingWithoutNormalsHasNone) {
  PointCloud without;
  without.points.emplace_back(2, 0, 0);
  PointCloud with = without;
  with.normals.emplace_back(0, 0, 1);
  PointCloud both = without;
  append(both, with);
  EXPECT_EQ(both.size(), 2U);
  EXPECT_TRUE(both.normals.empty());
  EXPECT_FALSE(PointCloud{}.has_normals());
}

TEST(VoxelDownsample, CubesAreToldApartAlongEachAxis) {
  PointCloud cloud;
  cloud.points = {{0.1F, 0.1F, 0.1F},  {0.1F, 0.1F, 0.35F}, {0.1F, 0.35F, 0.1F},
                  {0.35F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F},  {0.24F, 0.03F, 0.09F}};
  const PointCloud down = voxel_downsample(cloud, 0.25);
  ASSERT_EQ(down.size(), 4U);
  expect_near(down.points[0], {0.18, 0.11, 0.13}, 1e-6);
  EXPECT_EQ(down.points[1], cloud.points[1]);
  EXPECT_EQ(down.points[3], cloud.points[3]);
  EXPECT_FALSE(down.has_normals());
}

}  // namespace
}  // namespace vantage
