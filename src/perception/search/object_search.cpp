#include "vantage/perception/search/object_search.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

#include "vantage/perception/table_segmentation.hpp"

namespace vantage {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// What rises from a surface in one piece, as far as the thinned image tells.
struct Cluster {
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  double height_m = 0.0;
  double beside = 0.0;  ///< share of its points that are not over the surface
};

double height_sigma_m(const ObjectSearchOptions& options, double distance_m) {
  return options.noise_per_m * distance_m * distance_m;
}

/// Points above the surface and near it that stand out of the noise, highest objects included.
Points rising_from(const TablePlane& support, const PointCloud& world,
                   const Eigen::Vector3d& p_world_camera, const ObjectSearchOptions& options) {
  constexpr double kNear_m = 0.25;
  constexpr double kSigmas = 2.5;
  Points rising;
  for (const Eigen::Vector3f& point : world.points) {
    const Eigen::Vector3d p = point.cast<double>();
    const double height_m = support.height_above(p);
    if (height_m < options.cut.min_height_m || height_m > 2.0 * options.cut.max_height_m) continue;
    if (!inside_hull(support.hull, p.head<2>(), kNear_m)) continue;
    const double sigma_m = height_sigma_m(options, (p - p_world_camera).norm());
    if (height_m > options.cut.min_height_m + kSigmas * sigma_m) rising.push_back(p);
  }
  return rising;
}

Cluster cluster_of(const Points& points, const TablePlane& support,
                   const ObjectSearchOptions& options) {
  Cluster cluster;
  Eigen::AlignedBox2d box;
  std::size_t beside = 0;
  for (const auto& p : points) {
    box.extend(p.head<2>());
    cluster.height_m = std::max(cluster.height_m, support.height_above(p));
    beside += inside_hull(support.hull, p.head<2>(), options.gap_m) ? 0 : 1;
  }
  cluster.middle_m = box.center();
  for (const auto& p : points) {
    cluster.radius_m = std::max(cluster.radius_m, (p.head<2>() - cluster.middle_m).norm());
  }
  cluster.beside = static_cast<double>(beside) / static_cast<double>(points.size());
  return cluster;
}

/// Points are of one cluster if their cells of `gap_m` touch, seen from above.
std::vector<Cluster> clusters_of(const Points& points, const TablePlane& support,
                                 const ObjectSearchOptions& options) {
  if (points.empty()) return {};
  Eigen::AlignedBox2d box;
  for (const auto& p : points) box.extend(p.head<2>());
  const auto cell_of = [&](const Eigen::Vector3d& p) {
    const Eigen::Array2d at = (p.head<2>() - box.min()).array() / options.gap_m;
    return cv::Point(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  const cv::Point last = cell_of({box.max().x(), box.max().y(), 0.0});
  cv::Mat1b raster(last.y + 1, last.x + 1, static_cast<unsigned char>(0));
  for (const auto& p : points) raster(cell_of(p)) = 255;
  cv::Mat labels;
  const int count = cv::connectedComponents(raster, labels, 8);
  std::vector<Points> members(static_cast<std::size_t>(count));
  for (const auto& p : points) {
    members[static_cast<std::size_t>(labels.at<int>(cell_of(p)))].push_back(p);
  }
  constexpr std::size_t kFewest = 4;
  std::vector<Cluster> clusters;
  for (const Points& member : members) {
    if (member.size() >= kFewest) clusters.push_back(cluster_of(member, support, options));
  }
  return clusters;
}

bool may_be_object(const Cluster& cluster, const ObjectSearchOptions& options) {
  constexpr double kMaxBeside = 0.3;
  return cluster.height_m <= options.cut.max_height_m && cluster.radius_m <= options.cut.radius_m &&
         cluster.beside <= kMaxBeside;
}

/// The value that this share of the others lie below; reorders.
double quantile(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Ends of what lies between, without the outermost few.
Eigen::Vector2d ends(std::vector<double> values) {
  constexpr double kOutliers = 0.02;
  return {quantile(values, kOutliers), quantile(values, 1.0 - kOutliers)};
}

/// Points of the cut that are of the object and not of what lies behind its edge.
Points points_of(const ObjectView& view, const Pose& T_world_camera, const TablePlane& support,
                 const Cluster& cluster, const ObjectSegmentationOptions& cut) {
  Points points;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t i = view.index(row, column);
      if (view.mask[i] == 0 || !(view.depth_m[i] > 0.0F)) continue;
      const Eigen::Vector3d p = T_world_camera * view.point(row, column);
      const double height_m = support.height_above(p);
      if ((p.head<2>() - cluster.middle_m).norm() > cut.radius_m) continue;
      if (height_m > 0.5 * cut.min_height_m && height_m < cut.max_height_m) points.push_back(p);
    }
  }
  return points;
}

/// Place and size from the points' extent along and across the line of sight.
ObjectDetection measured(const Points& points, const TablePlane& support,
                         const Eigen::Vector3d& p_world_camera) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p.head<2>();
  mean /= static_cast<double>(points.size());
  const Eigen::Vector2d along = (mean - p_world_camera.head<2>()).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  std::vector<double> far_m, side_m, high_m;
  for (const auto& p : points) {
    far_m.push_back((p.head<2>() - mean).dot(along));
    side_m.push_back((p.head<2>() - mean).dot(across));
    high_m.push_back(support.height_above(p));
  }
  const Eigen::Vector2d far = ends(std::move(far_m));
  const Eigen::Vector2d side = ends(std::move(side_m));
  ObjectDetection detection;
  detection.height_m = ends(std::move(high_m)).y();
  const Eigen::Vector2d middle = mean + far.mean() * along + side.mean() * across;
  std::vector<double> off_m;
  for (const auto& p : points) off_m.push_back((p.head<2>() - middle).norm());
  detection.radius_m = ends(std::move(off_m)).y();
  const Eigen::Vector2d slope = -support.normal.head<2>() / support.normal.z();
  detection.support_z_m = support.height_m + slope.dot(middle - support.centroid_m.head<2>());
  detection.p_world_object_m << middle, detection.support_z_m + 0.5 * detection.height_m;
  detection.distance_m = (detection.p_world_object_m - p_world_camera).norm();
  return detection;
}

/// Not cut by the frame, not partly too near, nothing in front of it.
bool is_whole(const ObjectView& view, const CameraImages& images,
              const ObjectSearchOptions& options) {
  cv::Mat1b mask(view.height_px, view.width_px);
  std::copy(view.mask.begin(), view.mask.end(), mask.begin());
  const cv::Rect place = cv::boundingRect(mask) + cv::Point(view.left_px, view.top_px);
  const int border = options.border_px + options.cut.mask_growth_px;
  if (place.x < border || place.y < border || place.br().x > images.width_px - border ||
      place.br().y > images.height_px - border) {
    return false;
  }
  constexpr float kInFront_m = 0.15F;
  constexpr double kMaxHidden = 0.05;
  cv::Mat1b ring;
  cv::dilate(mask, ring, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  std::vector<double> depths_m;
  for (std::size_t i = 0; i < view.mask.size(); ++i) {
    if (view.mask[i] != 0 && view.depth_m[i] > 0.0F) depths_m.push_back(view.depth_m[i]);
  }
  if (depths_m.empty()) return false;
  const double nearest_m = ends(std::move(depths_m)).x();
  int around = 0;
  int hidden = 0;
  for (std::size_t i = 0; i < view.mask.size(); ++i) {
    if (view.mask[i] != 0 || *(ring.begin() + static_cast<std::ptrdiff_t>(i)) == 0) continue;
    ++around;
    const float depth_m = view.depth_m[i];
    hidden += depth_m > 0.0F && depth_m < nearest_m - kInFront_m ? 1 : 0;
  }
  return nearest_m >= options.nearest_m && hidden <= kMaxHidden * around;
}

std::optional<SeenObject> seen_object(const CameraImages& images, const Pose& T_world_camera,
                                      const TablePlane& support, const Cluster& cluster,
                                      const ObjectSearchOptions& options) {
  constexpr double kMargin_m = 0.04;
  const Eigen::Vector3d p_world_foot_m(cluster.middle_m.x(), cluster.middle_m.y(),
                                       support.height_m);
  const Eigen::Vector3d p_world_camera = T_world_camera.translation();
  ObjectSegmentationOptions cut = cut_at(options, (p_world_foot_m - p_world_camera).norm());
  cut.radius_m = cluster.radius_m + kMargin_m;
  SegmentedObject found = segment_on_table(images, T_world_camera, support, p_world_foot_m, cut);
  if (!found.view) return std::nullopt;
  const Points points = points_of(*found.view, T_world_camera, support, cluster, cut);
  if (2 * points.size() < static_cast<std::size_t>(cut.min_pixels)) return std::nullopt;
  SeenObject seen{measured(points, support, p_world_camera), std::move(*found.view)};
  seen.detection.pixels = static_cast<int>(points.size());
  seen.detection.whole = is_whole(seen.view, images, options);
  return seen;
}

}  // namespace

ObjectSegmentationOptions cut_at(const ObjectSearchOptions& options, double distance_m) {
  constexpr double kSigmas = 1.5;
  ObjectSegmentationOptions cut = options.cut;
  cut.min_height_m += kSigmas * height_sigma_m(options, distance_m);
  return cut;
}

std::vector<SeenObject> find_objects(const CameraImages& images, const Pose& T_world_camera,
                                     const ObjectSearchOptions& options) {
  check_options(options, "object search");
  const int stride = std::max(1, images.width_px / options.support.columns);
  const PointCloud world = transform(to_cloud(images, stride), T_world_camera);
  const Eigen::Vector3d p_world_camera = T_world_camera.translation();
  std::vector<SeenObject> seen;
  for (const TablePlane& support : find_supports(world, options.support)) {
    const Points rising = rising_from(support, world, p_world_camera, options);
    for (const Cluster& cluster : clusters_of(rising, support, options)) {
      if (!may_be_object(cluster, options)) continue;
      auto object = seen_object(images, T_world_camera, support, cluster, options);
      if (object && object->detection.distance_m <= options.range_m) {
        seen.push_back(std::move(*object));
      }
    }
  }
  std::ranges::stable_sort(seen, {}, [](const SeenObject& s) { return s.detection.distance_m; });
  return seen;
}

std::vector<ObjectDetection> detections_of(const std::vector<SeenObject>& seen) {
  std::vector<ObjectDetection> detections;
  for (const SeenObject& object : seen) detections.push_back(object.detection);
  return detections;
}

}  // namespace vantage
