/// Velocity of a body that moves on the floor.
#pragma once

namespace vantage {

/// In the body's own frame: x forward, y left.
struct Twist2 {
  double vx_m_s = 0.0;
  double vy_m_s = 0.0;
  double wz_rad_s = 0.0;
};

}  // namespace vantage
