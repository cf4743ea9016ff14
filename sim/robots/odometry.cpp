#include "vantage/sim/robots/odometry.hpp"

#include <cmath>
#include <utility>

namespace vantage {
namespace {

/// Ornstein-Uhlenbeck over `distance_m`, exact for any length of step.
double wander(double bias, double sigma, double distance_m, double length_m, Rng& rng) {
  const double keep = std::exp(-distance_m / length_m);
  return keep * bias + sigma * std::sqrt(1.0 - keep * keep) * rng.normal();
}

OdometryBias draw_bias(const OdometryOptions& options, Rng& rng) {
  OdometryBias bias;
  bias.x_m_per_m = options.bias_translation_m_per_m * rng.normal();
  bias.y_m_per_m = options.bias_translation_m_per_m * rng.normal();
  bias.yaw_rad_per_m = options.bias_yaw_rad_per_m * rng.normal();
  return bias;
}

}  // namespace

OdometryOptions OdometryOptions::perfect() {
  OdometryOptions options;
  options.sigma_translation_m = 0.0;
  options.sigma_yaw_rad = 0.0;
  options.sigma_turn_rad = 0.0;
  options.bias_translation_m_per_m = 0.0;
  options.bias_yaw_rad_per_m = 0.0;
  return options;
}

Pose2 measure_increment(const Pose2& T_previous_now, OdometryBias& bias,
                        const OdometryOptions& options, Rng& rng) {
  const double distance_m = std::hypot(T_previous_now.x_m, T_previous_now.y_m);
  const double turn_rad = std::abs(T_previous_now.yaw_rad);
  const double b = options.bias_translation_m_per_m;
  bias.x_m_per_m = wander(bias.x_m_per_m, b, distance_m, options.bias_length_m, rng);
  bias.y_m_per_m = wander(bias.y_m_per_m, b, distance_m, options.bias_length_m, rng);
  bias.yaw_rad_per_m = wander(bias.yaw_rad_per_m, options.bias_yaw_rad_per_m, distance_m,
                              options.bias_length_m, rng);

  const double sigma_m = options.sigma_translation_m * std::sqrt(distance_m);
  const double sigma_rad = std::sqrt(options.sigma_yaw_rad * options.sigma_yaw_rad * distance_m +
                                     options.sigma_turn_rad * options.sigma_turn_rad * turn_rad);
  Pose2 measured = T_previous_now;
  measured.x_m += bias.x_m_per_m * distance_m + sigma_m * rng.normal();
  measured.y_m += bias.y_m_per_m * distance_m + sigma_m * rng.normal();
  measured.yaw_rad += bias.yaw_rad_per_m * distance_m + sigma_rad * rng.normal();
  return measured;
}

Odometry::Odometry(const OdometryOptions& options, Rng rng, const Pose2& T_world_base_true)
    : options_(options),
      rng_(rng),
      T_world_base_true_(T_world_base_true),
      T_world_base_(T_world_base_true) {
  check_options(options_, "odometry");
  bias_ = draw_bias(options_, rng_);
}

Pose2 Odometry::update(const Pose2& T_world_base_true) {
  const Pose2 T_previous_now = compose(inverse(T_world_base_true_), T_world_base_true);
  T_world_base_true_ = T_world_base_true;
  Pose2 measured = measure_increment(T_previous_now, bias_, options_, rng_);
  if (on_increment) measured = on_increment(measured);
  T_world_base_ = compose(T_world_base_, measured);
  return measured;
}

}  // namespace vantage
