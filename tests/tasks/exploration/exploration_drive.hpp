/// All that the parts of an exploration are made of, with a robot of the test's own.
#pragma once

#include <filesystem>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/run_request.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage::support {

/// A lean run into `directory`. `episode` must outlive it.
inline RunRequest exploration_request(const ResolvedEpisode& episode,
                                      const std::filesystem::path& directory) {
  return mapping_request(episode, {directory, true, false, {}, true}, "exploration");
}

template <class Robot>
struct ExplorationDrive {
  /// @param load the episode; it is given a folder
  explicit ExplorationDrive(auto&& load) : episode(load(folder.path())) {}
  [[nodiscard]] MappingContext context() { return {options, robot, evaluator, recorder, nullptr}; }

  TemporaryDirectory folder;
  const ResolvedEpisode episode;
  const EpisodeOptions& options = episode.setup.options;
  Exploration task = std::get<Exploration>(episode.task);
  Robot robot{episode.setup, task};
  const RunRequest request = exploration_request(episode, folder.path() / "run");
  EpisodeRun run{request};
  MappingRecorder recorder{run, recorded(robot), exploration_predictors(task), task.scans};
  const MobileGroundTruth truth = robot.ground_truth();
  const ExplorationMapEvaluator evaluator{task, options.threads, truth, robot.view_field(),
                                          robot.T_base_sweep()};
  ExplorationBelief belief{options, task};
};

}  // namespace vantage::support
