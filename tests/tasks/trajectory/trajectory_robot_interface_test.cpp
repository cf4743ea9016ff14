// The path that a flight leads on to, told before it is taken.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/drawn_pixels.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"
#include "vantage/tasks/trajectory/trajectory_metrics.hpp"
#include "vantage/tasks/trajectory/trajectory_parts.hpp"
#include "vantage/tasks/trajectory/trajectory_recorder.hpp"
#include "vantage/tasks/trajectory/true_clearance.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

const fs::path kSourceTree = VANTAGE_SOURCE_DIR;

FlightWaypoint at(double x_m, double y_m, double yaw_rad) {
  return {.p_world_m = {x_m, y_m, 1.8}, .yaw_rad = yaw_rad};
}

/// The robot of the episode in its world.
struct FlyingRobot : SimulatedTrajectoryRobot {
  FlyingRobot(const ResolvedEpisode& resolved, const FlightWaypoint& start)
      : SimulatedTrajectoryRobot(resolved.setup, model_source(resolved),
                                 std::get<TrajectoryFlight>(resolved.task), start) {}
};

const ImageCallback kNothing = [](const FlightImage&) {};

class Interface : public testing::Test {
 protected:
  /// When it got nearer to something than ever before, until `end_s`.
  std::vector<double> clearance_lowered_s(FlyingRobot& robot, double end_s) {
    double clearance_m = robot.ground_truth().minimum_clearance_m;
    std::vector<double> lowered_s;
    while (robot.time_s() < end_s) {
      robot.fly_for(episode_.setup.options.simulation.control_period_s, kNothing);
      const double now_m = robot.ground_truth().minimum_clearance_m;
      if (now_m < clearance_m) lowered_s.push_back(robot.time_s());
      clearance_m = now_m;
    }
    return lowered_s;
  }

  const ResolvedEpisode episode_ = load_episode(
      kSourceTree / "assets/episodes/trajectory.yaml",
      {fmt::format("scene={}", (kSourceTree / "models/scenes/trajectory_4/scene.xml").string()),
       "camera={width_px: 32, height_px: 24}"});
};

TEST_F(Interface, TellsThePathThatItLeadsOnTo) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  robot.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2), at(-1.6, -1.8, 0.4)});
  robot.fly_for(0.9, kNothing);
  const std::vector<FlightWaypoint> others = {at(-1.6, -1.9, 0.0), at(-1.0, -1.9, -0.3)};
  constexpr double kDelay_s = 0.4;
  const int passed = robot.passed(kDelay_s);
  const MinimumJerkTrajectory told = robot.path_in(kDelay_s, others);
  const MinimumJerkTrajectory from_here = robot.path_in(0.0, others);
  robot.fly_for(kDelay_s, kNothing);
  EXPECT_EQ(robot.passed(), passed);
  robot.follow(others);
  for (int i = 1; i <= 4; ++i) {
    robot.fly_for(0.25, kNothing);
    const Eigen::Vector3d p_m = robot.path_in(0.0, others).at(0.0).p_world_m;
    EXPECT_NEAR((told.at(0.25 * i).p_world_m - p_m).norm(), 0.0, 1e-6);
    EXPECT_GT((from_here.at(0.25 * i).p_world_m - p_m).norm(), 0.01) << "a delay makes another";
  }
}

TEST_F(Interface, TellsWhatIsLeftOfThePathThatItFlies) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  EXPECT_FALSE(robot.path_on(0.1)) << "none yet";
  robot.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2), at(-1.6, -1.8, 0.4),
                           at(-1.1, -1.9, 0.0), at(-0.6, -1.9, 0.0)});
  robot.fly_for(0.9, kNothing);
  constexpr double kDelay_s = 0.4;
  const auto on = robot.path_on(kDelay_s);
  ASSERT_TRUE(on);
  EXPECT_EQ(on->knots_s().size(), 6U - static_cast<std::size_t>(robot.passed(kDelay_s)));
  robot.fly_for(kDelay_s, kNothing);
  for (const double t : {0.0, 0.1, 0.2, 0.3}) {
    const auto now = robot.path_on(0.0);
    ASSERT_TRUE(now);
    EXPECT_NEAR((on->at(t).p_world_m - now->at(0.0).p_world_m).norm(), 0.0, 1e-6);
    robot.fly_for(0.1, kNothing);
  }
  ASSERT_LE(robot.passed(), 2);
  robot.fly_past(2 - robot.passed(), kNothing);
  EXPECT_TRUE(robot.path_on(0.0)) << "three are left";
  robot.fly_past(1, kNothing);
  EXPECT_FALSE(robot.path_on(0.0)) << "two are left";
}

/// With nothing of its own that could not be copied.
struct BareTrajectoryRobot : TrajectoryRobotInterface {
  using TrajectoryRobotInterface::passed;
  [[nodiscard]] double time_s() const override { return 0.0; }
  void follow(std::span<const FlightWaypoint> /*waypoints*/) override {}
  void fly_for(double /*duration_s*/, const ImageCallback& /*on_image*/) override {}
  void fly_past(int /*waypoints*/, const ImageCallback& /*on_image*/) override {}
  [[nodiscard]] MinimumJerkTrajectory path_in(
      double /*delay_s*/, std::span<const FlightWaypoint> waypoints) const override {
    return {FlightReference{}, waypoints};
  }
  [[nodiscard]] std::optional<MinimumJerkTrajectory> path_on(double /*delay_s*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] int passed(double /*in_s*/) const override { return 0; }
  void capture_now(const ImageCallback& /*on_image*/) override {}
  [[nodiscard]] Pose estimated_body() const override { return Pose::Identity(); }
  [[nodiscard]] Pose T_body_camera() const override { return Pose::Identity(); }
};

TEST_F(Interface, IsOfOneRobotThatIsNotCopied) {
  EXPECT_TRUE(std::is_default_constructible_v<BareTrajectoryRobot>);
  EXPECT_FALSE(std::is_copy_constructible_v<BareTrajectoryRobot>);
  EXPECT_FALSE(std::is_copy_assignable_v<BareTrajectoryRobot>);
}

using LeanFlight = Interface;

TEST_F(LeanFlight, KeepsNoImagesEventsOrScene) {
  const support::TemporaryDirectory folder;
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  const auto& task = std::get<TrajectoryFlight>(episode_.task);
  RunOptions options;
  options.directory = folder / "run";
  options.lean = true;
  const RunRequest request{episode_.setup,         "trajectory", task.method_name(),
                           episode_yaml(episode_), {},           options};
  const EpisodeRun run(request);
  TrajectoryRecorder recorder(run, robot.quadrotor(), task.camera);
  ObjectView view;
  view.width_px = view.height_px = 2;
  view.rgb.assign(12, 100);
  view.mask.assign(4, 1);
  recorder.observation(0, {}, 1, view);
  recorder.commit();
  EXPECT_TRUE(fs::exists(options.directory / "looks.csv"));
  for (const char* name : {"views", "story.bin", "scene.bin", "candidates.csv", "states.bin"}) {
    EXPECT_FALSE(fs::exists(options.directory / name)) << name;
  }
  release_run_directory(options.directory);
}

/// Towards the wall, the nearest thing. Between two measurements it keeps what it has.
TEST_F(Interface, MeasuresItsClearanceAtOnceAndTenTimesASecond) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  TrueClearance at_first(robot.quadrotor().world());
  at_first.update(robot.quadrotor().world());
  EXPECT_DOUBLE_EQ(robot.ground_truth().minimum_clearance_m, at_first.min_m());
  robot.follow(std::vector{at(-2.7, -2.3, 0.0)});
  const std::vector<double> lowered_s = clearance_lowered_s(robot, 1.5);
  ASSERT_GT(lowered_s.size(), 3U);
  for (std::size_t i = 1; i < lowered_s.size(); ++i) {
    EXPECT_GT(lowered_s[i] - lowered_s[i - 1], 0.099) << i;
  }
}

TEST_F(Interface, CountsItsErrorAndItsWayTickByTick) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  robot.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2)});
  constexpr int kTicks = 300;
  double sum_m = 0.0;
  double most_m = 0.0;
  double way_m = 0.0;
  Eigen::Vector3d before_m = robot.quadrotor().true_body().translation();
  for (int tick = 0; tick < kTicks; ++tick) {
    robot.fly_for(episode_.setup.options.simulation.control_period_s, kNothing);
    const Eigen::Vector3d p_m = robot.quadrotor().true_body().translation();
    const double error_m = (p_m - robot.quadrotor().tracking().reference().p_world_m).norm();
    sum_m += error_m;
    most_m = std::max(most_m, error_m);
    way_m += (p_m - before_m).norm();
    before_m = p_m;
  }
  const TrajectoryGroundTruth truth = robot.ground_truth();
  EXPECT_NEAR(truth.tracking_error_mean_m, sum_m / kTicks, 1e-9);
  EXPECT_NEAR(truth.tracking_error_max_m, most_m, 1e-9);
  EXPECT_NEAR(truth.flown_m, way_m, 1e-9);
}

TEST(FlightImages, BeginWithNothing) {
  const FlightImage image{};
  EXPECT_EQ(image.time_s, 0.0);
  EXPECT_TRUE(image.arrived);
}

/// The parts of a flight along the path as given, before its first waypoint.
struct PartsInFlight {
  explicit PartsInFlight(const RunOptions& options)
      : robot(episode, path.front()),
        request{episode.setup,         "trajectory", task.method_name(),
                episode_yaml(episode), {},           options},
        run(request),
        recorder(run, robot.quadrotor(), task.camera),
        evaluator(robot),
        parts({episode.setup.options, task, recogniser, robot, evaluator, recorder}, path) {}

  const ResolvedEpisode episode = load_episode(
      kSourceTree / "assets/episodes/trajectory.yaml",
      {fmt::format("scene={}", (kSourceTree / "models/scenes/trajectory_4/scene.xml").string()),
       "method=initial", "camera={width_px: 160, height_px: 120}"});
  const TrajectoryFlight& task = std::get<TrajectoryFlight>(episode.task);
  const std::vector<FlightWaypoint> path = {at(-2.7, -1.9, 0.0), at(-2.4, -1.9, 0.0),
                                            at(-2.1, -1.9, 0.0), at(-1.8, -1.9, 0.0)};
  FlyingRobot robot;
  const Recogniser recogniser = support::recogniser_of_two();
  const RunRequest request;
  const EpisodeRun run;
  TrajectoryRecorder recorder;
  const TrajectoryEvaluator evaluator;
  TrajectoryParts parts;
};

RunOptions lean_run(const fs::path& directory) {
  RunOptions options;
  options.directory = directory;
  options.lean = true;
  return options;
}

TEST(FlightOfParts, LeadsAlongThePlanThatIsTaken) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  PartsInFlight flight(lean_run(folder / "run"));
  flight.parts.update(flight.parts.observe());
  flight.parts.record();
  CandidatePlan plan = flight.parts.propose().front();
  ASSERT_EQ(plan.points.cols(), 3);
  plan.points.row(2).tail(2).array() += 0.1;
  flight.parts.act(plan);
  std::vector<Eigen::Vector4d> higher = flight.parts.nominal();
  higher[2].z() += 0.1;
  higher[3].z() += 0.1;
  for (std::size_t i = 0; i < higher.size(); ++i) {
    EXPECT_NEAR((flight.parts.plan().at(i) - higher[i]).norm(), 0.0, 1e-12) << i;
  }
  release_run_directory(flight.run.directory());
}

TEST(FlightOfParts, HasNoMetricsOfWhatDidNotHappen) {
  const support::TemporaryDirectory folder;
  const PartsInFlight flight(lean_run(folder / "run"));
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 0.0;
  add_trajectory_metrics({flight.robot.ground_truth(), {}}, flight.parts, metrics);
  for (const char* key : {"replans", "late_plans", "missed_deadlines", "waypoints_reached",
                          "accuracy", "observations_total", "false_objects"}) {
    EXPECT_EQ(metrics.at(key), 0) << key;
  }
  EXPECT_EQ(metrics["plan_time_s"]["median"], 0.0);
  EXPECT_EQ(metrics["plan_time_s"]["p95"], 0.0);
  EXPECT_TRUE(metrics["mean_entropy_observed_nats"].is_null());
  release_run_directory(flight.run.directory());
}

/// The right half of the video has the name of the method above all else.
TEST(FlightOfParts, SaysInItsVideoWhatPlans) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  RunOptions options = lean_run(folder / "run");
  options.video = true;
  PartsInFlight flight(options);
  flight.parts.record();
  const cv::Mat still = cv::imread((folder / "run/frames/scan_01.png").string());
  ASSERT_EQ(still.cols, 1280);
  EXPECT_GT(support::count_coloured(still, {640 + 14, 8, 200, 20}, panel::kText), 0);
  release_run_directory(flight.run.directory());
}

/// Two of them are behind it; soon it will be five.
TEST(PassedWaypoints, AreThoseOfNowIfNoTimeIsSaid) {
  struct OnItsWay : BareTrajectoryRobot {
    using BareTrajectoryRobot::passed;
    [[nodiscard]] int passed(double in_s) const override { return in_s > 0.0 ? 5 : 2; }
  };
  EXPECT_EQ(OnItsWay().passed(), 2);
}

TEST(WaypointRecords, BeginWithoutAPlan) {
  const WaypointRecord first{};
  EXPECT_EQ(first.planner, "");
  EXPECT_EQ(first.plan_time_s, 0.0);
  EXPECT_EQ(first.latency_s, 0.0);
  EXPECT_FALSE(first.late);
  EXPECT_FALSE(first.missed);
  EXPECT_FALSE(first.target);
}

/// It has come to the end of the path by then. There is nothing to look at that large.
TEST(FlightOfParts, LeadsToTheLastWaypointHoweverLateItsPlanIs) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  PartsInFlight flight(lean_run(folder / "run"));
  TrajectoryFlight slow = flight.task;
  slow.latency_s = 6.0;
  slow.search.cut.min_pixels = 1'000'000;
  TrajectoryParts parts({flight.episode.setup.options, slow, flight.recogniser, flight.robot,
                         flight.evaluator, flight.recorder},
                        flight.path);
  parts.update(parts.observe());
  parts.record();
  std::vector<CandidatePlan> plans = parts.propose();
  parts.score(plans);
  parts.act(plans.front());
  EXPECT_EQ(parts.observe().waypoint, 3);
  EXPECT_EQ(parts.finished(), "end of the path, 4 waypoints");
  release_run_directory(flight.run.directory());
}

TEST(FlightOfParts, NamesThePictureOfALookByItsNumberAndItsObject) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  RunOptions options = lean_run(folder / "run");
  options.lean = false;
  PartsInFlight flight(options);
  ObjectView view;
  view.width_px = view.height_px = 2;
  view.rgb.assign(12, 100);
  view.mask.assign(4, 1);
  flight.recorder.observation(7, {}, 2, view);
  EXPECT_TRUE(fs::exists(options.directory / "views/look_002_object_7.png"));
  release_run_directory(options.directory);
}

/// Five a second from when one was asked for.
TEST_F(Interface, TakesImagesAtTheirRate) {
  ResolvedEpisode slower = episode_;
  std::get<TrajectoryFlight>(slower.task).image_rate_hz = 5.0;
  FlyingRobot robot(slower, at(-2.7, -1.9, 0.0));
  std::vector<double> taken_s;
  const ImageCallback note = [&](const FlightImage& image) { taken_s.push_back(image.time_s); };
  robot.capture_now(note);
  robot.fly_for(1.0, note);
  EXPECT_NEAR(robot.time_s(), 1.0, 1e-6);
  ASSERT_EQ(taken_s.size(), 6U);
  for (std::size_t i = 0; i < taken_s.size(); ++i) {
    EXPECT_NEAR(taken_s[i], 0.2 * static_cast<double>(i), 1e-6) << i;
  }
}

TEST_F(Interface, FliesPastAsManyWaypointsAsItIsTold) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  EXPECT_EQ(robot.passed(), 0) << "there are none yet";
  robot.fly_for(0.2, kNothing);
  const std::vector<FlightWaypoint> waypoints = {at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2),
                                                 at(-1.6, -1.8, 0.4)};
  const MinimumJerkTrajectory path = robot.path_in(0.0, waypoints);
  robot.follow(waypoints);
  const double start_s = robot.time_s();
  robot.fly_past(2, kNothing);
  EXPECT_EQ(robot.passed(), 2);
  EXPECT_NEAR(robot.time_s() - start_s, path.knots_s()[2], 0.0021);
  const Eigen::Vector3d led_m = robot.quadrotor().tracking().reference().p_world_m;
  EXPECT_NEAR((led_m - path.at(robot.time_s() - start_s).p_world_m).norm(), 0.0, 1e-6);
  robot.fly_past(5, kNothing);
  EXPECT_EQ(robot.passed(), 3);
  EXPECT_NEAR(robot.time_s() - start_s, path.duration_s(), 0.0021) << "there are no more";
}

TEST_F(Interface, SumsUpThePowerOfItsRotors) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  const TrajectoryGroundTruth before = robot.ground_truth();
  EXPECT_EQ(before.tracking_error_mean_m, 0.0);
  EXPECT_EQ(before.tracking_error_max_m, 0.0);
  EXPECT_EQ(before.flown_m, 0.0);
  EXPECT_EQ(before.energy_j, 0.0);
  const double period_s = episode_.setup.options.simulation.control_period_s;
  const Quadrotor& vehicle = robot.quadrotor().vehicle();
  robot.follow(std::vector{at(-2.3, -1.9, 0.0)});
  double energy_j = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    robot.fly_for(period_s, kNothing);
    energy_j += period_s * induced_power_W(vehicle.thrusts_N(robot.quadrotor().world()),
                                           vehicle.rotor_radius_m());
  }
  EXPECT_GT(energy_j, 1.0);
  EXPECT_NEAR(robot.ground_truth().energy_j, energy_j, 1e-6);
}

TEST_F(Interface, ColoursTheDepthThatItHasMeasured) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.5));
  int taken = 0;
  robot.capture_now([&](const FlightImage& image) {
    ++taken;
    EXPECT_TRUE(image.arrived);
    const CameraImages coloured = image.with_colour();
    EXPECT_EQ(coloured.depth_m, image.depth.depth_m);
    EXPECT_EQ(coloured.rgb.size(), 3U * 32U * 24U);
    const Pose T_world_camera = robot.estimated_body() * robot.T_body_camera();
    EXPECT_TRUE(image.T_world_camera.isApprox(T_world_camera, 1e-9));
  });
  EXPECT_EQ(taken, 1);
  const double pitch_rad = std::get<TrajectoryFlight>(episode_.task).camera_pitch_rad;
  const Eigen::Vector3d sight = robot.T_body_camera().linear().col(2);
  const Eigen::Vector3d tilted(std::cos(pitch_rad), 0.0, -std::sin(pitch_rad));
  EXPECT_NEAR((sight - tilted).norm(), 0.0, 1e-4);
  const Pose placed = make_pose({-2.7, -1.9, 1.8}, 0.5);
  EXPECT_TRUE(robot.quadrotor().true_body().isApprox(placed, 1e-6));
}

TEST_F(Interface, MeasuresTheSameDepthWhetherColourIsAskedForOrNot) {
  const auto second_depth_m = [&](bool ask) {
    FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
    robot.capture_now([&](const FlightImage& image) {
      if (ask) image.with_colour();
    });
    std::vector<float> depth_m;
    robot.capture_now([&](const FlightImage& image) { depth_m = image.depth.depth_m; });
    return depth_m;
  };
  EXPECT_EQ(second_depth_m(true), second_depth_m(false));
}

TEST_F(Interface, SaysWhichImagesAreLost) {
  ResolvedEpisode blind = episode_;
  blind.setup.options.faults.dropped_frames = 1.0;
  FlyingRobot robot(blind, at(-2.7, -1.9, 0.0));
  int lost = 0;
  robot.capture_now([&](const FlightImage& image) {
    lost += image.arrived ? 0 : 1;
    EXPECT_TRUE(image.depth.depth_m.empty());
  });
  EXPECT_EQ(lost, 1);
}

TEST_F(Interface, SaysWhereItTouchedSomething) {
  FlyingRobot robot(episode_, {.p_world_m = {-2.2, -1.25, 0.6}});
  robot.follow(std::vector{FlightWaypoint{.p_world_m = {0.0, -1.25, 0.6}}});
  std::string why;
  try {
    robot.fly_for(9.0, kNothing);
  } catch (const EpisodeFailed& error) {
    why = error.what();
  }
  const Eigen::Vector3d p_m = robot.quadrotor().true_body().translation();
  EXPECT_NE(why.find(fmt::format("{:.2f} s, ({:.2f}, {:.2f}, {:.2f}) m", robot.time_s(), p_m.x(),
                                 p_m.y(), p_m.z())),
            std::string::npos)
      << why;
  WaypointRecord record;
  TrajectoryEvaluator(robot).measure(record);
  EXPECT_EQ(record.collisions, 1);
  EXPECT_EQ(record.clearance_m, 0.0);
  EXPECT_EQ(record.tracking_error_m, robot.ground_truth().tracking_error_mean_m);
  EXPECT_EQ(record.flown_m, robot.ground_truth().flown_m);
}

/// On its way to the wall it is nearer every time.
TEST_F(Interface, MeasuresItsClearanceEveryTenthOfASecond) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  robot.follow(std::vector{at(-2.7, -2.3, 0.0)});
  robot.fly_for(0.3, kNothing);
  const std::vector<double> lowered_s = clearance_lowered_s(robot, 0.8);
  ASSERT_GE(lowered_s.size(), 4U);
  for (std::size_t i = 1; i < lowered_s.size(); ++i) {
    EXPECT_NEAR(lowered_s[i] - lowered_s[i - 1], 0.1, 1e-6) << i;
  }
}

/// Nothing is tracked under that number.
TEST(FlightOfParts, ForgetsWhatTurnedOutToBeAnotherObject) {
  set_verbosity(Verbosity::quiet);
  const support::TemporaryDirectory folder;
  PartsInFlight flight(lean_run(folder / "run"));
  auto& beliefs = const_cast<ObjectObservations&>(flight.parts.observations());
  beliefs.found(99, {0.0, 0.0, 0.8});
  flight.parts.observe();
  for (const RecognisedObject& object : flight.parts.observations().objects()) {
    EXPECT_NE(object.id, 99);
  }
  release_run_directory(flight.run.directory());
}

}  // namespace
}  // namespace vantage
