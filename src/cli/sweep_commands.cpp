#include "vantage/cli/sweep_commands.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/hints/episode_file.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/study/collect.hpp"
#include "vantage/study/compare.hpp"
#include "vantage/study/results.hpp"
#include "vantage/study/study.hpp"
#include "vantage/study/sweep.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct SweepArguments {
  std::string study;  ///< file or study folder
  fs::path directory;
  std::vector<std::string> overrides;
  std::string shard = "1/1";
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool overwrite = false;
  bool keep_states = false;
  bool json = false;
};

struct OpenedStudy {
  Study study;
  fs::path directory;
  bool from_folder = false;
};

/// A study by its file or by the folder of its results.
OpenedStudy open_study(const SweepArguments& arguments) {
  const fs::path given = arguments.study;
  std::error_code error;
  if (fs::is_directory(given, error)) {
    if (!arguments.directory.empty()) {
      throw ConfigError(fmt::format("--out: {} is a study's folder already", given.string()));
    }
    require_study_folder(given);
    return {read_study(given / "study.yaml", arguments.overrides), given, true};
  }
  Study study = read_study(find_study(arguments.study), arguments.overrides);
  fs::path directory =
      arguments.directory.empty() ? fs::path("out") / study.name : arguments.directory;
  return {std::move(study), std::move(directory), false};
}

ExitCode code_of(const std::vector<EpisodeState>& states) {
  const bool good = std::ranges::all_of(
      states, [](EpisodeState state) { return state == EpisodeState::completed; });
  return good ? ExitCode::done : ExitCode::goal_failed;
}

void print_status(const SweepArguments& arguments, const fs::path& directory,
                  const std::vector<PlannedEpisode>& plan,
                  const std::vector<EpisodeState>& states) {
  if (arguments.json) {
    fmt::print("{}\n", status_json(directory, plan, states).dump(2));
  } else {
    fmt::print("{}: {}", directory.string(), status_text(directory, plan, states));
  }
}

ExitCode run_command(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study(arguments);
  const auto plan = shard_of(plan_study(opened.study), parse_shard(arguments.shard));
  const StudySweepOptions options{opened.directory, arguments.jobs, arguments.overwrite,
                                  arguments.keep_states};
  prepare_study_folder(opened.study, options);
  catch_interrupts();
  const auto states = run_sweep(plan, options);
  print_status(arguments, opened.directory, plan, states);
  if (interrupt_signal() != 0) return static_cast<ExitCode>(128 + interrupt_signal());
  return code_of(states);
}

/// Of a folder, what would run now; of a file, every episode.
ExitCode plan_command(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study(arguments);
  const auto plan = shard_of(plan_study(opened.study), parse_shard(arguments.shard));
  const auto states = opened.from_folder ? episode_states(opened.directory, plan)
                                         : std::vector<EpisodeState>(plan.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (!is_result(states[i])) names.push_back(plan[i].name);
  }
  if (arguments.json) {
    fmt::print("{}\n", nlohmann::ordered_json({{"episodes", names}}).dump(2));
  } else {
    for (const std::string& name : names) fmt::print("{}\n", name);
  }
  return ExitCode::done;
}

ExitCode status_command(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study(arguments);
  const auto plan = plan_study(opened.study);
  const auto states = episode_states(opened.directory, plan);
  print_status(arguments, opened.directory, plan, states);
  return code_of(states);
}

/// What there is, even if something is missing; says then what, and ends in 1.
ExitCode collect_command(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study(arguments);
  require_study_folder(opened.directory);
  const StudyResults results = read_study_results(opened.directory);
  const Evaluation evaluation = evaluate(results);
  write_collection(results, evaluation);
  if (!arguments.json) {
    fmt::print("{}\n", study_summary(results, evaluation));
  }
  print_status(arguments, opened.directory, results.plan, results.states);
  return code_of(results.states);
}

void add_overrides(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--set", arguments.overrides, "key=value for every episode")
      ->type_size(1)
      ->allow_extra_args(false);
}

void add_shard(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--shard", arguments.shard, "i/N: every N-th episode, from the i-th on")
      ->capture_default_str();
}

struct SweepVerb {
  const char* name;
  const char* help;
  ExitCode (*command)(const SweepArguments&);
  void (*options)(CLI::App&, SweepArguments&);
};

constexpr SweepVerb kVerbs[] = {
    {"run", "run the episodes that have no result yet", run_command,
     [](CLI::App& app, SweepArguments& arguments) {
       add_overrides(app, arguments);
       add_shard(app, arguments);
       app.add_option("--jobs", arguments.jobs, "episodes at a time")
           ->check(CLI::Range(1, 1024))
           ->capture_default_str();
       app.add_flag("--keep-states", arguments.keep_states,
                    "whole run folders, to view, replay and report on single episodes");
       add_overwrite(app, arguments.overwrite);
     }},
    {"plan", "list the episodes that would run", plan_command,
     [](CLI::App& app, SweepArguments& arguments) {
       add_overrides(app, arguments);
       add_shard(app, arguments);
     }},
    {"status", "what is missing, failed, diverged; exit 1 unless all is there", status_command,
     [](CLI::App&, SweepArguments&) {}},
    {"collect", "merge the results to tables and figures; exit 1 unless all is there",
     collect_command, [](CLI::App&, SweepArguments&) {}},
};

}  // namespace

std::function<ExitCode()> declare_sweep(CLI::App& app) {
  auto arguments = std::make_shared<SweepArguments>();
  auto chosen = std::make_shared<ExitCode (*)(const SweepArguments&)>(nullptr);
  app.require_subcommand(1);
  for (const SweepVerb& verb : kVerbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.help);
    sub->add_option("study", arguments->study, "study file, or folder of its results")->required();
    sub->add_option("--out", arguments->directory, "study folder; default out/<study>");
    verb.options(*sub, *arguments);
    add_json(*sub, arguments->json);
    sub->callback([chosen, command = verb.command] { *chosen = command; });
  }
  return [arguments, chosen] { return (*chosen)(*arguments); };
}

std::function<ExitCode()> declare_compare(CLI::App& app) {
  struct Arguments {
    fs::path first;
    fs::path second;
    double tolerance = 0.0;
    bool all = false;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("first", arguments->first, "folder of a run or of a collected study")->required();
  app.add_option("second", arguments->second, "another of the same kind")->required();
  app.add_option("--tolerance", arguments->tolerance, "relative; 0: everything but wall times same")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag("--all", arguments->all, "every value that differs, not only what matters most");
  add_json(app, arguments->json);
  return [arguments] {
    for (const fs::path& folder : {arguments->first, arguments->second}) {
      require_result_folder(folder);
    }
    const FolderComparison comparison =
        compare_folders(arguments->first, arguments->second, arguments->tolerance);
    fmt::print("{}", arguments->json
                         ? comparison_json(comparison, arguments->tolerance).dump(2) + "\n"
                         : comparison_text(comparison, arguments->all));
    return comparison.beyond == 0 ? ExitCode::done : ExitCode::goal_failed;
  };
}

}  // namespace vantage
