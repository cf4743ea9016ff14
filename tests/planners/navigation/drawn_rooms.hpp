/// Floors with walls where they are said to be, and the finer map of the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "vantage/belief/map/floor_detail.hpp"
#include "vantage/planners/navigation/footprint_space.hpp"
#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

struct DrawnRooms {
  static constexpr double kCell_m = 0.05;
  static constexpr int kParts = 5;  ///< finer cells are of 1 cm
  FloorMap floor;
  FloorMap detail;

  /// 0 to width_m x 0 to height_m, free but for the walls; a cell is a wall if its middle is.
  DrawnRooms(double width_m, double height_m, const std::vector<Eigen::AlignedBox2d>& walls_m)
      : floor(Eigen::Vector2d::Zero(), kCell_m, static_cast<int>(std::lround(width_m / kCell_m)),
              static_cast<int>(std::lround(height_m / kCell_m))),
        detail(make_floor_detail(floor, {.parts = kParts})) {
    std::ranges::fill(floor.log_odds, -3.0F);
    std::ranges::fill(detail.log_odds, -3.0F);
    for (std::size_t cell = 0; cell < detail.size(); ++cell) {
      const Eigen::Vector2d p_m = detail.centre(detail.cell(cell));
      const bool wall =
          std::ranges::any_of(walls_m, [&](const auto& w) { return w.contains(p_m); });
      if (!wall) continue;
      detail.log_odds[cell] = 3.0F;
      floor.log_odds[floor.index(floor.cell_at(p_m))] = 3.0F;
    }
  }
  [[nodiscard]] std::shared_ptr<const FootprintSpace> space(const RobotOutline& robot,
                                                            const PassageOptions& options) const {
    return std::make_shared<const FootprintSpace>(detail, kParts, robot, options);
  }
};

inline Eigen::AlignedBox2d wall(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

inline FloorOutline rectangle(double length_m, double width_m) {
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Two rooms of 2.5 x 3 m and a wall of 0.1 m between them, with a door in its middle.
inline DrawnRooms rooms_with_door(double door_m) {
  return {
      5.1, 3.0, {wall(2.5, 0.0, 2.6, 1.5 - 0.5 * door_m), wall(2.5, 1.5 + 0.5 * door_m, 2.6, 3.0)}};
}

/// The greatest angle between a step and the heading it is made at.
inline double farthest_off_rad(const PathField& field) {
  const std::size_t cells = field.map.size();
  double farthest = 0.0;
  for (const NarrowEdge& edge : field.narrow_edges) {
    if (edge.from < cells || edge.to < cells) continue;
    const NarrowPose& from = field.narrow[edge.from - cells];
    const NarrowPose& to = field.narrow[edge.to - cells];
    if (from.cell == to.cell) continue;
    const Eigen::Array2i step = field.map.cell(to.cell) - field.map.cell(from.cell);
    const double off_rad = std::atan2(step.y(), step.x()) - from.pose.yaw_rad;
    farthest = std::max(farthest, std::abs(wrap_angle(off_rad)));
  }
  return farthest;
}

}  // namespace vantage
