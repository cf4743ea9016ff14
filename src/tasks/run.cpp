#include "vantage/tasks/run.hpp"

#include <nlohmann/json.hpp>

#include "vantage/core/log.hpp"
#include "vantage/report/report.hpp"

namespace vantage {

RunOutcome run(const ResolvedEpisode& resolved, const RunOptions& options) {
  const RunOutcome outcome = std::visit(
      [&](const auto& task) {
        const RunRequest request{.setup = resolved.setup,
                                 .task = std::string(task.metrics_task()),
                                 .method = task.method_name(),
                                 .config = episode_yaml(resolved),
                                 .inputs = task.inputs(),
                                 .options = options};
        return task.run(request);
      },
      resolved.task);
  if (!options.lean) write_report(outcome.directory, report_sections(resolved.task));
  log_to_file({});
  return outcome;
}

std::string outcome_text(const ResolvedEpisode& resolved, const RunOutcome& outcome) {
  const auto metrics = nlohmann::ordered_json::parse(outcome.metrics);
  return std::visit([&](const auto& task) { return task.outcome(metrics); }, resolved.task);
}

}  // namespace vantage
