/// How far from the next obstacle a point of the floor is, and where a disc can go.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "vantage/models/catalogue/shapes/footprint.hpp"

namespace vantage {

/// 0 inside; [Ericson2005, 5.1.2] per edge.
double distance_to(const Outline& outline, const Eigen::Vector2d& point_m);

/// Exact distances at the centres of square cells.
class ClearanceMap {
 public:
  /// Distances above `limit_m` are not told apart.
  ClearanceMap(const Eigen::AlignedBox2d& area_m, double cell_m, double limit_m);

  void add(const Outline& outline);
  [[nodiscard]] double at(const Eigen::Vector2d& point_m) const;  ///< of its cell's centre

  /// One entry a cell: whether the centre of a disc can get there from `start_m` by steps between
  /// neighbouring cells' centres, all at least `radius_m` from everything.
  [[nodiscard]] std::vector<bool> reachable(const Eigen::Vector2d& start_m, double radius_m) const;
  [[nodiscard]] Eigen::Vector2d centre_m(std::size_t cell) const;
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& point_m) const;
  [[nodiscard]] double cell_m() const { return cell_m_; }

 private:
  Eigen::AlignedBox2d area_m_;
  double cell_m_;
  double limit_m_;
  int columns_;
  int rows_;
  std::vector<double> distance_m_;  ///< row-major from the area's lower corner
};

}  // namespace vantage
