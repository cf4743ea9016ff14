#include "vantage/control/airframe.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/control/flight_kit.hpp"

namespace vantage {
namespace {

using test::airframe;

double random_in(double low, double high) {
  constexpr int kSteps = 1000000;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

TEST(Airframe, HoverSharesTheWeight) {
  Airframe frame = airframe();
  frame.p_body_com_m.setZero();
  const Allocation hover = allocate(frame, {.collective_N = frame.weight_N()});
  for (const double thrust : hover.thrust_N) EXPECT_NEAR(thrust, 1.24 * 9.81 / 4.0, 1e-12);
}

TEST(Airframe, HoverLeansOnTheRotorsNearTheCentreOfMass) {
  const Airframe frame = airframe();  // its centre of mass lies 8 mm ahead
  const Allocation hover = allocate(frame, {.collective_N = frame.weight_N()});
  const double quarter_N = frame.weight_N() / 4.0;
  const double shift = 0.008 / 0.117;  // the lever rule
  EXPECT_NEAR(hover.thrust_N[0], quarter_N * (1.0 + shift), 1e-9);
  EXPECT_NEAR(hover.thrust_N[1], quarter_N * (1.0 - shift), 1e-9);
  EXPECT_NEAR(hover.thrust_N[2], quarter_N * (1.0 - shift), 1e-9);
  EXPECT_NEAR(hover.thrust_N[3], quarter_N * (1.0 + shift), 1e-9);
}

TEST(Airframe, TorquesHaveTheSignsOfTheRightHand) {
  const Airframe frame = airframe();
  const Wrench left = wrench_of(frame, {1.0, 1.0, 0.0, 0.0});
  EXPECT_GT(left.torque_Nm.x(), 0.0) << "thrust on the left rolls to the right";
  const Wrench rear = wrench_of(frame, {0.0, 1.0, 1.0, 0.0});
  EXPECT_GT(rear.torque_Nm.y(), 0.0) << "thrust behind pitches down";
  const Wrench diagonal = wrench_of(frame, {1.0, 0.0, 1.0, 0.0});
  EXPECT_NEAR(diagonal.torque_Nm.z(), -0.032, 1e-12);
}

RC_GTEST_PROP(Airframe, GivesTheWholeWrenchWhereItFits, ()) {
  const Airframe frame = airframe();
  Eigen::Vector4d thrust_N;
  // Far enough from the limits that its part without yaw fits too.
  for (double& thrust : thrust_N) thrust = random_in(2.2, 5.8);
  const Allocation given = allocate(frame, wrench_of(frame, thrust_N));
  RC_ASSERT((given.thrust_N - thrust_N).cwiseAbs().maxCoeff() < 1e-9);
  RC_ASSERT(given.tilt_share > 1.0 - 1e-9);
}

RC_GTEST_PROP(Airframe, StaysInRangeAndSaysWhatItGives, ()) {
  const Airframe frame = airframe();
  const Wrench wanted{
      .collective_N = random_in(-10.0, 50.0),
      .torque_Nm = {random_in(-3.0, 3.0), random_in(-3.0, 3.0), random_in(-1.0, 1.0)}};
  const Allocation given = allocate(frame, wanted);
  RC_ASSERT(given.thrust_N.minCoeff() >= 0.0 && given.thrust_N.maxCoeff() <= 8.0);
  const Wrench got = wrench_of(frame, given.thrust_N);
  RC_ASSERT(std::abs(got.collective_N - given.collective_N) < 1e-9);
  RC_ASSERT((got.torque_Nm.head<2>() - given.tilt_share * wanted.torque_Nm.head<2>()).norm() <
            1e-9);
  RC_ASSERT(std::abs(got.torque_Nm.z() - given.yaw_share * wanted.torque_Nm.z()) < 1e-9);
  // Nothing is given up for something that comes later.
  if (given.tilt_share < 1.0) {
    Wrench more = wanted;
    more.torque_Nm.head<2>() *= 1.001 * given.tilt_share;
    more.torque_Nm.z() = 0.0;
    for (double f = 0.0; f <= 32.0; f += 0.1) {
      more.collective_N = f;
      const Eigen::Vector4d thrust_N =
          mixing_matrix(frame).inverse() *
          (Eigen::Vector4d() << more.collective_N, more.torque_Nm).finished();
      RC_ASSERT(thrust_N.minCoeff() < 0.0 || thrust_N.maxCoeff() > 8.0);
    }
  }
}

TEST(Airframe, YawIsGivenUpFirst) {
  const Airframe frame = airframe();
  const Wrench wanted{.collective_N = 20.0, .torque_Nm = {0.5, -0.5, 2.0}};
  const Allocation given = allocate(frame, wanted);
  EXPECT_EQ(given.tilt_share, 1.0);
  EXPECT_NEAR(given.collective_N, 20.0, 1e-9);
  EXPECT_LT(given.yaw_share, 0.2);
  const Wrench got = wrench_of(frame, given.thrust_N);
  EXPECT_NEAR(got.torque_Nm.x(), 0.5, 1e-9);
  EXPECT_NEAR(got.torque_Nm.y(), -0.5, 1e-9);
}

TEST(Airframe, ThenForceSoThatTiltIsKept) {
  const Airframe frame = airframe();
  const Allocation full = allocate(frame, {.collective_N = 32.0, .torque_Nm = {0.5, 0.0, 0.0}});
  EXPECT_EQ(full.tilt_share, 1.0);
  EXPECT_LT(full.collective_N, 32.0 - 1.0);
  EXPECT_NEAR(full.thrust_N.maxCoeff(), 8.0, 1e-9);
  const Allocation none = allocate(frame, {.collective_N = 0.0, .torque_Nm = {0.5, 0.0, 0.0}});
  EXPECT_EQ(none.tilt_share, 1.0);
  EXPECT_GT(none.collective_N, 1.0);
  EXPECT_NEAR(none.thrust_N.minCoeff(), 0.0, 1e-9);
}

TEST(Airframe, InducedPowerOfHover) {
  // T^1.5 / sqrt(2 rho A) by hand: 3.0411 N on a disc of 0.1 m.
  const double one_W = 3.0411 * std::sqrt(3.0411 / (2.0 * 1.225 * M_PI * 0.01));
  EXPECT_NEAR(induced_power_W(Eigen::Vector4d::Constant(3.0411), 0.1), 4.0 * one_W, 1e-9);
  EXPECT_EQ(induced_power_W(Eigen::Vector4d::Zero(), 0.1), 0.0);
}

/// Arms of 10 cm, the centre of mass amid them, 8 N a rotor; yaw by 2 cm a newton.
Airframe even_frame() {
  Airframe frame;
  frame.mass_kg = 1.0;
  frame.rotors = {Rotor{{0.1, 0.1, 0.0}, -0.02}, Rotor{{-0.1, 0.1, 0.0}, 0.02},
                  Rotor{{-0.1, -0.1, 0.0}, -0.02}, Rotor{{0.1, -0.1, 0.0}, 0.02}};
  frame.thrust_max_N = 8.0;
  return frame;
}

TEST(Airframe, WrenchesAreAboutTheCentreOfMass) {
  Airframe frame = even_frame();
  frame.p_body_com_m = {0.02, 0.03, 0.5};
  const Wrench wrench = wrench_of(frame, {1.0, 2.0, 3.0, 5.0});
  EXPECT_NEAR(wrench.collective_N, 11.0, 1e-12);
  EXPECT_NEAR(wrench.torque_Nm.x(), 0.07 * 1.0 + 0.07 * 2.0 - 0.13 * 3.0 - 0.13 * 5.0, 1e-12);
  EXPECT_NEAR(wrench.torque_Nm.y(), -0.08 * 1.0 + 0.12 * 2.0 + 0.12 * 3.0 - 0.08 * 5.0, 1e-12);
  EXPECT_NEAR(wrench.torque_Nm.z(), 0.02 * (-1.0 + 2.0 - 3.0 + 5.0), 1e-12);
}

/// A torque of 3.2 N m about x takes 8 N from one side to the other, of which half can be had.
TEST(Airframe, TiltIsCutWhereNoForceMakesRoomForIt) {
  const Allocation given =
      allocate(even_frame(), {.collective_N = 10.0, .torque_Nm = {3.2, 0.0, 0.4}});
  EXPECT_NEAR(given.tilt_share, 0.5, 1e-12);
  EXPECT_NEAR(given.collective_N, 16.0, 1e-9);
  EXPECT_NEAR(given.yaw_share, 0.0, 1e-9);
  const Eigen::Vector4d thrust_N(8.0, 8.0, 0.0, 0.0);
  EXPECT_LT((given.thrust_N - thrust_N).norm(), 1e-9);
}

TEST(Airframe, ForceMakesRoomForTilt) {
  const auto collective_N = [](double wanted_N) {
    return allocate(even_frame(), {.collective_N = wanted_N, .torque_Nm = {0.8, 0.0, 0.0}})
        .collective_N;
  };
  EXPECT_NEAR(collective_N(30.0), 24.0, 1e-9);
  EXPECT_NEAR(collective_N(20.0), 20.0, 1e-9);
  EXPECT_NEAR(collective_N(2.0), 8.0, 1e-9);
}

TEST(Airframe, YawTakesTheRoomThatIsLeft) {
  const auto yaw_share = [](double collective_N, double torque_Nm) {
    return allocate(even_frame(),
                    {.collective_N = collective_N, .torque_Nm = {0.0, 0.0, torque_Nm}})
        .yaw_share;
  };
  EXPECT_NEAR(yaw_share(16.0, 0.64), 0.5, 1e-9) << "4 N of 8";
  EXPECT_NEAR(yaw_share(24.0, 0.64), 0.25, 1e-9) << "2 N up";
  EXPECT_NEAR(yaw_share(8.0, -0.64), 0.25, 1e-9) << "2 N down";
  EXPECT_EQ(yaw_share(16.0, 0.3), 1.0);
}

}  // namespace
}  // namespace vantage
