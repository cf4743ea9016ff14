/// What keeps an episode from beginning, found before anything runs.
#pragma once

#include "sim/pr2.hpp"
#include "sim/ray_scene.hpp"
#include "sim/world.hpp"
#include "src/episode/scenario.hpp"

namespace vantage {

/// @throws ConfigError if the torso cannot bring the laser to `candidates.height_m` or its joint
/// cannot sweep the laser's tilt range.
void check_reach(const World& world, const Pr2& robot, const Episode& episode);

/// Whether anything in the region of interest is as high as a table: rays from above, 5 x 5.
/// `geometry` is the scene's without the robot.
bool has_table(const RayScene& geometry, const Episode& episode);

/// With the robot where it starts.
/// @throws InputError if nothing in the region of interest is as high as a table; ConfigError if
/// the robot would stand in that region or touch something while it turns once.
void check_start(const World& world, const Pr2& robot, const RayScene& geometry,
                 const ResolvedEpisode& resolved);

}  // namespace vantage
