#include "vantage/perception/features/kit/object_surface.hpp"

#include <gtest/gtest.h>

#include "tests/support/object_views.hpp"

namespace vantage {
namespace {

TEST(ObjectSurface, NormalsOfABallPointFromItsCentre) {
  Rng rng(1);
  const BallLook look;
  const ObjectView view = ball_view(140, look, rng);
  const ObjectPixels pixels = object_pixels(view);
  const ObjectSurface surface = object_surface(view, pixels, 0.005);
  ASSERT_EQ(surface.cloud.size(), static_cast<std::size_t>(pixels.depth_count));
  ASSERT_GT(pixels.depth_count, 5000);
  const Eigen::Vector3f centre(0.0F, 0.0F, static_cast<float>(look.distance_m));
  double sum = 0.0;
  for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
    const Eigen::Vector3f out = (surface.cloud.points[i] - centre).normalized();
    sum += static_cast<double>(out.dot(surface.cloud.normals[i]));
  }
  EXPECT_GT(sum / static_cast<double>(surface.cloud.size()), 0.99);
}

TEST(ObjectSurface, PointsAreFoundByTheirPixels) {
  Rng rng(1);
  const ObjectView view = ball_view(40, {.radius_m = 0.03}, rng);
  const ObjectSurface surface = object_surface(view, object_pixels(view), 0.01);
  const int point = surface.point_at[view.index(20, 20)];
  ASSERT_GE(point, 0);
  EXPECT_TRUE(surface.cloud.points[static_cast<std::size_t>(point)].isApprox(
      view.point(20, 20).cast<float>()));
  EXPECT_EQ(surface.point_at[view.index(0, 0)], -1);
}

TEST(ObjectSurface, ALineHasNoNormals) {
  ObjectView view = blank_view(40, 40);
  for (int column = 0; column < 40; ++column) {
    view.mask[view.index(20, column)] = 1;
    view.depth_m[view.index(20, column)] = 1.0F;
  }
  const ObjectSurface surface = object_surface(view, object_pixels(view), 0.02);
  ASSERT_EQ(surface.cloud.size(), 40U);
  for (const auto& normal : surface.cloud.normals) EXPECT_TRUE(normal.isZero());
}

/// Two columns of a millimetre, of which each row is so much farther away than the one above: of
/// the spreads the second is to the first as 0.75 or 1.25 to 10000.
TEST(ObjectSurface, ALineIsAHundredTimesAsLongAsWide) {
  const auto has_normal = [](double step_m) {
    ObjectView view = blank_view(2, 17);
    view.focal_px = 1000.0;
    view.centre_px = {view.left_px + 0.5, view.top_px + 8.0};
    for (int i = 0; i < 34; ++i) {
      view.depth_m[static_cast<std::size_t>(i)] = static_cast<float>(1.0 + step_m * (i / 2 - 8));
    }
    ObjectPixels pixels;
    pixels.width_px = 2;
    pixels.height_px = 17;
    pixels.depth.assign(34, 1);
    pixels.depth_count = 34;
    const ObjectSurface surface = object_surface(view, pixels, 0.05);
    return !surface.cloud.normals[view.index(8, 0)].isZero();
  };
  EXPECT_TRUE(has_normal(0.0091));
  EXPECT_FALSE(has_normal(0.0117));
}

TEST(ObjectSurface, IntrinsicsThatAreNoNumbersAreNamed) {
  ObjectView view = blank_view(2, 2);
  EXPECT_TRUE(lacks_geometry(view).empty());
  view.focal_px = 0.0;
  EXPECT_FALSE(lacks_geometry(view).empty());
}

}  // namespace
}  // namespace vantage
