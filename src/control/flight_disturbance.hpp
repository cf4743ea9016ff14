/// What makes flying hard: gusts of wind, and an estimate of the pose that is a little off.
#pragma once

#include <Eigen/Core>

#include <array>

#include "vantage/control/flight_controller.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

/// A disturbance: a constant force on the body for a while.
struct Gust {
  double force_N = 4.0;
  std::array<double, 3> direction = {0.0, 1.0, 0.0};
  double start_s = 0.0;
  double duration_s = 0.5;
  void fields(auto&& f) {
    f("force_N", force_N, "strength of the push; higher throws the vehicle farther off",
      between(0.0, 50.0));
    f("direction", direction, "direction of the push in the world frame; any length but 0");
    f("start_s", start_s, "simulated time at which the push begins", at_least(0.0));
    f("duration_s", duration_s, "duration of the push; higher throws the vehicle farther off",
      above(0.0));
  }
  void check() const;  ///< @throws ConfigError for a direction without length

  [[nodiscard]] Eigen::Vector3d force_world_N(double time_s) const;
};

/// Errors of position, heading and tilt that wander: Gaussian at any moment, correlated over
/// `correlation_s` (Ornstein-Uhlenbeck), as those of visual-inertial estimates are.
struct PoseNoiseOptions {
  double sigma_position_m = 0.01;
  double sigma_yaw_rad = 0.01;
  double sigma_tilt_rad = 0.003;  ///< small: gravity is easily felt
  double correlation_s = 2.0;
  void fields(auto&& f) {
    f("sigma_position_m", sigma_position_m,
      "standard deviation of the position error along each axis; higher is noisier",
      between(0.0, 1.0));
    f("sigma_yaw_rad", sigma_yaw_rad, "standard deviation of the heading error; higher is noisier",
      between(0.0, 0.5));
    f("sigma_tilt_rad", sigma_tilt_rad,
      "standard deviation of the tilt error about x and about y; higher is noisier",
      between(0.0, 0.1));
    f("correlation_s", correlation_s,
      "time over which the errors decorrelate; higher drifts more slowly", above(0.0));
  }
  static PoseNoiseOptions perfect();  ///< no errors at all
};

/// Where the vehicle believes to be. Give it a stream of random numbers of its own.
class PoseEstimate {
 public:
  PoseEstimate(const PoseNoiseOptions& options, Rng rng);

  /// Moves the errors on by `period_s`.
  void update(double period_s);
  /// The true state with the errors of now on its pose; velocities are taken as they are.
  [[nodiscard]] FlightState of(const FlightState& truth) const;

 private:
  PoseNoiseOptions options_;
  Rng rng_;
  Eigen::Matrix<double, 6, 1> error_;  ///< standardised: x, y, z, yaw, about x, about y
};

}  // namespace vantage
