/// What is really so of a quadrotor that flies round an object. For evaluators alone.
#pragma once

namespace vantage {

struct OrbitGroundTruth {
  int collisions = 0;
  double position_error_m = 0.0;  ///< camera, from where it was meant to be
  double angle_error_rad = 0.0;   ///< camera, from how it was meant to be turned
  double object_angle_rad = 0.0;  ///< yaw of the target as the camera sees it, [0, 2 pi)
};

}  // namespace vantage
