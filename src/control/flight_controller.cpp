#include "vantage/control/flight_controller.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Vertical pull, in shares of gravity, that is always kept: the thrust never points down.
constexpr double kMinLift = 0.2;
/// Cosine between thrust and wanted thrust above which integrals trust what they see.
constexpr double kAligned = 0.7;

Eigen::Vector3d shortened(const Eigen::Vector3d& v, double most) {
  const double length = v.norm();
  return length > most ? Eigen::Vector3d(most / length * v) : v;
}

/// Within what the rotors can lift and the tilt that is allowed; height comes before the way.
Eigen::Vector3d feasible_force(const Eigen::Vector3d& wanted_m_s2, const Airframe& airframe,
                               double tilt_max_rad) {
  const double max_m_s2 = kRotors * airframe.thrust_max_N / airframe.mass_kg;
  Eigen::Vector3d force = wanted_m_s2;
  force.z() = std::clamp(force.z(), kMinLift * airframe.gravity_m_s2, max_m_s2);
  const double level_m_s2 = std::min(force.z() * std::tan(tilt_max_rad),
                                     std::sqrt(max_m_s2 * max_m_s2 - force.z() * force.z()));
  const Eigen::Vector2d level = force.head<2>();
  if (level.norm() > level_m_s2) force.head<2>() = level_m_s2 / level.norm() * level;
  return force;
}

Eigen::Vector3d limited(const Eigen::Vector3d& v, double most) {
  return v.cwiseMax(-most).cwiseMin(most);
}

/// The centre of mass, about which the vehicle turns (world).
struct Motion {
  Eigen::Vector3d p_m;
  Eigen::Vector3d v_m_s;
};

Motion centre_of(const FlightState& state, const Airframe& airframe) {
  const Eigen::Matrix3d R = state.T_world_body.linear();
  return {.p_m = state.T_world_body * airframe.p_body_com_m,
          .v_m_s = state.v_world_m_s + R * state.w_body_rad_s.cross(airframe.p_body_com_m)};
}

Motion planned_centre(const FlightReference& reference, const Airframe& airframe) {
  const AttitudeReference planned =
      attitude_along(reference.a_world_m_s2 + airframe.gravity_m_s2 * Eigen::Vector3d::UnitZ(),
                     reference.j_world_m_s3, reference.yaw_rad, reference.yaw_rate_rad_s);
  const Eigen::Vector3d& com_m = airframe.p_body_com_m;
  return {
      .p_m = reference.p_world_m + planned.R_world_body * com_m,
      .v_m_s = reference.v_world_m_s + planned.R_world_body * planned.w_body_rad_s.cross(com_m)};
}

void estimate_disturbance(const Eigen::Vector3d& v_world_m_s, double period_s,
                          const FlightControllerOptions& options, FlightMemory& memory) {
  if (memory.started) {
    const Eigen::Vector3d unexplained_m_s =
        v_world_m_s - memory.v_world_m_s -
        period_s * (memory.a_given_m_s2 + memory.disturbance_m_s2);
    memory.disturbance_m_s2 =
        limited(memory.disturbance_m_s2 + options.disturbance_per_s * unexplained_m_s,
                options.disturbance_max_m_s2);
  }
  memory.v_world_m_s = v_world_m_s;
  memory.started = true;
}

/// Specific force that is wanted, and how it will change.
struct Force {
  Eigen::Vector3d m_s2;
  Eigen::Vector3d rate_m_s3 = Eigen::Vector3d::Zero();
};

/// The rate is that of the law itself, with the acceleration that the present attitude gives; none
/// where the law is cut off. [LeeLeokMcClamroch2010]
Force wanted_force(const Motion& centre, const FlightReference& reference,
                   const Eigen::Vector3d& thrust_axis, const Airframe& airframe,
                   const FlightControllerOptions& options, const FlightMemory& memory) {
  const Motion planned = planned_centre(reference, airframe);
  const Eigen::Vector3d p_error_m = centre.p_m - planned.p_m;
  const Eigen::Vector3d v_error_m_s = centre.v_m_s - planned.v_m_s;
  const Eigen::Vector3d up_m_s2 = airframe.gravity_m_s2 * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d wanted_m_s2 =
      reference.a_world_m_s2 + up_m_s2 - memory.disturbance_m_s2 -
      options.position_per_s2 * shortened(p_error_m, options.position_error_max_m) -
      options.velocity_per_s * v_error_m_s;
  Force force{.m_s2 = feasible_force(wanted_m_s2, airframe, options.tilt_max_rad)};
  const double along_m_s2 = force.m_s2.dot(thrust_axis);
  if (force.m_s2 == wanted_m_s2 && along_m_s2 > kAligned * force.m_s2.norm()) {
    const Eigen::Vector3d a_m_s2 = along_m_s2 * thrust_axis - up_m_s2 + memory.disturbance_m_s2;
    force.rate_m_s3 = reference.j_world_m_s3 - options.position_per_s2 * v_error_m_s -
                      options.velocity_per_s * (a_m_s2 - reference.a_world_m_s2);
  }
  return force;
}

/// Torque that turns the body to the reference and carries its gyroscopic part.
/// [LeeLeokMcClamroch2010]
Eigen::Vector3d attitude_torque(const FlightState& state, const AttitudeReference& wanted,
                                const Airframe& airframe, double period_s,
                                const FlightControllerOptions& options, FlightMemory& memory) {
  const Eigen::Matrix3d R = state.T_world_body.linear();
  const Eigen::Vector3d& w = state.w_body_rad_s;
  const Eigen::Vector3d w_wanted = R.transpose() * wanted.R_world_body * wanted.w_body_rad_s;
  const Eigen::Vector3d gain(options.attitude_per_s2, options.attitude_per_s2, options.yaw_per_s2);
  const Eigen::Vector3d damping(options.rate_per_s, options.rate_per_s, options.yaw_rate_per_s);
  const Eigen::Vector3d pull_rad_s2 = gain.cwiseProduct(attitude_error(R, wanted.R_world_body)) +
                                      damping.cwiseProduct(w - w_wanted);
  if (R.col(2).dot(wanted.R_world_body.col(2)) > kAligned) {
    memory.torque_rad_s2 =
        limited(memory.torque_rad_s2 + options.torque_per_s * period_s * pull_rad_s2,
                options.torque_max_rad_s2);
  }
  const Eigen::Vector3d turn_rad_s2 = -pull_rad_s2 - memory.torque_rad_s2 - w.cross(w_wanted);
  return airframe.inertia_kg_m2 * turn_rad_s2 + w.cross(airframe.inertia_kg_m2 * w);
}

}  // namespace

Eigen::Vector3d attitude_error(const Eigen::Matrix3d& R_world_body,
                               const Eigen::Matrix3d& R_world_desired) {
  const Eigen::Quaterniond q(Eigen::Matrix3d(R_world_body.transpose() * R_world_desired));
  const double turn = std::hypot(q.w(), q.z());
  if (turn < 1e-9) return {-2.0 * q.x(), -2.0 * q.y(), 0.0};  // upside down: any heading will do
  const Eigen::Vector3d to_desired(q.w() * q.x() - q.y() * q.z(), q.w() * q.y() + q.x() * q.z(),
                                   std::copysign(1.0, q.w()) * q.z());
  return -2.0 / turn * to_desired;
}

AttitudeReference attitude_along(const Eigen::Vector3d& specific_force_m_s2,
                                 const Eigen::Vector3d& force_rate_m_s3, double yaw_rad,
                                 double yaw_rate_rad_s) {
  const double force_m_s2 = specific_force_m_s2.norm();
  expects(force_m_s2 > 0.0, "free fall has no attitude");
  const Eigen::Vector3d z = specific_force_m_s2 / force_m_s2;
  const Eigen::Vector3d heading(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  const Eigen::Vector3d y = z.cross(heading).normalized();
  const Eigen::Vector3d x = y.cross(z);

  AttitudeReference attitude;
  attitude.R_world_body << x, y, z;
  const Eigen::Vector3d z_rate = (force_rate_m_s3 - z.dot(force_rate_m_s3) * z) / force_m_s2;
  attitude.w_body_rad_s = {-z_rate.dot(y), z_rate.dot(x), yaw_rate_rad_s * z.z()};
  return attitude;
}

Allocation control_flight(const FlightState& state, const FlightReference& reference,
                          const Airframe& airframe, double period_s,
                          const FlightControllerOptions& options, FlightMemory& memory) {
  const Motion centre = centre_of(state, airframe);
  estimate_disturbance(centre.v_m_s, period_s, options, memory);
  const Eigen::Vector3d axis = state.T_world_body.linear().col(2);
  const Force force = wanted_force(centre, reference, axis, airframe, options, memory);
  const AttitudeReference attitude =
      attitude_along(force.m_s2, force.rate_m_s3, reference.yaw_rad, reference.yaw_rate_rad_s);
  const Allocation given = allocate(
      airframe,
      {.collective_N = airframe.mass_kg * std::max(0.0, force.m_s2.dot(axis)),
       .torque_Nm = attitude_torque(state, attitude, airframe, period_s, options, memory)});
  memory.a_given_m_s2 = given.collective_N / airframe.mass_kg * axis -
                        airframe.gravity_m_s2 * Eigen::Vector3d::UnitZ();
  return given;
}

}  // namespace vantage
