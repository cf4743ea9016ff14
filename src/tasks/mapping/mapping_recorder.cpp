#include "vantage/tasks/mapping/mapping_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"
#include "vantage/tasks/mapping/measures/progress_measures.hpp"

namespace vantage {
namespace {

constexpr std::string_view kSteps = "steps.csv";
constexpr std::string_view kCandidates = "candidates.csv";
constexpr std::string_view kMetrics = "metrics.json";

// Of columns of steps.csv and keys of metrics.json alike.
constexpr std::string_view kPoseError =
    "of the position that the scan is in the map at, by ground truth: the registered one, or the "
    "tracked one where the scan was not registered; in metrics.json after what later loops have "
    "corrected";
constexpr std::string_view kBefore =
    "of the position that the wheels alone give since the scan before, without any registration";
constexpr std::string_view kTracked =
    "of the position that registration of the scan starts from: the wheels', corrected on the way "
    "by the planar scanner where it could";
constexpr std::string_view kRegistered =
    "the scan itself corrected the pose; false: the tracked pose was kept as it was";
constexpr std::string_view kUnconstrained =
    "directions of (x, y, yaw) in which the tracked pose was kept; 3: the scan was not registered";

std::string steps_header(const std::vector<Predictor>& predictors) {
  std::string header =
      "time_s,scan,chosen_view,fallback,x_m,y_m,z_m,yaw_rad,pitch_rad,unobserved_cells,observable_"
      "unobserved_cells,"
      "actual_new_cells,";
  for (const Predictor& predictor : predictors) {
    header += fmt::format("predicted_{}_cells,", predictor.label);
  }
  return header +
         "path_length_m,leg_length_m,plan_time_s,map_time_s,scan_time_s,pose_error_m,"
         "pose_error_before_registration_m,pose_error_tracked_m,yaw_error_rad,registered,"
         "unconstrained,"
         "collisions,precision,recall,pose_sigma_m";
}

std::string steps_row(const ScanRecord& scan, std::size_t number) {
  std::string gains;
  for (const auto& [name, cells] : scan.predicted_cells) gains += fmt::format("{},", cells);
  return fmt::format(
      "{},{},{},{},{},{},{},{},{}{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", scan.time_s, number,
      scan.chosen_view, scan.fallback, pose_columns(scan.T_world_sensor), scan.unobserved_cells,
      scan.observable_unobserved_cells, scan.actual_new_cells, gains, scan.path_length_m,
      scan.leg_length_m, scan.plan_time_s, scan.map_time_s, scan.scan_time_s, scan.pose_error_m,
      scan.pose_error_before_registration_m, scan.pose_error_tracked_m, scan.yaw_error_rad,
      scan.registered, scan.unconstrained, scan.collisions, scan.precision, scan.recall,
      scan.pose_sigma_m);
}

std::vector<CandidateRow> candidate_rows(const std::vector<Candidate>& candidates,
                                         const Gain& gain) {
  std::vector<CandidateRow> rows;
  for (const Candidate& view : candidates) {
    ViewOption option{view.T_world_sensor, view.gain_bits, unit_of(gain), {}, view.path_length_m};
    if (predicts_cells(gain)) option.predicted_cells = view.gain_bits;
    rows.push_back({view.id, view_columns(option)});
  }
  return rows;
}

/// The same in metrics.json and, without the front, in steps.csv.
constexpr std::string_view kFront = "scans[].";
constexpr auto kScanTexts = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"scans[].time_s", "simulated, at the end of the scan"},
    {"scans[].unobserved_cells", "cells of the map that are still unobserved"},
    {"scans[].observable_unobserved_cells",
     "those of them that can be observed at all, by ground truth"},
    {"scans[].actual_new_cells", "unobserved cells that the scan has observed"},
    {"scans[].chosen_view", "id of the candidate that was taken; -1: the scan at the start"},
    {"scans[].plan_time_s", "wall, of the decision that led here"},
    {"scans[].map_time_s", "wall, of registration and map update"},
    {"scans[].scan_time_s", "simulated, of the scan"},
    {"scans[].path_length_m", "way of the base, from the start"},
    {"scans[].leg_length_m", "of it since the scan before"},
    {"scans[].pose_error_m", kPoseError},
    {"scans[].pose_error_before_registration_m", kBefore},
    {"scans[].pose_error_tracked_m", kTracked},
    {"scans[].yaw_error_rad", "of the heading that goes with pose_error_m"},
    {"scans[].registered", kRegistered},
    {"scans[].unconstrained", kUnconstrained},
    {"scans[].fallback", "the view was out of reach, and the robot went as near as it could"},
    {"scans[].collisions", "up to here"},
    {"scans[].precision",
     "of occupied cells, share that is occupied within metrics.tolerance_cells"},
    {"scans[].recall",
     "of observable surface cells, share with an occupied cell within metrics.tolerance_cells"},
    {"scans[].pose_sigma_m",
     "of the position that the scan is in the map at, by what all scans say of each other: grows "
     "along plain walls, shrinks with loops; 0: the task closes none"},
});

}  // namespace

MappingRecorder::MappingRecorder(const EpisodeRun& run, RecordedRobot robot,
                                 const std::vector<Predictor>& predictors, int scans)
    : EpisodeRecorder(run, std::move(robot), steps_header(predictors), scans, kViewColumns),
      planned_scans_(scans) {
  if (!lean()) event_log_.emplace(directory());
}

void MappingRecorder::set_panel(std::function<MapPanelInput()> panel) {
  log().set_panel(
      [panel = std::move(panel)](cv::Size size) { return draw_map_panel(panel(), size); });
}

void MappingRecorder::tell(EpisodeEvent event) {
  log().tell(event);
  if (event_log_) event_log_->add(event);
}

void MappingRecorder::decision(const std::vector<Candidate>& candidates, std::size_t chosen,
                               const Gain& gain) {
  if (keeps_candidates()) add_candidates(candidate_rows(candidates, gain), chosen);
  if (logs_events()) tell({0, Decision{candidates, chosen}});
}

void MappingRecorder::plan(const PlannedTour& tour, const PlanMoment& moment) {
  if (tour.stops.empty()) return;
  if (!lean() && !plans_) plans_.emplace(directory());
  if (plans_) plans_->add(tour, moment);
  if (logs_events()) tell({0, tour});
}

void MappingRecorder::route(const std::vector<Pose2>& waypoints) {
  if (!logs_events()) return;
  PlannedRoute route;
  for (const Pose2& waypoint : waypoints) route.path_m.emplace_back(waypoint.x_m, waypoint.y_m);
  tell({0, std::move(route)});
}

void MappingRecorder::scan(const ScanRecord& record, std::size_t number,
                           const OccupancyGrid& grid) {
  scans_ = number;
  if (!lean()) voxels_.note(grid, number);
  if (logs_events()) tell({0, map_change(known_, grid)});
  step(steps_row(record, number), number, static_cast<double>(number),
       fmt::format("scan {} of {}: {} observable cells left, {:.1f} s simulated", number,
                   planned_scans_, record.observable_unobserved_cells, record.time_s));
}

void MappingRecorder::commit() {
  EpisodeRecorder::commit();
  if (event_log_) event_log_->commit();
  if (plans_) plans_->commit();
}

void MappingRecorder::write_map(const OccupancyGrid& grid, const PointCloud& cloud) {
  voxels_.note(grid, std::max<std::size_t>(1, scans_));
  write_voxels(directory() / "voxels.bin",
               {grid.frame.cell_size_m, grid.frame.box(), voxels_.of(grid)});
  write_ply(directory() / "cloud.ply", cloud);
  if (grid.count(CellState::unobserved) < grid.size()) write_octomaps(grid, directory());
}

RecordTexts mapping_records() {
  RecordTexts texts{
      {kSteps, "scan", "number of the scan, from 1"},
      {kSteps, "x_m", "of the sensor, world, as the robot believes it"},
      {kSteps, "y_m", "of the sensor, world, as the robot believes it"},
      {kSteps, "z_m", "of the sensor, world, as the robot believes it"},
      {kSteps, "yaw_rad", "heading of the sensor, world, as the robot believes it"},
      {kSteps, "pitch_rad", "of the sensor; positive looks down"},
      {kSteps, "predicted_<gain>_cells", "what that gain said the scan would newly observe"},
      {kCandidates, "decision",
       "number of the decision, from 1; the first leads to the second scan"},
      {kCandidates, "candidate", "id of the view, as chosen_view of steps.csv has it"},
      {kCandidates, "x_m", "of the sensor, world"},
      {kCandidates, "y_m", "of the sensor, world"},
      {kCandidates, "z_m", "of the sensor, world"},
      {kCandidates, "yaw_rad", "heading of the sensor, world"},
      {kCandidates, "pitch_rad", "of the sensor; positive looks down"},
      {kCandidates, "gain", "what the gain in use says of the view, as the choice weighed it"},
      {kCandidates, "gain_unit", "what it counts"},
      {kCandidates, "predicted_cells",
       "cells that it would newly show; empty: the gain counts no cells"},
      {kCandidates, "way_m", "length of the planned path to it; empty: out of reach"},
      {kCandidates, "chosen", "1: it was taken"},
      {kMetrics, "observable_cells", "cells that can be observed at all, by ground truth"},
      {kMetrics, "unreachable.rooms",
       "exploration: open places that no way leads to, by ground truth"},
      {kMetrics, "unreachable.cells",
       "exploration: cells that can be observed from there alone; not among observable_cells"},
      {kMetrics, "unreachable.share", "of them and observable_cells together"},
      {kMetrics, "scans", "one entry a scan"},
      {kMetrics, "scans[].predicted", "what each gain said the scan would newly observe"},
      {kMetrics, "scans[].predicted.<gain>", "cells"},
      {kMetrics, "scans[].by_distance",
       "cells of the scan by their distance from where it was expected to be taken"},
      {kMetrics, "scans[].by_distance[].from_m", "least distance"},
      {kMetrics, "scans[].by_distance[].to_m", "greatest distance; null: no end"},
      {kMetrics, "scans[].by_distance[].predicted_cells", "what adaptive said it would observe"},
      {kMetrics, "scans[].by_distance[].actual_cells", "unobserved cells that it has observed"},
      {kMetrics, "scans[].by_distance[].outside_cells",
       "those of them outside the field of view that gains predict for"},
      {kMetrics, "scans[].forecast",
       "what adaptive said the scan would newly observe; null: first"},
      {kMetrics, "scans[].forecast.cells", "cells"},
      {kMetrics, "scans[].forecast.low_cells", "least of the interval (intervals.confidence)"},
      {kMetrics, "scans[].forecast.high_cells", "greatest of it"},
      {kMetrics, "scans[].left",
       "what the robot held for unseen after the scan; null: not asked (stop.share)"},
      {kMetrics, "scans[].left.expected_cells", "cells that all candidates show together"},
      {kMetrics, "scans[].left.share", "the same of all that can be seen"},
      {kMetrics, "scans[].left.confidence", "that stop.share of it has been seen"},
      {kMetrics, "scans[].hazard_scale",
       "factor on the learnt hazard by the forecasts so far (forecast.calibrate)"},
      {kMetrics, "scans[].candidates", "number of views that were chosen from"},
      {kMetrics, "scans[].scan_share", "of a whole scan's images that were taken"},
      {kMetrics, "scans[].images_on_the_way",
       "images taken while driving there (gaze.on_the_way_m)"},
      {kMetrics, "scans[].map_sigma_m",
       "how far off its place the robot believes what it maps to be, RMS"},
      {kMetrics, "scans[].pose_error_at_scan_m", "pose_error_m before later loops corrected it"},
      {kMetrics, "scans[].view", "pose of the sensor, as the robot believes it"},
      {kMetrics, "map.precision",
       "of the map at the end: of occupied cells, share that is occupied within the tolerance; "
       "null "
       "before the first scan"},
      {kMetrics, "map.recall",
       "of the map at the end: of observable surface cells, share with an occupied cell within the "
       "tolerance; null before the first scan"},
      {kMetrics, "map.tolerance_cells", "how far an occupied cell may be off the true surface"},
      {kMetrics, "observability",
       "transmission of an unobserved cell that the gain assumes at the end; null: none"},
      {kMetrics, "observability_per_slice",
       "the same as learnt on the run, from the lowest layer of cells up"},
      {kMetrics, "localisation.map_sigma_m", "greatest map_sigma_m of the scans"},
      {kMetrics, "localisation.tolerance_m",
       "how far off it may believe its map to be, from localisation.tolerance_cells"},
      {kMetrics, "localisation.trusted", "map_sigma_m is within it"},
      {kMetrics, "localisation.registered_scans", "scans whose registration was taken"},
      {kMetrics, "localisation.pose_sigma_m", "greatest pose_sigma_m of the scans"},
      {kMetrics, "localisation.loops", "times the robot was found to be back at a place"},
      {kMetrics, "localisation.loops_refused",
       "loops that were found, and that no other confirmed or that the others contradict"},
      {kMetrics, "localisation.corrections",
       "times loops have moved the poses, and the map was made anew"},
      {kMetrics, "localisation.contradicted_share",
       "of the planar scanner's returns, share whose beams go through walls of the map: walls "
       "drawn "
       "twice; null: the task closes no loops"},
      {kMetrics, "localisation.map_in_doubt",
       "map_sigma_m, pose_sigma_m or contradicted_share is too large, or too few of the scans were "
       "registered"},
      {kMetrics, "localisation.doubt", "why, in words; null: not in doubt, or not trusted"},
      {kMetrics, "region", "box of the map, world: min_m, max_m"},
      {kMetrics, "candidates", "views of the last decision"},
  };
  for (const auto& [name, text] : kScanTexts) {
    texts.push_back({kSteps, name.substr(kFront.size()), text});
    texts.push_back({kMetrics, name, text});
  }
  const RecordTexts of_budget{
      {kMetrics, "energy_j",
       "used by the robot, as its robot.yaml has it: power at rest and of the motors"},
      {kMetrics, "scans[].energy_j", "used up to here"},
      {kMetrics, "budget.time_s", "limit; null: none"},
      {kMetrics, "budget.energy_j", "limit; null: none"},
      {kMetrics, "budget.return_to_start", "whether the robot was to come back"},
      {kMetrics, "budget.kept", "whether it kept within all of that"},
      {kMetrics, "budget.returned", "whether it came back to the start"},
      {kMetrics, "budget.from_start_m",
       "distance from the start at the end, as the robot believes"},
  };
  texts.insert(texts.end(), of_budget.begin(), of_budget.end());
  for (const auto& [name, text] : kProgressTexts) texts.push_back({kMetrics, name, text});
  return joined(std::move(texts), plan_records());
}

}  // namespace vantage
