#include "vantage/tasks/object_flight/object_flight_recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgcodecs.hpp>

#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/runtime/scene_file.hpp"

namespace vantage {
namespace {

constexpr std::string_view kStepsHeader =
    "time_s,view,chosen_view,view_rad,features,entropy_bits,estimate,map_probability,gain_bits,"
    "feature_time_s,selection_time_s,view_time_s,flight,flight_time_s,path_length_m,energy_j,"
    "object_px,position_error_m,angle_error_rad,bin_error,collisions";

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

std::string steps_row(const ObservationRecord& record, std::size_t index) {
  const ViewReport& report = record.report;
  const FlightResult flight = record.flight.value_or(FlightResult{});
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}", record.time_s, index,
      record.bearing_id, report.view_rad, fmt::join(report.features, " "), report.entropy_bits,
      record.estimate, record.map_probability, record.gain_bits, report.feature_time_s,
      report.selection_time_s, report.view_time_s, record.flight ? to_string(flight.status) : "",
      flight.duration_s, flight.path_length_m, flight.energy_J, record.object_px,
      record.position_error_m, record.angle_error_rad, record.bin_error, record.collisions,
      change_columns(record));
}

}  // namespace

ObjectFlightRecorder::ObjectFlightRecorder(const EpisodeRun& run, RecordedRobot robot,
                                           int max_views, bool of_change)
    : EpisodeRecorder(run, robot, std::string(kStepsHeader).append(of_change ? kChangeHeader : ""),
                      max_views),
      world_(robot.world),
      max_views_(max_views) {
  if (lean()) return;
  make_writable_directory(directory() / "views");
  event_log_.emplace(directory());
}

void ObjectFlightRecorder::tell(EpisodeEvent event) {
  log().tell(event);
  if (event_log_) event_log_->add(event);
}

void ObjectFlightRecorder::decision(Decision decision, PlannedFlight way) {
  if (!event_log_ && !log().watched()) return;
  tell({0, std::move(decision)});
  tell({0, std::move(way)});
}

void ObjectFlightRecorder::commit() {
  EpisodeRecorder::commit();
  if (lean()) return;
  event_log_->commit();
  write_scene_file(world_, directory());
}

void ObjectFlightRecorder::set_panel(std::function<RecognitionPanelInput()> panel) {
  log().set_panel(
      [panel = std::move(panel)](cv::Size size) { return draw_recognition_panel(panel(), size); });
}

void ObjectFlightRecorder::observation(const ObservationRecord& record, std::size_t index,
                                       const CameraImages& image,
                                       const std::optional<ObjectView>& cut) {
  step(steps_row(record, index), index, static_cast<double>(index + 1),
       fmt::format("view {} of at most {}: {}, {:.1f} s simulated", index + 1, max_views_,
                   belief_text(record), record.time_s));
  if (lean()) return;
  const cv::Mat drawn = outlined(image, cut ? &*cut : nullptr);
  write_file_with(directory() / "views" / fmt::format("view_{:02}.png", index),
                  [&](const auto& part) { return cv::imwrite(part.string(), drawn); });
}

}  // namespace vantage
