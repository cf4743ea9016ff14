/// What a scene to fly through publishes beside its MJCF, and its vehicle knows.
#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <span>
#include <vector>

#include "vantage/control/minimum_jerk_trajectory.hpp"

namespace vantage {

/// The path of the vehicle's body, camera ahead, of path.csv beside `scene`, an MJCF file. The
/// vehicle knows it.
/// @throws InputError naming file, line and column if it is missing or malformed, or has fewer than
/// two waypoints.
std::vector<FlightWaypoint> read_flight_path(const std::filesystem::path& scene);

/// What to map for a flight along that path: its box, wider by `margin_m` on all sides, from the
/// floor to `headroom_m` above the highest waypoint.
Eigen::AlignedBox3d flight_region(std::span<const FlightWaypoint> path, double margin_m = 3.0,
                                  double headroom_m = 0.8);

}  // namespace vantage
