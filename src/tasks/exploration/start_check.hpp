/// What keeps an exploration from beginning, found before anything runs.
#pragma once

#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/exploration/exploration.hpp"

namespace vantage {

class MobileBase;
class RayScene;
class World;

/// With the robot where it starts. `geometry` is the scene's without the robot.
/// @throws InputError if there is no floor, or no room on it; ConfigError if the map or the floor
/// map does not hold the start.
void check_exploration_start(const World& world, const MobileBase& robot, const RayScene& geometry,
                             const EpisodeSetup& setup, const Exploration& task);

/// What the floor map leaves out of the map; "" if nothing.
std::string floor_map_note(const Exploration& task);

/// "robot.start_site 'start_0'"
std::string start_text(const RobotOptions& robot);

}  // namespace vantage
