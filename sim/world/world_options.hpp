/// How the simulated world is stepped.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct WorldOptions {
  double timestep_s = 0.0025;
  double control_period_s = 0.025;
  void fields(auto&& f) {
    f("timestep_s", timestep_s, "time step of the physics; higher is faster and less stable",
      Range{1e-5, 0.02});
    f("control_period_s", control_period_s,
      "time for which commands stay constant, a whole multiple of the time step; higher reacts "
      "later",
      Range{1e-5, 1.0});
  }
  void check() const;  ///< @throws ConfigError if the period is no whole multiple of the step
  [[nodiscard]] int steps_per_tick() const;
};

}  // namespace vantage
