/// The cells a field of view holds, found without an angle per cell.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "vantage/core/rounding.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

/// `contains` for the points p + i step of one row of cells, in single precision and without a
/// branch, for loops that the compiler turns into SIMD.
struct ConeRow {
  std::array<float, 3> origin_m{};  ///< p in the sensor's frame
  std::array<float, 3> step_m{};
  float tan_tilt_min = 0.0F;
  float tan_tilt_max = 0.0F;
  float sin2_half_width = 0.0F;
  float max_excess_ahead_m2 = 0.0F;
  float min_excess_behind_m2 = 0.0F;
  float range2_min_m2 = 0.0F;
  float range2_max_m2 = 0.0F;
  float all_round = 0.0F;  ///< 1 for a panorama, else 0

  [[nodiscard]] bool contains(float i) const {
    const float x = origin_m[0] + i * step_m[0];
    const float y = origin_m[1] + i * step_m[1];
    const float z = origin_m[2] + i * step_m[2];
    const float range2 = x * x + y * y + z * z;
    const float depth = std::sqrt(x * x + all_round * (y * y));
    const float drop = ((x >= 0.0F) | (all_round > 0.0F)) ? -z : z;
    const float excess = y * y - sin2_half_width * range2;
    const bool in_sector = ((x >= 0.0F) & (excess <= max_excess_ahead_m2)) |
                           ((x < 0.0F) & (excess >= min_excess_behind_m2));
    return in_sector & (range2 >= range2_min_m2) & (range2 <= range2_max_m2) &
           (drop >= tan_tilt_min * depth) & (drop <= tan_tilt_max * depth);
  }
};

/// FieldOfView::contains for points of the world, by products instead of angles.
class ViewCone {
 public:
  ViewCone(const Pose& T_world_sensor, const FieldOfView& field_of_view);

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_world) const;

  [[nodiscard]] ConeRow row(const Eigen::Vector3d& p_world, const Eigen::Vector3d& step) const;

  [[nodiscard]] const Eigen::Vector3d& apex_m() const { return apex_m_; }
  /// Inward normals, world, of planes through the apex that hold the cone; none if it looks behind.
  [[nodiscard]] std::span<const Eigen::Vector3d> normals() const {
    return std::span(normals_).first(behind_ ? 0 : normals_.size());
  }
  [[nodiscard]] double range2_max_m2() const { return range2_max_m2_; }
  [[nodiscard]] double range2_min_m2() const { return range2_min_m2_; }
  /// The sensor's y axis in the world, across the sector.
  [[nodiscard]] Eigen::Vector3d across() const { return R_sensor_world_.row(1).transpose(); }
  [[nodiscard]] double sin2_half_width() const { return sin2_half_width_; }

 private:
  Eigen::Vector3d apex_m_;
  Eigen::Matrix3d R_sensor_world_;
  double tan_tilt_min_;
  double tan_tilt_max_;
  bool panorama_;
  bool behind_;  // sees behind itself, as panoramas and sectors wider than pi do
  double sin2_half_width_;
  double range2_min_m2_;
  double range2_max_m2_;
  std::array<Eigen::Vector3d, 5> normals_;  // world, inwards, of planes that bound the front
};

/// Where rows of points p + i step, i = 0, 1, ..., may be inside a cone.
class RowBounds {
 public:
  RowBounds(const ViewCone& cone, const Eigen::Vector3d& step);

  struct Interval {
    int begin = 0;
    int end = 0;
  };
  /// Bounds on the indices i in [0, count) that the cone contains.
  [[nodiscard]] Interval of_row(const Eigen::Vector3d& p_world, int count) const;

  struct Runs {
    std::array<Interval, 2> runs;  ///< ascending; may be empty
    bool exact = false;            ///< all of them are inside, but for rounding at the rim
  };
  /// Where the indices i in [begin, end) that the cone contains are: exactly, unless it sees behind
  /// itself or its nearest range cuts the row.
  [[nodiscard]] Runs runs_of_row(const Eigen::Vector3d& p_world, int begin, int end) const;

 private:
  struct Reals {
    double low = 0.0;
    double high = -1.0;
    [[nodiscard]] bool empty() const { return !(low <= high); }
    [[nodiscard]] Interval whole() const {  ///< numbers of it
      if (empty()) return {};
      return {ceil_int(low), floor_int(high) + 1};
    }
  };
  /// Inside the first `planes` planes and the greatest range.
  [[nodiscard]] Reals clip(const Eigen::Vector3d& p, Reals row, std::size_t planes) const;
  [[nodiscard]] Runs inside_sector(const Eigen::Vector3d& p, const Reals& row) const;

  struct Plane {
    Eigen::Vector3d normal;  ///< world, inwards
    double per_index = 0.0;  ///< 1 / (what a step moves inwards); 0: along the plane
  };
  Eigen::Vector3d apex_m_;
  Eigen::Vector3d along_;  ///< step / |step|^2
  double step2_m2_;
  double range2_min_m2_;
  double range2_max_m2_;
  std::array<Plane, 5> planes_;
  std::size_t
      count_;  ///< of the planes that bound the cone; of those the first 3 are its own faces
  Eigen::Vector3d across_;
  Eigen::Vector3d step_;
  double sin2_half_width_;
  double across_per_index_;
  double curvature_;  ///< of across^2 - sin^2(half width) range^2 along the row
};

/// Calls `visit(cell, cell index)` in index order for each cell with `wanted(cell index)` whose
/// centre the cone contains, in the z slices [z_begin, z_end).
template <class Wanted, class Visit>
void for_each_cell_in_view(const GridFrame& grid, const ViewCone& cone, int z_begin, int z_end,
                           Wanted&& wanted, Visit&& visit) {
  const RowBounds bounds(cone, {grid.cell_size_m.x(), 0.0, 0.0});
  for (int z = z_begin; z < z_end; ++z) {
    for (int y = 0; y < grid.cells.y(); ++y) {
      const auto row = bounds.of_row(grid.centre({0, y, z}), grid.cells.x());
      for (int x = row.begin; x < row.end; ++x) {
        const Eigen::Array3i cell(x, y, z);
        const std::size_t index = grid.index(cell);
        if (wanted(index) && cone.contains(grid.centre(cell))) visit(cell, index);
      }
    }
  }
}

template <class Wanted, class Visit>
void for_each_cell_in_view(const GridFrame& grid, const ViewCone& cone, Wanted&& wanted,
                           Visit&& visit) {
  for_each_cell_in_view(grid, cone, 0, grid.cells.z(), wanted, visit);
}

}  // namespace vantage
