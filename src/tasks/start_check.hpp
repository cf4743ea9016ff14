/// What keeps an episode from beginning, found before anything runs.
#pragma once

#include "vantage/sim/robots/pr2.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

/// @throws ConfigError if the torso cannot bring the laser to `candidates.height_m` or its joint
/// cannot sweep the laser's tilt range.
void check_reach(const World& world, const Pr2& robot, const Episode& episode);

/// Whether anything in the region of interest is as high as a table: rays from above, 5 x 5.
/// `geometry` is the scene's without the robot.
bool has_table(const RayScene& geometry, const Episode& episode);

/// With the robot where it starts at a table.
/// @throws InputError if nothing in the region of interest is as high as a table; ConfigError if
/// the robot would stand in that region or touch something while it turns once.
void check_start(const World& world, const Pr2& robot, const RayScene& geometry,
                 const ResolvedEpisode& resolved);

/// Where the robot starts in an office: robot.start_site or robot.start_pose.
/// @throws ConfigError naming the scene's sites if it has none of that name.
Pose2 office_start(const World& world, const ResolvedEpisode& resolved);
/// "robot.start_site 'start_0'"
std::string office_start_text(const Episode& episode);

/// The torso's lift that brings the camera from `lowest_m` to exploration.frontiers.height_m.
/// @throws ConfigError if it cannot.
double camera_lift_m(const Pr2& robot, double lowest_m, const Episode& episode);

/// @throws ConfigError if the robot would touch something while it turns once where it is;
/// `place` says which keys put it there.
void check_turning_room(const World& world, const Pr2& robot, const std::string& place);

}  // namespace vantage
