#include "vantage/cli/sweep_commands.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/cli/sweep/cluster_verbs.hpp"
#include "vantage/cli/sweep/verbs.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/compare.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

void add_overrides(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--set", arguments.overrides, "key=value for every episode")
      ->type_size(1)
      ->allow_extra_args(false);
}

void add_split(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--split", arguments.split,
                 "of the study's splits, the one that is meant; default: the first");
}

void add_shard(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--shard", arguments.shard, "i/N: every N-th episode, from the i-th on")
      ->capture_default_str();
}

void add_keep_states(CLI::App& app, SweepArguments& arguments) {
  app.add_flag("--keep-states", arguments.keep_states,
               "whole run folders, to view, replay and report on single episodes");
}

void add_jobs(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--jobs", arguments.jobs, "episodes at a time")
      ->check(CLI::Range(1, 1024))
      ->default_str("all cores");
}

void add_other_study(CLI::App& app, bool& overwrite) {
  app.add_flag("--overwrite", overwrite,
               "go on in a folder that holds another study, or an older state of this one; results "
               "that still fit are kept");
}

void add_submission(CLI::App& app, SweepArguments& arguments) {
  app.add_option("--array", arguments.tasks, "tasks, at most one an episode")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--partition", arguments.partition, "of the cluster; default: its own")
      ->check(not_empty);
  app.add_option("--time", arguments.time, "limit of a task, as sbatch takes it: 30, 2:00:00, 1-0")
      ->check(not_empty);
  app.add_option("--sbatch-arg", arguments.sbatch_arguments,
                 "one more option of sbatch, of both jobs: --sbatch-arg=--mem=2G")
      ->type_size(1)
      ->allow_extra_args(false);
}

struct SweepVerb {
  const char* name;
  const char* help;
  ExitCode (*command)(const SweepArguments&);
  void (*options)(CLI::App&, SweepArguments&);
};

constexpr SweepVerb kSweepVerbs[] = {
    {"run", "run the episodes that have no result yet, then collect", run_study,
     [](CLI::App& app, SweepArguments& arguments) {
       add_overrides(app, arguments);
       add_split(app, arguments);
       add_shard(app, arguments);
       add_jobs(app, arguments);
       add_keep_states(app, arguments);
       add_other_study(app, arguments.overwrite);
     }},
    {"plan", "list the episodes that would run", print_study_plan,
     [](CLI::App& app, SweepArguments& arguments) {
       add_overrides(app, arguments);
       add_split(app, arguments);
       add_shard(app, arguments);
     }},
    {"submit", "run the episodes that have no result yet on a Slurm cluster, then collect",
     submit_study,
     [](CLI::App& app, SweepArguments& arguments) {
       add_overrides(app, arguments);
       add_split(app, arguments);
       add_submission(app, arguments);
       add_keep_states(app, arguments);
       add_other_study(app, arguments.overwrite);
     }},
    {"work", "claim and run episodes of a shared folder until none is left", work_on_study,
     [](CLI::App& app, SweepArguments& arguments) {
       add_jobs(app, arguments);
       add_keep_states(app, arguments);
     }},
    {"status", "what runs, waits, is missing, failed; exit 1 unless all is there",
     print_study_status, add_split},
    {"cancel", "end what was submitted; results so far are kept", cancel_study,
     [](CLI::App&, SweepArguments&) {}},
    {"collect", "merge the results to tables and figures; exit 1 unless all is there",
     collect_study, add_split},
};

}  // namespace

std::function<ExitCode()> declare_sweep(CLI::App& app) {
  auto arguments = std::make_shared<SweepArguments>();
  auto chosen = std::make_shared<ExitCode (*)(const SweepArguments&)>(nullptr);
  app.require_subcommand(1);
  for (const SweepVerb& verb : kSweepVerbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.help);
    sub->add_option("study", arguments->study, "study file, or folder of its results")->required();
    sub->add_option("--out", arguments->directory, "study folder; default out/<study>")
        ->check(not_empty);
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
    fmt::print("{}", arguments->json ? json_text(comparison_json(comparison, arguments->tolerance))
                                     : comparison_text(comparison, arguments->all));
    return comparison.beyond == 0 ? ExitCode::done : ExitCode::goal_failed;
  };
}

}  // namespace vantage
