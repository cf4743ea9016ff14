// Against images of a table and a box, drawn ray by ray.
#include "vantage/perception/object_segmentation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace vantage {
namespace {

using Eigen::Vector3d;

const Vector3d kTable_m(0.3, -0.2, 0.7);
const ObjectSegmentationOptions kExact{.mask_growth_px = 0, .margin_px = 2};

/// A camera 1 m off that looks down on the table's middle by 45 deg, from that side.
Pose camera_at(double bearing_rad) {
  const Vector3d out(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
  const Vector3d z = -(out + Vector3d::UnitZ()).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Pose T = Pose::Identity();
  T.linear() << x, z.cross(x), z;
  T.translation() = kTable_m - z;
  return T;
}

/// Along the axes of the world.
struct Box {
  Vector3d middle_m;
  Vector3d half_m;
};

std::optional<double> meets(const Box& box, const Vector3d& from, const Vector3d& along) {
  const Eigen::Array3d a = (box.middle_m - box.half_m - from).array() / along.array();
  const Eigen::Array3d b = (box.middle_m + box.half_m - from).array() / along.array();
  const double enters = a.min(b).maxCoeff();
  const double leaves = a.max(b).minCoeff();
  if (enters < leaves && enters > 0.0) return enters;
  return std::nullopt;
}

struct Scene {
  std::vector<Box> boxes;
  double half_table_m = 0.5;
};

struct Drawn {
  CameraImages images;
  std::vector<std::uint8_t> first_box;  ///< 1 where it is seen
};

Drawn draw(const Scene& scene, const Pose& T_world_camera, double noise_m = 0.0) {
  Drawn drawn;
  CameraImages& image = drawn.images;
  image.width_px = 320;
  image.height_px = 240;
  image.focal_px = 290.0;
  image.range_max_m = 3.5;
  Rng rng(7);
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const Vector3d along = T_world_camera.linear() * image.ray(row, column);
      const Vector3d from = T_world_camera.translation();
      double depth_m = -from.z() / along.z();
      const double table_m = (kTable_m.z() - from.z()) / along.z();
      const Vector3d off = from + table_m * along - kTable_m;
      if (off.head<2>().cwiseAbs().maxCoeff() < scene.half_table_m) depth_m = table_m;
      bool first = false;
      for (const Box& box : scene.boxes) {
        const auto hit = meets(box, from, along);
        if (!hit || *hit >= depth_m) continue;
        depth_m = *hit;
        first = &box == scene.boxes.data();
      }
      drawn.first_box.push_back(first ? 1 : 0);
      image.depth_m.push_back(static_cast<float>(depth_m + noise_m * rng.normal()));
      for (int c = 0; c < 3; ++c) image.rgb.push_back(first ? 200 : 60);
    }
  }
  return drawn;
}

Box box_at(double x_m, double y_m, const Vector3d& size_m) {
  return {kTable_m + Vector3d(x_m, y_m, 0.5 * size_m.z()), 0.5 * size_m};
}

/// Intersection over union of the mask with the first box.
double overlap(const Drawn& drawn, const ObjectView& view) {
  int both = 0;
  int either = 0;
  for (int row = 0; row < drawn.images.height_px; ++row) {
    for (int column = 0; column < drawn.images.width_px; ++column) {
      const int r = row - view.top_px;
      const int c = column - view.left_px;
      const bool in_cut = r >= 0 && c >= 0 && r < view.height_px && c < view.width_px;
      const bool masked = in_cut && view.mask[view.index(r, c)] != 0;
      const auto pixel = static_cast<std::size_t>(row * drawn.images.width_px + column);
      const bool meant = drawn.first_box[pixel] != 0;
      both += masked && meant ? 1 : 0;
      either += masked || meant ? 1 : 0;
    }
  }
  return static_cast<double>(both) / either;
}

SegmentedObject segmented(const Drawn& drawn, const Pose& T_world_camera,
                          const ObjectSegmentationOptions& options = kExact) {
  Rng rng(1);
  return segment_object(drawn.images, T_world_camera, kTable_m, options, rng);
}

TEST(ObjectSegmentation, CutsABoxOutFromEverySide) {
  const Scene scene{{box_at(0.02, -0.01, {0.08, 0.12, 0.15})}};
  for (int i = 0; i < 6; ++i) {
    const Pose T_world_camera = camera_at(i * std::numbers::pi / 3.0 + 0.1);
    const Drawn drawn = draw(scene, T_world_camera, 0.002);
    const SegmentedObject found = segmented(drawn, T_world_camera);
    ASSERT_TRUE(found.view) << found.reason;
    EXPECT_GT(overlap(drawn, *found.view), 0.93) << "side " << i;
  }
}

TEST(ObjectSegmentation, KeepsTheFootThatIsLowerThanAnObjectMustBe) {
  const Pose T_world_camera = camera_at(0.7);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.03})}}, T_world_camera, 0.001);
  ObjectSegmentationOptions options = kExact;
  options.min_height_m = 0.015;  // half of it
  const SegmentedObject found = segmented(drawn, T_world_camera, options);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.93);
}

TEST(ObjectSegmentation, TakesAPoseThatIsOffAsItIs) {
  const Pose T_true = camera_at(0.4);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.07, 0.07, 0.03})}}, T_true, 0.002);
  Pose T_estimated = T_true * Eigen::AngleAxisd(0.02, Vector3d::UnitX());
  T_estimated.translation() += Vector3d(0.02, -0.015, 0.025);
  const SegmentedObject found = segmented(drawn, T_estimated);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.85);
}

TEST(ObjectSegmentation, TheViewIsThePartOfTheImageThatItSays) {
  const Pose T_world_camera = camera_at(1.0);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.1})}}, T_world_camera);
  const SegmentedObject found = segmented(drawn, T_world_camera);
  ASSERT_TRUE(found.view) << found.reason;
  const ObjectView& view = *found.view;
  EXPECT_NEAR((view.up - T_world_camera.linear().transpose() * Vector3d::UnitZ()).norm(), 0.0,
              1e-12);
  for (int row = 0; row < view.height_px; row += 5) {
    for (int column = 0; column < view.width_px; column += 5) {
      const float depth_m = drawn.images.depth_at(view.top_px + row, view.left_px + column);
      EXPECT_EQ(view.depth_m[view.index(row, column)], depth_m);
      const Vector3d meant = depth_m * drawn.images.ray(view.top_px + row, view.left_px + column);
      EXPECT_NEAR((view.point(row, column) - meant).norm(), 0.0, 1e-6);
    }
  }
  for (int column = 0; column < view.width_px; ++column) {
    EXPECT_EQ(view.mask[view.index(0, column)], 0) << "the margin is not the object's";
  }
}

TEST(ObjectSegmentation, LeavesAloneWhatStandsBesideTheMiddle) {
  const Pose T_world_camera = camera_at(2.0);
  const Drawn drawn =
      draw({{box_at(0.0, 0.0, {0.05, 0.05, 0.05}), box_at(0.38, 0.3, {0.1, 0.1, 0.2})}},
           T_world_camera, 0.001);
  const SegmentedObject found = segmented(drawn, T_world_camera);
  ASSERT_TRUE(found.view) << found.reason;
  EXPECT_GT(overlap(drawn, *found.view), 0.85);
}

TEST(ObjectSegmentation, GrowsTheMaskByWhatWasAskedFor) {
  const Pose T_world_camera = camera_at(0.0);
  const Drawn drawn = draw({{box_at(0.0, 0.0, {0.1, 0.1, 0.1})}}, T_world_camera);
  ObjectSegmentationOptions grown = kExact;
  grown.mask_growth_px = 2;
  const auto exact = segmented(drawn, T_world_camera).view;
  const auto wide = segmented(drawn, T_world_camera, grown).view;
  ASSERT_TRUE(exact && wide);
  EXPECT_EQ(wide->width_px, exact->width_px + 4);
  EXPECT_EQ(wide->height_px, exact->height_px + 4);
}

TEST(ObjectSegmentation, FillsABottomTooThinToTellButNotAHoleInTheTable) {
  const Pose T_world_camera = camera_at(0.0);
  const auto ring_round = [](double bottom_m) {
    Scene scene{{box_at(0.0, 0.0, {0.1, 0.1, bottom_m})}};
    for (const double side : {-1.0, 1.0}) {
      scene.boxes.push_back(box_at(0.06 * side, 0.0, {0.02, 0.14, 0.03}));
      scene.boxes.push_back(box_at(0.0, 0.06 * side, {0.1, 0.02, 0.03}));
    }
    return scene;
  };
  const auto pixels = [&](double bottom_m) {
    const auto found = segmented(draw(ring_round(bottom_m), T_world_camera, 0.001), T_world_camera);
    EXPECT_TRUE(found.view) << found.reason;
    return found.view ? std::ranges::count(found.view->mask, 1) : 0;
  };
  const Drawn bowl = draw(ring_round(0.004), T_world_camera);
  const auto bottom = std::ranges::count(bowl.first_box, 1);
  EXPECT_GT(pixels(0.004), pixels(0.0001) + bottom / 2);
}

TEST(ObjectSegmentation, SaysWhatIsMissing) {
  const Pose T_world_camera = camera_at(0.0);
  EXPECT_THAT(segmented(draw({}, T_world_camera, 0.002), T_world_camera).reason,
              testing::HasSubstr("rise from the table"));
  const Drawn floor = draw({.boxes = {}, .half_table_m = 0.0}, T_world_camera);
  EXPECT_THAT(segmented(floor, T_world_camera).reason, testing::StartsWith("no table"));
}

}  // namespace
}  // namespace vantage
