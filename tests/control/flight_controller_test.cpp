#include "vantage/control/flight_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/control/flight_kit.hpp"

namespace vantage {
namespace {

using test::airframe;
constexpr double kFlightPeriod_s = 0.002;

Eigen::Matrix3d turned(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

TEST(AttitudeError, OfKnownTurns) {
  const Eigen::Matrix3d desired = turned(0.7, {0.2, 0.1, 1.0});
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0.6, -0.8, 0.0), Eigen::Vector3d(0.0, 0.0, 1.0)}) {
    for (const double angle : {0.01, 0.5, 1.5, 3.0, std::numbers::pi}) {
      const Eigen::Vector3d error = attitude_error(desired * turned(angle, axis), desired);
      const Eigen::Vector3d expected = 2.0 * std::sin(angle / 2.0) * axis;
      EXPECT_TRUE(error.isApprox(expected, 1e-9) ||
                  (angle == std::numbers::pi && error.isApprox(-expected, 1e-9)))
          << angle;
    }
    // Beyond half a turn the short way is the other way.
    EXPECT_TRUE(attitude_error(desired * turned(4.0, axis), desired)
                    .isApprox(-2.0 * std::sin((2.0 * std::numbers::pi - 4.0) / 2.0) * axis, 1e-9));
  }
  EXPECT_LT(attitude_error(desired, desired).norm(), 1e-12);
}

TEST(AttitudeError, TurnsTheThrustAxisTheShortWayWhateverTheHeading) {
  for (const double yaw : {-3.1, -1.0, 0.3, 3.0}) {
    const Eigen::Matrix3d R = turned(0.8, {0.3, 1.0, 0.2});
    const Eigen::Matrix3d desired = turned(0.5, {1.0, -0.4, 0.0}) * turned(yaw, {0.0, 0.0, 1.0});
    const Eigen::Vector3d error = attitude_error(R, desired);
    const Eigen::Vector3d wanted = R.transpose() * desired.col(2);  // thrust axis, in body axes
    const Eigen::Vector3d way = Eigen::Vector3d::UnitZ().cross(wanted).normalized();
    const double angle = std::acos(wanted.z());
    EXPECT_LT((error.head<2>() + 2.0 * std::sin(angle / 2.0) * way.head<2>()).norm(), 1e-9) << yaw;
  }
}

TEST(AttitudeError, IsThatOfLeeToFirstOrder) {
  const Eigen::Matrix3d R = turned(0.002, {1.0, 2.0, 3.0});
  const Eigen::Matrix3d skew = 0.5 * (R - R.transpose());
  const Eigen::Vector3d lee(skew(2, 1), skew(0, 2), skew(1, 0));
  EXPECT_LT((attitude_error(R, Eigen::Matrix3d::Identity()) - lee).norm(), 0.002 * lee.norm());
}

TEST(AttitudeAlong, PointsThrustAndHeading) {
  const Eigen::Vector3d force(2.0, -1.0, 9.0);
  const Eigen::Matrix3d R = attitude_along(force, Eigen::Vector3d::Zero(), 0.8, 0.0).R_world_body;
  EXPECT_TRUE(R.col(2).isApprox(force.normalized(), 1e-12));
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)), 0.8, 0.05);
  EXPECT_NEAR(R.col(1).dot(Eigen::Vector3d(std::cos(0.8), std::sin(0.8), 0.0)), 0.0, 1e-12);
}

TEST(AttitudeAlong, TurnsAsTheForceChanges) {
  constexpr double kStep_s = 1e-6;
  const Eigen::Vector3d force(2.0, -1.0, 9.0);
  const Eigen::Vector3d rate(1.0, 3.0, -2.0);
  const AttitudeReference now = attitude_along(force, rate, 0.8, 0.0);
  const AttitudeReference next =
      attitude_along(force + kStep_s * rate, Eigen::Vector3d::Zero(), 0.8, 0.0);
  const Eigen::Vector3d w = attitude_error(next.R_world_body, now.R_world_body) / kStep_s;
  EXPECT_NEAR(w.x(), now.w_body_rad_s.x(), 1e-4);
  EXPECT_NEAR(w.y(), now.w_body_rad_s.y(), 1e-4);
}

TEST(ControlFlight, HoverCarriesTheWeight) {
  const Airframe frame = airframe();
  FlightMemory memory;
  const Allocation given = control_flight({}, {}, frame, kFlightPeriod_s, {}, memory);
  const Wrench got = wrench_of(frame, given.thrust_N);
  EXPECT_NEAR(got.collective_N, 1.24 * 9.81, 1e-9);
  EXPECT_LT(got.torque_Nm.norm(), 1e-9);
}

TEST(ControlFlight, PushesTowardsTheReference) {
  const Airframe frame = airframe();
  const auto torque = [&](const Eigen::Vector3d& p_m, double yaw_rad) {
    FlightMemory memory;
    const FlightReference reference{.p_world_m = p_m, .yaw_rad = yaw_rad};
    const Allocation given = control_flight({}, reference, frame, kFlightPeriod_s, {}, memory);
    return wrench_of(frame, given.thrust_N);
  };
  EXPECT_GT(torque({0.3, 0.0, 0.0}, 0.0).torque_Nm.y(), 0.1) << "forward: nose down";
  EXPECT_LT(torque({0.0, 0.3, 0.0}, 0.0).torque_Nm.x(), -0.1) << "left: roll to the left";
  EXPECT_GT(torque({0.0, 0.0, 0.3}, 0.0).collective_N, 1.24 * 9.81 + 1.0);
  EXPECT_GT(torque({0.0, 0.0, 0.0}, 0.2).torque_Nm.z(), 0.01);
}

/// Level, at the wanted heading and yaw rate r, but rolling at p: J (-k_p p, p r, 0) + w x J w.
TEST(ControlFlight, TurnsWithTheReferenceThatTurns) {
  const Airframe frame = airframe();
  const double p = 0.3;
  const double r = 0.8;
  FlightState state;
  state.w_body_rad_s = {p, 0.0, r};
  const Eigen::Vector3d arm = frame.p_body_com_m;
  const FlightReference reference{.yaw_rate_rad_s = r};
  FlightControllerOptions options;
  options.torque_per_s = 0.0;
  options.position_per_s2 = 1e-9;  // its position and velocity ask for nothing
  options.velocity_per_s = 1e-9;
  FlightMemory memory;
  const Allocation given =
      control_flight(state, reference, frame, kFlightPeriod_s, options, memory);
  const Eigen::Vector3d w = state.w_body_rad_s;
  const Eigen::Vector3d turn(-options.rate_per_s * p, p * r, 0.0);
  const Eigen::Vector3d expected = frame.inertia_kg_m2 * turn + w.cross(frame.inertia_kg_m2 * w);
  EXPECT_GT(arm.norm(), 0.0);
  EXPECT_LT((wrench_of(frame, given.thrust_N).torque_Nm - expected).norm(), 1e-6);
}

TEST(ControlFlight, NeverAsksForMoreTiltThanAllowed) {
  // Level is as far as it may tilt if the allowed tilt is next to nothing: no torque, however far
  // off it is.
  const Airframe frame = airframe();
  FlightControllerOptions options;
  options.tilt_max_rad = 1e-6;
  FlightMemory memory;
  const FlightReference far{.p_world_m = {50.0, 0.0, 0.0}};
  const Allocation given = control_flight({}, far, frame, kFlightPeriod_s, options, memory);
  EXPECT_LT(wrench_of(frame, given.thrust_N).torque_Nm.norm(), 1e-3);
}

TEST(ControlFlight, UpsideDownTurnsWithoutPushingDown) {
  const Airframe frame = airframe();
  FlightState state;
  state.T_world_body.linear() = turned(2.8, {1.0, 0.0, 0.0});
  FlightMemory memory;
  const Allocation given = control_flight(state, {}, frame, kFlightPeriod_s, {}, memory);
  const Wrench got = wrench_of(frame, given.thrust_N);
  EXPECT_LT(got.torque_Nm.x(), -0.5);
  // No more force than the torque needs: one rotor at least is at rest.
  EXPECT_NEAR(given.thrust_N.minCoeff(), 0.0, 1e-9);
}

/// A point mass that answers the controller at once: no attitude dynamics.
struct Hover {
  Airframe frame = airframe();
  FlightControllerOptions options;
  FlightMemory memory;
  FlightState state;

  void step(const FlightReference& reference, const Eigen::Vector3d& disturbance_m_s2) {
    const Allocation given =
        control_flight(state, reference, frame, kFlightPeriod_s, options, memory);
    Eigen::Vector3d a = disturbance_m_s2;
    a.z() += given.collective_N / frame.mass_kg - frame.gravity_m_s2;
    state.v_world_m_s += kFlightPeriod_s * a;
    state.T_world_body.translation() += kFlightPeriod_s * state.v_world_m_s;
  }
};

TEST(ControlFlight, LearnsASteadyPush) {
  Hover hover;
  for (int i = 0; i < 5000; ++i) hover.step({}, {0.0, 0.0, -1.5});
  EXPECT_NEAR(hover.memory.disturbance_m_s2.z(), -1.5, 1e-6);
  EXPECT_NEAR(hover.state.T_world_body.translation().z(), 0.0, 1e-6);
}

TEST(ControlFlight, StepsOfTheReferenceTeachNoPush) {
  Hover hover;
  double most = 0.0;
  for (int i = 0; i < 2000; ++i) {
    hover.step({.p_world_m = {0.0, 0.0, 5.0}}, Eigen::Vector3d::Zero());
    most = std::max(most, hover.memory.disturbance_m_s2.norm());
  }
  EXPECT_LT(most, 1e-9);
  EXPECT_GT(hover.state.T_world_body.translation().z(), 4.0);
}

/// The same airframe with its centre of mass amid the rotors: nothing tilts it by itself.
Airframe centred() {
  Airframe frame = airframe();
  frame.p_body_com_m.setZero();
  return frame;
}

TEST(AttitudeAlong, TurnsAboutTheAxesOfTheBody) {
  const double quarter_rad = 0.5 * std::numbers::pi;
  const auto w = [](const Eigen::Vector3d& force, const Eigen::Vector3d& rate, double yaw_rad,
                    double yaw_rate) {
    return attitude_along(force, rate, yaw_rad, yaw_rate).w_body_rad_s;
  };
  EXPECT_LT((w({0, 0, 10}, {2, 0, 5}, 0.0, 0.7) - Eigen::Vector3d(0.0, 0.2, 0.7)).norm(), 1e-12);
  EXPECT_LT((w({0, 0, 10}, {2, 0, 5}, quarter_rad, 0.0) - Eigen::Vector3d(0.2, 0.0, 0.0)).norm(),
            1e-12);
  EXPECT_LT((w({0, 0, 10}, {0, 2, 0}, 0.0, 0.0) - Eigen::Vector3d(-0.2, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(w({3, 0, 4}, {0, 0, 0}, 0.0, 2.0).z(), 1.6, 1e-12);
}

TEST(ControlFlight, LiftsByItsGains) {
  const auto lift_N = [](const FlightState& state, const FlightReference& reference,
                         const FlightControllerOptions& options = {}) {
    FlightMemory memory;
    const Allocation given =
        control_flight(state, reference, centred(), kFlightPeriod_s, options, memory);
    EXPECT_NEAR(memory.a_given_m_s2.z(), given.collective_N / 1.24 - 9.81, 1e-9);
    return given.collective_N;
  };
  FlightState rising;
  rising.v_world_m_s = {0.0, 0.0, 0.05};
  EXPECT_NEAR(lift_N(rising, {.p_world_m = {0.0, 0.0, 0.1}}), 1.24 * (9.81 + 1.6 - 0.325), 1e-9);
  EXPECT_NEAR(lift_N({}, {.v_world_m_s = {0.0, 0.0, 0.2}, .a_world_m_s2 = {0.0, 0.0, 0.5}}),
              1.24 * (9.81 + 1.3 + 0.5), 1e-9);
  FlightControllerOptions near;
  near.position_error_max_m = 0.5;
  EXPECT_NEAR(lift_N({}, {.p_world_m = {0.0, 0.0, 5.0}}, near), 1.24 * (9.81 + 8.0), 1e-9);
  EXPECT_NEAR(lift_N({}, {.p_world_m = {0.0, 0.0, -5.0}}), 0.2 * 1.24 * 9.81, 1e-9)
      << "it never pushes down";
  EXPECT_NEAR(lift_N({}, {.p_world_m = {0.0, 0.0, 5.0}}), 32.0, 1e-9) << "all there is";
}

TEST(ControlFlight, EstimatesAPushByWhatTheThrustDoesNotExplain) {
  const auto learnt = [](const Eigen::Vector3d& v_m_s, FlightMemory memory) {
    memory.started = true;
    FlightState state;
    state.v_world_m_s = v_m_s;
    control_flight(state, {}, centred(), 0.1, {}, memory);
    EXPECT_LT((memory.v_world_m_s - v_m_s).norm(), 1e-12);
    return memory.disturbance_m_s2;
  };
  FlightMemory memory;
  EXPECT_LT((learnt({0.1, -0.2, 0.0}, memory) - Eigen::Vector3d(0.7, -1.4, 0.0)).norm(), 1e-12);
  memory.v_world_m_s = {0.05, 0.0, 0.0};
  memory.a_given_m_s2 = {0.2, 0.0, 0.0};
  memory.disturbance_m_s2 = {0.1, 0.0, 0.0};
  // 0.05 m/s gained, of which 0.1 s times 0.3 m/s^2 are explained.
  EXPECT_NEAR(learnt({0.1, 0.0, 0.0}, memory).x(), 0.1 + 7.0 * 0.02, 1e-12);
  EXPECT_LT((learnt({9.0, -9.0, 0.0}, {}) - Eigen::Vector3d(4.0, -4.0, 0.0)).norm(), 1e-12);
  FlightMemory fresh;
  control_flight({}, {}, centred(), 0.1, {}, fresh);
  EXPECT_TRUE(fresh.started);
  EXPECT_TRUE(fresh.disturbance_m_s2.isZero(0.0));
}

TEST(ControlFlight, LiftsAgainstAPushThatItKnows) {
  FlightMemory memory;
  memory.disturbance_m_s2 = {0.0, 0.0, -1.5};
  EXPECT_NEAR(control_flight({}, {}, centred(), kFlightPeriod_s, {}, memory).collective_N,
              1.24 * (9.81 + 1.5), 1e-9);
}

TEST(ControlFlight, TurnsItsHeadingByItsGains) {
  const auto torque_Nm = [](const FlightState& state, double yaw_rad, FlightMemory& memory) {
    const Allocation given =
        control_flight(state, {.yaw_rad = yaw_rad}, centred(), kFlightPeriod_s, {}, memory);
    return wrench_of(centred(), given.thrust_N).torque_Nm;
  };
  FlightMemory memory;
  const double pull = -25.0 * 2.0 * std::sin(0.1);
  // What it learns in this period already counts.
  EXPECT_LT((torque_Nm({}, 0.2, memory) - Eigen::Vector3d(0.0, 0.0, -0.0126 * 1.002 * pull)).norm(),
            1e-9);
  EXPECT_NEAR(memory.torque_rad_s2.z(), 0.002 * pull, 1e-12);
  FlightState spinning;
  spinning.w_body_rad_s = {0.0, 0.0, 0.1};
  memory = {};
  EXPECT_NEAR(torque_Nm(spinning, 0.0, memory).z(), -0.0126 * 1.002 * 0.9, 1e-9);
  memory = {};
  memory.torque_rad_s2 = {0.0, 0.0, 0.5};
  EXPECT_NEAR(torque_Nm({}, 0.0, memory).z(), -0.0126 * 0.5, 1e-9);
}

/// Errors of place and speed, a push and the reference ask for a level force in sum, which changes.
TEST(ControlFlight, TurnsAsTheForceThatItWantsWillChange) {
  FlightState state;
  state.T_world_body.translation() = Eigen::Vector3d(-0.04625, 0.0, 0.0);
  state.v_world_m_s = {0.16, 0.0, 0.0};
  FlightReference reference;
  reference.a_world_m_s2 = {0.5, 0.0, 0.0};
  reference.j_world_m_s3 = {1.0, 2.0, 0.0};
  FlightMemory memory;
  memory.disturbance_m_s2 = {0.2, 0.0, 0.0};
  const Allocation given = control_flight(state, reference, centred(), kFlightPeriod_s, {}, memory);
  // x: 1 - 16 * 0.16 - 6.5 * (0.2 - 0.5) m/s^3
  const Eigen::Vector3d rate_rad_s(-2.0 / 9.81, 0.39 / 9.81, 0.0);
  const Eigen::Vector3d expected = centred().inertia_kg_m2 * (1.002 * 22.0 * rate_rad_s);
  EXPECT_LT((wrench_of(centred(), given.thrust_N).torque_Nm - expected).norm(), 1e-9);
}

TEST(ControlFlight, TheJerkCountsOnlyWhereItsThrustGivesWhatItWants) {
  FlightControllerOptions options;
  options.attitude_per_s2 = 20.0;
  const auto jerk_counts = [&](double tilt_rad, double off_m) {
    std::vector<Eigen::Vector3d> torque_Nm;
    for (const double jerk_m_s3 : {0.0, 2.0}) {
      FlightState state;
      state.T_world_body.linear() = turned(tilt_rad, Eigen::Vector3d::UnitY());
      FlightReference reference;
      reference.p_world_m = {off_m, 0.0, 0.0};
      reference.j_world_m_s3 = {jerk_m_s3, 0.0, 0.0};
      FlightMemory memory;
      const Allocation given =
          control_flight(state, reference, centred(), kFlightPeriod_s, options, memory);
      torque_Nm.push_back(wrench_of(centred(), given.thrust_N).torque_Nm);
      EXPECT_EQ(memory.torque_rad_s2.isZero(0.0), tilt_rad > 0.8) << "it learns no torque either";
    }
    const double change_Nm = (torque_Nm[1] - torque_Nm[0]).norm();
    EXPECT_TRUE(change_Nm > 1e-3 || change_Nm < 1e-12) << change_Nm;
    return change_Nm > 1e-3;
  };
  EXPECT_TRUE(jerk_counts(0.75, 0.0)) << "its cosine is 0.73";
  EXPECT_FALSE(jerk_counts(0.85, 0.0)) << "its cosine is 0.66";
  options.tilt_max_rad = 1e-6;
  EXPECT_FALSE(jerk_counts(0.0, 50.0)) << "the force is cut off";
}

TEST(ControlFlight, TiltsAsFarAsAllowedOrAsItsThrustReaches) {
  const auto torque_Nm = [](const Eigen::Vector3d& p_m, const FlightControllerOptions& options) {
    FlightReference reference;
    reference.p_world_m = p_m;
    FlightMemory memory;
    const Allocation given =
        control_flight({}, reference, centred(), kFlightPeriod_s, options, memory);
    return wrench_of(centred(), given.thrust_N).torque_Nm.y();
  };
  const double pull_Nm = 0.0076 * 1.002 * 2.0 * 240.0;
  FlightControllerOptions options;
  EXPECT_NEAR(torque_Nm({5.0, 0.0, 0.0}, options), pull_Nm * std::sin(0.3), 1e-9);
  options.tilt_max_rad = 1.2;
  options.position_per_s2 = 20.0;
  // Of 32 N it needs (9.81 + 20 * 0.6) * 1.24 N to climb.
  const double tilt_rad = std::acos(21.81 * 1.24 / 32.0);
  EXPECT_NEAR(torque_Nm({0.8, 0.0, 0.6}, options), pull_Nm * std::sin(0.5 * tilt_rad), 1e-9);
}

TEST(ControlFlight, GoesByTheMotionOfItsCentreOfMass) {
  Airframe frame = airframe();
  frame.p_body_com_m = {0.1, 0.0, 0.0};
  FlightState state;
  state.T_world_body.linear() = turned(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  state.v_world_m_s = {1.0, 0.0, 0.0};
  state.w_body_rad_s = {0.0, 0.0, 2.0};
  FlightMemory memory;
  control_flight(state, {}, frame, kFlightPeriod_s, {}, memory);
  EXPECT_LT((memory.v_world_m_s - Eigen::Vector3d(0.8, 0.0, 0.0)).norm(), 1e-12);
  FlightState spinning;
  spinning.w_body_rad_s = {0.0, 0.0, 0.8};
  FlightReference reference;
  reference.yaw_rate_rad_s = 0.8;
  FlightMemory fresh;
  const Allocation given =
      control_flight(spinning, reference, airframe(), kFlightPeriod_s, {}, fresh);
  EXPECT_LT(wrench_of(airframe(), given.thrust_N).torque_Nm.norm(), 1e-9) << "it turns as planned";
  EXPECT_NEAR(given.collective_N, 1.24 * 9.81, 1e-9);
}

TEST(AttitudeError, OfHalfATurnIsTwo) {
  const auto error = [](double x, double y, double z) {
    const Eigen::Matrix3d R = Eigen::Vector3d(x, y, z).asDiagonal();
    return Eigen::Vector3d(attitude_error(R, Eigen::Matrix3d::Identity()).cwiseAbs());
  };
  EXPECT_EQ(error(1.0, -1.0, -1.0), Eigen::Vector3d(2.0, 0.0, 0.0));
  EXPECT_EQ(error(-1.0, 1.0, -1.0), Eigen::Vector3d(0.0, 2.0, 0.0));
}

/// Level, with no error but that the reference speeds up by 2 m/s^2, of which its thrust gives
/// nothing yet: 6.5 times that a second is how the force changes.
TEST(ControlFlight, WhatItsThrustDoesNotGiveYetChangesTheForce) {
  FlightReference reference;
  reference.a_world_m_s2 = {2.0, 0.0, 0.0};
  FlightMemory memory;
  const Allocation given = control_flight({}, reference, centred(), kFlightPeriod_s, {}, memory);
  const AttitudeReference wanted = attitude_along({2.0, 0.0, 9.81}, {13.0, 0.0, 0.0}, 0.0, 0.0);
  const Eigen::Matrix3d& R = wanted.R_world_body;
  const Eigen::Vector3d turn_rad_s = R * wanted.w_body_rad_s;
  const Eigen::Vector3d pull = Eigen::Vector3d(240.0, 240.0, 25.0)
                                   .cwiseProduct(attitude_error(Eigen::Matrix3d::Identity(), R)) -
                               Eigen::Vector3d(22.0, 22.0, 9.0).cwiseProduct(turn_rad_s);
  const Eigen::Vector3d expected = -1.002 * (centred().inertia_kg_m2 * pull);
  EXPECT_LT((wrench_of(centred(), given.thrust_N).torque_Nm - expected).norm(), 1e-9);
  EXPECT_NEAR(given.collective_N, 1.24 * 9.81, 1e-9);
}

/// With next to no gains there is no torque that needs force either.
TEST(ControlFlight, UpsideDownItLiftsNothing) {
  FlightState state;
  state.T_world_body.linear() = turned(std::numbers::pi, Eigen::Vector3d::UnitX());
  FlightControllerOptions options;
  options.attitude_per_s2 = 1e-9;
  options.yaw_per_s2 = 1e-9;
  FlightMemory memory;
  const Allocation given = control_flight(state, {}, centred(), kFlightPeriod_s, options, memory);
  EXPECT_NEAR(given.collective_N, 0.0, 1e-6);
}

}  // namespace
}  // namespace vantage
