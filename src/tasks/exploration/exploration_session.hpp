/// An exploration with all its parts, ready to run.
#pragma once

#include "vantage/tasks/exploration/exploration_map_evaluator.hpp"
#include "vantage/tasks/exploration/exploration_parts.hpp"
#include "vantage/tasks/exploration/simulated_exploration_robot.hpp"
#include "vantage/tasks/mapping/mapping_run.hpp"

namespace vantage {

/// @tparam Parts ExplorationParts, or what is derived from it to watch an episode
template <class Parts = ExplorationParts>
struct ExplorationSession {
  /// @throws ConfigError, InputError if the episode cannot begin; ConfigError if the run folder
  /// holds a run already; OutputError, RendererError
  ExplorationSession(const RunRequest& request, const Exploration& options)
      : task(options), robot(request.setup, task), run(request) {
    run.begin();  // now that every part is there
  }

  RunOutcome run_to_end() {
    return run_mapping(run, task, robot, recorder, evaluator, belief, parts);
  }

  const Exploration task;
  SimulatedExplorationRobot robot;
  EpisodeRun run;
  MappingRecorder recorder{run, recorded(robot), exploration_predictors(task), task.scans};
  const MobileGroundTruth truth = robot.ground_truth();
  const EpisodeOptions& episode = run.request().setup.options;
  const ExplorationMapEvaluator evaluator{task, episode.threads, truth, robot.view_field(),
                                          robot.T_base_sweep()};
  ExplorationBelief belief{episode, task};
  Parts parts{MappingContext{episode, robot, evaluator, recorder, outside_choice(run)}, task, robot,
              belief};
};

}  // namespace vantage
