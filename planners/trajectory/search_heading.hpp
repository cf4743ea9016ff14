/// Where to look for objects that were not found yet, while there is none to look at.
#pragma once

#include <Eigen/Core>

#include <optional>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/planners/trajectory/flight_cost.hpp"

namespace vantage {

struct SearchOptions {
  double turn_rad = 1.0;
  double below_m = 0.9;
  double range_m = 2.5;
  double min_area_m2 = 0.3;
  void fields(auto&& f) {
    f("turn_rad", turn_rad,
      "greatest turn from the direction of flight to look for objects; higher looks aside more; 0: "
      "never",
      between(0.0, 3.0));
    f("below_m", below_m,
      "height below the vehicle at which objects are looked for; higher looks for lower ones",
      at_least(0.0));
    f("range_m", range_m, "distance within which objects are looked for; higher looks farther",
      between(0.6, 10.0));
    f("min_area_m2", min_area_m2,
      "least unobserved area that the camera turns to; higher turns less", at_least(0.0));
  }
};

/// The yaw from which a camera sees most of what was not seen yet, at the height where objects are
/// looked for and before anything that is in the way there; a turn aside counts against it.
/// Nothing if that is the way ahead, or if there is too little to see.
/// @param ahead_rad yaw of the way, world
/// @param fov_rad of the camera, horizontal
std::optional<double> search_heading(const SearchOptions& options, const OccupancyGrid& grid,
                                     const Eigen::Vector3d& p_world_vehicle_m, double ahead_rad,
                                     double fov_rad);

/// What a waypoint turns to by that: a place `away_m` in the middle of the image, looked at and
/// not flown to.
/// @param path 2 waypoints or more, as they are given
std::optional<ObservationTarget> search_target(const SearchOptions& options,
                                               const OccupancyGrid& grid,
                                               const FlightCamera& camera,
                                               const Eigen::Matrix4Xd& path, Eigen::Index waypoint,
                                               double away_m);

}  // namespace vantage
