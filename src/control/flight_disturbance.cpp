#include "vantage/control/flight_disturbance.hpp"

#include <cmath>

namespace vantage {

void Gust::check() const {
  if (Eigen::Map<const Eigen::Vector3d>(direction.data()).norm() < 1e-9) {
    throw ConfigError("direction must not be of length 0");
  }
}

Eigen::Vector3d Gust::force_world_N(double time_s) const {
  if (time_s < start_s || time_s >= start_s + duration_s) return Eigen::Vector3d::Zero();
  return force_N * Eigen::Map<const Eigen::Vector3d>(direction.data()).normalized();
}

PoseNoiseOptions PoseNoiseOptions::perfect() {
  return {.sigma_position_m = 0.0, .sigma_yaw_rad = 0.0, .sigma_tilt_rad = 0.0};
}

PoseEstimate::PoseEstimate(const PoseNoiseOptions& options, Rng rng)
    : options_(options), rng_(rng) {
  check_options(options_, "pose_noise");
  for (double& error : error_) error = rng_.normal();
}

void PoseEstimate::update(double period_s) {
  const double keep = std::exp(-period_s / options_.correlation_s);
  const double renew = std::sqrt(1.0 - keep * keep);
  for (double& error : error_) error = keep * error + renew * rng_.normal();
}

FlightState PoseEstimate::of(const FlightState& truth) const {
  const double yaw_rad = options_.sigma_yaw_rad * error_[3];
  const Eigen::Vector3d tilt_rad =
      options_.sigma_tilt_rad * Eigen::Vector3d(error_[4], error_[5], 0.0);
  FlightState estimate = truth;
  estimate.T_world_body.translation() += options_.sigma_position_m * error_.head<3>();
  if (yaw_rad == 0.0 && tilt_rad.isZero(0.0)) return estimate;
  const Eigen::Vector3d axis = tilt_rad.normalized();
  estimate.T_world_body.linear() =
      Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
      Eigen::AngleAxisd(tilt_rad.norm(), axis).toRotationMatrix() * truth.T_world_body.linear();
  return estimate;
}

}  // namespace vantage
