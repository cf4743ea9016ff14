#include "vantage/localisation/map_contradiction.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kBehind_m = 0.15;        ///< farther than a registration is ever off
constexpr double kMinFacing = 0.7;        ///< cosine between beam and normal
constexpr std::size_t kMinWitnesses = 2;  ///< scans that see a surface there
constexpr std::size_t kEvery = 3;         ///< returns that are asked

/// The surfaces that scans see in a cell.
struct Surface {
  Eigen::Vector2d normal_sum = Eigen::Vector2d::Zero();
  std::size_t last_scan = 0;
  std::size_t witnesses = 0;
};

std::int64_t key_of(const Eigen::Vector2d& p_m) {
  constexpr std::int64_t kRow = std::int64_t{1} << 32;
  return static_cast<std::int64_t>(std::floor(p_m.y() / kCell_m)) * kRow +
         static_cast<std::int64_t>(std::floor(p_m.x() / kCell_m));
}

using Surfaces = std::unordered_map<std::int64_t, Surface>;

Surfaces surfaces_of(std::span<const SeenFrom> scans) {
  Surfaces surfaces;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    const PointCloud cloud = transform(scans[s].scan_base, to_se3(scans[s].T_world_base));
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector2d normal = cloud.normals[i].head<2>().cast<double>();
      if (normal.isZero()) continue;
      Surface& surface = surfaces[key_of(cloud.points[i].head<2>().cast<double>())];
      surface.normal_sum += normal;
      if (surface.witnesses == 0 || surface.last_scan != s) ++surface.witnesses;
      surface.last_scan = s;
    }
  }
  return surfaces;
}

bool goes_through(const Surfaces& surfaces, const Eigen::Vector2d& from_m,
                  const Eigen::Vector2d& to_m) {
  const double range_m = (to_m - from_m).norm();
  const Eigen::Vector2d along = (to_m - from_m) / range_m;
  for (double way_m = kBehind_m; way_m < range_m - kBehind_m; way_m += kCell_m) {
    const auto found = surfaces.find(key_of(from_m + way_m * along));
    if (found == surfaces.end() || found->second.witnesses < kMinWitnesses) continue;
    if (found->second.normal_sum.normalized().dot(along) < -kMinFacing) return true;
  }
  return false;
}

}  // namespace

double contradicted_share(std::span<const SeenFrom> scans) {
  const Surfaces surfaces = surfaces_of(scans);
  std::size_t asked = 0;
  std::size_t contradicted = 0;
  for (const SeenFrom& scan : scans) {
    expects(scan.scan_base.empty() || scan.scan_base.has_normals(), "scans with normals");
    const Pose2 sensor =
        compose(scan.T_world_base, {scan.p_sensor_base.x(), scan.p_sensor_base.y(), 0.0});
    const PointCloud cloud = transform(scan.scan_base, to_se3(scan.T_world_base));
    for (std::size_t i = 0; i < cloud.size(); i += kEvery) {
      const Eigen::Vector2d p_m = cloud.points[i].head<2>().cast<double>();
      if ((p_m - Eigen::Vector2d(sensor.x_m, sensor.y_m)).norm() < 3.0 * kBehind_m) continue;
      ++asked;
      contradicted += goes_through(surfaces, {sensor.x_m, sensor.y_m}, p_m) ? 1 : 0;
    }
  }
  return asked == 0 ? 0.0 : static_cast<double>(contradicted) / static_cast<double>(asked);
}

}  // namespace vantage
