#include "vantage/perception/table_extraction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/synthetic_room.hpp"
#include "vantage/perception/clouds/normals.hpp"

namespace vantage {
namespace {

/// A rectangle of points 1 cm apart, rising by `slope` along x.
PointCloud surface(double x, double y, double z, double size_x, double size_y, double slope = 0.0) {
  PointCloud cloud;
  for (double u = -0.5 * size_x; u <= 0.5 * size_x; u += 0.01) {
    for (double v = -0.5 * size_y; v <= 0.5 * size_y; v += 0.01) {
      cloud.points.emplace_back(x + u, y + v, z + slope * u);
    }
  }
  return cloud;
}

double area(const std::vector<Eigen::Vector2d>& hull) {
  double twice = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const auto& a = hull[i];
    const auto& b = hull[(i + 1) % hull.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

class FindTable : public testing::Test {
 protected:
  TableSearch find(const PointCloud& cloud) { return find_table(cloud, options, rng); }
  TableOptions options;
  Rng rng{5};
};

TEST_F(FindTable, HeightHullAndNormal) {
  PointCloud cloud = surface(0.1, -0.2, 0.72, 1.0, 0.8);
  for (auto& p : cloud.points) p.z() += static_cast<float>(0.003 * rng.normal());
  const auto found = find(cloud);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_TRUE(found.reason.empty());
  EXPECT_NEAR(found.table->height_m, 0.72, 0.001);
  EXPECT_GT(found.table->normal.z(), std::cos(0.01));
  EXPECT_NEAR(area(found.table->hull), 0.8, 0.05);
  EXPECT_TRUE(inside_hull(found.table->hull, {0.55, 0.15}));
  EXPECT_FALSE(inside_hull(found.table->hull, {0.65, 0.15}));
}

//   z
//   2.0  ~~~~~~~~~~~~~~~~   ceiling: larger, above the band
//   0.72     ________       table
//   0.0  ________________   floor: larger, below the band
TEST_F(FindTable, FloorAndCeilingAreOutsideTheBand) {
  PointCloud cloud = surface(0, 0, 0.0, 1.9, 1.9);
  append(cloud, surface(0, 0, 2.0, 1.9, 1.9));
  EXPECT_FALSE(find(cloud).table);
  append(cloud, surface(0, 0, 0.72, 0.8, 0.8));
  const auto found = find(cloud);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_NEAR(found.table->height_m, 0.72, 1e-4);
}

TEST_F(FindTable, LargerOfTwoSurfacesAtTheSamePlace) {
  PointCloud cloud = surface(0, 0, 0.72, 1.0, 1.0);
  append(cloud, surface(0.1, 0.1, 0.92, 0.3, 0.3));  // the lid of a box
  EXPECT_NEAR(find(cloud).table->height_m, 0.72, 1e-4);
}

// Twice as many points do not make a surface twice as large.
TEST_F(FindTable, AreaCountsAndNotTheDensityOfBeams) {
  PointCloud cloud = surface(0, 0, 0.72, 0.6, 0.6);
  for (int i = 0; i < 5; ++i) append(cloud, surface(0.1, 0.1, 0.92 + 0.0001 * i, 0.4, 0.4));
  EXPECT_NEAR(find(cloud).table->height_m, 0.72, 1e-4);
}

TEST_F(FindTable, OfTwoTablesTheOneInTheRegion) {
  PointCloud cloud = surface(0, 0, 0.70, 0.8, 0.8);
  append(cloud, surface(4, 0, 0.80, 1.6, 1.6));
  EXPECT_NEAR(find(cloud).table->height_m, 0.70, 1e-4);
  options.region_centre_m = {4.0, 0.0};
  EXPECT_NEAR(find(cloud).table->height_m, 0.80, 1e-4);
}

TEST_F(FindTable, ATiltedPlaneIsNoTable) {
  const auto found = find(surface(0, 0, 0.72, 1.0, 1.0, 0.2));
  EXPECT_FALSE(found.table && found.table->inliers > 1000);
  options.max_tilt_rad = 0.3;
  EXPECT_TRUE(find(surface(0, 0, 0.72, 1.0, 1.0, 0.2)).table);
}

TEST_F(FindTable, ATiltedPlaneWithNormalsSaysSo) {
  PointCloud cloud = surface(0, 0, 0.72, 1.0, 1.0, 0.5);
  estimate_normals(cloud, {0, 0, 3}, {.radius_m = 0.03});
  const auto found = find(cloud);
  EXPECT_FALSE(found.table);
  EXPECT_NE(found.reason.find("no level surface"), std::string::npos) << found.reason;
  EXPECT_NE(found.reason.find("min_height_m"), std::string::npos) << found.reason;
}

TEST_F(FindTable, NothingThereHasAReason) {
  EXPECT_NE(find({}).reason.find("no level surface"), std::string::npos);
  const auto small = find(surface(0, 0, 0.72, 0.1, 0.1));
  EXPECT_FALSE(small.table);
  EXPECT_NE(small.reason.find("less than min_area_m2 0.04"), std::string::npos) << small.reason;
}

TEST_F(FindTable, VerticalSurfacesAreLeftOutByTheirNormals) {
  PointCloud wall;
  for (double y = -0.9; y <= 0.9; y += 0.01) {
    for (double z = 0.45; z <= 1.15; z += 0.01) wall.points.emplace_back(0.8, y, z);
  }
  PointCloud cloud = surface(0, 0, 0.72, 0.4, 0.4);
  append(cloud, wall);
  estimate_normals(cloud, {0, 0, 3}, {.radius_m = 0.03});
  const auto found = find(cloud);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_NEAR(found.table->height_m, 0.72, 1e-3);
  EXPECT_LT(found.table->hull.back().x(), 0.3);
}

// What a robot sees: a sector of the table, its objects, floor and walls, with noise.
TEST_F(FindTable, InAScanOfARoom) {
  const auto scene = support::table_scene();
  const Pose T_world_sensor = to_se3(support::view_of_table(0.4), 1.05);
  auto cloud = transform(to_cloud(support::sector_scan(scene, T_world_sensor, 600, 0.005, rng)),
                         T_world_sensor);
  const auto found = find(cloud);
  ASSERT_TRUE(found.table) << found.reason;
  EXPECT_NEAR(found.table->height_m, support::kTableHeight, 0.003);
  EXPECT_LT(std::acos(found.table->normal.z()), 0.02);
  const PointCloud objects = objects_on_table(cloud, *found.table, {.min_height_m = 0.02});
  ASSERT_GT(objects.size(), 500U);
  for (const auto& p : objects.points) {
    EXPECT_LT(p.head<2>().cwiseAbs().maxCoeff(), 0.55F);
    EXPECT_GT(p.z(), support::kTableHeight);
    EXPECT_LT(p.z(), support::kTableHeight + 0.30);
  }
}

// Two sectors of one table: |####|   | and |   |####|.
TEST(MergeTable, IsTheFitOfAllPointsAtOnce) {
  Rng rng(5);
  const TableOptions options;
  PointCloud left = surface(-0.25, 0, 0.72, 0.4, 0.8);
  PointCloud right = surface(0.30, 0, 0.725, 0.4, 0.8);
  TablePlane table = find_table(left, options, rng).table.value();
  const TablePlane seen = find_table(right, options, rng).table.value();
  ASSERT_TRUE(merge_table(table, seen, options.max_step_m));
  append(left, right);
  const TablePlane all = find_table(left, options, rng).table.value();
  EXPECT_EQ(table.inliers, all.inliers);
  EXPECT_NEAR(table.height_m, all.height_m, 1e-6);
  EXPECT_LT((table.normal - all.normal).norm(), 1e-6);
  EXPECT_NEAR(area(table.hull), area(all.hull), 1e-6);
  EXPECT_TRUE(inside_hull(table.hull, {0.0, 0.0}));  // between the sectors
}

TEST(MergeTable, AnotherHeightIsAnotherTable) {
  Rng rng(5);
  const TableOptions options;
  TablePlane table = find_table(surface(0, 0, 0.72, 0.5, 0.5), options, rng).table.value();
  const TablePlane other = find_table(surface(0, 0, 0.80, 0.5, 0.5), options, rng).table.value();
  const auto inliers = table.inliers;
  EXPECT_FALSE(merge_table(table, other, options.max_step_m));
  EXPECT_EQ(table.inliers, inliers);
  EXPECT_NEAR(table.height_m, 0.72, 1e-4);
}

TEST(ObjectsOnTable, OnlyAboveThePlaneAndInsideTheHull) {
  Rng rng(5);
  const TablePlane table =
      find_table(surface(0, 0, 0.72, 1.0, 1.0), TableOptions{}, rng).table.value();
  PointCloud cloud;
  cloud.points = {
      {0, 0, 0.80F},     // an object
      {0, 0, 0.725F},    // the table with noise
      {0, 0, 0.60F},     // below
      {0, 0, 1.60F},     // a lamp
      {0.52F, 0, 0.80F}  // a chair beside the table
  };
  cloud.normals.assign(cloud.points.size(), Eigen::Vector3f::UnitZ());
  const PointCloud objects = objects_on_table(cloud, table);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects.points[0], cloud.points[0]);
  EXPECT_TRUE(objects.has_normals());
  EXPECT_EQ(objects_on_table(cloud, table, {.hull_margin_m = 0.05}).size(), 2U);
}

TEST(ConvexHull, KnownSquare) {
  const auto hull = convex_hull({{0, 0}, {1, 0}, {0.5, 0.5}, {1, 1}, {0, 1}, {0.5, 0}, {0, 0}});
  ASSERT_EQ(hull.size(), 4U);
  EXPECT_DOUBLE_EQ(area(hull), 1.0);
}

TEST(ConvexHull, DegenerateContainsNothing) {
  EXPECT_FALSE(inside_hull(convex_hull({}), {0, 0}));
  EXPECT_FALSE(inside_hull(convex_hull({{0, 0}}), {0, 0}));
  EXPECT_FALSE(inside_hull(convex_hull({{0, 0}, {1, 1}, {2, 2}}), {1, 1}));
}

RC_GTEST_PROP(ConvexHull, HoldsAllPointsAndTurnsLeft, (std::uint64_t seed)) {
  Rng rng(seed);
  std::vector<Eigen::Vector2d> points;
  const std::size_t count = 3 + rng.uniform_index(60);
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(rng.normal(), rng.normal());
  const auto hull = convex_hull(points);
  RC_ASSERT(hull.size() >= 3U);
  RC_ASSERT(area(hull) > 0.0);
  for (const auto& p : points) RC_ASSERT(inside_hull(hull, p, 1e-9));
  for (const auto& corner : hull) RC_ASSERT(std::ranges::find(points, corner) != points.end());
}

TEST(TableOptions, AreChecked) {
  TableOptions table;
  EXPECT_NO_THROW(check_options(table));
  table.min_height_m = 2.0;
  EXPECT_THROW(check_options(table), ConfigError);
  ObjectCropOptions objects;
  objects.min_height_m = 0.7;
  EXPECT_THROW(check_options(objects), ConfigError);
}

}  // namespace
}  // namespace vantage
