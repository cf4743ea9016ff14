#include "vantage/tasks/exploration/exploration.hpp"

#include <fmt/format.h>

#include "vantage/core/log.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/mapping/mapping_metrics.hpp"
#include "vantage/tasks/mapping/mapping_recorder.hpp"
#include "vantage/tasks/mapping/measures/mapping_measures.hpp"

namespace vantage {

void Exploration::check_with(const EpisodeOptions& episode) const {
  require_possible(episode.faults, {.laser = true, .wheels = true});
  swept_field(sweep, camera, 0.0);
  check_floor_detail(floor_map, floor_detail);
}

ModelSource Exploration::model_source(const EpisodeSetup& setup) const {
  return {setup.scene, setup.robot.mjcf};
}

TaskExtent Exploration::extent(const EpisodeSetup&) const { return mapping_extent(*this); }
WindowContent Exploration::window() const { return mapping_window(*this); }
ReportSections Exploration::report() { return mapping_report(); }
Measures Exploration::measures() { return mapping_measures(); }

RecordTexts Exploration::records() { return mapping_records(); }
std::string Exploration::outcome(const nlohmann::ordered_json& metrics) {
  return mapping_outcome(metrics);
}

std::vector<std::string> Exploration::require_start(const EpisodeSetup& setup) const {
  require_planner(choice);
  return SimulatedExplorationRobot(setup, *this).start_notes();
}

void Exploration::check_robot(const World& alone, const RobotFolder& robot) const {
  const MobileBase base(alone.model(), mobile_base_of(robot, "robot.model"),
                        robot.description.string());
  if (base.has_head()) check_camera_reach(alone, base, *this);
}

RunOutcome Exploration::run(const RunRequest& request) const {
  ExplorationSession<> session(request, *this);
  for (const std::string& note : session.robot.start_notes()) log_warning(note);
  log_debug(fmt::format("{} cells are observable, from {} places",
                        session.evaluator.observable_cells(), session.evaluator.poses()));
  return session.run_to_end();
}

ViewCoverage Exploration::coverage(const EpisodeSetup& setup,
                                   const std::vector<Pose2>& T_world_bases) const {
  const SimulatedExplorationRobot robot(setup, *this);
  const MobileGroundTruth truth = robot.ground_truth();
  const ExplorationMapEvaluator evaluator(*this, setup.options.threads, truth, robot.view_field(),
                                          robot.T_base_sweep());
  ScanPlaces places;
  for (const Pose2& base : T_world_bases) {
    places.T_world_sensors.push_back(to_se3(base) * robot.T_base_sweep());
    places.base_m.emplace_back(base.x_m, base.y_m);
  }
  for (const Pose& T_world_sweep : evaluator.observing_poses()) {
    const Pose2 base = robot.base_for_sensor(T_world_sweep);
    places.T_world_sensors.push_back(T_world_sweep);
    places.base_m.emplace_back(base.x_m, base.y_m);
  }
  // Whole columns of the map's cells block the floor: what stands there may be a cell narrower.
  const double cell_m = map.frame().cell_size_m.head<2>().maxCoeff();
  return view_coverage(evaluator, places,
                       {evaluator.true_paths()->map, robot.inscribed_radius_m() - cell_m},
                       setup.options.threads);
}

}  // namespace vantage
