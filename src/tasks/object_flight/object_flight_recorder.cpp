#include "vantage/tasks/object_flight/object_flight_recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/scene_file.hpp"

namespace vantage {
namespace {

constexpr std::string_view kStepsHeader =
    "time_s,view,chosen_view,x_m,y_m,z_m,yaw_rad,pitch_rad,view_rad,features,entropy_bits,estimate,"
    "map_probability,gain_bits,"
    "feature_time_s,selection_time_s,view_time_s,flight,flight_time_s,path_length_m,leg_length_m,"
    "energy_j,"
    "object_px,target,expected_visible,seen_share,position_error_m,angle_error_rad,bin_error,"
    "collisions";

constexpr std::string_view kChangeHeader = ",change_probability,decision";

std::string change_columns(const ObservationRecord& record) {
  if (!record.change) return {};
  return fmt::format(",{},{}", record.change->probability, to_string(record.change->verdict));
}

std::string belief_text(const ObservationRecord& record) {
  if (!record.change) {
    return fmt::format("{} with probability {:.2f}", record.estimate, record.map_probability);
  }
  return fmt::format("changed with probability {:.2f}", record.change->probability);
}

/// x the way the camera looks, z up.
Pose forward_pose(const Pose& T_world_camera) {
  Pose T_world_view = T_world_camera;
  T_world_view.linear() << T_world_camera.linear().col(2), -T_world_camera.linear().col(0),
      -T_world_camera.linear().col(1);
  return T_world_view;
}

CandidateRow candidate_row(const BearingOption& option, const ObjectViewScore& score,
                           const Orbit& orbit) {
  Pose T_world_view = option.T_world_way.back();
  T_world_view.rotate(
      Eigen::AngleAxisd(std::atan2(orbit.height_m, orbit.radius_m), Eigen::Vector3d::UnitY()));
  const ObjectViewAction& action = option.action;
  const ViewOption view{T_world_view, score.gain.bits, "bits", {}, action.path_m};
  return {option.id, fmt::format("{},{},{},{},{},{}", view_columns(view), action.time_s,
                                 action.energy_j, score.cost, action.visible, option.target + 1)};
}

std::string steps_row(const ObservationRecord& record, std::size_t number) {
  const ViewReport& report = record.report;
  const FlightResult flight = record.flight.value_or(FlightResult{});
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}",
      record.time_s, number, record.bearing_id, pose_columns(forward_pose(record.T_world_camera)),
      report.view_rad, fmt::join(report.features, " "), report.entropy_bits,
      csv_field(record.estimate), record.map_probability, record.gain_bits, report.feature_time_s,
      report.selection_time_s, report.view_time_s, record.flight ? to_string(flight.status) : "",
      flight.duration_s, record.path_length_m, record.leg_length_m, flight.energy_J,
      record.object_px, record.target + 1, record.expected_visible, record.seen_share,
      record.position_error_m, record.angle_error_rad, record.bin_error, record.collisions,
      change_columns(record));
}

}  // namespace

ObjectFlightRecorder::ObjectFlightRecorder(const EpisodeRun& run, const RecordedRobot& robot,
                                           int max_views, bool of_change)
    : EpisodeRecorder(run, robot, std::string(kStepsHeader).append(of_change ? kChangeHeader : ""),
                      max_views,
                      std::string(kViewColumns) + ",flight_time_s,energy_j,cost,visible,target"),
      world_(robot.world),
      max_views_(max_views) {
  if (!lean()) event_log_.emplace(directory());
}

void ObjectFlightRecorder::tell(EpisodeEvent event) {
  log().tell(event);
  if (event_log_) event_log_->add(event);
}

void ObjectFlightRecorder::show(Decision decision, PlannedFlight way) {
  if (!event_log_ && !log().watched()) return;
  tell({0, std::move(decision)});
  tell({0, std::move(way)});
}

void ObjectFlightRecorder::map(const OccupancyGrid& grid) {
  if (!event_log_ && !log().watched()) return;
  tell({0, map_log_.change(grid, views_++)});
}

void ObjectFlightRecorder::commit() {
  EpisodeRecorder::commit();
  if (lean()) return;
  event_log_->commit();
  map_log_.commit(directory());
  write_scene_file(world_, directory());
}

void ObjectFlightRecorder::set_panel(std::function<RecognitionPanelInput()> panel) {
  log().set_panel(
      [panel = std::move(panel)](cv::Size size) { return draw_recognition_panel(panel(), size); });
}

void ObjectFlightRecorder::observation(const ObservationRecord& record, std::size_t number,
                                       const CameraImages& image,
                                       const std::optional<ObjectView>& cut) {
  step(steps_row(record, number), number, static_cast<double>(number),
       fmt::format("view {} of at most {}: {}, {:.1f} s simulated", number, max_views_,
                   belief_text(record), record.time_s));
  if (lean()) return;
  const cv::Mat drawn = outlined(image, cut ? &*cut : nullptr);
  make_writable_directory(directory() / "views");
  write_file_with(directory() / "views" / fmt::format("view_{:02}.png", number),
                  [&](const auto& part) { return cv::imwrite(part.string(), drawn); });
}

void ObjectFlightRecorder::decision(const std::vector<BearingOption>& options,
                                    const ObjectViewDecision& decision, const Orbit& orbit) {
  if (!keeps_candidates()) return;
  std::vector<CandidateRow> rows;
  for (std::size_t i = 0; i < options.size(); ++i) {
    rows.push_back(candidate_row(options[i], decision.scores.at(i), orbit));
  }
  add_candidates(rows, decision.action);
}

}  // namespace vantage
