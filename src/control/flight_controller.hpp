/// Geometric tracking control of a quadrotor on SE(3): state and reference in, four thrusts out.
/// Pure: no clock, no world. [LeeLeokMcClamroch2010]
#pragma once

#include <Eigen/Core>

#include "vantage/control/airframe.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

struct FlightState {
  Pose T_world_body = Pose::Identity();
  Eigen::Vector3d v_world_m_s = Eigen::Vector3d::Zero();   ///< of the body's origin
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();  ///< body axes
};

/// Where the body's origin should be and how it should move there; x axis along `yaw_rad`.
struct FlightReference {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_world_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d a_world_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d j_world_m_s3 = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double yaw_rate_rad_s = 0.0;
};

/// Gains are per unit of mass or inertia, so that they are those of any airframe.
struct FlightControllerOptions {
  double position_per_s2 = 16.0;
  double velocity_per_s = 6.5;
  double disturbance_per_s = 7.0;
  double disturbance_max_m_s2 = 4.0;
  double position_error_max_m = 1.0;
  double attitude_per_s2 = 240.0;
  double rate_per_s = 22.0;
  double yaw_per_s2 = 25.0;
  double yaw_rate_per_s = 9.0;
  double torque_per_s = 1.0;
  double torque_max_rad_s2 = 40.0;
  double tilt_max_rad = 0.6;
  void fields(auto&& f) {
    f("position_per_s2", position_per_s2,
      "acceleration per position error; higher is stiffer, and rings where the attitude cannot "
      "follow",
      Range{0.0, 50.0, true});
    f("velocity_per_s", velocity_per_s,
      "acceleration per velocity error; higher damps more, and amplifies noise of the velocity",
      Range{0.0, 20.0, true});
    f("disturbance_per_s", disturbance_per_s,
      "rate at which a disturbing force is estimated (integral action); higher adapts faster and "
      "rings; 0: none",
      between(0.0, 20.0));
    f("disturbance_max_m_s2", disturbance_max_m_s2,
      "strongest disturbance that is compensated, per axis and unit of mass; higher withstands "
      "stronger wind",
      between(0.0, 10.0));
    f("position_error_max_m", position_error_max_m,
      "position error that larger ones are cut to; higher approaches a far reference faster",
      Range{0.0, 10.0, true});
    f("attitude_per_s2", attitude_per_s2,
      "angular acceleration per tilt error; higher is faster, and rings by the lag of the motors",
      Range{0.0, 1000.0, true});
    f("rate_per_s", rate_per_s,
      "angular acceleration per error of the tilt rate; higher damps more, and rings above 1 / "
      "motor lag",
      Range{0.0, 100.0, true});
    f("yaw_per_s2", yaw_per_s2,
      "angular acceleration per heading error; higher is faster and saturates the rotors earlier",
      Range{0.0, 200.0, true});
    f("yaw_rate_per_s", yaw_rate_per_s,
      "angular acceleration per error of the yaw rate; higher damps the heading more",
      Range{0.0, 50.0, true});
    f("torque_per_s", torque_per_s,
      "rate at which a disturbing torque is learnt (integral action); higher adapts faster and "
      "rings; 0: none",
      between(0.0, 10.0));
    f("torque_max_rad_s2", torque_max_rad_s2,
      "strongest torque that is compensated, per axis and unit of inertia", between(0.0, 200.0));
    f("tilt_max_rad", tilt_max_rad, "greatest tilt that is commanded; higher accelerates harder",
      Range{0.0, 1.2, true});
  }
};

/// What the controller remembers between periods; its integral action.
struct FlightMemory {
  /// Disturbance: acceleration beside thrust and gravity, m/s^2, world, by a first-order observer
  /// of the momentum. It compares the change of velocity with the thrust that was given, not with
  /// the reference, so that no step, saturation or tumble winds it up.
  Eigen::Vector3d disturbance_m_s2 = Eigen::Vector3d::Zero();
  /// What turns beside the rotors, over inertia, rad/s^2, body axes: integral of the attitude's
  /// pull.
  Eigen::Vector3d torque_rad_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_world_m_s = Eigen::Vector3d::Zero();   ///< centre of mass, last period
  Eigen::Vector3d a_given_m_s2 = Eigen::Vector3d::Zero();  ///< thrust and gravity, last period
  bool started = false;
};

/// How far R is turned from R_desired, in body axes: x and y take the thrust axis the short way,
/// whatever the heading, z is about the heading that is left then; 2 sin(angle / 2) each. To first
/// order the error of Lee 2010, but a large error of heading does not turn into one of tilt, and it
/// grows up to half a turn. [BrescianiniDAndrea2020]
Eigen::Vector3d attitude_error(const Eigen::Matrix3d& R_world_body,
                               const Eigen::Matrix3d& R_world_desired);

/// An attitude with its angular velocity.
struct AttitudeReference {
  Eigen::Matrix3d R_world_body = Eigen::Matrix3d::Identity();
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();
};

/// The attitude whose z axis lies along `specific_force_m_s2` (world; acceleration less gravity)
/// and whose x axis heads along `yaw_rad`, and how it turns while the force changes at
/// `force_rate_m_s3`. [MellingerKumar2011]
AttitudeReference attitude_along(const Eigen::Vector3d& specific_force_m_s2,
                                 const Eigen::Vector3d& force_rate_m_s3, double yaw_rad,
                                 double yaw_rate_rad_s);

/// One period: moves `memory` on and returns the thrusts.
Allocation control_flight(const FlightState& state, const FlightReference& reference,
                          const Airframe& airframe, double period_s,
                          const FlightControllerOptions& options, FlightMemory& memory);

}  // namespace vantage
