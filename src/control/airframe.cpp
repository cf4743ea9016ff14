#include "vantage/control/airframe.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kAirDensity_kg_m3 = 1.225;

/// The share in [0, 1] of `extra` that fits on top of thrusts that are in range themselves.
double fitting_share(const Eigen::Vector4d& thrust_N, const Eigen::Vector4d& extra_N,
                     double max_N) {
  double share = 1.0;
  for (int i = 0; i < kRotors; ++i) {
    const double room_N = extra_N[i] > 0.0 ? max_N - thrust_N[i] : thrust_N[i];
    if (std::abs(extra_N[i]) > room_N) {
      share = std::min(share, std::max(0.0, room_N) / std::abs(extra_N[i]));
    }
  }
  return share;
}

/// The share of `tilt_N` (thrusts that make torque without force) that some collective force makes
/// room for, if rotors carry `weight` of it each.
double tilt_share(const Eigen::Vector4d& weight, const Eigen::Vector4d& tilt_N, double max_N) {
  double share = 1.0;
  for (int i = 0; i < kRotors; ++i) {
    for (int j = 0; j < kRotors; ++j) {
      const double span = tilt_N[j] / weight[j] - tilt_N[i] / weight[i];
      if (share * span * weight[j] > max_N) share = max_N / (span * weight[j]);
    }
  }
  return share;
}

/// The collective force nearest to `wanted_N` with room for `tilt_N` beside it.
double fitting_collective(const Eigen::Vector4d& weight, const Eigen::Vector4d& tilt_N,
                          double max_N, double wanted_N) {
  const double least_N = (-tilt_N.array() / weight.array()).maxCoeff();
  const double most_N = ((max_N - tilt_N.array()) / weight.array()).minCoeff();
  return std::min(std::max(wanted_N, least_N), most_N);
}

}  // namespace

Eigen::Matrix4d mixing_matrix(const Airframe& airframe) {
  Eigen::Matrix4d B;
  for (int i = 0; i < kRotors; ++i) {
    const Rotor& rotor = airframe.rotors[static_cast<std::size_t>(i)];
    const Eigen::Vector3d arm_m = rotor.p_body_m - airframe.p_body_com_m;
    B.col(i) << 1.0, arm_m.y(), -arm_m.x(), rotor.torque_per_thrust_m;
  }
  return B;
}

Wrench wrench_of(const Airframe& airframe, const Eigen::Vector4d& thrust_N) {
  const Eigen::Vector4d wrench = mixing_matrix(airframe) * thrust_N;
  return {.collective_N = wrench[0], .torque_Nm = wrench.tail<3>()};
}

Allocation allocate(const Airframe& airframe, const Wrench& wrench) {
  const Eigen::Matrix4d thrusts_of = mixing_matrix(airframe).inverse();
  const Eigen::Vector4d weight = thrusts_of.col(0);
  expects((weight.array() > 0.0).all(), "the centre of mass lies amid the rotors");
  const Eigen::Vector4d tilt_N = thrusts_of.middleCols<2>(1) * wrench.torque_Nm.head<2>();
  const Eigen::Vector4d yaw_N = thrusts_of.col(3) * wrench.torque_Nm.z();
  const double max_N = airframe.thrust_max_N;

  Allocation given;
  given.tilt_share = tilt_share(weight, tilt_N, max_N);
  const Eigen::Vector4d kept_N = given.tilt_share * tilt_N;
  given.collective_N = fitting_collective(weight, kept_N, max_N, wrench.collective_N);
  const Eigen::Vector4d without_yaw_N = given.collective_N * weight + kept_N;
  given.yaw_share = fitting_share(without_yaw_N, yaw_N, max_N);
  given.thrust_N = (without_yaw_N + given.yaw_share * yaw_N).cwiseMax(0.0).cwiseMin(max_N);
  return given;
}

double induced_power_W(const Eigen::Vector4d& thrust_N, double rotor_radius_m) {
  const double disc_m2 = std::numbers::pi * rotor_radius_m * rotor_radius_m;
  double power_W = 0.0;
  for (const double thrust : thrust_N) {
    power_W += thrust * std::sqrt(thrust / (2.0 * kAirDensity_kg_m3 * disc_m2));
  }
  return power_W;
}

}  // namespace vantage
