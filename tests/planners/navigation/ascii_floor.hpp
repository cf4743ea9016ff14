/// Floor maps drawn in ASCII, the top row at the highest y: '#' occupied, '?' unknown, anything
/// else free. Cells are 1 m, the lower left corner is the origin.
#pragma once

#include <string>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

using Drawing = std::vector<std::string>;

inline FloorMap floor_of(const Drawing& rows) {
  const auto ny = rows.size();
  FloorMap map(Eigen::Vector2d::Zero(), 1.0, static_cast<int>(rows.front().size()),
               static_cast<int>(ny));
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    const Eigen::Array2i at = map.cell(cell);
    const char drawn =
        rows[ny - 1 - static_cast<std::size_t>(at.y())][static_cast<std::size_t>(at.x())];
    map.log_odds[cell] = drawn == '#' ? 3.0F : (drawn == '?' ? 0.0F : -3.0F);
  }
  return map;
}

/// Centre of the first cell drawn as `mark`.
inline Pose2 place_of(const Drawing& rows, char mark, double yaw_rad = 0.0) {
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto column = rows[row].find(mark);
    if (column == std::string::npos) continue;
    return {static_cast<double>(column) + 0.5, static_cast<double>(rows.size() - 1 - row) + 0.5,
            yaw_rad};
  }
  expects(false, "the mark is not in the drawing");
  return {};
}

/// A robot that fits wherever its centre's cell is free.
inline NavigationOptions point_robot() {
  NavigationOptions options;
  options.footprint_radius_m = 0.9;
  options.margin_m = 0.0;
  options.clearance_weight = 0.0;
  return options;
}

}  // namespace vantage
