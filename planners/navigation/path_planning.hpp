/// Paths for the base to the goals of a PathField.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

/// A part of a path that is driven from rest to rest.
struct PathLeg {
  std::vector<Pose2> waypoints;  ///< the place it begins at first
  bool narrow = false;           ///< through a passage, at the heading of its waypoints
};

struct PlannedPath {
  std::vector<Pose2> waypoints;  ///< world; the robot's pose first; headings along the way
  std::vector<PathLeg> legs;     ///< the same in parts, if it leads through passages; else none
  double length_m = 0.0;         ///< in passages a metre counts for as many as it takes the time of
  bool reaches_goal = false;     ///< false: a fallback, the way to the nearest reachable place
  Pose2 end;                     ///< the last waypoint
};

/// The path to `goal`, ending with its heading. If the goal cannot be reached, the path leads to
/// the centre of the reachable cell nearest to it and ends facing `look_at_m` (world), or with the
/// goal's heading without one. If nothing can be reached, it is the robot's pose alone.
PlannedPath plan_path(const PathField& field, const Pose2& goal,
                      const std::optional<Eigen::Vector2d>& look_at_m = std::nullopt);

/// Pulls the points straight over open places wherever the straight way is open and costs no more
/// than what it replaces, so that clearance bought by a detour is kept.
std::vector<Eigen::Vector2d> pull_straight(const PathField& field,
                                           const std::vector<Eigen::Vector2d>& points_m);

/// Whether something occupied that the path was not planned round stands in the way: within
/// footprint_radius_m of the next `watch_m` of it, from its point nearest to the robot on, and
/// nearer to that place than to where the robot is. (Out of a tight place it must be able to go.)
bool is_way_blocked(const FloorMap& map, std::span<const Pose2> waypoints,
                    const Pose2& T_world_base, const NavigationOptions& options);

/// Length of that path; infinity if the goal cannot be reached.
double path_length_m(const PathField& field, const Pose2& goal);

}  // namespace vantage
