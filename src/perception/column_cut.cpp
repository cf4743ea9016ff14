#include "vantage/perception/column_cut.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

constexpr double kTableInlier_m = 0.008;

/// A plane fitted to thinned points lies a millimetre off the surface round the object, which is a
/// third of what tells its foot from noise.
void move_to_surface(const cv::Mat1f& heights_m, TablePlane& table) {
  std::vector<double> near_m;
  for (const float height_m : heights_m) {
    if (std::abs(height_m) <= kTableInlier_m) near_m.push_back(height_m);
  }
  if (near_m.empty()) return;
  const auto middle = near_m.begin() + std::ssize(near_m) / 2;
  std::ranges::nth_element(near_m, middle);
  table.centroid_m += *middle * table.normal;
  table.height_m = table.centroid_m.z();
}

}  // namespace

cv::Rect place_of_column(const CameraImages& images, const Pose& T_world_camera,
                         const Eigen::Vector3d& p_world_table_m,
                         const ObjectSegmentationOptions& options) {
  constexpr double kBelow_m = 0.05;
  constexpr double kNearest_m = 0.1;
  constexpr int kMargin_px = 8;
  const cv::Rect all(0, 0, images.width_px, images.height_px);
  const Pose T_camera_world = T_world_camera.inverse();
  const Eigen::Array2d centre(0.5 * (images.width_px - 1), 0.5 * (images.height_px - 1));
  Eigen::AlignedBox2d bounds;
  for (int corner = 0; corner < 8; ++corner) {
    const double r = options.radius_m;
    const Eigen::Vector3d off((corner & 1) != 0 ? r : -r, (corner & 2) != 0 ? r : -r,
                              (corner & 4) != 0 ? options.max_height_m : -kBelow_m);
    const Eigen::Vector3d p = T_camera_world * Eigen::Vector3d(p_world_table_m + off);
    if (p.z() < kNearest_m) return all;
    bounds.extend((p.head<2>() / p.z() * images.focal_px).array().matrix() + centre.matrix());
  }
  const double far = 1e6;
  const Eigen::Array2i low = bounds.min().array().max(-far).floor().cast<int>() - kMargin_px;
  const Eigen::Array2i high = bounds.max().array().min(far).ceil().cast<int>() + kMargin_px + 1;
  return cv::Rect(cv::Point(low.x(), low.y()), cv::Point(high.x(), high.y())) & all;
}

Patch patch_of(const CameraImages& images, const cv::Rect& place) {
  cv::Mat1f depth(place.size());
  for (int row = 0; row < place.height; ++row) {
    for (int column = 0; column < place.width; ++column) {
      depth(row, column) = images.depth_at(place.y + row, place.x + column);
    }
  }
  Patch patch{place, {}};
  cv::medianBlur(depth, patch.depth_m, 3);
  return patch;
}

TableSearch find_table_top(const CameraImages& images, const Pose& T_world_camera,
                           const Eigen::Vector3d& p_world_table_m,
                           const ObjectSegmentationOptions& options, Rng& rng) {
  constexpr int kStride_px = 2;
  TableOptions table;
  table.region_centre_m = {p_world_table_m.x(), p_world_table_m.y()};
  table.region_size_m = {4.0 * options.radius_m, 4.0 * options.radius_m};
  const double region_m2 = table.region_size_m[0] * table.region_size_m[1];
  table.min_area_m2 = std::min(table.min_area_m2, 0.25 * region_m2);
  table.min_height_m = p_world_table_m.z() - options.table_tolerance_m;
  table.max_height_m = p_world_table_m.z() + options.table_tolerance_m;
  table.inlier_distance_m = kTableInlier_m;
  TableSearch found =
      find_table(transform(to_cloud(images, kStride_px), T_world_camera), table, rng);
  const cv::Rect place = place_of_column(images, T_world_camera, p_world_table_m, options);
  if (!found.table || place.empty()) return found;
  const Patch patch = patch_of(images, place);
  move_to_surface(
      heights_over(patch, images, T_world_camera, *found.table, p_world_table_m, options),
      *found.table);
  return found;
}

cv::Mat1f heights_over(const Patch& patch, const CameraImages& images, const Pose& T_world_camera,
                       const TablePlane& table, const Eigen::Vector3d& p_world_table_m,
                       const ObjectSegmentationOptions& options) {
  cv::Mat1f heights_m(patch.place.size(), kOutside);
  for (int row = 0; row < heights_m.rows; ++row) {
    for (int column = 0; column < heights_m.cols; ++column) {
      const float z_m = patch.depth_m(row, column);
      if (!(z_m > 0.0F) || !std::isfinite(z_m)) continue;
      const Eigen::Vector3d p =
          T_world_camera * (z_m * images.ray(patch.place.y + row, patch.place.x + column));
      const double height_m = table.height_above(p);
      const double off_m = (p - p_world_table_m).head<2>().norm();
      if (off_m > options.radius_m || height_m > options.max_height_m) continue;
      heights_m(row, column) = static_cast<float>(height_m);
    }
  }
  return heights_m;
}

void fill_holes(cv::Mat1b& mask, const cv::Mat1f& heights_m, double min_height_m) {
  const cv::Mat1b beside = mask == 0;
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(beside, labels, statistics, centres, 4);
  for (int label = 1; label < count; ++label) {
    const cv::Rect box(statistics.at<int>(label, cv::CC_STAT_LEFT),
                       statistics.at<int>(label, cv::CC_STAT_TOP),
                       statistics.at<int>(label, cv::CC_STAT_WIDTH),
                       statistics.at<int>(label, cv::CC_STAT_HEIGHT));
    const bool enclosed =
        box.x > 0 && box.y > 0 && box.br().x < mask.cols && box.br().y < mask.rows;
    const cv::Mat hole = labels(box) == label;
    if (enclosed && cv::mean(heights_m(box), hole)[0] > min_height_m) mask(box).setTo(255, hole);
  }
}

void add_unmeasured(cv::Mat1b& mask, const cv::Mat1f& depth_m) {
  cv::Mat1b unmeasured(depth_m.size());
  std::ranges::transform(depth_m, unmeasured.begin(), [](float z_m) {
    return static_cast<std::uint8_t>(z_m > 0.0F && std::isfinite(z_m) ? 0 : 255);
  });
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(unmeasured, labels, statistics, centres, 8);
  for (int label = 1; label < count; ++label) {
    const cv::Rect box(statistics.at<int>(label, cv::CC_STAT_LEFT) - 1,
                       statistics.at<int>(label, cv::CC_STAT_TOP) - 1,
                       statistics.at<int>(label, cv::CC_STAT_WIDTH) + 2,
                       statistics.at<int>(label, cv::CC_STAT_HEIGHT) + 2);
    // What goes on beyond the patch is background that is too far.
    if ((box & cv::Rect(0, 0, mask.cols, mask.rows)) != box) continue;
    const cv::Mat1b hole = labels(box) == label;
    cv::Mat1b edge;
    cv::dilate(hole, edge, square(1));
    edge -= hole;
    const cv::Mat1b of_object = edge & mask(box);
    if (2 * cv::countNonZero(of_object) > cv::countNonZero(edge)) mask(box) |= hole;
  }
}

void add_foot(cv::Mat1b& mask, const cv::Mat1f& heights_m, const CameraImages& images,
              double distance_m, double min_height_m) {
  const cv::Mat1b low = heights_m >= kLow * min_height_m;
  const int reach_px =
      static_cast<int>(std::ceil(min_height_m * images.focal_px / std::max(distance_m, 0.1)));
  for (int i = 0; i < reach_px; ++i) {
    cv::Mat1b wider;
    cv::dilate(mask, wider, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
    mask |= wider & low;
  }
}

cv::Mat square(int half_px) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * half_px + 1, 2 * half_px + 1});
}

ObjectView cut(const CameraImages& images, const cv::Mat1b& mask, const cv::Point& corner,
               int margin_px) {
  cv::Rect place = cv::boundingRect(mask) + corner;
  place -= cv::Point(margin_px, margin_px);
  place += cv::Size(2 * margin_px, 2 * margin_px);
  place &= cv::Rect(0, 0, images.width_px, images.height_px);
  const cv::Rect known(corner, mask.size());
  ObjectView view;
  view.width_px = place.width;
  view.height_px = place.height;
  view.left_px = place.x;
  view.top_px = place.y;
  view.focal_px = images.focal_px;
  view.centre_px = {0.5 * (images.width_px - 1), 0.5 * (images.height_px - 1)};
  for (int row = place.y; row < place.y + place.height; ++row) {
    for (int column = place.x; column < place.x + place.width; ++column) {
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(images.width_px) +
                         static_cast<std::size_t>(column);
      const float depth_m = images.depth_m[pixel];
      view.depth_m.push_back(std::isfinite(depth_m) ? depth_m : 0.0F);
      const cv::Point at(column, row);
      view.mask.push_back(known.contains(at) && mask(at - corner) != 0 ? 1 : 0);
    }
  }
  if (!images.rgb.empty()) take_colour(images, view);
  return view;
}

}  // namespace vantage
