#include "vantage/perception/clouds/point_cloud.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Voxel = std::array<std::int64_t, 3>;

struct VoxelHash {
  std::size_t operator()(const Voxel& voxel) const {
    std::uint64_t hash = 0;
    for (const std::int64_t coordinate : voxel) {
      hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29U;
    }
    return static_cast<std::size_t>(hash);
  }
};

Voxel voxel_of(const Eigen::Vector3f& p, double cell_m) {
  const auto coordinate = [&](float v) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(v) / cell_m));
  };
  return {coordinate(p.x()), coordinate(p.y()), coordinate(p.z())};
}

struct VoxelSum {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double count = 0.0;
};

Eigen::Vector3f unit_or_zero(const Eigen::Vector3d& v) {
  const double length = v.norm();
  return length > 1e-6 ? Eigen::Vector3f((v / length).cast<float>()) : Eigen::Vector3f::Zero();
}

}  // namespace

PointCloud to_cloud(const RangeScan& scan) {
  expects(scan.range_m.size() == scan.lines() * scan.beams(), "a scan has lines x beams ranges");
  PointCloud cloud;
  cloud.points.reserve(scan.range_m.size());
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      const double range = scan.range(line, beam);
      if (!std::isfinite(range) || range <= 0.0) continue;
      const Eigen::Vector3d direction =
          beam_direction({scan.azimuth_rad[beam], scan.tilt_rad[line]});
      cloud.points.emplace_back((range * direction).cast<float>());
    }
  }
  return cloud;
}

PointCloud to_cloud(const PlanarScan& scan, double sensor_height_m) {
  expects(scan.range_m.size() == scan.azimuth_rad.size(), "a planar scan has one range per beam");
  const Pose T_base_sensor = to_se3(scan.T_base_sensor, sensor_height_m);
  PointCloud cloud;
  for (std::size_t beam = 0; beam < scan.range_m.size(); ++beam) {
    const double range = scan.range_m[beam];
    if (!std::isfinite(range) || range <= 0.0) continue;
    const Eigen::Vector3d p_sensor = range * beam_direction({scan.azimuth_rad[beam], 0.0});
    cloud.points.emplace_back((T_base_sensor * p_sensor).cast<float>());
  }
  return cloud;
}

PointCloud transform(const PointCloud& cloud_b, const Pose& T_a_b) {
  PointCloud cloud_a;
  cloud_a.points.reserve(cloud_b.points.size());
  cloud_a.normals.reserve(cloud_b.normals.size());
  for (const auto& p : cloud_b.points) {
    cloud_a.points.emplace_back((T_a_b * p.cast<double>()).cast<float>());
  }
  for (const auto& n : cloud_b.normals) {
    cloud_a.normals.emplace_back((T_a_b.linear() * n.cast<double>()).cast<float>());
  }
  return cloud_a;
}

PointCloud to_cloud(const CameraImages& image, int stride) {
  expects(stride >= 1, "a stride of at least one pixel");
  PointCloud cloud;
  for (int row = 0; row < image.height_px; row += stride) {
    for (int column = 0; column < image.width_px; column += stride) {
      const double depth_m = image.depth_at(row, column);
      if (depth_m == 0.0 || !std::isfinite(depth_m)) continue;
      cloud.points.emplace_back((depth_m * image.ray(row, column)).cast<float>());
    }
  }
  return cloud;
}

void append(PointCloud& cloud, const PointCloud& more) {
  if (more.empty()) return;
  const bool keep_normals = (cloud.empty() || cloud.has_normals()) && more.has_normals();
  cloud.points.insert(cloud.points.end(), more.points.begin(), more.points.end());
  if (keep_normals) {
    cloud.normals.insert(cloud.normals.end(), more.normals.begin(), more.normals.end());
  } else {
    cloud.normals.clear();
  }
}

PointCloud voxel_downsample(const PointCloud& cloud, double cell_m) {
  expects(cell_m > 0.0, "a voxel has a size");
  std::unordered_map<Voxel, std::size_t, VoxelHash> slots;
  slots.reserve(cloud.size());
  std::vector<VoxelSum> sums;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto [slot, is_new] = slots.try_emplace(voxel_of(cloud.points[i], cell_m), sums.size());
    if (is_new) sums.emplace_back();
    VoxelSum& sum = sums[slot->second];
    sum.point += cloud.points[i].cast<double>();
    if (cloud.has_normals()) sum.normal += cloud.normals[i].cast<double>();
    sum.count += 1.0;
  }
  PointCloud down;
  down.points.reserve(sums.size());
  for (const VoxelSum& sum : sums) {
    down.points.emplace_back((sum.point / sum.count).cast<float>());
    if (cloud.has_normals()) down.normals.push_back(unit_or_zero(sum.normal));
  }
  return down;
}

PointCloud crop(const PointCloud& cloud, const Eigen::AlignedBox3d& box) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (box.contains(cloud.points[i].cast<double>())) inside.push_back(i);
  }
  return select(cloud, inside);
}

PointCloud select(const PointCloud& cloud, const std::vector<std::size_t>& indices) {
  PointCloud chosen;
  chosen.points.reserve(indices.size());
  for (const std::size_t i : indices) {
    chosen.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) chosen.normals.push_back(cloud.normals[i]);
  }
  return chosen;
}

}  // namespace vantage
