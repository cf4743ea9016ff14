/// Where the robot can drive: a 2-D occupancy map of the floor from planar scans.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

/// Of a floor map, and of a finer one.
inline constexpr double kMaxFloorCells = 67108864.0;  // 2^26
/// At least so free is where the robot stands.
inline constexpr float kStandingLogOdds = -2.0F;

struct FloorMapOptions {
  double cell_m = 0.05;
  double half_size_m = 6.0;
  double log_odds_hit = 1.5;
  double log_odds_miss = 0.5;
  double log_odds_limit = 3.0;
  void fields(auto&& f) {
    f("cell_m", cell_m, "edge of a cell; higher is faster and coarser", above(0.0));
    f("half_size_m", half_size_m,
      "half of the edge of the map, a square centred on the world's origin; higher covers more "
      "floor and is slower",
      above(0.0));
    f("log_odds_hit", log_odds_hit,
      "log odds that a return adds to a cell; higher trusts a single return more", above(0.0));
    f("log_odds_miss", log_odds_miss,
      "log odds that a passing beam takes from a cell; higher forgets obstacles faster",
      above(0.0));
    f("log_odds_limit", log_odds_limit,
      "greatest magnitude of a cell's log odds; higher takes longer to change its mind",
      above(0.0));
  }
  /// Cells along an edge of the map; a whole number.
  [[nodiscard]] double edge_cells() const;
  /// One hit or miss must be able to decide a cell's state; 1 to kMaxFloorCells cells.
  void check() const;
};

/// Square cells in the world's plane z = 0, row-major, x fastest. What lies outside is unknown.
struct FloorMap {
  Eigen::Vector2d min_corner_m = Eigen::Vector2d::Zero();
  double cell_m = 1.0;
  int nx = 0;
  int ny = 0;
  std::vector<float> log_odds;        ///< ln(p / (1 - p)) of the scans
  std::vector<std::uint8_t> blocked;  ///< 1: an obstacle whatever the scans say

  FloorMap() = default;
  FloorMap(const Eigen::Vector2d& min_corner, double cell, int cells_x, int cells_y);

  [[nodiscard]] std::size_t size() const { return log_odds.size(); }
  [[nodiscard]] bool contains(const Eigen::Array2i& cell) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < nx && cell.y() < ny;
  }
  [[nodiscard]] std::size_t index(const Eigen::Array2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(cell.x());
  }
  [[nodiscard]] Eigen::Array2i cell(std::size_t index) const {
    const auto width = static_cast<std::size_t>(nx);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }
  /// May lie outside the map.
  [[nodiscard]] Eigen::Array2i cell_at(const Eigen::Vector2d& p_world) const {
    return ((p_world - min_corner_m) / cell_m).array().floor().cast<int>();
  }
  [[nodiscard]] Eigen::Vector2d centre(const Eigen::Array2i& cell) const {
    return min_corner_m + ((cell.cast<double>() + 0.5) * cell_m).matrix();
  }
  [[nodiscard]] CellState state(std::size_t cell) const;
  /// `unobserved` outside the map.
  [[nodiscard]] CellState state_at(const Eigen::Vector2d& p_world) const;
  /// The map as one layer of cells, z in [0, 1), for walk_ray; indices agree.
  [[nodiscard]] GridFrame frame() const;
};

/// Nothing known yet.
/// @throws ConfigError if the options are out of range.
FloorMap make_floor_map(const FloorMapOptions& options);

/// Adds one scan: cells a beam passes become freer, the cell of a return more occupied. A cell
/// changes once per scan and a return in it outweighs beams through it. A beam without return frees
/// up to range_max_m; a NaN range is skipped. Does not depend on `threads` (>= 1).
void add_planar_scan(FloorMap& map, const PlanarScan& scan, const Pose2& T_world_base,
                     const FloorMapOptions& options, int threads = 1);

/// Makes every cell that overlaps `box_m` (world) an obstacle for good: what a low scanner cannot
/// see, such as a table top.
void block_box(FloorMap& map, const Eigen::AlignedBox2d& box_m);

/// The robot stands there: cells with their centre within `radius_m` of it are free, except blocked
/// ones.
void clear_footprint(FloorMap& map, const Pose2& T_world_base, double radius_m);

}  // namespace vantage
