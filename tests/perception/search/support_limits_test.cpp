// Limits of the search for support surfaces and objects, on level grids of points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "vantage/perception/search/object_search.hpp"
#include "vantage/perception/search/support_search.hpp"

namespace vantage {
namespace {

/// A point every 2 cm of a rectangle round (x, y), rising along x.
PointCloud level_grid(double x, double y, double z, int columns, int rows, double slope = 0.0) {
  PointCloud cloud;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double u = 0.02 * (i - 0.5 * (columns - 1));
      cloud.points.emplace_back(x + u, y + 0.02 * (j - 0.5 * (rows - 1)), z + slope * u);
    }
  }
  return cloud;
}

TEST(SupportLimits, ALevelSurfaceIsFoundWhereItIs) {
  const auto supports = find_supports(level_grid(1.2, -0.7, 0.805, 26, 21), {});
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_NEAR(supports[0].height_m, 0.805, 1e-6);
  EXPECT_LT((supports[0].centroid_m - Eigen::Vector3d(1.2, -0.7, 0.805)).norm(), 1e-6);
  EXPECT_LT((supports[0].normal - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
  EXPECT_EQ(supports[0].inliers, 26U * 21U);
  EXPECT_TRUE(inside_hull(supports[0].hull, {1.2 + 0.249, -0.7 - 0.199}));
  EXPECT_FALSE(inside_hull(supports[0].hull, {1.2 + 0.251, -0.7}));
  EXPECT_NEAR(supports[0].scatter_m2(2, 2), 0.0, 1e-9);
  EXPECT_NEAR(supports[0].scatter_m2(0, 0), 21.0 * 4e-4 * 26.0 * (26.0 * 26.0 - 1.0) / 12.0, 1e-4);
}

TEST(SupportLimits, HeightsAreBetweenTheTwo) {
  const auto found_at = [](double z_m) {
    return find_supports(level_grid(0.0, 0.0, z_m, 21, 21), {}).size();
  };
  EXPECT_EQ(found_at(0.29), 0U);
  EXPECT_EQ(found_at(0.31), 1U);
  EXPECT_EQ(found_at(1.49), 1U);
  EXPECT_EQ(found_at(1.51), 0U);
}

/// Of 50 by 40 cm.
TEST(SupportLimits, AreaIsAtLeastWhatIsAskedFor) {
  const PointCloud grid = level_grid(0.0, 0.0, 0.8, 26, 21);
  EXPECT_EQ(find_supports(grid, {.min_area_m2 = 0.19}).size(), 1U);
  EXPECT_EQ(find_supports(grid, {.min_area_m2 = 0.27}).size(), 0U);
}

TEST(SupportLimits, SurfacesApartAreTwo) {
  PointCloud grid = level_grid(0.0, 0.0, 0.8, 21, 21);
  append(grid, level_grid(0.0, 1.0, 0.8, 21, 21));
  const auto supports = find_supports(grid, {});
  ASSERT_EQ(supports.size(), 2U);
  EXPECT_NEAR(std::abs(supports[0].centroid_m.y() - supports[1].centroid_m.y()), 1.0, 1e-5);
}

TEST(SupportLimits, ATiltIsFittedUpToItsLimit) {
  const auto slight = find_supports(level_grid(0.0, 0.0, 0.8, 26, 21, 0.05), {});
  ASSERT_EQ(slight.size(), 1U);
  const double variance = 4e-4 * (26.0 * 26.0 - 1.0) / 12.0;
  const double slope = 0.05 * variance / (variance + 4e-4);
  EXPECT_LT((slight[0].normal - Eigen::Vector3d(-slope, 0.0, 1.0).normalized()).norm(), 1e-5);
  const auto steep = find_supports(level_grid(0.0, 0.0, 0.8, 11, 21, 0.2), {});
  ASSERT_EQ(steep.size(), 1U);
  EXPECT_NEAR(steep[0].normal.z(), std::cos(0.08), 1e-9);
  EXPECT_LT(steep[0].normal.x(), 0.0);
}

TEST(SupportLimits, NothingComesOfNothing) {
  EXPECT_TRUE(find_supports({}, {}).empty());
  EXPECT_TRUE(find_supports(level_grid(0.0, 0.0, 0.1, 26, 21), {}).empty());
}

TEST(CutAt, AnObjectMustStandOutOfTheNoiseThere) {
  ObjectSearchOptions options;
  EXPECT_NEAR(cut_at(options, 0.0).min_height_m, 0.006, 1e-12);
  EXPECT_NEAR(cut_at(options, 2.0).min_height_m, 0.006 + 1.5 * 0.0008 * 4.0, 1e-12);
  options.noise_per_m = 0.01;
  options.cut.min_height_m = 0.02;
  EXPECT_NEAR(cut_at(options, 3.0).min_height_m, 0.02 + 0.135, 1e-12);
  EXPECT_EQ(cut_at(options, 3.0).radius_m, 0.3);
  EXPECT_EQ(cut_at(options, 3.0).min_pixels, 60);
}

TEST(DetectionsOf, AreThoseOfTheObjectsInTheirOrder) {
  std::vector<SeenObject> seen(2);
  seen[0].detection.distance_m = 2.5;
  seen[1].detection.distance_m = 1.5;
  seen[1].detection.pixels = 77;
  const auto detections = detections_of(seen);
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].distance_m, 2.5);
  EXPECT_EQ(detections[1].distance_m, 1.5);
  EXPECT_EQ(detections[1].pixels, 77);
}

/// Cells of 1/16 m from the first point on: 4 cm, 12 cm and 14 cm are one, two and three of them.
TEST(SupportLimits, ASurfaceIsThreeCellsWide) {
  const SupportSearchOptions sixteenths{.cell_m = 0.0625};
  EXPECT_TRUE(find_supports(level_grid(0.0, 0.0, 0.8, 3, 51), sixteenths).empty());
  EXPECT_TRUE(find_supports(level_grid(0.0, 0.0, 0.8, 7, 51), sixteenths).empty());
  EXPECT_EQ(find_supports(level_grid(0.0, 0.0, 0.8, 8, 51), sixteenths).size(), 1U);
}

/// Points at one height count in five bins of 1 cm; the middle of the lowest is theirs.
TEST(SupportLimits, PointsAreWithinTwoInlierDistancesOfTheirHeight) {
  const double off_m = 0.5 - 48.5 * 0.01;
  const auto found_with = [](double inlier_m) {
    const SupportSearchOptions options{
        .min_height_m = 0.0, .max_height_m = 1.0, .inlier_distance_m = inlier_m};
    return find_supports(level_grid(0.0, 0.0, 0.5, 26, 21), options).size();
  };
  EXPECT_EQ(found_with(0.5 * off_m), 1U);
  EXPECT_EQ(found_with(0.499 * off_m), 0U);
}

TEST(SupportLimits, OfTwoAtAboutOneHeightTheOneOfMorePointsStays) {
  PointCloud grid = level_grid(0.0, 0.0, 0.8, 12, 12);
  append(grid, level_grid(0.0, 0.0, 0.85, 26, 21));
  const auto supports = find_supports(grid, {});
  ASSERT_EQ(supports.size(), 1U);
  EXPECT_NEAR(supports[0].height_m, 0.85, 1e-6);
  EXPECT_EQ(supports[0].inliers, 26U * 21U);
}

}  // namespace
}  // namespace vantage
