/// What an episode leaves out and its robot knows.
#pragma once

#include <string_view>

#include "vantage/core/config_node.hpp"
#include "vantage/sim/robots/robot_description.hpp"

namespace vantage {

/// `episode` with, where it sets no other value, what robot.yaml's `episode_defaults` says for that
/// task, and, for a mobile base that navigates, `navigation.footprint_radius_m` of its footprint: a
/// centimetre more than the circle that covers it.
/// @param keys of the episode and its task
ConfigNode with_robot_defaults(const ConfigNode& episode, const ConfigNode& keys,
                               const RobotFolder& robot, std::string_view task);

}  // namespace vantage
