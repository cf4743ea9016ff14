/// Runs the parts of a mapping task and writes what they come to.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "vantage/core/log.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/tasks/mapping/mapping_metrics.hpp"
#include "vantage/tasks/mapping/mapping_recorder.hpp"
#include "vantage/tasks/mapping/mobile_ground_truth.hpp"

namespace vantage {

/// What the recorder follows of a simulated mobile robot.
template <class Robot>
RecordedRobot recorded(Robot& robot) {
  return {robot.world(), [&robot] { return to_se3(robot.ground_truth().T_world_base()); },
          [&robot] { return to_se3(robot.estimated_base()); }, &robot.faults()};
}

/// That the run was asked for; null: none, the task chooses itself.
inline const OutsideChoice* outside_choice(const EpisodeRun& run) {
  const auto& outside = run.request().options.outside;
  return outside ? &*outside : nullptr;
}

template <class Robot, class Belief, class Parts>
RunOutcome run_mapping(EpisodeRun& run, const MappingOptions& options, Robot& robot,
                       MappingRecorder& recorder, const GroundTruthMapEvaluator& evaluator,
                       const Belief& belief, Parts& parts) {
  std::string remark;
  Ending ending = ending_of([&] {
    std::string reason = run_episode(parts);
    parts.end();
    remark = parts.distrust();
    if (!remark.empty() && !options.localisation.accept_drift) throw EpisodeFailed(remark);
    return reason;
  });
  const LocalisationSummary localisation = parts.localisation();
  if (!localisation.doubt.empty()) {
    if (!remark.empty()) remark += "; ";
    remark += localisation.doubt;
  }
  if (ending.status == EpisodeStatus::completed && !remark.empty()) {
    log_warning(remark);
    ending.reason += "; " + remark;
  }
  const RunTotals totals{robot.time_s(), robot.ground_truth().collisions()};
  const auto add_metrics = [&](nlohmann::ordered_json& metrics) {
    add_mapping_metrics(
        options,
        {belief.grid(), belief.hazard(), evaluator, parts.scans(), parts.views(), localisation},
        metrics);
    parts.budget().add_metrics(metrics);
  };
  return run.finish(ending, totals, recorder, add_metrics, [&] {
    if (!run.request().options.lean) recorder.write_map(belief.grid(), belief.cloud());
  });
}

/// What a window shows of a task that maps.
WindowContent mapping_window(const MappingOptions& options);
TaskExtent mapping_extent(const MappingOptions& options);
ReportSections mapping_report();

}  // namespace vantage
