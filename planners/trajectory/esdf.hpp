/// Euclidean signed distance field (ESDF) of the occupied cells of a grid.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/geometry/grid_frame.hpp"

namespace vantage {

/// Signed distance to the surface of the occupied cells of a grid: above 0 outside, below 0 inside.
///
/// Between cell centres it is exact, and the surface lies half a cell, the shortest edge, from an
/// occupied centre: it may be up to 0.37 cells nearer than told where a cube's corner points at the
/// place. Inside the grid no distance is told to be more than `reach_m`. Outside of it nothing is
/// occupied.
class Esdf {
 public:
  /// @param occupied a flag for each cell, `frame.index` order
  Esdf(const GridFrame& frame, std::span<const std::uint8_t> occupied, double reach_m = 1.5);

  struct Sample {
    double distance_m = 0.0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< world, of distance_m
  };
  /// Trilinear between cell centres. Beyond the outer ones: of the nearest place among them, and
  /// what it is away from there on top.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p_world) const;
  [[nodiscard]] Sample sample(const Eigen::Vector3d& p_world) const;

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] double reach_m() const { return reach_m_; }
  /// At cell centres, `frame().index` order.
  [[nodiscard]] std::span<const float> at_centres_m() const { return signed_m_; }

 private:
  struct Corner;
  [[nodiscard]] Corner corner(const Eigen::Vector3d& p_world) const;

  GridFrame frame_;
  double reach_m_;
  std::vector<float> signed_m_;
};

/// Of the occupied cells of a map inside `window` (world; cut to the map). What was never observed
/// is not occupied.
Esdf make_esdf(const OccupancyGrid& map, const Eigen::AlignedBox3d& window, double reach_m = 1.5);
/// The same of what a flag for each cell of `frame`, `frame.index` order, calls occupied.
Esdf make_esdf(const GridFrame& frame, std::span<const std::uint8_t> occupied,
               const Eigen::AlignedBox3d& window, double reach_m = 1.5);

}  // namespace vantage
