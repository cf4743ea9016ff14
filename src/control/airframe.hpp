/// What a quadrotor is to its controller, and how a wanted force and torque become four thrusts.
#pragma once

#include <Eigen/Core>

#include <array>

namespace vantage {

inline constexpr int kRotors = 4;

/// Body frame: x forward, y left, z along the rotors' thrust.
struct Rotor {
  Eigen::Vector3d p_body_m = Eigen::Vector3d::Zero();
  double torque_per_thrust_m = 0.0;  ///< reaction about body z, N m per N; signed
};

struct Airframe {
  double mass_kg = 0.0;
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about the centre of mass, body axes
  Eigen::Vector3d p_body_com_m = Eigen::Vector3d::Zero();   ///< centre of mass
  std::array<Rotor, kRotors> rotors;
  double thrust_max_N = 0.0;  ///< of one rotor; the least is 0
  double gravity_m_s2 = 9.81;

  [[nodiscard]] double weight_N() const { return mass_kg * gravity_m_s2; }
};

/// Force along body z and torque about the centre of mass, body axes.
struct Wrench {
  double collective_N = 0.0;
  Eigen::Vector3d torque_Nm = Eigen::Vector3d::Zero();
};

/// The matrix B of (collective, torque x, y, z) = B thrusts, about the true centre of mass.
Eigen::Matrix4d mixing_matrix(const Airframe& airframe);

Wrench wrench_of(const Airframe& airframe, const Eigen::Vector4d& thrust_N);

/// Thrusts within [0, thrust_max_N] and what of the wrench they give.
struct Allocation {
  Eigen::Vector4d thrust_N = Eigen::Vector4d::Zero();
  double collective_N = 0.0;  ///< as given
  double tilt_share = 1.0;    ///< of the torque about x and y
  double yaw_share = 1.0;     ///< of the torque about z
};

/// What cannot be had of a wrench is given up in this order: torque about z, collective force,
/// torque about x and y. The last two are what keeps it from tumbling.
Allocation allocate(const Airframe& airframe, const Wrench& wrench);

/// Ideal power of the rotors, W: sum of T^1.5 / sqrt(2 rho A), momentum theory at hover
/// [Leishman2006].
double induced_power_W(const Eigen::Vector4d& thrust_N, double rotor_radius_m);

}  // namespace vantage
