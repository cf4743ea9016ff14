/// The table top, and what stands on it.  [Potthast2016, 3.3.1]
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage {

struct TableOptions {
  std::array<double, 2> region_centre_m{0.0, 0.0};  ///< world x, y where to look; set by the caller
  std::array<double, 2> region_size_m{2.0, 2.0};    ///< its edge lengths; set by the caller
  double min_height_m = 0.4;
  double max_height_m = 1.2;
  double max_tilt_rad = 0.05;
  double inlier_distance_m = 0.015;
  double max_normal_angle_rad = 0.4;
  double cell_m = 0.02;
  double min_area_m2 = 0.04;
  int hypotheses = 200;
  double max_step_m = 0.03;
  void fields(auto&& f) {
    f("min_height_m", min_height_m,
      "least height of a table top in the world frame; must be above the floor");
    f("max_height_m", max_height_m, "greatest height of a table top in the world frame");
    f("max_tilt_rad", max_tilt_rad,
      "greatest tilt of a table top from horizontal; higher accepts sloping surfaces",
      between(0.0, 0.8));
    f("inlier_distance_m", inlier_distance_m,
      "greatest distance of a point from the plane that it belongs to; higher tolerates more noise",
      above(0.0));
    f("max_normal_angle_rad", max_normal_angle_rad,
      "greatest angle between a point's normal, where it has one, and the vertical; higher keeps "
      "more points",
      between(0.0, 1.6));
    f("cell_m", cell_m,
      "voxel size that points are thinned to, so that their number is an area; higher is faster "
      "and coarser",
      above(0.0));
    f("min_area_m2", min_area_m2,
      "least area of the points on the plane; smaller planes are no table", above(0.0));
    f("hypotheses", hypotheses,
      "number of random planes that sample consensus tries; higher is surer and slower",
      between(1, 1000000));
    f("max_step_m", max_step_m,
      "greatest height difference between two views of one table; beyond it the new view of the "
      "table is dropped",
      above(0.0));
  }
  void check() const;  ///< min_height_m below max_height_m
};

/// A nearly horizontal plane with the moments of its points, so that it can be refitted exactly
/// when more of the table is seen.
struct TablePlane {
  double height_m = 0.0;                                 ///< world z at the centroid
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();     ///< unit, upwards
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< world, on the plane
  Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();  ///< sum of (p - centroid)(p - centroid)^T
  std::vector<Eigen::Vector2d> hull;                     ///< convex, counter-clockwise, world x, y
  std::size_t inliers = 0;                               ///< thinned points

  /// Height of `p_world` above the plane, along the normal.
  [[nodiscard]] double height_above(const Eigen::Vector3d& p_world) const {
    return normal.dot(p_world - centroid_m);
  }
};

struct TableSearch {
  std::optional<TablePlane> table;
  std::string reason;  ///< why there is none; empty when found
};

/// The largest horizontal plane inside the region and the height band, by sample consensus
/// [FischlerBolles1981] and a least-squares fit of its inliers. `world`: points in the world frame.
/// @param keys what stands before the names of the options in a reason
TableSearch find_table(const PointCloud& world, const TableOptions& options, Rng& rng,
                       std::string_view keys = {});

/// Joins what two scans saw of one table: exact least-squares plane of both, hull of both hulls.
/// @return false, and `table` unchanged, if `seen` differs in height by more than `max_step_m`.
bool merge_table(TablePlane& table, const TablePlane& seen, double max_step_m);

struct ObjectCropOptions {
  double min_height_m = 0.010;
  double max_height_m = 0.60;
  double hull_margin_m = 0.0;
  void fields(auto&& f) {
    f("min_height_m", min_height_m,
      "least height above the table of points that are kept; higher drops low objects and more "
      "noise",
      at_least(0.0));
    f("max_height_m", max_height_m, "greatest height above the table of points that are kept",
      above(0.0));
    f("hull_margin_m", hull_margin_m,
      "how far beyond the convex hull of the table top points are kept; negative shrinks the hull",
      between(-0.5, 0.5));
  }
  void check() const;  ///< min_height_m below max_height_m
};

/// The points above the table and inside its hull, in their order.
PointCloud objects_on_table(const PointCloud& world, const TablePlane& table,
                            const ObjectCropOptions& options = {});

/// Counter-clockwise, without collinear points [Andrew1979]; fewer than 3 points if degenerate.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);
/// Whether `p` lies in the convex `hull` moved outwards by `margin_m`; never for a degenerate hull.
bool inside_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& p,
                 double margin_m = 0.0);

}  // namespace vantage
