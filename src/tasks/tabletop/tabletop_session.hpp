/// A table-top episode with all its parts, ready to run.
#pragma once

#include "vantage/tasks/mapping/mapping_run.hpp"
#include "vantage/tasks/tabletop/simulated_tabletop_robot.hpp"
#include "vantage/tasks/tabletop/tabletop_parts.hpp"

namespace vantage {

/// Observable is what a noise-free scan sees from at least one view of the ring.
GroundTruthMapEvaluator tabletop_evaluator(const Tabletop& task, int threads,
                                           const MobileGroundTruth& truth,
                                           const FieldOfView& view_field);

/// @tparam Parts TabletopParts, or what is derived from it to watch an episode
template <class Parts = TabletopParts>
struct TabletopSession {
  /// @throws ConfigError, InputError if the episode cannot begin; ConfigError if the run folder
  /// holds a run already; OutputError, RendererError
  TabletopSession(const RunRequest& request, const Tabletop& options)
      : task(options), robot(request.setup, task), run(request) {
    run.begin();  // now that every part is there
  }

  RunOutcome run_to_end() {
    return run_mapping(run, task, robot, recorder, evaluator, belief, parts);
  }

  const Tabletop task;
  SimulatedTabletopRobot robot;
  EpisodeRun run;
  MappingRecorder recorder{run, recorded(robot), recorded_predictors(task, cell_predictors()),
                           task.scans};
  const MobileGroundTruth truth = robot.ground_truth();
  const EpisodeOptions& episode = run.request().setup.options;
  const GroundTruthMapEvaluator evaluator =
      tabletop_evaluator(task, episode.threads, truth, robot.view_field());
  TabletopBelief belief{episode, task};
  Parts parts{MappingContext{episode, robot, evaluator, recorder, outside_choice(run)}, task, robot,
              belief};
};

}  // namespace vantage
