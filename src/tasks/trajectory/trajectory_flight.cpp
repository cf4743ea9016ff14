#include "vantage/tasks/trajectory/trajectory_flight.hpp"

#include <nlohmann/json.hpp>

#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/tasks/flight/flight_world.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"
#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"
#include "vantage/tasks/trajectory/trajectory_metrics.hpp"
#include "vantage/tasks/trajectory/trajectory_records.hpp"

namespace vantage {
namespace {

/// @throws InputError if the model file is missing, saying how to make one, or damaged; ConfigError
/// if it neither knows an object of the scene nor can call it unknown.
Recogniser load_recogniser(const TrajectoryFlight& task,
                           const std::vector<ObjectOnSupport>& objects) {
  const auto path = find_recognition_model(task.model);
  Recogniser recogniser = load_lean_recogniser(path, task.recogniser);
  for (const ObjectOnSupport& object : objects) {
    require_answer(recogniser, path, object.object, "stands in the room");
  }
  kernel_of(task.transition, 0.0, recogniser.states.bins);  // says if it does not fit
  return recogniser;
}

}  // namespace

std::string TrajectoryFlight::method_name() const {
  return trajectory_method_name(method, planner.cost);
}

void TrajectoryFlight::check_with(const EpisodeOptions& episode) const {
  require_possible(episode.faults, {.colour = true, .rotors = true});
  require_flight_world(episode.simulation);
}

void TrajectoryFlight::find_files(const std::filesystem::path& base) {
  model = found_model_name(model, base);
  database.models = found_model_name(database.models, base);
}

std::vector<InputFile> TrajectoryFlight::inputs() const { return flight_inputs(model, database); }

ModelSource TrajectoryFlight::model_source(const EpisodeSetup& setup) const {
  return {setup.scene, setup.robot.mjcf, object_files(database, draw_flight_objects(*this, setup))};
}

TaskExtent TrajectoryFlight::extent(const EpisodeSetup& setup) const {
  return {"waypoints", "waypoints", read_flight_path(setup.scene).size()};
}

WindowContent TrajectoryFlight::window() {
  return {.gain_unit = "nats", .follows_height = true, .step_word = "waypoint"};
}

WindowContent TrajectoryFlight::window(const EpisodeSetup& setup) const {
  const std::vector<FlightWaypoint> path = read_flight_path(setup.scene);
  WindowContent content = window();
  content.map = FlightMap(flight_region(path), map).grid().frame;
  content.overview_m.setEmpty();
  for (const FlightWaypoint& waypoint : path) {
    content.overview_m.extend(Eigen::Vector2d(waypoint.p_world_m.head<2>()));
  }
  content.scans = path.size();
  return content;
}

ReportSections TrajectoryFlight::report() {
  return {.figures = kFlightFigures,
          .step_word = "waypoint",
          .scene = true,
          .view_heading = "The flight"};
}

Measures TrajectoryFlight::measures() { return trajectory_measures(); }

RecordTexts TrajectoryFlight::records() { return trajectory_records(); }

std::string TrajectoryFlight::outcome(const nlohmann::ordered_json& metrics) {
  return trajectory_outcome(metrics);
}

void TrajectoryFlight::require_start(const EpisodeSetup& setup) const {
  const SimulatedTrajectoryRobot robot(setup, model_source(setup), *this,
                                       read_flight_path(setup.scene).front());
  load_recogniser(*this, draw_flight_objects(*this, setup));
}

RunOutcome TrajectoryFlight::run(const RunRequest& request) const {
  const EpisodeSetup& setup = request.setup;
  const std::vector<FlightWaypoint> path = read_flight_path(setup.scene);
  std::vector<ObjectOnSupport> objects = draw_flight_objects(*this, setup);
  SimulatedTrajectoryRobot robot(setup, model_source(setup), *this, path.front());
  const Recogniser recogniser = load_recogniser(*this, objects);
  EpisodeRun run(request);
  TrajectoryRecorder recorder(run, robot.quadrotor(), camera);
  const TrajectoryEvaluator evaluator(robot);
  TrajectoryParts parts({setup.options, *this, recogniser, robot, evaluator, recorder}, path);
  run.begin();
  const Ending ending = ending_of([&] { return run_episode(parts); });
  const TrajectoryGroundTruth truth = robot.ground_truth();
  follow_moved(robot.quadrotor().world(), objects);
  return run.finish(ending, {robot.time_s(), truth.collisions}, recorder,
                    [&](nlohmann::ordered_json& metrics) {
                      add_trajectory_metrics({truth, objects}, parts, metrics);
                    });
}

}  // namespace vantage
