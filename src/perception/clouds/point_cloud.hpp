/// Point clouds: metres, in the frame that the variable's name says (`scan_base`, `map_world`).
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

struct PointCloud {
  std::vector<Eigen::Vector3f> points;   ///< m
  std::vector<Eigen::Vector3f> normals;  ///< unit, or zero where unknown; empty or one per point

  [[nodiscard]] std::size_t size() const { return points.size(); }
  [[nodiscard]] bool empty() const { return points.empty(); }
  [[nodiscard]] bool has_normals() const { return !empty() && normals.size() == points.size(); }
};

/// The scan's returns in the sensor frame; beams without a return or invalid are left out.
PointCloud to_cloud(const RangeScan& scan);
/// The line's returns in the base frame, at the height of the scanner above the base's origin.
PointCloud to_cloud(const PlanarScan& scan, double sensor_height_m);

PointCloud transform(const PointCloud& cloud_b, const Pose& T_a_b);
/// Returns of every `stride`-th pixel of every `stride`-th row, in the camera frame.
PointCloud to_cloud(const CameraImages& image, int stride);

/// Adds `more` behind `cloud`. Normals survive only if both have them.
void append(PointCloud& cloud, const PointCloud& more);

/// One point for each occupied cube of edge `cell_m` > 0: the mean of its points, its normal the
/// mean direction of theirs. Order: that of each cube's first point.
PointCloud voxel_downsample(const PointCloud& cloud, double cell_m);

/// The points inside `box`, faces included, in their order.
PointCloud crop(const PointCloud& cloud, const Eigen::AlignedBox3d& box);

/// The points (and normals) at `indices`, in that order.
PointCloud select(const PointCloud& cloud, const std::vector<std::size_t>& indices);

}  // namespace vantage
