// Defaults and ranges of controllers, by number.
#include <gtest/gtest.h>

#include "tests/support/option_numbers.hpp"
#include "vantage/control/differential_controller.hpp"
#include "vantage/control/drive_options.hpp"
#include "vantage/control/tracking_options.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

TEST(ControlOptions, OfBases) {
  expect_numbers(DriveOptions{}, {{"controller.speed_m_s", 0.6, {0.0, 1.0, true}},
                                  {"controller.acceleration_m_s2", 0.5, {0.0, 1.5, true}},
                                  {"controller.turn_rate_rad_s", 0.8, {0.0, 1.5, true}},
                                  {"controller.turn_acceleration_rad_s2", 1.2, {0.0, 5.0, true}},
                                  {"controller.lookahead_m", 0.10, {0.0, 1.0, true}},
                                  {"controller.gain_per_s", 2.0, {0.0, 3.0, true}},
                                  {"goal_tolerance_m", 0.01, between(0.001, 1.0)},
                                  {"goal_tolerance_rad", 0.0105, between(0.001, 1.0)},
                                  {"rest_speed_m_s", 0.002, between(0.001, 0.1)},
                                  {"stuck_time_s", 1.0, above(0.0)},
                                  {"timeout_factor", 4.0, at_least(1.0)}});
  EXPECT_EQ(DifferentialFollowing{}.arrival_m, 0.003);
  EXPECT_FALSE(DifferentialFollowing{}.turning || DifferentialFollowing{}.aligning);
}

TEST(ControlOptions, OfFlights) {
  expect_numbers(TrajectoryTrackingOptions{},
                 {{"controller.position_per_s2", 16.0, {0.0, 50.0, true}},
                  {"controller.velocity_per_s", 6.5, {0.0, 20.0, true}},
                  {"controller.disturbance_per_s", 7.0, between(0.0, 20.0)},
                  {"controller.disturbance_max_m_s2", 4.0, between(0.0, 10.0)},
                  {"controller.position_error_max_m", 1.0, {0.0, 10.0, true}},
                  {"controller.attitude_per_s2", 240.0, {0.0, 1000.0, true}},
                  {"controller.rate_per_s", 22.0, {0.0, 100.0, true}},
                  {"controller.yaw_per_s2", 25.0, {0.0, 200.0, true}},
                  {"controller.yaw_rate_per_s", 9.0, {0.0, 50.0, true}},
                  {"controller.torque_per_s", 1.0, between(0.0, 10.0)},
                  {"controller.torque_max_rad_s2", 40.0, between(0.0, 200.0)},
                  {"controller.tilt_max_rad", 0.6, {0.0, 1.2, true}},
                  {"limits.speed_m_s", 1.0, {0.0, 5.0, true}},
                  {"limits.acceleration_m_s2", 2.0, {0.0, 5.0, true}},
                  {"limits.yaw_rate_rad_s", 1.0, {0.0, 4.0, true}},
                  {"pose_noise.sigma_position_m", 0.01, between(0.0, 1.0)},
                  {"pose_noise.sigma_yaw_rad", 0.01, between(0.0, 0.5)},
                  {"pose_noise.sigma_tilt_rad", 0.003, between(0.0, 0.1)},
                  {"pose_noise.correlation_s", 2.0, above(0.0)},
                  {"goal_tolerance_m", 0.05, between(0.001, 1.0)},
                  {"goal_tolerance_rad", 0.05, between(0.001, 1.0)},
                  {"rest_speed_m_s", 0.05, between(0.001, 1.0)},
                  {"settle_time_s", 0.3, between(0.0, 10.0)},
                  {"timeout_s", 8.0, above(0.0)}});
  EXPECT_TRUE(TrajectoryTrackingOptions{}.gusts.empty());
}

TEST(ControlOptions, OfGusts) {
  expect_numbers(Gust{}, {{"force_N", 4.0, between(0.0, 50.0)},
                          {"direction[0]", 0.0},
                          {"direction[1]", 1.0},
                          {"direction[2]", 0.0},
                          {"start_s", 0.0, at_least(0.0)},
                          {"duration_s", 0.5, above(0.0)}});
  const PoseNoiseOptions perfect = PoseNoiseOptions::perfect();
  EXPECT_EQ(perfect.sigma_position_m, 0.0);
  EXPECT_EQ(perfect.sigma_yaw_rad, 0.0);
  EXPECT_EQ(perfect.sigma_tilt_rad, 0.0);
}

TEST(ControlOptions, OfAirframes) {
  Airframe frame;
  frame.mass_kg = 1.5;
  EXPECT_NEAR(frame.weight_N(), 1.5 * 9.81, 1e-12);
  EXPECT_EQ(frame.thrust_max_N, 0.0);
  EXPECT_EQ(Rotor{}.torque_per_thrust_m, 0.0);
  EXPECT_EQ(Allocation{}.tilt_share, 1.0);
  EXPECT_EQ(Allocation{}.yaw_share, 1.0);
  EXPECT_EQ(Allocation{}.collective_N, 0.0);
}

TEST(ControlDefaults, AreOfRestAtTheOrigin) {
  EXPECT_EQ(PathFollowing{}.arc_m, 0.0);
  EXPECT_EQ(PathFollowing{}.wz_rad_s, 0.0);
  EXPECT_EQ(DifferentialFollowing{}.arc_m, 0.0);
  EXPECT_EQ(DifferentialFollowing{}.v_m_s, 0.0);
  EXPECT_EQ(DifferentialFollowing{}.wz_rad_s, 0.0);
  EXPECT_EQ(FlightReference{}.yaw_rad, 0.0);
  EXPECT_EQ(FlightReference{}.yaw_rate_rad_s, 0.0);
  EXPECT_EQ(FlightWaypoint{}.yaw_rad, 0.0);
  EXPECT_FALSE(FlightMemory{}.started);
  EXPECT_EQ(Airframe{}.mass_kg, 0.0);
  EXPECT_EQ(Wrench{}.collective_N, 0.0);
  EXPECT_EQ(DriveResult{}.path_length_m, 0.0);
  EXPECT_EQ(DriveResult{}.duration_s, 0.0);
  const FlightResult flight;
  EXPECT_EQ(flight.duration_s, 0.0);
  EXPECT_EQ(flight.path_length_m, 0.0);
  EXPECT_EQ(flight.rms_error_m, 0.0);
  EXPECT_EQ(flight.greatest_error_m, 0.0);
  EXPECT_EQ(flight.energy_J, 0.0);
}

}  // namespace
}  // namespace vantage
