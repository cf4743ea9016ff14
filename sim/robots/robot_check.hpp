/// Everything that can be wrong with a robot's folder, found without a scene.
#pragma once

#include "vantage/sim/robots/robot_description.hpp"

namespace vantage {

/// Compiles the MJCF on its own and finds in it what robot.yaml names.
/// @throws InputError, ConfigError as load_model(), MobileBase and Quadrotor
void check_robot(const RobotFolder& robot);

}  // namespace vantage
