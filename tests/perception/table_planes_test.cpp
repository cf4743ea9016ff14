// Hulls, joined planes and limits of the table search, by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "vantage/perception/background_planes.hpp"
#include "vantage/perception/table_extraction.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;

TEST(ConvexHull, RunsCounterClockwiseFromTheLowestOfTheLeftmost) {
  const auto hull =
      convex_hull({{2, 3}, {0, 1}, {4, 1}, {1, 1}, {0, 4}, {3, 5}, {0, 2.5}, {4, 1}, {2, 1}});
  const std::vector<Eigen::Vector2d> expected{{0, 1}, {4, 1}, {3, 5}, {0, 4}};
  EXPECT_EQ(hull, expected);
}

TEST(InsideHull, ReachesToItsEdgeAndAMarginBeyond) {
  const std::vector<Eigen::Vector2d> hull{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  EXPECT_TRUE(inside_hull(hull, {4.0, 1.0}));
  EXPECT_TRUE(inside_hull(hull, {3.0, 0.0}));
  EXPECT_FALSE(inside_hull(hull, {4.001, 1.0}));
  EXPECT_TRUE(inside_hull(hull, {4.25, 1.0}, 0.25));
  EXPECT_TRUE(inside_hull(hull, {1.0, -0.25}, 0.25));
  EXPECT_FALSE(inside_hull(hull, {4.26, 1.0}, 0.25));
  EXPECT_FALSE(inside_hull(hull, {1.0, 2.26}, 0.25));
  EXPECT_FALSE(inside_hull(hull, {3.9, 1.0}, -0.25)) << "a negative margin shrinks it";
  EXPECT_TRUE(inside_hull(hull, {3.7, 1.0}, -0.25));
}

TablePlane plane_through(const std::vector<Eigen::Vector3d>& points) {
  TablePlane plane;
  plane.inliers = points.size();
  std::vector<Eigen::Vector2d> outline;
  for (const auto& p : points) {
    plane.centroid_m += p / static_cast<double>(points.size());
    outline.emplace_back(p.head<2>());
  }
  for (const auto& p : points) {
    plane.scatter_m2 += (p - plane.centroid_m) * (p - plane.centroid_m).transpose();
  }
  plane.height_m = plane.centroid_m.z();
  plane.hull = convex_hull(outline);
  return plane;
}

/// Of the plane z = 0.7 + 0.03 x - 0.02 y, three points and five.
TEST(MergeTable, JoinsPartsOfDifferentSize) {
  std::vector<Eigen::Vector3d> first, second;
  const auto at = [](double x, double y) {
    return Eigen::Vector3d(x, y, 0.7 + 0.03 * x - 0.02 * y);
  };
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.1}, {0.1, 0.4}}) {
    first.push_back(at(x, y));
  }
  for (const auto& [x, y] : {std::pair{0.5, 0.2}, {0.9, 0.1}, {0.8, 0.6}, {0.6, 0.5}, {0.7, 0.3}}) {
    second.push_back(at(x, y));
  }
  TablePlane table = plane_through(first);
  ASSERT_TRUE(merge_table(table, plane_through(second), 0.1));
  first.insert(first.end(), second.begin(), second.end());
  const TablePlane all = plane_through(first);
  EXPECT_EQ(table.inliers, 8U);
  EXPECT_LT((table.centroid_m - all.centroid_m).norm(), 1e-12);
  EXPECT_LT((table.scatter_m2 - all.scatter_m2).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(table.height_m, all.height_m, 1e-12);
  EXPECT_LT((table.normal - Eigen::Vector3d(-0.03, 0.02, 1.0).normalized()).norm(), 1e-9);
  EXPECT_EQ(table.hull, all.hull);
}

TEST(MergeTable, AStepIsAllowed) {
  TablePlane low;
  low.inliers = 1;
  low.height_m = 0.5;
  TablePlane high = low;
  high.height_m = 0.625;
  TablePlane copy = low;
  EXPECT_TRUE(merge_table(copy, high, 0.125));
  copy = low;
  EXPECT_FALSE(merge_table(copy, high, 0.124));
  copy = high;
  EXPECT_FALSE(merge_table(copy, low, 0.124));
}

TEST(ObjectsOnTable, StandBetweenTwoHeights) {
  TablePlane table;
  table.centroid_m = {0.0, 0.0, 0.5};
  table.hull = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  PointCloud cloud;
  for (const float z : {0.62F, 0.625F, 0.7F, 1.0F, 1.01F}) cloud.points.emplace_back(0.1F, 0.2F, z);
  const PointCloud kept =
      objects_on_table(cloud, table, {.min_height_m = 0.125, .max_height_m = 0.5});
  ASSERT_EQ(kept.size(), 3U) << "those at the limits too";
  EXPECT_EQ(kept.points[0].z(), 0.625F);
  EXPECT_EQ(kept.points[2].z(), 1.0F);
}

/// A point in the middle of each of the voxels of 2 cm.
PointCloud table_of_cells(int columns, int rows, double z_m, double x_m = 0.0, double y_m = 0.0) {
  PointCloud cloud;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      cloud.points.emplace_back(x_m + 0.02 * i + 0.01, y_m + 0.02 * j + 0.01, z_m);
    }
  }
  return cloud;
}

class TableLimits : public testing::Test {
 protected:
  TableSearch find(const PointCloud& cloud) { return find_table(cloud, options, rng, "table."); }
  TableOptions options;
  Rng rng{3};
};

TEST_F(TableLimits, AreaIsThatOfItsCells) {
  options.min_area_m2 = 0.0399;
  const auto found = find(table_of_cells(10, 10, 0.71));
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_EQ(found.table->inliers, 100U);
  EXPECT_NEAR(found.table->height_m, 0.71, 1e-6);
  EXPECT_NEAR(found.table->centroid_m.x(), 0.1, 1e-6);
  options.min_area_m2 = 0.0401;
  EXPECT_EQ(find(table_of_cells(10, 10, 0.71)).reason,
            "the largest level surface seen has 0.040 m^2, less than table.min_area_m2 0.0401");
  options.min_area_m2 = 100.0 * (options.cell_m * options.cell_m);
  EXPECT_TRUE(find(table_of_cells(10, 10, 0.71)).table) << "just as much";
}

TEST_F(TableLimits, RegionIsRoundItsCentre) {
  options.region_centre_m = {1.0, 2.0};
  options.region_size_m = {0.4, 0.8};
  const PointCloud wide = table_of_cells(100, 150, 0.71);
  const auto found = find(wide);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_EQ(found.table->inliers, 20U * 40U);
  EXPECT_NEAR(found.table->centroid_m.x(), 1.0, 1e-5);
  EXPECT_NEAR(found.table->centroid_m.y(), 2.0, 1e-5);
}

TEST_F(TableLimits, HeightsAreBetweenTheTwo) {
  options.min_height_m = 0.7;
  options.max_height_m = 0.75;
  EXPECT_TRUE(find(table_of_cells(15, 12, 0.701)).table);
  EXPECT_TRUE(find(table_of_cells(15, 12, 0.749)).table);
  EXPECT_EQ(find(table_of_cells(15, 12, 0.699)).reason,
            "no level surface in the region between table.min_height_m 0.7 and "
            "table.max_height_m 0.75");
  EXPECT_FALSE(find(table_of_cells(15, 12, 0.751)).table);
}

TEST_F(TableLimits, NormalsArePlumbWithinAnAngleOrNotKnown) {
  const auto inliers_with = [&](const Eigen::Vector3f& normal) {
    PointCloud cloud = table_of_cells(15, 12, 0.71);
    cloud.normals.assign(cloud.size(), normal);
    const auto found = find(cloud);
    return found.table ? found.table->inliers : 0U;
  };
  EXPECT_EQ(inliers_with({std::sin(0.39F), 0.0F, std::cos(0.39F)}), 180U);
  EXPECT_EQ(inliers_with({std::sin(0.39F), 0.0F, -std::cos(0.39F)}), 180U);
  EXPECT_EQ(inliers_with({0.0F, 0.0F, 0.0F}), 180U);
  EXPECT_EQ(inliers_with({std::sin(0.41F), 0.0F, std::cos(0.41F)}), 0U);
}

TEST_F(TableLimits, PointsAreOfThePlaneWithinADistance) {
  PointCloud cloud = table_of_cells(15, 12, 0.71);
  append(cloud, table_of_cells(1, 2, 0.724, 0.14, 0.1));
  append(cloud, table_of_cells(1, 2, 0.73, 0.08, 0.1));
  EXPECT_EQ(find(cloud).table.value().inliers, 182U);
}

BackgroundPlane facing(double x, double y, double z) {
  return {.normal = Eigen::Vector3d(x, y, z), .offset_m = 1.0, .share = 0.3};
}

TEST(ElevationOver, IsThatOfTheMostLevelPlane) {
  EXPECT_NEAR(elevation_over({facing(0.0, -0.8, -0.6)}), std::asin(0.6), 1e-12);
  EXPECT_NEAR(elevation_over({facing(0.0, -0.6, -0.8), facing(0.0, -0.8, -0.6)}), std::asin(0.6),
              1e-12);
  EXPECT_NEAR(elevation_over({facing(0.0, -0.8, -0.6), facing(0.0, -0.6, -0.8)}), std::asin(0.6),
              1e-12);
  EXPECT_EQ(elevation_over({facing(0.0, -1.0, 0.05)}), 0.0) << "no lower than level";
}

TEST(ElevationOver, WallsAndCeilingsAreNoSupport) {
  EXPECT_LT(elevation_over({}), 0.0);
  EXPECT_LT(elevation_over({facing(0.0, 0.0, -1.0)}), 0.0);
  EXPECT_LT(elevation_over({facing(0.0, 0.9, -0.3)}), 0.0);
  EXPECT_LT(elevation_over({facing(0.36, -0.8, -0.5)}), 0.0) << "the camera rolls";
  EXPECT_LT(elevation_over({facing(-0.36, -0.8, -0.5)}), 0.0);
  EXPECT_NEAR(elevation_over({facing(0.34, -0.8, -0.5)}), std::asin(0.5), 1e-12);
  EXPECT_LT(elevation_over({facing(0.0, -0.9, 0.11)}), 0.0) << "it looks up at it";
  EXPECT_EQ(elevation_over({facing(0.0, -0.9, 0.1)}), 0.0);
  EXPECT_LT(elevation_over({facing(0.0, -0.25, -0.9)}), 0.0);
  EXPECT_NEAR(elevation_over({facing(0.0, -0.26, -0.9)}), std::asin(0.9), 1e-12);
}

TEST(PlaneTolerance, GrowsWithTheSquareOfTheDistance) {
  EXPECT_NEAR(plane_tolerance_m(0.0), 0.006, 1e-15);
  EXPECT_NEAR(plane_tolerance_m(2.0), 0.018, 1e-15);
  EXPECT_NEAR(facing(0.6, 0.0, -0.8).height_above({1.0, 5.0, 2.0}), 0.0, 1e-12);
  EXPECT_EQ(BackgroundPlane{}.height_above({3.0, 4.0, 0.5}), -0.5);
}

TEST_F(TableLimits, ThreePointsMakeAPlaneAndTwoDoNot) {
  options.min_area_m2 = 0.001;
  PointCloud cloud;
  cloud.points = {{0.01F, 0.01F, 0.71F}, {0.11F, 0.01F, 0.71F}, {0.01F, 0.11F, 0.71F}};
  const auto found = find(cloud);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_EQ(found.table->inliers, 3U);
  cloud.points.pop_back();
  EXPECT_THAT(find(cloud).reason, HasSubstr("no level surface"));
}

/// Strips of 4 cm, each level, 1.2 cm one above the other: tan(2a) = 0.24 / 0.464.
TEST_F(TableLimits, WhatIsLevelInPartsOnlyIsTilted) {
  PointCloud cloud = table_of_cells(2, 40, 0.7);
  append(cloud, table_of_cells(2, 40, 0.712, 0.04));
  const auto found = find(cloud);
  EXPECT_FALSE(found.table);
  EXPECT_EQ(found.reason,
            "the largest surface seen is tilted by 0.239 rad, more than table.max_tilt_rad 0.05");
}

/// Three points on it run clockwise as often as not.
TEST_F(TableLimits, OfASlopingTableAlmostAnyThreePointsDo) {
  options.hypotheses = 1;
  PointCloud cloud = table_of_cells(30, 24, 0.7);
  for (auto& p : cloud.points) p.z() += 0.02F * p.x();
  int found = 0;
  for (int i = 0; i < 40; ++i) found += find(cloud).table ? 1 : 0;
  EXPECT_GT(found, 30);
}

TEST_F(TableLimits, AHypothesisIsThreePoints) {
  options.hypotheses = 7;
  ASSERT_TRUE(find(table_of_cells(15, 12, 0.71)).table);
  Rng drawn(3);
  for (int i = 0; i < 7 * 3; ++i) drawn.uniform_index(180);
  EXPECT_EQ(rng.next(), drawn.next()) << "as many are tried as are asked for";
}

}  // namespace
}  // namespace vantage
