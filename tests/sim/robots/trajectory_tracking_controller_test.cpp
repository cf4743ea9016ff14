// Flights under physics. The bars are those of a 330 mm vehicle that was measured before this one.

#include "vantage/sim/robots/trajectory_tracking_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

#include "tests/control/flight_kit.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using test::exact_tracking;
using test::FlightWorld;
constexpr double kPeriod_s = 0.002;

/// How far off a place the vehicle is while it holds there.
struct Excursion {
  double greatest_m = 0.0;
  double last_out_s = 0.0;  ///< when it was last more than 20 mm off
  double at_end_m = 0.0;
};

Excursion watch(FlightWorld& scene, const FlightReference& reference, double duration_s) {
  Excursion seen;
  const double end_s = scene.world.time_s() + duration_s - 1e-9;
  while (scene.world.time_s() < end_s) {
    scene.tracking.tick(reference);
    seen.at_end_m = (scene.position_m() - reference.p_world_m).norm();
    seen.greatest_m = std::max(seen.greatest_m, seen.at_end_m);
    if (seen.at_end_m > 0.02) seen.last_out_s = scene.world.time_s();
  }
  return seen;
}

TEST(TrajectoryTrackingController, HoversWithoutDrift) {
  FlightWorld scene;
  const FlightResult result = scene.tracking.hold(10.0);
  EXPECT_EQ(result.status, FlightStatus::arrived);
  EXPECT_LT(result.greatest_error_m, 1e-4);
  EXPECT_NEAR(result.duration_s, 10.0, 1e-6);
  const double hover_W =
      induced_power_W(scene.vehicle.thrusts_N(scene.world), scene.vehicle.rotor_radius_m());
  EXPECT_NEAR(result.energy_J, 10.0 * hover_W, 0.01 * result.energy_J);
}

TEST(TrajectoryTrackingController, StepsOfHalfAMetre) {
  for (const Eigen::Vector3d& step :
       {Eigen::Vector3d(0.5, 0.0, 0.0), Eigen::Vector3d(0.0, -0.5, 0.0),
        Eigen::Vector3d(0.0, 0.0, 0.5)}) {
    FlightWorld scene;
    FlightReference reference = scene.tracking.reference();
    reference.p_world_m += step;
    double overshoot_m = 0.0;
    double settled_s = 0.0;
    for (int i = 0; i < 1500; ++i) {
      scene.tracking.tick(reference);
      const Eigen::Vector3d off_m = scene.position_m() - reference.p_world_m;
      overshoot_m = std::max(overshoot_m, off_m.dot(step.normalized()));
      if (off_m.norm() > 0.02) settled_s = scene.world.time_s();
    }
    EXPECT_LT(overshoot_m, 0.020);
    EXPECT_LT(settled_s, 1.3);
  }
}

TEST(TrajectoryTrackingController, CirclesAtOneMetrePerSecond) {
  constexpr double kRadius_m = 2.0;
  constexpr double kRamp_s = 3.0;
  constexpr double kRate_rad_s = 0.5;
  FlightWorld scene(exact_tracking(), make_pose({kRadius_m, 0.0, 2.0}, std::numbers::pi));
  double sum_m2 = 0.0;
  int count = 0;
  for (int i = 1; i <= 7500; ++i) {
    const double t = i * kPeriod_s;
    const bool ramp = t < kRamp_s;
    const double w = ramp ? kRate_rad_s * t / kRamp_s : kRate_rad_s;
    const double angle = ramp ? 0.5 * w * t : kRate_rad_s * (t - 0.5 * kRamp_s);
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d along(-out.y(), out.x(), 0.0);
    const double gain = ramp ? kRate_rad_s / kRamp_s : 0.0;
    const FlightReference reference{
        .p_world_m = kRadius_m * out + Eigen::Vector3d(0.0, 0.0, 2.0),
        .v_world_m_s = kRadius_m * w * along,
        .a_world_m_s2 = kRadius_m * (gain * along - w * w * out),
        .j_world_m_s3 = -kRadius_m * w * (w * w * along + 3.0 * gain * out),
        .yaw_rad = angle + std::numbers::pi,
        .yaw_rate_rad_s = w};
    scene.tracking.tick(reference);
    if (t < 5.0) continue;
    sum_m2 += (scene.position_m() - reference.p_world_m).squaredNorm();
    ++count;
  }
  EXPECT_LT(std::sqrt(sum_m2 / count), 0.010);
}

TEST(TrajectoryTrackingController, RecoversFromAGust) {
  for (const std::array<double, 3>& direction :
       {std::array{0.0, 1.0, 0.0}, std::array{1.0, 0.0, 0.0}, std::array{0.0, 0.0, -1.0}}) {
    TrajectoryTrackingOptions options = exact_tracking();
    options.gusts = {{.force_N = 4.0, .direction = direction, .start_s = 0.5, .duration_s = 0.5}};
    FlightWorld scene(options);
    const Excursion seen = watch(scene, scene.tracking.reference(), 6.0);
    EXPECT_GT(seen.greatest_m, 0.02) << "it is pushed";
    EXPECT_LT(seen.greatest_m, 0.22);
    EXPECT_LT(seen.last_out_s - 1.0, 1.3);
    EXPECT_LT(seen.at_end_m, 1e-3);
    EXPECT_EQ(scene.tracking.collisions(), 0);
  }
}

TEST(TrajectoryTrackingController, RecoversFromASteadyPush) {
  TrajectoryTrackingOptions options = exact_tracking();
  options.gusts = {{.force_N = 2.0, .direction = {1.0, 1.0, 0.0}, .duration_s = 100.0}};
  FlightWorld scene(options);
  const Excursion seen = watch(scene, scene.tracking.reference(), 8.0);
  EXPECT_LT(seen.last_out_s, 2.0);
  EXPECT_LT(seen.at_end_m, 3e-3);
}

TEST(TrajectoryTrackingController, TurnsOverFromAnyAttitude) {
  for (const double angle : {1.5, 2.5, std::numbers::pi}) {
    const Pose start = Eigen::Translation3d(0.0, 0.0, 5.0) *
                       Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 0.3, 0.0).normalized());
    FlightWorld scene(exact_tracking(), start);
    const Excursion seen = watch(scene, {.p_world_m = {0.0, 0.0, 5.0}}, 4.0);
    EXPECT_LT(seen.greatest_m, 1.3) << angle;
    EXPECT_LT(seen.at_end_m, 0.01) << angle;
  }
}

TEST(TrajectoryTrackingController, SaturationDoesNotTumbleIt) {
  // Far away, half a turn of heading and a blow, all at once.
  TrajectoryTrackingOptions options = exact_tracking();
  options.gusts = {{.force_N = 12.0, .direction = {0.0, 1.0, -0.5}, .duration_s = 0.4}};
  FlightWorld scene(options, test::at_height(8.0));
  const FlightReference far{.p_world_m = {6.0, -6.0, 11.0}, .yaw_rad = 3.0};
  double max_tilt_seen_rad = 0.0;
  bool saturated = false;
  for (int i = 0; i < 6000; ++i) {
    scene.tracking.tick(far);
    const FlightState state = scene.vehicle.state(scene.world);
    max_tilt_seen_rad = std::max(max_tilt_seen_rad, std::acos(state.T_world_body.linear()(2, 2)));
    saturated = saturated || scene.vehicle.thrusts_N(scene.world).maxCoeff() > 7.5;
  }
  EXPECT_TRUE(saturated);
  EXPECT_LT(max_tilt_seen_rad, 1.0);
  EXPECT_LT((scene.position_m() - far.p_world_m).norm(), 0.02);
}

TEST(TrajectoryTrackingController, FliesToAPlaceAndSaysWhatItTook) {
  FlightWorld scene;
  const std::vector<FlightWaypoint> waypoints{{{1.0, 0.0, 3.0}, 0.5}, {{1.5, 1.0, 2.5}, 1.5}};
  const FlightResult result = scene.tracking.fly_to(waypoints);
  EXPECT_EQ(result.status, FlightStatus::arrived);
  EXPECT_LT((scene.position_m() - waypoints.back().p_world_m).norm(), 0.02);
  const Pose T_world_body = scene.vehicle.state(scene.world).T_world_body;
  EXPECT_NEAR(project_to_se2(T_world_body).yaw_rad, 1.5, 0.02);
  EXPECT_NEAR(result.path_length_m, 1.0 + Eigen::Vector3d(0.5, 1.0, -0.5).norm(), 0.15);
  EXPECT_LT(result.rms_error_m, 0.01);
  EXPECT_GT(result.greatest_error_m, result.rms_error_m);
  EXPECT_NEAR(result.energy_J / result.duration_s, 73.0, 3.0) << "W, about as in hover";
}

TEST(TrajectoryTrackingController, StopsWhenToldTo) {
  FlightWorld scene;
  const FlightWaypoint goal{.p_world_m = {3.0, 0.0, 3.0}};
  const FlightResult result = scene.tracking.fly_to(
      std::span(&goal, 1),
      [](const TrajectoryTrackingController& tracking) { return tracking.world().time_s() < 1.0; });
  EXPECT_EQ(result.status, FlightStatus::stopped);
  EXPECT_NEAR(result.duration_s, 1.0, 0.01);
  EXPECT_GT(scene.tracking.reference().v_world_m_s.norm(), 0.1) << "a path may go on from there";
  EXPECT_EQ(scene.tracking.fly_to(std::span(&goal, 1)).status, FlightStatus::arrived);
}

TEST(TrajectoryTrackingController, EndsAFlightAtAContact) {
  FlightWorld scene(exact_tracking(), test::at_height(1.0),
                    "<geom type='box' size='0.1 2 2' pos='1.5 0 1'/>");
  const FlightWaypoint behind{.p_world_m = {3.0, 0.0, 1.0}};
  const FlightResult result = scene.tracking.fly_to(std::span(&behind, 1));
  EXPECT_EQ(result.status, FlightStatus::contact);
  EXPECT_EQ(scene.tracking.collisions(), 1);
  EXPECT_NEAR(scene.position_m().x() + 0.117 + 0.105, 1.4, 0.02) << "with its front rotors";
}

TEST(TrajectoryTrackingController, GivesUpAfterATime) {
  TrajectoryTrackingOptions options = exact_tracking();
  options.gusts = {{.force_N = 9.0, .direction = {-1.0, 0.0, 0.0}, .duration_s = 100.0}};
  options.timeout_s = 1.0;
  FlightWorld scene(options, test::at_height(8.0));
  const FlightWaypoint goal{.p_world_m = {0.5, 0.0, 8.0}};
  EXPECT_EQ(scene.tracking.fly_to(std::span(&goal, 1)).status, FlightStatus::timeout);
}

TEST(TrajectoryTrackingController, FollowsItsEstimate) {
  TrajectoryTrackingOptions options;
  options.pose_noise = {.sigma_position_m = 0.03, .sigma_yaw_rad = 0.02, .sigma_tilt_rad = 0.002};
  FlightWorld scene(options);
  double estimated_m2 = 0.0;
  double true_m2 = 0.0;
  constexpr int kTicks = 10000;
  for (int i = 0; i < kTicks; ++i) {
    const FlightReference reference{.p_world_m = {0.0, 0.0, 3.0}};
    scene.tracking.tick(reference);
    const Eigen::Vector3d believed = scene.tracking.estimate().T_world_body.translation();
    estimated_m2 += (believed - reference.p_world_m).squaredNorm() / kTicks;
    true_m2 += (scene.position_m() - reference.p_world_m).squaredNorm() / kTicks;
  }
  EXPECT_GT(std::sqrt(true_m2), 0.015) << "it wanders with its errors";
  EXPECT_LT(std::sqrt(true_m2), 0.15);
  EXPECT_LT(std::sqrt(estimated_m2), 0.05);
}

TEST(TrajectoryTrackingController, NeedsACommandAtEveryStep) {
  const test::SceneFolder folder(test::scene_mjcf(""));
  World world({folder.path(), test::quadrotor_file()}, {});
  const Quadrotor vehicle = test::quadrotor(world);
  EXPECT_THROW(TrajectoryTrackingController(world, vehicle, {}, Rng(1)), ConfigError);
}

TEST(TrajectoryTrackingController, SameBitsAgain) {
  const auto fly = [](std::uint64_t seed) {
    TrajectoryTrackingOptions options;
    options.gusts = {{.force_N = 3.0, .start_s = 0.5}};
    FlightWorld scene(options, test::at_height(2.0), "", seed);
    const FlightWaypoint goal{.p_world_m = {1.0, 0.5, 2.0}, .yaw_rad = 1.0};
    scene.tracking.fly_to(std::span(&goal, 1));
    return scene.world.state();
  };
  const std::vector<double> first = fly(1);
  EXPECT_EQ(first, fly(1));
  EXPECT_NE(first, fly(2));
}

TEST(TrajectoryTrackingController, GivesUpSoLongAfterTheEndOfItsPath) {
  TrajectoryTrackingOptions options = exact_tracking();
  options.gusts = {{.force_N = 9.0, .direction = {-1.0, 0.0, 0.0}, .duration_s = 100.0}};
  options.timeout_s = 0.5;
  FlightWorld scene(options, test::at_height(8.0));
  const FlightWaypoint goal{.p_world_m = {0.5, 0.0, 8.0}};
  const MinimumJerkTrajectory path(scene.tracking.reference(), std::span(&goal, 1), options.limits);
  const FlightResult result = scene.tracking.follow(path);
  EXPECT_EQ(result.status, FlightStatus::timeout);
  EXPECT_GT(result.duration_s, path.duration_s() + 0.499);
  EXPECT_LT(result.duration_s, path.duration_s() + 0.505);
}

TEST(TrajectoryTrackingController, HasArrivedWhenItHasBeenThereForAWhile) {
  TrajectoryTrackingOptions options = exact_tracking();
  options.settle_time_s = 0.8;
  FlightWorld scene(options);
  const FlightWaypoint goal{.p_world_m = {0.6, -0.4, 3.2}, .yaw_rad = 0.3};
  const MinimumJerkTrajectory path(scene.tracking.reference(), std::span(&goal, 1), options.limits);
  const FlightResult result = scene.tracking.follow(path);
  EXPECT_EQ(result.status, FlightStatus::arrived);
  EXPECT_GT(result.duration_s, path.duration_s() + 0.79);
  EXPECT_LT(result.duration_s, path.duration_s() + 1.5);
}

TEST(FlightStatuses, HaveNames) {
  EXPECT_EQ(to_string(FlightStatus::arrived), "arrived");
  EXPECT_EQ(to_string(FlightStatus::contact), "contact");
  EXPECT_EQ(to_string(FlightStatus::stopped), "stopped");
  EXPECT_EQ(to_string(FlightStatus::timeout), "timeout");
}

TEST(TrajectoryTrackingController, StartsWithItsReferenceWhereTheVehicleIs) {
  const FlightWorld scene(exact_tracking(), make_pose({1.0, -2.0, 3.0}, 0.7));
  const FlightReference& reference = scene.tracking.reference();
  EXPECT_LT((reference.p_world_m - Eigen::Vector3d(1.0, -2.0, 3.0)).norm(), 1e-12);
  EXPECT_NEAR(reference.yaw_rad, 0.7, 1e-12);
  EXPECT_TRUE(reference.v_world_m_s.isZero(0.0));
  EXPECT_TRUE(reference.a_world_m_s2.isZero(0.0));
  EXPECT_EQ(reference.yaw_rate_rad_s, 0.0);
}

TEST(TrajectoryTrackingController, SumsUpWhatItFlewTickByTick) {
  Gust gust;
  gust.force_N = 4.0;
  gust.duration_s = 0.2;
  TrajectoryTrackingOptions options = exact_tracking();
  options.gusts = {gust};
  FlightWorld scene(options);
  const Eigen::Vector3d place_m = scene.tracking.reference().p_world_m;
  Eigen::Vector3d before_m = scene.position_m();
  FlightResult sum;
  double squared_m2_s = 0.0;
  scene.world.on_tick = [&](World& world) {
    const Eigen::Vector3d p_m = scene.position_m();
    sum.path_length_m += (p_m - before_m).norm();
    sum.greatest_error_m = std::max(sum.greatest_error_m, (p_m - place_m).norm());
    sum.energy_J +=
        kPeriod_s * induced_power_W(scene.vehicle.thrusts_N(world), scene.vehicle.rotor_radius_m());
    squared_m2_s += kPeriod_s * (p_m - place_m).squaredNorm();
    before_m = p_m;
  };
  const FlightResult result = scene.tracking.hold(0.5);
  EXPECT_GT(result.greatest_error_m, 1e-3) << "it is pushed";
  EXPECT_NEAR(result.greatest_error_m, sum.greatest_error_m, 1e-9);
  EXPECT_NEAR(result.path_length_m, sum.path_length_m, 1e-9);
  EXPECT_NEAR(result.rms_error_m, std::sqrt(squared_m2_s / result.duration_s), 1e-9);
  EXPECT_NEAR(result.energy_J, sum.energy_J, 1e-9);
}

TEST(TrajectoryTrackingController, HoldingEndsAtAContactToo) {
  TrajectoryTrackingOptions options = exact_tracking();
  options.gusts = {{.force_N = 9.0, .direction = {1.0, 0.0, 0.0}, .duration_s = 100.0}};
  FlightWorld scene(options, test::at_height(1.0),
                    "<geom type='box' size='0.1 2 2' pos='0.36 0 1'/>");
  const FlightResult result = scene.tracking.hold(3.0);
  EXPECT_EQ(result.status, FlightStatus::contact);
  EXPECT_LT(result.duration_s, 2.0);
  EXPECT_EQ(scene.tracking.collisions(), 1);
}

TEST(TrajectoryTrackingController, SumsUpEachFlightAnew) {
  FlightWorld scene;
  const FlightResult first = scene.tracking.hold(0.5);
  const FlightResult second = scene.tracking.hold(0.25);
  EXPECT_NEAR(first.duration_s, 0.5, 1e-9);
  EXPECT_NEAR(second.duration_s, 0.25, 1e-9);
  EXPECT_NEAR(second.energy_J, 0.5 * first.energy_J, 0.05 * first.energy_J);
  const double start_s = scene.world.time_s();
  const FlightWaypoint goal{.p_world_m = scene.position_m() + Eigen::Vector3d(0.4, 0.0, 0.0)};
  const FlightResult flown = scene.tracking.fly_to(std::span(&goal, 1));
  EXPECT_NEAR(flown.duration_s, scene.world.time_s() - start_s, 1e-9);
  EXPECT_NEAR(flown.path_length_m, 0.4, 0.1);
}

TEST(TrajectoryTrackingController, ItsReferenceIsWhereThePathIsAtTheEndOfATick) {
  FlightWorld scene;
  scene.tracking.hold(0.25);
  const FlightWaypoint goal{.p_world_m = {1.0, 0.0, 3.0}};
  const MinimumJerkTrajectory path(scene.tracking.reference(), std::span(&goal, 1),
                                   exact_tracking().limits);
  int ticks = 0;
  scene.tracking.follow(path, [&](const TrajectoryTrackingController& tracking) {
    ++ticks;
    EXPECT_LT((tracking.reference().p_world_m - path.at(kPeriod_s * ticks).p_world_m).norm(), 1e-9);
    return ticks < 200;
  });
  EXPECT_EQ(ticks, 200);
}

TEST(TrajectoryTrackingController, ToHoldForNoTimeIsNoError) {
  FlightWorld scene;
  const FlightResult result = scene.tracking.hold(0.0);
  EXPECT_EQ(result.duration_s, 0.0);
  EXPECT_EQ(result.rms_error_m, 0.0);
}

}  // namespace
}  // namespace vantage
