#include "vantage/runtime/recorder.hpp"

#include <utility>

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
}

}  // namespace vantage
