#include "vantage/tasks/tabletop/tabletop.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/core/log.hpp"
#include "vantage/tasks/mapping/mapping_metrics.hpp"
#include "vantage/tasks/mapping/mapping_recorder.hpp"
#include "vantage/tasks/mapping/measures/mapping_measures.hpp"
#include "vantage/tasks/tabletop/start_check.hpp"
#include "vantage/tasks/tabletop/table_region.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage {
namespace {

/// What each view truly sees is worked out cell by cell.
constexpr double kMaxCellsOfAllViews = 2147483648.0;

void require_few_cells(const Tabletop& task) {
  const double views = static_cast<double>(task.candidates.positions) *
                       static_cast<double>(task.candidates.yaw_offsets_rad.size());
  if (task.map.count() * views <= kMaxCellsOfAllViews) return;
  throw ConfigError(
      fmt::format("map.cells: {:.3g} cells times {} views of candidates.positions and "
                  "candidates.yaw_offsets_rad is more than 2^31",
                  task.map.count(), views));
}

}  // namespace

GroundTruthMapEvaluator tabletop_evaluator(const Tabletop& task, int threads,
                                           const MobileGroundTruth& truth,
                                           const FieldOfView& view_field) {
  GroundTruthMapEvaluator evaluator(truth, task.map.frame(), view_field, threads);
  std::vector<Pose> T_world_views;
  for (const Candidate& view : tabletop_views(task)) T_world_views.push_back(view.T_world_sensor);
  evaluator.add_observable(T_world_views);
  if (knows_truth(task.choice)) evaluator.remember_visible(T_world_views);
  return evaluator;
}

void Tabletop::check_with(const EpisodeOptions& episode) const {
  require_possible(episode.faults, {.laser = true, .wheels = true});
  const double period_s = episode.simulation.control_period_s;
  if (std::abs(laser.line_rate_hz * period_s - 1.0) > 1e-9) {
    throw ConfigError(fmt::format(
        "laser.line_rate_hz: {} must be 1 / simulation.control_period_s = {}: a line per tick",
        laser.line_rate_hz, 1.0 / period_s));
  }
  if (episode.robot.start_view >= candidates.positions) {
    throw ConfigError(fmt::format("robot.start_view: {} is not below candidates.positions = {}",
                                  episode.robot.start_view, candidates.positions));
  }
}

void Tabletop::resolve(const EpisodeSetup& setup) {
  if (!map.centre_m) {
    if (const auto found = scene_table(setup.scene, table)) follow_table(map, *found);
  }
  map.fill_in();
  require_few_cells(*this);
}

ModelSource Tabletop::model_source(const EpisodeSetup& setup) const {
  return {setup.scene, setup.robot.mjcf};
}

TaskExtent Tabletop::extent(const EpisodeSetup&) const { return mapping_extent(*this); }
WindowContent Tabletop::window() const { return mapping_window(*this); }
ReportSections Tabletop::report() { return mapping_report(); }
Measures Tabletop::measures() { return mapping_measures(); }

RecordTexts Tabletop::records() { return mapping_records(); }
std::string Tabletop::outcome(const nlohmann::ordered_json& metrics) {
  return mapping_outcome(metrics);
}

std::vector<std::string> Tabletop::require_start(const EpisodeSetup& setup) const {
  require_planner(choice);
  return SimulatedTabletopRobot(setup, *this).start_notes();
}

void Tabletop::check_robot(const World& alone, const RobotFolder& robot) const {
  const MobileBase base(alone.model(), mobile_base_of(robot, "robot.model"),
                        robot.description.string());
  if (base.has_tilting_laser()) check_reach(alone, base, *this);
}

RunOutcome Tabletop::run(const RunRequest& request) const {
  TabletopSession<> session(request, *this);
  for (const std::string& note : session.robot.start_notes()) log_warning(note);
  if (session.evaluator.observable_cells() == 0) {
    log_warning("map: none of the views sees any of its cells");
  }
  return session.run_to_end();
}

ViewCoverage Tabletop::coverage(const EpisodeSetup& setup,
                                const std::vector<Pose2>& T_world_bases) const {
  const SimulatedTabletopRobot robot(setup, *this);
  const MobileGroundTruth truth = robot.ground_truth();
  const GroundTruthMapEvaluator evaluator =
      tabletop_evaluator(*this, setup.options.threads, truth, robot.view_field());
  const Pose T_base_sensor = to_se3(robot.estimated_base()).inverse() * robot.estimated_sensor();
  ScanPlaces places;
  for (const Pose2& base : T_world_bases) {
    places.T_world_sensors.push_back(to_se3(base) * T_base_sensor);
    places.base_m.emplace_back(base.x_m, base.y_m);
  }
  for (const Candidate& view : tabletop_views(*this)) {
    const Pose2 base = robot.base_for_sensor(view.T_world_sensor);
    places.T_world_sensors.push_back(view.T_world_sensor);
    places.base_m.emplace_back(base.x_m, base.y_m);
  }
  OpenFloor floor{free_floor(floor_map), robot.inscribed_radius_m()};
  const Eigen::AlignedBox3d region =
      map.frame().box();  // kept free of the robot, see TabletopParts
  block_box(floor.map, {region.min().head<2>(), region.max().head<2>()});
  return view_coverage(evaluator, places, floor, setup.options.threads);
}

}  // namespace vantage
