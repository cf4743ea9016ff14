/// Whether a path keeps clear of what is occupied, between its waypoints too.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "planners/trajectory/horizon.hpp"
#include "planners/trajectory/surface_distance.hpp"

namespace vantage {

/// Places at most `step_m` apart along the cubic spline through the horizon's points (at a point it
/// moves parallel to the chord of its neighbours), ends included.
std::vector<Eigen::Vector3d> places_along(const Horizon& horizon, double step_m = 0.05);

/// The least distance of any of the places to the surface; infinity of none. What a vehicle has
/// left is that minus its radius, minus half the way between places at worst.
double clearance_m(const SurfaceDistance& surface, std::span<const Eigen::Vector3d> p_world_m);

/// Of the places along the horizon.
double clearance_m(const SurfaceDistance& surface, const Horizon& horizon, double step_m = 0.05);

}  // namespace vantage
