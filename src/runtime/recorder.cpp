#include "vantage/runtime/recorder.hpp"

#include <utility>

#include "vantage/sim/faults/robot_faults.hpp"

namespace vantage {

EpisodeRecorder::EpisodeRecorder(const EpisodeRun& run, RecordedRobot robot,
                                 const std::string& steps_header, double extent,
                                 std::string_view candidate_columns)
    : directory_(run.directory()),
      steps_header_(steps_header),
      on_step_(run.request().options.spectator.on_step),
      lean_(run.request().options.lean),
      log_(std::move(robot), run.request().setup.options.recording, directory_,
           run.request().options.video, lean_, run.request().options.spectator),
      steps_(directory_ / "steps.csv"),
      progress_(run.request().setup.name, extent) {
  if (!lean_ && !candidate_columns.empty()) candidates_.emplace(directory_, candidate_columns);
  steps_.write(steps_header);
  steps_.write("\n");
}

void EpisodeRecorder::step(const std::string& row, std::size_t number, double progress,
                           const std::string& text) {
  steps_.write(row);
  steps_.write("\n");
  progress_.update(progress, text);
  log_.save_still(number);
  if (on_step_) on_step_(steps_header_, row);
}

void EpisodeRecorder::add_candidates(std::span<const CandidateRow> rows, std::size_t chosen) {
  if (candidates_) candidates_->add_decision(rows, chosen);
}

void EpisodeRecorder::commit() {
  log_.commit();
  steps_.commit();
  if (candidates_) candidates_->commit();
  const RobotFaults* faults = log_.faults();
  if (faults == nullptr || !any_fault(faults->options())) return;
  write_file(directory_ / "faults.csv", faults->record().csv());
}

std::vector<std::pair<std::string, std::int64_t>> EpisodeRecorder::faults() const {
  std::vector<std::pair<std::string, std::int64_t>> struck;
  const RobotFaults* faults = log_.faults();
  for (std::size_t i = 0; faults != nullptr && i < kFaults; ++i) {
    const auto fault = static_cast<Fault>(i);
    if (amount_of(faults->options(), fault) == 0.0) continue;
    struck.emplace_back(name_of(fault), faults->record().struck(fault));
  }
  return struck;
}

}  // namespace vantage
