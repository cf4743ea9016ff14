/// How the world of a quadrotor is stepped.
#pragma once

#include "vantage/sim/world/world_options.hpp"

namespace vantage {

/// @throws ConfigError unless thrusts are commanded at every physics step.
void require_flight_world(const WorldOptions& simulation);

}  // namespace vantage
