#include "vantage/cli/sweep/verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "vantage/cli/hints/episode_file.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/collect.hpp"
#include "vantage/study/sweep/submission.hpp"
#include "vantage/study/sweep/sweep.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

ExitCode code_of(const std::vector<EpisodeState>& states) {
  const bool good = std::ranges::all_of(
      states, [](EpisodeState state) { return state == EpisodeState::completed; });
  return good ? ExitCode::done : ExitCode::goal_failed;
}

/// Each split has a folder of its own.
fs::path default_folder(const Study& study) {
  return fs::path("out") / (study.name + (study.split.empty() ? "" : "_" + study.split));
}

StudyResults collect(const SweepArguments& arguments, const fs::path& directory) {
  StudyResults results = read_study_results(directory);
  const Evaluation evaluation = evaluate(results);
  write_collection(results, evaluation);
  if (!arguments.json) {
    fmt::print("{}\n", study_summary(results, evaluation));
  }
  return results;
}

/// As it was run: split and --set of then, unless others are given.
OpenedStudy open_recorded_study(const SweepArguments& arguments) {
  OpenedStudy opened = open_study(arguments);
  const fs::path recorded = opened.directory / "study.yaml";
  std::error_code error;
  if (arguments.overrides.empty() && arguments.split.empty() && fs::exists(recorded, error)) {
    opened.study = read_study(recorded, {}, {});
  }
  return opened;
}

}  // namespace

OpenedStudy open_study(const SweepArguments& arguments) {
  const fs::path given = arguments.study;
  std::error_code error;
  if (fs::is_directory(given, error)) {
    if (!arguments.directory.empty()) {
      throw ConfigError(fmt::format("--out: {} is a study's folder already", given.string()));
    }
    require_study_folder(given);
    return {read_study(given / "study.yaml", arguments.overrides, arguments.split), given};
  }
  Study study = read_study(find_study(arguments.study), arguments.overrides, arguments.split);
  fs::path directory = arguments.directory.empty() ? default_folder(study) : arguments.directory;
  return {std::move(study), std::move(directory)};
}

OpenedStudy open_study_folder(const SweepArguments& arguments) {
  std::error_code error;
  if (fs::is_regular_file(arguments.study, error)) {
    throw ConfigError(
        fmt::format("{}: is a file; expected the folder of a study", arguments.study));
  }
  return open_study(arguments);
}

void print_status(const SweepArguments& arguments, const fs::path& directory,
                  const std::vector<PlannedEpisode>& plan,
                  const std::vector<EpisodeState>& states) {
  const auto submissions = read_submissions(directory);
  const SlurmQueue queue = ask_slurm_of(submissions);
  const auto activities = episode_activities(directory, plan, states, submissions, queue);
  if (!arguments.json) {
    fmt::print("{}: {}{}", directory.string(), status_text(directory, plan, states, activities),
               submissions_text(submissions, queue));
    return;
  }
  auto json = status_json(directory, plan, states, activities);
  if (!submissions.empty()) json["slurm"] = submissions_json(submissions, queue);
  fmt::print("{}", json_text(json));
}

ExitCode run_study(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study(arguments);
  const auto plan = shard_of(plan_study(opened.study), parse_shard(arguments.shard));
  const StudySweepOptions options{.directory = opened.directory,
                                  .jobs = jobs_here(arguments),
                                  .overwrite = arguments.overwrite,
                                  .keep_states = arguments.keep_states};
  prepare_study_folder(opened.study, options);
  catch_interrupts();
  run_sweep(plan, options);
  collect(arguments, opened.directory);
  const auto states = episode_states(opened.directory, plan);  // others may have ended theirs
  print_status(arguments, opened.directory, plan, states);
  if (interrupt_signal() != 0) return static_cast<ExitCode>(128 + interrupt_signal());
  return code_of(states);
}

ExitCode print_study_plan(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study(arguments);
  const auto plan = shard_of(plan_study(opened.study), parse_shard(arguments.shard));
  const auto states = episode_states(opened.directory, plan);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (!is_result(states[i])) names.push_back(plan[i].name);
  }
  if (arguments.json) {
    fmt::print("{}", json_text({{"episodes", names}}));
  } else {
    for (const std::string& name : names) fmt::print("{}\n", name);
  }
  return ExitCode::done;
}

ExitCode print_study_status(const SweepArguments& arguments) {
  const OpenedStudy opened = open_recorded_study(arguments);
  const auto plan = plan_study(opened.study);
  const auto states = episode_states(opened.directory, plan);
  print_status(arguments, opened.directory, plan, states);
  return code_of(states);
}

ExitCode collect_study(const SweepArguments& arguments) {
  const fs::path directory = open_study(arguments).directory;
  require_study_folder(directory);
  const std::string held = read_study(directory / "study.yaml").split;
  if (!arguments.split.empty() && arguments.split != held) {
    throw ConfigError(
        fmt::format("--split {}: {} holds split '{}'", arguments.split, directory.string(), held));
  }
  const StudyResults results = collect(arguments, directory);
  print_status(arguments, results.directory, results.plan, results.states);
  return code_of(results.states);
}

}  // namespace vantage
