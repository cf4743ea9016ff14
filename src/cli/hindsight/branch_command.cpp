#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "vantage/cli/hindsight/hindsight_commands.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/hindsight/branching.hpp"
#include "vantage/report/report.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct BranchArguments {
  fs::path directory;
  std::vector<long long> scans;
  std::optional<int> view;
  std::optional<int> then;
  bool all = false;
  bool json = false;
  fs::path out;
  bool overwrite = false;
};

/// The decisions that are asked for; without any, all that were taken.
std::vector<std::size_t> scans_of(const BranchArguments& arguments, const RecordedRun& run) {
  std::vector<std::size_t> scans;
  for (const long long scan : arguments.scans) {
    require_decision(run, scan);
    scans.push_back(static_cast<std::size_t>(scan));
  }
  if (scans.empty()) require_decision(run, 1);
  for (std::size_t k = 1; arguments.scans.empty() && k < run.scans.size(); ++k) scans.push_back(k);
  std::ranges::sort(scans);
  scans.erase(std::unique(scans.begin(), scans.end()), scans.end());
  return scans;
}

ExitCode print_branches(const BranchArguments& arguments, const RecordedRun& run) {
  const BranchRequest request{.scans = scans_of(arguments, run),
                              .all = arguments.all,
                              .view = arguments.view,
                              .then = static_cast<std::size_t>(arguments.then.value_or(0))};
  const auto decisions = branch_views(run, request);
  if (arguments.all) {
    keep_branches(run.directory, decisions);
    if (fs::exists(run.directory / "report.html")) {
      write_report(run.directory, report_sections(run.episode.task));
    }
  }
  nlohmann::ordered_json found = nlohmann::ordered_json::array();
  for (const BranchedDecision& decision : decisions) {
    found.push_back(branched_json(decision));
    if (!arguments.json) fmt::print("{}", branched_text(decision));
  }
  if (arguments.json) {
    fmt::print("{}", json_text({{"directory", run.directory.string()}, {"decisions", found}}));
  }
  return ExitCode::done;
}

/// For the manifest.
std::vector<std::string> command_of(const BranchArguments& arguments) {
  std::vector<std::string> command{"vantage", "branch", arguments.directory.string(), "--scan",
                                   std::to_string(arguments.scans.front())};
  if (arguments.view) command.insert(command.end(), {"--view", std::to_string(*arguments.view)});
  return command;
}

/// One decision taken otherwise, or as it was, and the episode to its end.
ExitCode run_to_the_end(const BranchArguments& arguments, const RecordedRun& run) {
  const std::size_t scan = scans_of(arguments, run).front();
  std::optional<ScratchFolder> scratch;
  RunOptions options{.directory = arguments.out,
                     .overwrite = arguments.overwrite,
                     .command = command_of(arguments)};
  if (options.directory.empty()) {
    options.directory = scratch.emplace().path() / "branch";
    options.lean = true;
  }
  const RunOutcome outcome = run_branch(run, scan, arguments.view, options);
  const auto metrics = nlohmann::ordered_json::parse(outcome.metrics);
  const auto hash = metrics["state_hash"].get<std::string>();
  const bool same = hash == run.state_hash;
  if (arguments.json) {
    fmt::print("{}", json_text({{"directory", run.directory.string()},
                                {"scan", scan},
                                {"view", arguments.view ? nlohmann::ordered_json(*arguments.view)
                                                        : nlohmann::ordered_json()},
                                {"recorded_view", run.scans[scan].chosen_view},
                                {"state_hash", hash},
                                {"recorded_state_hash", run.state_hash},
                                {"same_bits", same},
                                {"metrics", metrics}}));
  } else {
    fmt::print("{}state hash {}, {} {}\n", outcome_text(run.episode, outcome), hash,
               same ? "as recorded" : "recorded", same ? "" : run.state_hash);
  }
  if (outcome.code != ExitCode::done) return outcome.code;
  const bool as_chosen = !arguments.view || *arguments.view == run.scans[scan].chosen_view;
  return as_chosen && !same ? ExitCode::goal_failed : ExitCode::done;
}

ExitCode branch_command(const BranchArguments& arguments) {
  require_run_folder(arguments.directory);
  if (!arguments.all && arguments.scans.empty()) {
    throw ConfigError("--scan: missing; it says which decision is taken otherwise");
  }
  const bool one = !arguments.all && !arguments.then;
  if (one && arguments.scans.size() > 1) {
    throw ConfigError("--scan: several go with --all or --then");
  }
  if (!one && !arguments.out.empty()) {
    throw ConfigError("--out: goes with one branch to its end, without --all and --then");
  }
  catch_interrupts();
  const RecordedRun run = read_recorded_run(arguments.directory);
  return one ? run_to_the_end(arguments, run) : print_branches(arguments, run);
}

}  // namespace

std::function<ExitCode()> declare_branch(CLI::App& app) {
  auto arguments = std::make_shared<BranchArguments>();
  app.add_option("dir", arguments->directory, "run folder of a mapping task")->required();
  app.add_option("--scan", arguments->scans,
                 "number of the scan after which the decision was taken, as in steps.csv; with "
                 "--all or --then several, and --all without it is all decisions");
  auto* view = app.add_option("--view", arguments->view,
                              "candidate that is taken; default: the one that was chosen");
  app.add_flag("--all", arguments->all, "every candidate in turn; kept in branches.json")
      ->excludes(view);
  app.add_option("--then", arguments->then,
                 "scans to go on for after that of the view, by the episode's own choice; default: "
                 "to the end, with --all none")
      ->check(CLI::Range(0, 10000));
  app.add_option("--out", arguments->out, "keep the run folder of a branch to the end")
      ->check([](const std::string& text) { return text.empty() ? "is empty" : ""; });
  app.add_flag("--overwrite", arguments->overwrite, "replace a result that is there");
  app.add_flag("--json", arguments->json, "print one JSON object");
  return [arguments] { return branch_command(*arguments); };
}

}  // namespace vantage
