/// What a scene to fly through publishes beside its MJCF: the path, and where objects may stand.
#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <span>
#include <vector>

#include "vantage/control/minimum_jerk_trajectory.hpp"

namespace vantage {

struct FlightLayout {
  std::vector<FlightWaypoint> path;         ///< of the vehicle's body, camera ahead; known to it
  std::vector<Eigen::Vector3d> supports_m;  ///< middles of the tops, world; truth, not known to it
};

/// Reads path.csv and stands.csv beside `scene`, an MJCF file.
/// @throws InputError naming file, line and column if one is missing, malformed or has no row,
/// or if the path has only one.
FlightLayout read_flight_layout(const std::filesystem::path& scene);

/// What to map for a flight along that path: its box, wider by `margin_m` on all sides, from the
/// floor to `headroom_m` above the highest waypoint.
Eigen::AlignedBox3d flight_region(std::span<const FlightWaypoint> path, double margin_m = 3.0,
                                  double headroom_m = 0.8);

}  // namespace vantage
