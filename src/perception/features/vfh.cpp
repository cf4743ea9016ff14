#include "vantage/perception/features/vfh.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "vantage/perception/features/kit/histogram.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/kit/object_surface.hpp"

namespace vantage {
namespace {

constexpr int kAngleBins = 45;
constexpr int kSizeBlock = 3 * kAngleBins;
constexpr int kViewBlock = 4 * kAngleBins;
constexpr int kViewBins = 128;

int bin_of(double share, int bins) {
  return std::clamp(static_cast<int>(std::floor(share * bins)), 0, bins - 1);
}

/// Of the pair (centroid, its normal) -> (point, its normal); none where they coincide or the
/// normal points along the line between them.
std::optional<std::array<double, 3>> pair_angles(Eigen::Vector3d d, Eigen::Vector3d n1,
                                                 Eigen::Vector3d n2) {
  const double distance = d.norm();
  if (!(distance > 0.0)) return std::nullopt;
  const double a1 = n1.dot(d) / distance;
  const double a2 = n2.dot(d) / distance;
  double f3 = a1;
  if (std::acos(std::min(std::abs(a1), 1.0)) > std::acos(std::min(std::abs(a2), 1.0))) {
    std::swap(n1, n2);
    d = -d;
    f3 = -a2;
  }
  Eigen::Vector3d v = d.cross(n1);
  if (!(v.norm() > 0.0)) return std::nullopt;
  v.normalize();
  const Eigen::Vector3d w = n1.cross(v);
  return std::array{std::atan2(w.dot(n2), n1.dot(n2)), v.dot(n2), f3};
}

struct Centroid {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // mean, shorter than 1
  double farthest = 0.0;
};

Centroid centroid_of(const PointCloud& cloud) {
  Centroid centroid;
  for (const auto& p : cloud.points) centroid.p += p.cast<double>();
  for (const auto& n : cloud.normals) centroid.normal += n.cast<double>();
  centroid.p /= static_cast<double>(cloud.size());
  centroid.normal /= static_cast<double>(cloud.size());
  for (const auto& p : cloud.points) {
    centroid.farthest = std::max(centroid.farthest, (p.cast<double>() - centroid.p).norm());
  }
  return centroid;
}

int size_bin(double distance_m, const Centroid& centroid, VfhSizes sizes) {
  if (sizes == VfhSizes::metres) {
    return std::min(static_cast<int>(std::lround(100.0 * distance_m)), kAngleBins - 1);
  }
  return centroid.farthest > 0.0 ? bin_of(distance_m / centroid.farthest, kAngleBins) : 0;
}

PointCloud with_normals(const PointCloud& cloud) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.normals[i].isZero()) kept.push_back(i);
  }
  return select(cloud, kept);
}

}  // namespace

Eigen::VectorXf viewpoint_feature_histogram(const PointCloud& all,
                                            const Eigen::Vector3d& p_viewpoint, VfhSizes sizes) {
  expects(all.has_normals(), "a viewpoint feature histogram needs normals");
  const PointCloud cloud = with_normals(all);
  Eigen::VectorXd histogram = Eigen::VectorXd::Zero(kViewBlock + kViewBins);
  if (cloud.empty()) return histogram.cast<float>();
  const auto n = static_cast<double>(cloud.size());
  const double angle_share = 100.0 / std::max(1.0, n - 1.0);
  const double view_share = 100.0 / n;
  const Centroid centroid = centroid_of(cloud);
  const Eigen::Vector3d to_viewpoint = (p_viewpoint - centroid.p).normalized();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d d = cloud.points[i].cast<double>() - centroid.p;
    const Eigen::Vector3d normal = cloud.normals[i].cast<double>();
    histogram[kViewBlock + bin_of((normal.dot(to_viewpoint) + 1.0) / 2.0, kViewBins)] += view_share;
    const auto angles = pair_angles(d, centroid.normal, normal);
    if (!angles) continue;
    for (int k = 0; k < 3; ++k) {
      const double share = ((*angles)[k] + std::numbers::pi) / (2.0 * std::numbers::pi);
      histogram[k * kAngleBins + bin_of(share, kAngleBins)] += angle_share;
    }
    if (sizes != VfhSizes::none) {
      histogram[kSizeBlock + size_bin(d.norm(), centroid, sizes)] += angle_share;
    }
  }
  return histogram.cast<float>();
}

FeatureResult Vfh::extract(const ObjectView& view) const {
  const ObjectPixels pixels = object_pixels(view);
  if (auto why = lacks_depth(pixels, min_points); !why.empty()) return FeatureResult::skip(why);
  if (auto why = lacks_geometry(view); !why.empty()) return FeatureResult::skip(why);
  const ObjectSurface surface = object_surface(view, pixels, normal_radius_m);
  const auto known = std::ranges::count_if(surface.cloud.normals,
                                           [](const auto& normal) { return !normal.isZero(); });
  if (known < min_points) {
    return FeatureResult::skip(
        fmt::format("{} points have a normal, fewer than {}", known, min_points));
  }
  const auto sizes = size_block ? VfhSizes::metres : VfhSizes::none;
  return {
      root_of_shares(viewpoint_feature_histogram(surface.cloud, Eigen::Vector3d::Zero(), sizes)),
      {}};
}

}  // namespace vantage
