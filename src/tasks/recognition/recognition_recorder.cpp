#include "vantage/tasks/recognition/recognition_recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgcodecs.hpp>

#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

constexpr std::string_view kStepsHeader =
    "time_s,view,chosen_view,view_rad,features,entropy_bits,estimate,map_probability,gain_bits,"
    "feature_time_s,selection_time_s,view_time_s,flight,flight_time_s,path_length_m,energy_j,"
    "object_px,position_error_m,angle_error_rad,bin_error,collisions";

constexpr std::string_view kChangeHeader = ",change_probability,decision";

std::string change_columns(const ObservationRecord& observation_record) {
  if (!observation_record.change) return {};
  return fmt::format(",{},{}", observation_record.change->probability,
                     to_string(observation_record.change->verdict));
}

std::string belief_text(const ObservationRecord& observation_record) {
  if (!observation_record.change) {
    return fmt::format("{} with probability {:.2f}", observation_record.estimate,
                       observation_record.map_probability);
  }
  return fmt::format("changed with probability {:.2f}", observation_record.change->probability);
}

std::string steps_row(const ObservationRecord& observation_record, std::size_t index) {
  const ViewReport& report = observation_record.report;
  const FlightResult flight = observation_record.flight.value_or(FlightResult{});
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}\n",
                     observation_record.time_s, index, observation_record.bearing_id,
                     report.view_rad, fmt::join(report.features, " "), report.entropy_bits,
                     observation_record.estimate, observation_record.map_probability,
                     observation_record.gain_bits, report.feature_time_s, report.selection_time_s,
                     report.view_time_s, observation_record.flight ? to_string(flight.status) : "",
                     flight.duration_s, flight.path_length_m, flight.energy_J,
                     observation_record.object_px, observation_record.position_error_m,
                     observation_record.angle_error_rad, observation_record.bin_error,
                     observation_record.collisions, change_columns(observation_record));
}

}  // namespace

RecognitionRecorder::RecognitionRecorder(const ResolvedEpisode& resolved,
                                         OrbitRobotInterface& robot,
                                         std::filesystem::path directory, bool with_video,
                                         bool lean, Spectator spectator)
    : directory_(std::move(directory)),
      max_views_(resolved.episode.recognition.decision.max_views),
      lean_(lean),
      log_({robot.world(), [&robot] { return robot.true_body(); },
            [&robot] { return robot.estimated_body(); }},
           resolved.episode.recording, directory_, with_video, lean, std::move(spectator)),
      steps_(directory_ / "steps.csv"),
      progress_(resolved.name, max_views_) {
  steps_.write(kStepsHeader);
  if (resolved.episode.detects_change()) steps_.write(kChangeHeader);
  steps_.write("\n");
  if (!lean_) make_writable_directory(directory_ / "views");
}

void RecognitionRecorder::set_panel(std::function<RecognitionPanelInput()> panel) {
  log_.set_panel(
      [panel = std::move(panel)](cv::Size size) { return draw_recognition_panel(panel(), size); });
}

void RecognitionRecorder::observation_record(const ObservationRecord& observation_record,
                                             std::size_t index, const CameraImages& image,
                                             const std::optional<ObjectView>& cut) {
  steps_.write(steps_row(observation_record, index));
  progress_.update(
      static_cast<double>(index + 1),
      fmt::format("view {} of at most {}: {}, {:.1f} s simulated", index + 1, max_views_,
                  belief_text(observation_record), observation_record.time_s));
  log_.save_still(index);
  if (lean_) return;
  const cv::Mat drawn = outlined(image, cut ? &*cut : nullptr);
  write_file_with(directory_ / "views" / fmt::format("view_{:02}.png", index),
                  [&](const auto& part) { return cv::imwrite(part.string(), drawn); });
}

void RecognitionRecorder::commit() {
  log_.commit();
  steps_.commit();
}

}  // namespace vantage
