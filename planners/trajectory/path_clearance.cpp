#include "planners/trajectory/path_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planners/trajectory/path_spline.hpp"
#include "src/core/error.hpp"

namespace vantage {

std::vector<Eigen::Vector3d> places_along(const Horizon& horizon, double step_m) {
  expects(horizon.count() >= 2 && step_m > 0.0, "a path of two points, sampled at steps");
  std::vector<Eigen::Vector3d> waypoints;
  for (Eigen::Index i = -1; i <= horizon.count(); ++i) {
    waypoints.emplace_back(horizon.point(i).head<3>());
  }
  const PathSpline spline(waypoints);
  std::vector<Eigen::Vector3d> places;
  for (std::size_t segment = 0; segment < spline.segments(); ++segment) {
    // Tangents being of unit length at most, it goes at up to two chords a segment.
    const int steps =
        std::max(1, static_cast<int>(std::ceil(2.0 * spline.chord_m(segment) / step_m)));
    for (int k = 0; k < steps; ++k) places.push_back(spline.at(segment, k / double(steps)));
  }
  places.push_back(waypoints[waypoints.size() - 2]);
  return places;
}

double clearance_m(const SurfaceDistance& surface, std::span<const Eigen::Vector3d> p_world_m) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : p_world_m) least = std::min(least, surface.distance_m(p));
  return least;
}

double clearance_m(const SurfaceDistance& surface, const Horizon& horizon, double step_m) {
  return clearance_m(surface, places_along(horizon, step_m));
}

}  // namespace vantage
