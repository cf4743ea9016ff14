/// What is really so of a quadrotor in flight. For evaluators and the end of the episode alone.
#pragma once

namespace vantage {

struct TrajectoryGroundTruth {
  int collisions = 0;
  double minimum_clearance_m = 0.0;  ///< so far, body surface to anything
  double tracking_error_mean_m = 0.0;
  double tracking_error_max_m = 0.0;
  double energy_j = 0.0;  ///< induced power of the rotors, integrated
  double flown_m = 0.0;
};

}  // namespace vantage
