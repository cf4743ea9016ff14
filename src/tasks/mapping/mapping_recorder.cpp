#include "vantage/tasks/mapping/mapping_recorder.hpp"

#include <fmt/format.h>

#include <utility>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {
namespace {

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
         "pose_error_before_registration_m,yaw_error_rad,registered,collisions,precision,recall";
}

std::string steps_row(const ScanRecord& scan, std::size_t number) {
  std::string gains;
  for (const auto& [name, cells] : scan.predicted_cells) gains += fmt::format("{},", cells);
  return fmt::format("{},{},{},{},{},{},{},{},{}{},{},{},{},{},{},{},{},{},{},{},{}", scan.time_s,
                     number, scan.chosen_view, scan.fallback, pose_columns(scan.T_world_sensor),
                     scan.unobserved_cells, scan.observable_unobserved_cells, scan.actual_new_cells,
                     gains, scan.path_length_m, scan.leg_length_m, scan.plan_time_s,
                     scan.map_time_s, scan.scan_time_s, scan.pose_error_m,
                     scan.pose_error_before_registration_m, scan.yaw_error_rad, scan.registered,
                     scan.collisions, scan.precision, scan.recall);
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

void MappingRecorder::route(const std::vector<Pose2>& waypoints) {
  if (!logs_events()) return;
  PlannedRoute route;
  for (const Pose2& waypoint : waypoints) route.path_m.emplace_back(waypoint.x_m, waypoint.y_m);
  tell({0, std::move(route)});
}

void MappingRecorder::scan(const ScanRecord& record, std::size_t number,
                           const OccupancyGrid& grid) {
  if (!lean()) add_occupied_voxels(grid, number - 1);
  if (logs_events()) tell({0, map_change(known_, grid)});
  step(steps_row(record, number), number, static_cast<double>(number),
       fmt::format("scan {} of {}: {} observable cells left, {:.1f} s simulated", number,
                   planned_scans_, record.observable_unobserved_cells, record.time_s));
}

void MappingRecorder::add_occupied_voxels(const OccupancyGrid& grid, std::size_t step) {
  was_occupied_.resize(grid.size(), 0);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (was_occupied_[cell] != 0 || grid.state(cell) != CellState::occupied) continue;
    was_occupied_[cell] = 1;
    add_voxel(grid, cell, step, kVoxelOccupied);
  }
}

void MappingRecorder::add_voxel(const OccupancyGrid& grid, std::size_t cell, std::size_t step,
                                std::uint8_t kind) {
  const Eigen::Vector3f p = grid.frame.centre(grid.frame.cell(cell)).cast<float>();
  voxels_.push_back({p.x(), p.y(), p.z(), static_cast<std::uint16_t>(step), kind});
}

void MappingRecorder::commit() {
  EpisodeRecorder::commit();
  if (event_log_) event_log_->commit();
}

void MappingRecorder::write_map(const OccupancyGrid& grid, const PointCloud& cloud) {
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) == CellState::unobserved) add_voxel(grid, cell, 0, kVoxelUnobserved);
  }
  write_voxels(directory() / "voxels.bin", {grid.frame.cell_size_m, grid.frame.box(), voxels_});
  write_ply(directory() / "cloud.ply", cloud);
  if (grid.count(CellState::unobserved) < grid.size()) {
    write_octomap(grid, directory() / "map.bt");
    write_octomap(grid, directory() / "map.ot");
  }
}

}  // namespace vantage
