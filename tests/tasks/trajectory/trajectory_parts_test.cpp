// The parts of a flight along a path: what they fly, weigh and record of what the robot does.
#include "vantage/tasks/trajectory/trajectory_parts.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <numbers>
#include <variant>

#include "tests/tasks/trajectory/noted_flight.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/tasks/trajectory/trajectory_metrics.hpp"
#include "vantage/tasks/trajectory/trajectory_panel.hpp"

namespace vantage {
namespace {

using support::expect_leads;
using support::NotedFlight;

TEST(NotedFlights, BeginAlongThePathAsGiven) {
  NotedFlight flight;
  const WaypointReached reached = flight.parts.observe();
  EXPECT_EQ(reached.waypoint, 0);
  EXPECT_EQ(reached.time_s, 12.5);
  EXPECT_TRUE(reached.T_world_body.isApprox(flight.robot.estimated_body(), 1e-12));
  ASSERT_EQ(flight.parts.nominal().size(), 10U);
  EXPECT_EQ(flight.parts.nominal()[3], Eigen::Vector4d(-2.7 + 0.4 * 3, -1.9, 1.8, 0.01 * 3));
  expect_leads(flight.robot.followed, flight.parts.nominal(), 1, 5);
  EXPECT_EQ(flight.parts.finished(), "");
}

TEST(NotedFlights, RecordThePlanThatLedToAWaypoint) {
  NotedFlight flight;
  EXPECT_EQ(flight.recorded().planner, "") << "none has led to the first";
  flight.told.clear();
  flight.robot.passed_now = 1;
  flight.parts.act(flight.aside(3));
  EXPECT_EQ(flight.robot.flown_on_s, flight.task.latency_s);
  std::vector<Eigen::Vector4d> plan = flight.parts.nominal();
  for (const std::size_t i : {1, 2, 3}) plan[i].y() += 0.1;
  for (std::size_t i = 0; i < plan.size(); ++i) EXPECT_EQ(flight.parts.plan()[i], plan[i]) << i;
  expect_leads(flight.robot.followed, plan, 1, 5);
  ASSERT_EQ(flight.told.size(), 1U);
  const auto& ahead_m = std::get<PlannedFlight>(flight.told[0].what).path_m;
  ASSERT_EQ(ahead_m.size(), 4U) << "where it is, and the horizon";
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(ahead_m[i], Eigen::Vector3d(plan[i].head<3>()));
  const WaypointRecord record = flight.recorded();
  EXPECT_EQ(flight.robot.flown_past, 1);
  EXPECT_EQ(record.waypoint, 1);
  EXPECT_EQ(record.time_s, 12.5);
  EXPECT_TRUE(record.T_world_body.isApprox(flight.robot.estimated_body(), 1e-12));
  EXPECT_EQ(record.planner, "by hand");
  EXPECT_EQ(record.cost, 2.5);
  EXPECT_EQ(record.planned_clearance_m, 0.75);
  EXPECT_EQ(record.latency_s, flight.task.latency_s);
  EXPECT_FALSE(record.late || record.missed);
  ASSERT_EQ(record.plan.size(), 9U);
  EXPECT_EQ(record.plan.front(), plan[1]);
  flight.parts.act(flight.aside(1));
  EXPECT_EQ(flight.recorded().waypoint, 2);
}

/// What it was made for first is behind it already.
TEST(NotedFlights, TakeTheRestOfAPlanThatComesLate) {
  NotedFlight flight;
  flight.recorded();
  flight.robot.passes = 1;
  flight.parts.act(flight.aside(3));
  std::vector<Eigen::Vector4d> plan = flight.parts.nominal();
  for (const std::size_t i : {2, 3}) plan[i].y() += 0.1;
  for (std::size_t i = 0; i < plan.size(); ++i) EXPECT_EQ(flight.parts.plan()[i], plan[i]) << i;
  expect_leads(flight.robot.followed, plan, 2, 5);
  const WaypointRecord record = flight.recorded();
  EXPECT_EQ(record.waypoint, 2);
  EXPECT_TRUE(record.missed);
  EXPECT_EQ(record.plan.size(), 8U);
}

TEST(NotedFlights, FlyToTheLastWaypointAtLast) {
  NotedFlight flight;
  flight.recorded();
  flight.robot.passes = 20;
  flight.parts.act(flight.aside(3));
  expect_leads(flight.robot.followed, flight.parts.nominal(), 9, 1);
  EXPECT_EQ(flight.parts.finished(), "");
  EXPECT_EQ(flight.recorded().waypoint, 9);
  EXPECT_EQ(flight.parts.finished(), "end of the path, 10 waypoints");
}

TEST(NotedFlights, GoOnWhereThePlanIsAsItIsFlown) {
  NotedFlight flight;
  flight.recorded();
  flight.robot.followed.clear();
  CandidatePlan plan = flight.aside(3);
  plan.same_spline = true;
  flight.parts.act(plan);
  EXPECT_TRUE(flight.robot.followed.empty());
}

/// The last of the points lies aside, by half a metre, and the spline is looked at as far as there.
TEST(NotedFlights, WeighAPlanAsItWillBeFlown) {
  for (const int missed : {0, 1}) {
    NotedFlight flight;
    flight.recorded();
    flight.robot.passed_now = 1;
    flight.robot.passes = missed;
    std::vector<CandidatePlan> plans = flight.parts.propose();
    ASSERT_EQ(plans.front().points.cols(), 3);
    plans.front().points(1, 2) += 0.5;
    plans.front().same_spline = true;  // which the robot has not
    flight.parts.score(plans);
    const CandidatePlan& scored = plans.front();
    EXPECT_FALSE(scored.same_spline);
    EXPECT_EQ(flight.robot.asked_delay_s, flight.task.latency_s);
    std::vector<Eigen::Vector4d> plan = flight.parts.nominal();
    plan[3].y() += 0.5;
    expect_leads(flight.robot.asked, plan, static_cast<std::size_t>(missed) + 1, 5);
    FlightPlanner planner({.method = flight.task.method,
                           .options = flight.task.planner,
                           .horizon = 3,
                           .known_below_nats = 0.1},
                          flight_camera(flight.robot.T_camera, 32, 24, 0.8), Rng(1));
    planner.propose({.at = 0, .nominal = flight.parts.nominal(), .plan = flight.parts.plan()}, {},
                    flight.parts.map());
    const MinimumJerkTrajectory& path = flight.robot.told.value();
    const auto last = static_cast<std::size_t>(3 - missed);
    EXPECT_NEAR(scored.clearance_m, planner.clearance_m(path, path.knots_s()[last]), 1e-9);
    EXPECT_LT(scored.clearance_m, planner.clearance_m(path, path.knots_s()[last - 1]) - 0.1);
    EXPECT_EQ(scored.clear, scored.clearance_m >= flight.task.planner.clearance_m);
  }
}

TEST(NotedFlights, AreBlindAfterTwentyLostImages) {
  NotedFlight seeing;
  seeing.robot.lost_images = 19;
  EXPECT_EQ(seeing.parts.observe().waypoint, 0);
  NotedFlight blind;
  blind.robot.lost_images = 20;
  EXPECT_THROW(blind.parts.observe(), EpisodeFailed);
}

/// A first look is expected to tell three quarters of ln 2; without information, all of it.
TEST(NotedFlights, TellWhichViewsTheyWeigh) {
  for (const bool information : {true, false}) {
    NotedFlight flight([&](TrajectoryFlight& task) {
      task.planner.cost.information = information;
      task.observations.min_gain_nats = 0.6;
    });
    flight.recorded();
    flight.beliefs().found(5, {-1.0, -1.5, 0.9});
    flight.told.clear();
    EXPECT_EQ(flight.parts.choose({flight.aside(3)}), 0U);
    ASSERT_EQ(flight.told.size(), 1U);
    const auto& decision = std::get<Decision>(flight.told[0].what);
    PlannableObject object;
    object.id = 5;
    object.p_world_m = {-1.0, -1.5, 0.9};
    const Decision expected =
        view_decision({object}, flight.robot.T_camera, flight.task.planner.observation_distance_m,
                      1.8, std::nullopt);
    ASSERT_EQ(decision.candidates.size(), 8U);
    EXPECT_EQ(decision.chosen, 8U) << "none";
    for (std::size_t i = 0; i < 8; ++i) {
      const Candidate& view = decision.candidates[i];
      EXPECT_TRUE(view.T_world_sensor.isApprox(expected.candidates[i].T_world_sensor, 1e-9)) << i;
      EXPECT_NEAR(view.gain_bits, (information ? 0.75 : 1.0) * std::numbers::ln2, 1e-9);
      EXPECT_EQ(view.reachable, !information) << "that tells too little";
    }
  }
}

TEST(NotedFlights, RecordWhatIsKnown) {
  NotedFlight flight;
  flight.beliefs().found(5, {1.0, 1.0, 0.8});
  flight.beliefs().found(6, {5.0, 5.0, 0.7});
  const double sure_nats = flight.look(5, {1.0, 1.0, 0.9}).entropy_nats;
  const Pose T_world_body = make_pose({1.0, 2.0, 3.0}, 0.4);
  flight.parts.update({.waypoint = 4, .time_s = 6.5, .T_world_body = T_world_body});
  flight.parts.record();
  const WaypointRecord& record = flight.parts.waypoints().front();
  EXPECT_EQ(record.waypoint, 4);
  EXPECT_EQ(record.time_s, 6.5);
  EXPECT_TRUE(record.T_world_body.isApprox(T_world_body, 1e-12));
  EXPECT_EQ(record.objects, 2);
  EXPECT_EQ(record.known, 1);
  EXPECT_EQ(record.observations, 1);
  EXPECT_NEAR(record.mean_entropy_nats, 0.5 * (sure_nats + std::numbers::ln2), 1e-9);
  ASSERT_EQ(flight.told.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<MapChange>(flight.told[0].what));
}

/// Without latency every plan is late.
TEST(NotedFlights, CountHowLongTheyPlan) {
  NotedFlight flight([](TrajectoryFlight& task) { task.latency_s = 0.0; });
  flight.recorded();
  const double before_s = wall_s();
  std::vector<CandidatePlan> plans = flight.parts.propose();
  const double proposed_s = wall_s();
  flight.parts.score(plans);
  const double scored_s = wall_s();
  flight.parts.choose(plans);
  const double after_s = wall_s();
  flight.parts.act(plans.front());
  const WaypointRecord record = flight.recorded();
  EXPECT_GE(record.plan_time_s, scored_s - proposed_s);
  EXPECT_LE(record.plan_time_s, after_s - before_s);
  EXPECT_TRUE(record.late);
  flight.parts.act(flight.aside(1));  // in no time
  flight.recorded();
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 0.0;
  add_trajectory_metrics({{}, {}}, flight.parts, metrics);
  EXPECT_EQ(metrics["replans"], 2);
  EXPECT_EQ(metrics["late_plans"], 1);
  EXPECT_EQ(metrics["missed_deadlines"], 0);
  EXPECT_EQ(metrics["waypoints_reached"], 3);
  ASSERT_EQ(metrics["plan"].size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      EXPECT_EQ(metrics["plan"][i][k], flight.parts.plan()[i][axis]) << i;
      EXPECT_EQ(metrics["path"][i][k], flight.parts.nominal()[i][axis]) << i;
    }
  }
}

/// Beside what the camera on board sees, in the right half of the video.
TEST(NotedFlights, ShowWhereTheyAreAndWhatTheyKnow) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  NotedFlight flight([](TrajectoryFlight& task) { task.observations.range_m = 1.5; });
  RunOptions options;
  options.directory = flight.folder / "filmed";
  options.lean = true;
  options.video = true;
  const RunRequest request{flight.episode.setup,         "trajectory", flight.task.method_name(),
                           episode_yaml(flight.episode), {},           options};
  const EpisodeRun run(request);
  TrajectoryRecorder recorder(run, flight.hovering.quadrotor(), flight.task.camera);
  TrajectoryParts parts({flight.episode.setup.options, flight.task, flight.recogniser, flight.robot,
                         flight.evaluator, recorder},
                        flight.path);
  parts.update(parts.observe());
  parts.record();
  TrajectoryPanelInput expected{.observations = parts.observations(),
                                .nominal = parts.nominal(),
                                .plan = parts.plan(),
                                .at = 0};
  expected.T_world_body = flight.robot.estimated_body();
  expected.method = flight.task.method_name();
  expected.range_m = 1.5;
  expected.half_width_rad = std::atan(std::tan(0.5 * flight.task.camera.fovy_rad) * 32.0 / 24.0);
  const cv::Mat panel = draw_trajectory_panel(expected, {}, {640, 720});
  const cv::Mat still = cv::imread((run.directory() / "frames/scan_01.png").string());
  release_run_directory(run.directory());
  ASSERT_EQ(still.size(), cv::Size(1280, 720));
  const cv::Mat shown = still(cv::Rect(640, 0, 640, 720));
  for (const cv::Rect& part : {cv::Rect(0, 0, 640, 36), cv::Rect(0, 330, 640, 390)}) {
    EXPECT_EQ(cv::norm(shown(part), panel(part), cv::NORM_INF), 0.0) << part;
  }
}

}  // namespace
}  // namespace vantage
