#include "vantage/tasks/flight/flight_world.hpp"

#include <fmt/format.h>

#include "vantage/core/error.hpp"

namespace vantage {

void require_flight_world(const WorldOptions& simulation) {
  if (simulation.steps_per_tick() == 1) return;
  throw ConfigError(fmt::format(
      "simulation.control_period_s: {} must equal simulation.timestep_s = {}: a quadrotor is "
      "commanded at every step",
      simulation.control_period_s, simulation.timestep_s));
}

}  // namespace vantage
