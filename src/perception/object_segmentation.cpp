#include "vantage/perception/object_segmentation.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vantage/perception/column_cut.hpp"
#include "vantage/perception/table_segmentation.hpp"

namespace vantage {
namespace {

/// The largest patch; returns its pixels.
int keep_largest(cv::Mat1b& mask) {
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centres, 8);
  int best = 0;
  int most = 0;
  for (int label = 1; label < count; ++label) {
    const int pixels = statistics.at<int>(label, cv::CC_STAT_AREA);
    if (pixels > most) std::tie(best, most) = std::pair(label, pixels);
  }
  mask = most > 0 ? cv::Mat1b(labels == best) : mask;
  return most;
}

}  // namespace

void take_colour(const CameraImages& images, ObjectView& view) {
  view.rgb.clear();
  for (int row = view.top_px; row < view.top_px + view.height_px; ++row) {
    const auto first = static_cast<std::ptrdiff_t>(row) * images.width_px + view.left_px;
    view.rgb.insert(view.rgb.end(), images.rgb.begin() + 3 * first,
                    images.rgb.begin() + 3 * (first + view.width_px));
  }
}

SegmentedObject segment_object(const CameraImages& images, const Pose& T_world_camera,
                               const Eigen::Vector3d& p_world_table_m,
                               const ObjectSegmentationOptions& options, Rng& rng) {
  const TableSearch found = find_table_top(images, T_world_camera, p_world_table_m, options, rng);
  if (!found.table) return {std::nullopt, "no table: " + found.reason, false};
  return segment_on_table(images, T_world_camera, *found.table, p_world_table_m, options);
}

SegmentedObject segment_on_table(const CameraImages& images, const Pose& T_world_camera,
                                 const TablePlane& table, const Eigen::Vector3d& p_world_table_m,
                                 const ObjectSegmentationOptions& options) {
  const cv::Rect place = place_of_column(images, T_world_camera, p_world_table_m, options);
  if (place.empty()) return {std::nullopt, "the image does not show the place", false};
  const Patch patch = patch_of(images, place);
  const cv::Mat1f heights_m =
      heights_over(patch, images, T_world_camera, table, p_world_table_m, options);
  cv::Mat1b mask = heights_m >= options.min_height_m;
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, square(1));
  add_unmeasured(mask, patch.depth_m);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, square(2));
  const int pixels = keep_largest(mask);
  if (pixels < options.min_pixels) {
    return {std::nullopt, fmt::format("{} pixels rise from the table, an object has at least {}",
                                      pixels, options.min_pixels)};
  }
  const double distance_m = (T_world_camera.translation() - p_world_table_m).norm();
  add_foot(mask, heights_m, images, distance_m, options.min_height_m);
  fill_holes(mask, heights_m, kLow * options.min_height_m);
  if (options.mask_growth_px > 0) cv::dilate(mask, mask, square(options.mask_growth_px));
  SegmentedObject object{cut(images, mask, place.tl(), options.margin_px), {}};
  object.view->up = T_world_camera.linear().transpose() * Eigen::Vector3d::UnitZ();
  return object;
}

}  // namespace vantage
