/// Writes the run folder of an episode while it runs: what the recorders of all tasks share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/log/candidate_table.hpp"
#include "vantage/runtime/log/run_log.hpp"

namespace vantage {

class EpisodeRecorder {
 public:
  EpisodeRecorder(const EpisodeRecorder&) = delete;
  EpisodeRecorder& operator=(const EpisodeRecorder&) = delete;
  virtual ~EpisodeRecorder() = default;

  /// Puts the growing files under their final names.
  virtual void commit();
  void finish_video() { log_.finish_video(); }

  [[nodiscard]] std::uint64_t state_hash() const { return log_.state_hash(); }
  [[nodiscard]] double path_length_m() const { return log_.path_length_m(); }
  /// Of the faults that are on, how often each has struck.
  [[nodiscard]] std::vector<std::pair<std::string, std::int64_t>> faults() const;

 protected:
  /// Hooks itself to the world's ticks. With `lean` options neither states nor images are kept.
  /// @param steps_header of steps.csv, without line end
  /// @param extent progress that is the whole episode
  /// @param candidate_columns of candidates.csv, see CandidateTable; empty: there is none
  /// @throws OutputError, RendererError
  EpisodeRecorder(const EpisodeRun& run, RecordedRobot robot, const std::string& steps_header,
                  double extent, std::string_view candidate_columns = {});

  /// Adds a row to steps.csv, tells the progress and keeps a still of the video.
  /// @param number of the step, the first is 1
  void step(const std::string& row, std::size_t number, double progress, const std::string& text);

  /// Adds the rows of a decision to candidates.csv.
  void add_candidates(std::span<const CandidateRow> rows, std::size_t chosen);
  [[nodiscard]] bool keeps_candidates() const { return candidates_.has_value(); }

  [[nodiscard]] bool lean() const { return lean_; }
  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] RunLog& log() { return log_; }
  [[nodiscard]] const RunLog& log() const { return log_; }

 private:
  std::filesystem::path directory_;
  std::string steps_header_;
  std::function<void(std::string_view, std::string_view)> on_step_;  ///< of the spectator
  bool lean_;
  RunLog log_;
  GrowingFile steps_;
  std::optional<CandidateTable> candidates_;
  Progress progress_;
};

}  // namespace vantage
