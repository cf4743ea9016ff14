/// A flight along a straight path with a robot that does what the test says.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"
#include "vantage/tasks/trajectory/trajectory_parts.hpp"
#include "vantage/tasks/trajectory/trajectory_recorder.hpp"

namespace vantage::support {

/// Ten waypoints, 0.4 m apart.
inline std::vector<FlightWaypoint> straight_path() {
  std::vector<FlightWaypoint> path;
  for (int i = 0; i < 10; ++i) {
    path.push_back({.p_world_m = {-2.7 + 0.4 * i, -1.9, 1.8}, .yaw_rad = 0.01 * i});
  }
  return path;
}

/// A mug and a bowl; whatever is seen is the mug.
inline Recogniser recogniser_of_mugs() {
  const TrainedFeature colour(Colour{}, 0.0);
  ObservationModel model;
  model.feature = "colour";
  model.mean = Eigen::MatrixXf::Zero(colour.dimension(), 8);
  model.mean.rightCols(4).setOnes();
  model.variance = Eigen::MatrixXf::Ones(colour.dimension(), 8);
  return make_recogniser(recogniser_of_two().states, {{colour, model}}, 1);
}

/// Notes what it is asked for; while it flies on it passes as many waypoints as the test says.
struct NotingRobot : TrajectoryRobotInterface {
  explicit NotingRobot(const Pose& T_body_camera) : T_camera(T_body_camera) {}
  using TrajectoryRobotInterface::passed;
  [[nodiscard]] double time_s() const override { return 12.5; }
  void follow(std::span<const FlightWaypoint> waypoints) override {
    followed.assign(waypoints.begin(), waypoints.end());
  }
  void fly_for(double duration_s, const ImageCallback& /*on_image*/) override {
    flown_on_s = duration_s;
    passed_now += passes;
  }
  void fly_past(int waypoints, const ImageCallback& /*on_image*/) override {
    flown_past = waypoints;
  }
  [[nodiscard]] MinimumJerkTrajectory path_in(
      double delay_s, std::span<const FlightWaypoint> waypoints) const override {
    asked_delay_s = delay_s;
    asked.assign(waypoints.begin(), waypoints.end());
    return told.emplace(FlightReference{.p_world_m = {-2.7, -1.9, 1.8}}, waypoints);
  }
  [[nodiscard]] std::optional<MinimumJerkTrajectory> path_on(double /*delay_s*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] int passed(double in_s) const override {
    return in_s > 0.0 ? passed_now + passes : passed_now;
  }
  void capture_now(const ImageCallback& on_image) override {
    FlightImage lost;
    lost.arrived = false;
    for (int i = 0; i < lost_images; ++i) on_image(lost);
  }
  [[nodiscard]] Pose estimated_body() const override { return make_pose({-2.6, -1.8, 1.7}, 0.3); }
  [[nodiscard]] Pose T_body_camera() const override { return T_camera; }

  Pose T_camera;
  int passes = 0;
  int passed_now = 0;
  int lost_images = 0;
  int flown_past = 0;
  double flown_on_s = -1.0;
  std::vector<FlightWaypoint> followed;
  mutable double asked_delay_s = -1.0;
  mutable std::vector<FlightWaypoint> asked;
  mutable std::optional<MinimumJerkTrajectory> told;
};

/// A flight along the straight path as given that plans three waypoints at once.
struct NotedFlight {
  explicit NotedFlight(const std::function<void(TrajectoryFlight&)>& change = {}, bool lean = true)
      : task(changed(std::get<TrajectoryFlight>(episode.task), change)),
        hovering(episode.setup, model_source(episode), task, path.front()),
        request{episode.setup,         "trajectory", task.method_name(),
                episode_yaml(episode), {},           watched(lean)},
        run(request),
        recorder(run, hovering.quadrotor(), task.camera),
        evaluator(hovering),
        robot(hovering.T_body_camera()),
        parts({episode.setup.options, task, recogniser, robot, evaluator, recorder}, path) {}
  ~NotedFlight() { release_run_directory(run.directory()); }
  NotedFlight(const NotedFlight&) = delete;
  NotedFlight& operator=(const NotedFlight&) = delete;

  static TrajectoryFlight changed(TrajectoryFlight task,
                                  const std::function<void(TrajectoryFlight&)>& change) {
    if (change) change(task);
    return task;
  }
  RunOptions watched(bool lean) {
    set_verbosity(Verbosity::quiet);
    RunOptions options;
    options.directory = folder / "run";
    options.lean = lean;
    options.spectator.on_event = [this](const EpisodeEvent& event) { told.push_back(event); };
    options.spectator.on_step = [this](std::string_view /*columns*/, std::string_view row) {
      rows.emplace_back(row);
    };
    return options;
  }
  WaypointRecord recorded() {
    parts.update(parts.observe());
    parts.record();
    return parts.waypoints().back();
  }
  /// Of the next waypoints, 0.1 m to the left of the path.
  [[nodiscard]] CandidatePlan aside(int count) const {
    CandidatePlan plan;
    plan.planner = "by hand";
    plan.points.resize(4, count);
    for (int i = 0; i < count; ++i) {
      plan.points.col(i) = parts.nominal()[static_cast<std::size_t>(i) + 1];
      plan.points(1, i) += 0.1;
    }
    plan.cost = 2.5;
    plan.clearance_m = 0.75;
    return plan;
  }
  /// For tests that say what was found.
  ObjectObservations& beliefs() { return const_cast<ObjectObservations&>(parts.observations()); }
  /// Seen from (2, 2, 1.8) m.
  ObjectObservation look(int id, const Eigen::Vector3d& p_world_m) {
    ObjectDetection detection;
    detection.p_world_object_m = p_world_m;
    detection.distance_m = 1.4;
    detection.pixels = 321;
    ObjectView view;
    view.width_px = view.height_px = 12;
    view.rgb.assign(432, 90);
    view.depth_m.assign(144, 1.0F);
    view.mask.assign(144, 1);
    Rng rng(1);
    return beliefs().take(id, detection, view, make_pose({2.0, 2.0, 1.8}, 0.0), 7.5, rng);
  }

  std::vector<EpisodeEvent> told;
  std::vector<std::string> rows;  ///< of steps.csv
  const TemporaryDirectory folder;
  const ResolvedEpisode episode =
      load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/trajectory.yaml",
                   {"scene=" VANTAGE_SOURCE_DIR "/models/scenes/trajectory_4/scene.xml",
                    "method=initial", "camera={width_px: 32, height_px: 24}", "horizon=3"});
  const std::vector<FlightWaypoint> path = straight_path();
  const TrajectoryFlight task;
  SimulatedTrajectoryRobot hovering;
  const Recogniser recogniser = recogniser_of_mugs();
  const RunRequest request;
  const EpisodeRun run;
  TrajectoryRecorder recorder;
  const TrajectoryEvaluator evaluator;
  NotingRobot robot;
  TrajectoryParts parts;
};

/// The waypoints of the plan from `first` on, `count` of them.
inline void expect_leads(const std::vector<FlightWaypoint>& waypoints,
                         const std::vector<Eigen::Vector4d>& plan, std::size_t first,
                         std::size_t count) {
  ASSERT_EQ(waypoints.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4d& q = plan.at(first + i);
    EXPECT_NEAR((waypoints[i].p_world_m - q.head<3>()).norm(), 0.0, 1e-12) << i;
    EXPECT_NEAR(waypoints[i].yaw_rad, q[3], 1e-12) << i;
  }
}

}  // namespace vantage::support
