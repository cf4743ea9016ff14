#include "vantage/models/catalogue/office/clearance_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vantage {

using Eigen::Vector2d;

double distance_to(const Outline& outline, const Vector2d& point_m) {
  bool inside = true;
  double nearest = 1e9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    const Vector2d to_point = point_m - outline[i];
    inside = inside && edge.x() * to_point.y() - edge.y() * to_point.x() >= 0.0;
    const double along = std::clamp(to_point.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (to_point - along * edge).norm());
  }
  return inside ? 0.0 : nearest;
}

ClearanceMap::ClearanceMap(const Eigen::AlignedBox2d& area_m, double cell_m, double limit_m)
    : area_m_(area_m),
      cell_m_(cell_m),
      limit_m_(limit_m),
      columns_(static_cast<int>(std::ceil(area_m.sizes().x() / cell_m))),
      rows_(static_cast<int>(std::ceil(area_m.sizes().y() / cell_m))),
      distance_m_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), limit_m) {}

Vector2d ClearanceMap::centre_m(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(columns_);
  const std::size_t column = cell % columns;
  const std::size_t row = cell / columns;
  return area_m_.min() +
         cell_m_ * Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
}

std::size_t ClearanceMap::cell_at(const Vector2d& point_m) const {
  const Vector2d at = (point_m - area_m_.min()) / cell_m_;
  const int column = std::clamp(static_cast<int>(std::floor(at.x())), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(std::floor(at.y())), 0, rows_ - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

double ClearanceMap::at(const Vector2d& point_m) const { return distance_m_[cell_at(point_m)]; }

void ClearanceMap::add(const Outline& outline) {
  Eigen::AlignedBox2d near;
  for (const Vector2d& p : outline) near.extend(p);
  const Vector2d margin = Vector2d::Constant(limit_m_ + cell_m_);
  const auto columns = static_cast<std::size_t>(columns_);
  const std::size_t first = cell_at(near.min() - margin);
  const std::size_t last = cell_at(near.max() + margin);
  for (std::size_t row = first / columns; row <= last / columns; ++row) {
    for (std::size_t column = first % columns; column <= last % columns; ++column) {
      double& distance = distance_m_[row * columns + column];
      distance = std::min(distance, distance_to(outline, centre_m(row * columns + column)));
    }
  }
}

std::vector<bool> ClearanceMap::reachable(const Vector2d& start_m, double radius_m) const {
  std::vector<bool> reached(distance_m_.size(), false);
  std::vector<std::size_t> open;
  const auto visit = [&](std::size_t cell) {
    if (reached[cell] || distance_m_[cell] < radius_m) return;
    reached[cell] = true;
    open.push_back(cell);
  };
  visit(cell_at(start_m));
  const auto columns = static_cast<std::size_t>(columns_);
  while (!open.empty()) {
    const std::size_t cell = open.back();
    open.pop_back();
    if (cell % columns > 0) visit(cell - 1);
    if (cell % columns + 1 < columns) visit(cell + 1);
    if (cell >= columns) visit(cell - columns);
    if (cell + columns < distance_m_.size()) visit(cell + columns);
  }
  return reached;
}

}  // namespace vantage
