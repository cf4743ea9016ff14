#include "vantage/tasks/run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <concepts>
#include <memory>

#include "vantage/core/log.hpp"
#include "vantage/core/names.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/report/report.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/tasks/episode_planner.hpp"

namespace vantage {

namespace {

/// Whether a task is of those that take the next of some views, and may be told which.
template <class Task>
constexpr bool kChoosesViews = std::derived_from<Task, MappingOptions>;

/// @throws ConfigError if nobody can choose in place of the task
template <class Task>
void require_choice(const Task& task, const OutsideChoice& outside) {
  if constexpr (kChoosesViews<Task>) {
    if (outside.blind || !knows_truth(task.choice)) return;
    throw ConfigError(fmt::format("choice: {} asks ground truth, which {} must not learn of",
                                  strategy_name_of(task.choice), outside.name));
  } else {
    throw ConfigError(fmt::format("task: {} does not choose among views; {} has nothing to choose",
                                  Task::name, outside.name));
  }
}

}  // namespace

RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& given) {
  RunOptions options = given;
  const auto planner = options.outside ? nullptr : external_planner(resolved);
  if (planner) options.outside = planner->as_outside_choice(method_name(resolved.task));
  const RunOutcome outcome = std::visit(
      [&](const auto& task) {
        if (options.outside) require_choice(task, *options.outside);
        const RunRequest request{
            .setup = resolved.setup,
            .task = std::string(task.metrics_task()),
            .method = options.outside ? options.outside->name : task.method_name(),
            .config = episode_yaml(resolved),
            .inputs = input_hashes(resolved.setup, task.inputs()),
            .options = options};
        return task.run(request);
      },
      resolved.task);
  if (!options.lean) write_report(outcome.directory, report_sections(resolved.task));
  log_to_file({});
  release_run_directory(outcome.directory);
  if (outcome.video_error) std::rethrow_exception(outcome.video_error);
  return outcome;
}

std::string outcome_text(const ResolvedEpisode& resolved, const RunOutcome& outcome) {
  const auto metrics = nlohmann::ordered_json::parse(outcome.metrics);
  return std::visit([&](const auto& task) { return task.outcome(metrics); }, resolved.task);
}

}  // namespace vantage
