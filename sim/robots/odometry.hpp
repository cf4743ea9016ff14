/// Dead reckoning as the wheels give it: good over a metre, adrift over a room.
#pragma once

#include <functional>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

/// Errors are a random walk in distance (their variance grows with it, whatever the tick), plus
/// biases that wander slowly (Ornstein-Uhlenbeck in distance). A robot at rest makes no error.
struct OdometryOptions {
  double sigma_translation_m = 0.01;
  double sigma_yaw_rad = 0.01;
  double sigma_turn_rad = 0.02;
  double bias_translation_m_per_m = 0.01;
  double bias_yaw_rad_per_m = 0.005;
  double bias_length_m = 5.0;
  void fields(auto&& f) {
    f("sigma_translation_m", sigma_translation_m,
      "standard deviation of the position error along each axis after 1 m driven; higher is "
      "noisier",
      at_least(0.0));
    f("sigma_yaw_rad", sigma_yaw_rad,
      "standard deviation of the heading error after 1 m driven; higher is noisier", at_least(0.0));
    f("sigma_turn_rad", sigma_turn_rad,
      "standard deviation of the heading error after 1 rad turned; higher is noisier",
      at_least(0.0));
    f("bias_translation_m_per_m", bias_translation_m_per_m,
      "standard deviation of the slowly wandering position error along each axis, per metre "
      "driven; higher drifts faster",
      at_least(0.0));
    f("bias_yaw_rad_per_m", bias_yaw_rad_per_m,
      "standard deviation of the slowly wandering heading error, per metre driven; higher drifts "
      "faster",
      at_least(0.0));
    f("bias_length_m", bias_length_m,
      "distance driven over which these biases decorrelate; higher drifts longer to one side",
      above(0.0));
  }
  static OdometryOptions perfect();  ///< no errors at all
};

/// Per metre driven: along x, along y, and in heading.
struct OdometryBias {
  double x_m_per_m = 0.0;
  double y_m_per_m = 0.0;
  double yaw_rad_per_m = 0.0;
};

/// The increment that the wheels report for the true one; moves `bias` on by the distance.
Pose2 measure_increment(const Pose2& T_previous_now, OdometryBias& bias,
                        const OdometryOptions& options, Rng& rng);

/// Where the robot believes to be. Give it a stream of random numbers of its own.
class Odometry {
 public:
  /// Starts right at the true pose.
  Odometry(const OdometryOptions& options, Rng rng, const Pose2& T_world_base_true);

  /// Once per tick. @return the increment measured, T_previous_now.
  Pose2 update(const Pose2& T_world_base_true);
  [[nodiscard]] const Pose2& estimate() const { return T_world_base_; }
  /// Replaces the estimate, after a registration.
  void correct(const Pose2& T_world_base) { T_world_base_ = T_world_base; }
  [[nodiscard]] const OdometryBias& bias() const { return bias_; }
  /// What wheels report that fail, for the increment that they would have measured; may be empty.
  std::function<Pose2(const Pose2&)> on_increment;

 private:
  OdometryOptions options_;
  Rng rng_;
  OdometryBias bias_;
  Pose2 T_world_base_true_;
  Pose2 T_world_base_;
};

}  // namespace vantage
