/// How the space round a sensor is divided for a sweep.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/visibility/sweep_tables.hpp"

namespace vantage {

/// One of the six pyramids round a sensor: the cells to which a ray advances most along one axis.
struct Pyramid {
  int axis = 0;
  bool ascending = true;  ///< away from the sensor, the axis' index grows
};
inline constexpr std::array<Pyramid, 6> kPyramids{
    {{0, true}, {0, false}, {1, true}, {1, false}, {2, true}, {2, false}}};

/// Whether some direction of the pyramid may be inside the view's cone.
inline bool may_see(const ViewCone& view, const Pyramid& pyramid,
                    const Eigen::Vector3d& cell_size_m) {
  const SweepAxes axes = sweep_axes(pyramid.axis);
  return std::ranges::all_of(view.normals(), [&](const Eigen::Vector3d& normal) {
    const Eigen::Vector3d inwards = normal.cwiseProduct(cell_size_m);
    const double ahead = pyramid.ascending ? inwards[axes.w] : -inwards[axes.w];
    return ahead + std::abs(inwards[axes.u]) + std::abs(inwards[axes.v]) >= 0.0;
  });
}

}  // namespace vantage
