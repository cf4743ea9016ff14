#include "vantage/perception/clouds/normals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

/// A square patch of side 0.6 m in the plane spanned by `u` and `v`, with noise across it.
PointCloud patch(const Eigen::Vector3d& centre, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                 double sigma_m, Rng& rng) {
  PointCloud cloud;
  const Eigen::Vector3d across = u.cross(v);
  for (double a = -0.3; a <= 0.3; a += 0.02) {
    for (double b = -0.3; b <= 0.3; b += 0.02) {
      const Eigen::Vector3d p = centre + a * u + b * v + sigma_m * rng.normal() * across;
      cloud.points.emplace_back(p.cast<float>());
    }
  }
  return cloud;
}

RC_GTEST_PROP(EstimateNormals, PlaneSeenFromEitherSide, (std::uint64_t seed)) {
  Rng rng(seed);
  const Eigen::Vector3d random(rng.normal(), rng.normal(), rng.normal());
  const Eigen::Vector3d normal = random.normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d centre(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2));
  for (const double side : {1.0, -1.0}) {
    PointCloud cloud = patch(centre, u, normal.cross(u), 0.0, rng);
    estimate_normals(cloud, centre + side * 2.0 * normal);
    RC_ASSERT(cloud.has_normals());
    for (const auto& n : cloud.normals) {
      RC_ASSERT((n.cast<double>() - side * normal).norm() < 1e-3);
    }
  }
}

TEST(EstimateNormals, NoiseTurnsThemLittle) {
  Rng rng(3);
  PointCloud cloud = patch({1, 0, 1}, {0, 1, 0}, {0, 0, 1}, 0.005, rng);
  estimate_normals(cloud, {0, 0, 1}, {.radius_m = 0.12});
  double sum = 0.0;
  for (const auto& n : cloud.normals) sum += std::acos(std::min(1.0, -static_cast<double>(n.x())));
  EXPECT_LT(sum / static_cast<double>(cloud.size()), 0.05);
}

//   wall  o o o o o o o o      seen from above; all points at one height
//                 ^
//              scanner
TEST(EstimateNormals, HorizontalLineGetsTheNormalAcrossIt) {
  Rng rng(3);
  PointCloud wall;
  for (double x = -1.0; x <= 1.0; x += 0.02) {
    wall.points.emplace_back(x, 2.0 + 0.005 * rng.normal(), 0.25);
  }
  estimate_normals(wall, {0, 0, 1.05}, {.radius_m = 0.15});
  for (const auto& n : wall.normals) {
    EXPECT_EQ(n.z(), 0.0F);
    EXPECT_LT(n.y(), -0.95F);
  }
}

TEST(EstimateNormals, OtherLinesAndLonelyPointsHaveNone) {
  PointCloud cloud;
  for (double z = 0.0; z <= 1.0; z += 0.02) cloud.points.emplace_back(1.0, 0.0, z);
  cloud.points.emplace_back(-3.0F, 0.0F, 0.0F);
  estimate_normals(cloud, {0, 0, 0});
  ASSERT_EQ(cloud.normals.size(), cloud.points.size());
  for (const auto& n : cloud.normals) EXPECT_TRUE(n.isZero());
}

TEST(EstimateNormals, IdenticalPointsHaveNone) {
  PointCloud cloud;
  cloud.points.assign(20, Eigen::Vector3f(1, 1, 1));
  estimate_normals(cloud, {0, 0, 0});
  for (const auto& n : cloud.normals) EXPECT_TRUE(n.isZero());
}

TEST(EstimateNormals, EmptyCloud) {
  PointCloud cloud;
  estimate_normals(cloud, {0, 0, 0});
  EXPECT_TRUE(cloud.normals.empty());
}

/// A rectangle of four corners and its middle, all within 8 cm of each other.
PointCloud few_points(double half_x_m, double half_y_m) {
  PointCloud cloud;
  for (const double x : {-half_x_m, half_x_m}) {
    for (const double y : {-half_y_m, half_y_m}) cloud.points.emplace_back(x, y, 1.0);
  }
  cloud.points.emplace_back(0.0F, 0.0F, 1.0F);
  return cloud;
}

TEST(EstimateNormals, FivePointsAreEnoughAndFourAreNot) {
  PointCloud five = few_points(0.03, 0.02);
  estimate_normals(five, {0, 0, 0});
  for (const auto& n : five.normals) EXPECT_NEAR(n.z(), -1.0F, 1e-5F);
  PointCloud four = five;
  four.points.pop_back();
  estimate_normals(four, {0, 0, 0});
  for (const auto& n : four.normals) EXPECT_TRUE(n.isZero());
}

TEST(EstimateNormals, NeighboursAreNearerThanTheRadius) {
  PointCloud cloud = few_points(0.039, 0.035);  // its diagonal is longer than 8 cm
  estimate_normals(cloud, {0, 0, 0});
  EXPECT_NEAR(cloud.normals[4].z(), -1.0F, 1e-5F) << "the middle has four";
  EXPECT_TRUE(cloud.normals[0].isZero()) << "a corner does not reach the opposite one";
}

/// Of variances 16 to 1 along x and y; the ratio is 0.0625.
TEST(EstimateNormals, ALineIsMuchLongerThanWide) {
  PointCloud cloud = few_points(0.032, 0.008);
  estimate_normals(cloud, {0, 0, 0}, {.line_ratio = 0.06});
  EXPECT_NEAR(cloud.normals[4].z(), -1.0F, 1e-5F);
  estimate_normals(cloud, {0, -1, 1}, {.line_ratio = 0.065});
  EXPECT_NEAR(cloud.normals[4].y(), -1.0F, 1e-4F) << "across the line, and level";
}

TEST(EstimateNormals, ALineMayRiseByTenDegrees) {
  for (const double sine : {0.16, 0.18}) {
    PointCloud line;
    for (int i = -10; i <= 10; ++i) {
      line.points.emplace_back(0.01 * i * std::sqrt(1.0 - sine * sine), 2.0, 0.01 * i * sine);
    }
    estimate_normals(line, {0, 0, 0});
    EXPECT_NEAR(line.normals[10].norm(), sine < 0.17 ? 1.0F : 0.0F, 1e-5F) << sine;
    EXPECT_NEAR(line.normals[10].y(), sine < 0.17 ? -1.0F : 0.0F, 1e-3F) << sine;
  }
}

/// Just 16 to 1: a line is below the ratio.
TEST(EstimateNormals, AtTheRatioItIsNoLineYet) {
  PointCloud cloud = few_points(0.032, 0.008);
  estimate_normals(cloud, {0, 0, 0}, {.line_ratio = 0.0625});
  EXPECT_NEAR(cloud.normals[4].z(), -1.0F, 1e-5F);
}

}  // namespace
}  // namespace vantage
