#include "vantage/perception/table_extraction.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

struct Plane {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< upwards
};

PointCloud candidate_points(const PointCloud& world, const TableOptions& o) {
  const Eigen::Vector3d centre(o.region_centre_m[0], o.region_centre_m[1],
                               0.5 * (o.min_height_m + o.max_height_m));
  const Eigen::Vector3d half(0.5 * o.region_size_m[0], 0.5 * o.region_size_m[1],
                             0.5 * (o.max_height_m - o.min_height_m));
  const PointCloud thin =
      voxel_downsample(crop(world, Eigen::AlignedBox3d(centre - half, centre + half)), o.cell_m);
  if (!thin.has_normals()) return thin;
  const double min_cosine = std::cos(o.max_normal_angle_rad);
  std::vector<std::size_t> level;
  for (std::size_t i = 0; i < thin.size(); ++i) {
    const bool unknown = thin.normals[i].isZero();
    if (unknown || std::abs(thin.normals[i].z()) >= min_cosine) level.push_back(i);
  }
  return select(thin, level);
}

bool is_level(const Eigen::Vector3d& normal, double max_tilt_rad) {
  return normal.z() >= std::cos(max_tilt_rad);
}

std::vector<Eigen::Vector3d> points_on(const Plane& plane, const PointCloud& cloud,
                                       double distance_m) {
  std::vector<Eigen::Vector3d> on;
  for (const auto& p : cloud.points) {
    const Eigen::Vector3d point = p.cast<double>();
    if (std::abs(plane.normal.dot(point - plane.point)) <= distance_m) on.push_back(point);
  }
  return on;
}

/// The plane through three random points; none if they are collinear or the plane is not level.
std::optional<Plane> random_plane(const PointCloud& cloud, const TableOptions& options, Rng& rng) {
  std::array<Eigen::Vector3d, 3> p;
  for (auto& point : p) point = cloud.points[rng.uniform_index(cloud.size())].cast<double>();
  Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  if (normal.norm() < options.cell_m * options.cell_m) return std::nullopt;
  normal.normalize();
  if (normal.z() < 0.0) normal = -normal;
  if (!is_level(normal, options.max_tilt_rad)) return std::nullopt;
  return Plane{p[0], normal};
}

std::vector<Eigen::Vector3d> largest_consensus(const PointCloud& cloud, const TableOptions& options,
                                               Rng& rng) {
  std::vector<Eigen::Vector3d> best;
  for (int i = 0; i < options.hypotheses; ++i) {
    const auto plane = random_plane(cloud, options, rng);
    if (!plane) continue;
    auto on = points_on(*plane, cloud, options.inlier_distance_m);
    if (on.size() > best.size()) best = std::move(on);
  }
  return best;
}

/// Sets height and normal from centroid and scatter: total least squares.
void refit(TablePlane& table) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(table.scatter_m2);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  table.normal = normal.z() < 0.0 ? Eigen::Vector3d(-normal) : normal;
  table.height_m = table.centroid_m.z();
}

TablePlane fit(const std::vector<Eigen::Vector3d>& points) {
  TablePlane table;
  table.inliers = points.size();
  for (const auto& p : points) table.centroid_m += p;
  table.centroid_m /= static_cast<double>(points.size());
  std::vector<Eigen::Vector2d> outline;
  outline.reserve(points.size());
  for (const auto& p : points) {
    const Eigen::Vector3d d = p - table.centroid_m;
    table.scatter_m2 += d * d.transpose();
    outline.emplace_back(p.head<2>());
  }
  table.hull = convex_hull(std::move(outline));
  refit(table);
  return table;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

void TableOptions::check() const {
  if (min_height_m >= max_height_m) throw ConfigError("min_height_m must be below max_height_m");
}

void ObjectCropOptions::check() const {
  if (min_height_m >= max_height_m) throw ConfigError("min_height_m must be below max_height_m");
}

TableSearch find_table(const PointCloud& world, const TableOptions& options, Rng& rng,
                       std::string_view keys) {
  const PointCloud cloud = candidate_points(world, options);
  const double cell_area_m2 = options.cell_m * options.cell_m;
  const auto area_m2 = [&](std::size_t points) {
    return static_cast<double>(points) * cell_area_m2;
  };
  if (cloud.size() < 3) {
    return {std::nullopt,
            fmt::format("no level surface in the region between {0}min_height_m {1} and "
                        "{0}max_height_m {2}",
                        keys, options.min_height_m, options.max_height_m)};
  }
  auto on = largest_consensus(cloud, options, rng);
  constexpr int kRefinements = 3;
  for (int i = 0; i < kRefinements && on.size() >= 3; ++i) {
    const TablePlane fitted = fit(on);
    on = points_on({fitted.centroid_m, fitted.normal}, cloud, options.inlier_distance_m);
  }
  if (on.size() < 3 || area_m2(on.size()) < options.min_area_m2) {
    return {std::nullopt,
            fmt::format("the largest level surface seen has {:.3f} m^2, less than {}min_area_m2 {}",
                        area_m2(on.size()), keys, options.min_area_m2)};
  }
  TablePlane table = fit(on);
  if (!is_level(table.normal, options.max_tilt_rad)) {
    return {
        std::nullopt,
        fmt::format("the largest surface seen is tilted by {:.3f} rad, more than {}max_tilt_rad {}",
                    std::acos(std::min(1.0, table.normal.z())), keys, options.max_tilt_rad)};
  }
  return {std::move(table), {}};
}

bool merge_table(TablePlane& table, const TablePlane& seen, double max_step_m) {
  if (std::abs(seen.height_m - table.height_m) > max_step_m) return false;
  const auto n_table = static_cast<double>(table.inliers);
  const auto n_seen = static_cast<double>(seen.inliers);
  const double n = n_table + n_seen;
  // Moments of a union from those of its parts [ChanGolubLeVeque1983].
  const Eigen::Vector3d apart = seen.centroid_m - table.centroid_m;
  table.scatter_m2 += seen.scatter_m2 + (n_table * n_seen / n) * apart * apart.transpose();
  table.centroid_m += (n_seen / n) * apart;
  table.inliers += seen.inliers;
  auto outline = table.hull;
  outline.insert(outline.end(), seen.hull.begin(), seen.hull.end());
  table.hull = convex_hull(std::move(outline));
  refit(table);
  return true;
}

PointCloud objects_on_table(const PointCloud& world, const TablePlane& table,
                            const ObjectCropOptions& options) {
  std::vector<std::size_t> above;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Eigen::Vector3d p = world.points[i].cast<double>();
    const double height_m = table.height_above(p);
    if (height_m < options.min_height_m || height_m > options.max_height_m) continue;
    if (inside_hull(table.hull, p.head<2>(), options.hull_margin_m)) above.push_back(i);
  }
  return select(world, above);
}

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  // Lower chain left to right, then upper chain right to left; each keeps left turns only.
  const auto extend = [&hull](const Eigen::Vector2d& p, std::size_t chain_start) {
    while (hull.size() >= chain_start + 2 &&
           cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const auto& p : points) extend(p, 0);
  const std::size_t upper = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, upper);
  hull.pop_back();
  return hull;
}

bool inside_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& p,
                 double margin_m) {
  if (hull.size() < 3) return false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (cross(edge, p - hull[i]) < -margin_m * edge.norm()) return false;
  }
  return true;
}

}  // namespace vantage
