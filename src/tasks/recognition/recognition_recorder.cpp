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

std::string change_columns(const Sighting& sighting) {
  if (!sighting.change) return {};
  return fmt::format(",{},{}", sighting.change->probability, to_string(sighting.change->verdict));
}

std::string belief_text(const Sighting& sighting) {
  if (!sighting.change) {
    return fmt::format("{} with probability {:.2f}", sighting.estimate, sighting.map_probability);
  }
  return fmt::format("changed with probability {:.2f}", sighting.change->probability);
}

std::string steps_row(const Sighting& sighting, std::size_t index) {
  const ViewReport& report = sighting.report;
  const FlightResult flight = sighting.flight.value_or(FlightResult{});
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}\n", sighting.time_s, index,
      sighting.bearing_id, report.view_rad, fmt::join(report.features, " "), report.entropy_bits,
      sighting.estimate, sighting.map_probability, sighting.gain_bits, report.feature_time_s,
      report.selection_time_s, report.view_time_s, sighting.flight ? to_string(flight.status) : "",
      flight.duration_s, flight.path_length_m, flight.energy_J, sighting.object_px,
      sighting.position_error_m, sighting.angle_error_rad, sighting.bin_error, sighting.collisions,
      change_columns(sighting));
}

}  // namespace

RecognitionRecorder::RecognitionRecorder(const ResolvedEpisode& resolved, FlightRig& rig,
                                         std::filesystem::path directory, bool with_video,
                                         bool lean, Spectator spectator)
    : directory_(std::move(directory)),
      most_views_(resolved.episode.recognition.decision.most_views),
      lean_(lean),
      log_({rig.world(), [&rig] { return rig.true_body(); },
            [&rig] { return rig.estimated_body(); }},
           resolved.episode.recording, directory_, with_video, lean, std::move(spectator)),
      steps_(directory_ / "steps.csv"),
      progress_(resolved.name, most_views_) {
  steps_.write(kStepsHeader);
  if (resolved.episode.detects_change()) steps_.write(kChangeHeader);
  steps_.write("\n");
  if (!lean_) make_writable_directory(directory_ / "views");
}

void RecognitionRecorder::set_panel(std::function<RecognitionPanelInput()> panel) {
  log_.set_panel(
      [panel = std::move(panel)](cv::Size size) { return draw_recognition_panel(panel(), size); });
}

void RecognitionRecorder::sighting(const Sighting& sighting, std::size_t index,
                                   const CameraImages& picture,
                                   const std::optional<ObjectView>& cut) {
  steps_.write(steps_row(sighting, index));
  progress_.update(static_cast<double>(index + 1),
                   fmt::format("view {} of at most {}: {}, {:.1f} s simulated", index + 1,
                               most_views_, belief_text(sighting), sighting.time_s));
  log_.keep_still(index);
  if (lean_) return;
  const cv::Mat drawn = outlined(picture, cut ? &*cut : nullptr);
  write_file_with(directory_ / "views" / fmt::format("view_{:02}.png", index),
                  [&](const auto& part) { return cv::imwrite(part.string(), drawn); });
}

void RecognitionRecorder::commit() {
  log_.commit();
  steps_.commit();
}

}  // namespace vantage
