/// A view as it is drawn into a map.
#pragma once

#include <array>

#include "vantage/geometry/pose.hpp"
#include "vantage/runtime/drawing/map_view.hpp"

namespace vantage {

/// Pyramid of a view: tip at the sensor, opening along x.
inline void draw_frustum(MapCanvas& canvas, const MapCamera& camera, const Pose& T_world_sensor,
                         double length_m, const LineStyle& style) {
  const std::array<Eigen::Vector3d, 4> rim{
      {{1, .3, .2}, {1, -.3, .2}, {1, -.3, -.2}, {1, .3, -.2}}};
  const Eigen::Vector3d tip = T_world_sensor.translation();
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = T_world_sensor * Eigen::Vector3d(length_m * rim[i]);
    const Eigen::Vector3d next = T_world_sensor * Eigen::Vector3d(length_m * rim[(i + 1) % 4]);
    draw_line(canvas, camera, tip, p, style);
    draw_line(canvas, camera, p, next, style);
  }
}

}  // namespace vantage
