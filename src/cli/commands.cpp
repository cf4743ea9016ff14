#include "vantage/cli/commands.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "vantage/cli/dataset_commands.hpp"
#include "vantage/cli/doctor.hpp"
#include "vantage/cli/listing.hpp"
#include "vantage/cli/recognition_commands.hpp"
#include "vantage/cli/score_views_command.hpp"
#include "vantage/cli/sweep_commands.hpp"
#include "vantage/cli/view_command.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/runtime/replay.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/study/study.hpp"
#include "vantage/study/study_page.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> g_command_line;

struct RunArguments {
  std::string episode = "assets/episodes/tabletop.yaml";
  std::vector<std::string> overrides;
  std::string seed;
  RunOptions options;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool print_config = false;
  bool dry_run = false;
};

void print_config(const ResolvedEpisode& resolved, bool json) {
  fmt::print("{}", json ? json_text(config_json(episode_node(resolved))) : episode_yaml(resolved));
}

void print_plan(const ResolvedEpisode& resolved, bool json) {
  const EpisodeSetup& setup = resolved.setup;
  const TaskExtent longest = extent(resolved);
  if (json) {
    fmt::print("{}", json_text({{"episode", setup.name},
                                {longest.key, longest.count},
                                {"scene", setup.scene.string()},
                                {"method", method_name(resolved.task)},
                                {"seed", setup.options.seed}}));
    return;
  }
  fmt::print("{}: {} {} in {} by {}, seed {}\n", setup.name, longest.count, longest.text,
             setup.scene.string(), method_name(resolved.task), setup.options.seed);
}

void print_outcome(const ResolvedEpisode& resolved, const RunOutcome& outcome) {
  const auto metrics = nlohmann::ordered_json::parse(outcome.metrics);
  fmt::print("{}state hash {}\n", outcome_text(resolved, outcome),
             metrics["state_hash"].get<std::string>());
  for (const auto& [label, file] : {std::pair("report", "report.html"), {"video ", "video.mp4"}}) {
    if (fs::exists(outcome.directory / file)) {
      fmt::print("{} {}\n", label, (outcome.directory / file).string());
    }
  }
}

ExitCode run_episode_command(const RunArguments& arguments) {
  if (arguments.quiet) set_verbosity(Verbosity::quiet);
  if (arguments.verbose) set_verbosity(Verbosity::verbose);
  const auto path = find_input(arguments.episode, {}, "episode");
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) overrides.push_back("seed=" + arguments.seed);
  const ResolvedEpisode resolved = load_episode(path, overrides);
  if (arguments.print_config) {
    print_config(resolved, arguments.json);
    return ExitCode::done;
  }
  if (arguments.dry_run) {
    const Validation found = validate_episode(path, overrides);
    for (const auto& problem : found.problems) log_error(problem);
    if (!found.problems.empty()) return found.code;
    print_plan(resolved, arguments.json);
    return found.code;
  }
  catch_interrupts();
  RunOptions options = arguments.options;
  options.command = g_command_line;
  const RunOutcome outcome = run(resolved, options);
  if (arguments.json) {
    std::fputs(outcome.metrics.c_str(), stdout);
  } else {
    print_outcome(resolved, outcome);
  }
  return outcome.code;
}

std::function<ExitCode()> declare_run(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  app.add_option("episode", arguments->episode, "episode file")->capture_default_str();
  app.add_option("--set", arguments->overrides, "key=value, same keys as the file")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--seed", arguments->seed, "seed of every random stream");
  app.add_option("--out", arguments->options.directory, "run folder; default out/<episode>-<seed>")
      ->check([](const std::string& text) { return text.empty() ? "is empty" : ""; });
  app.add_flag("--overwrite", arguments->options.overwrite, "replace a run in that folder");
  app.add_flag("--video", arguments->options.video, "record video.mp4 and frames/");
  app.add_flag("--lean", arguments->options.lean,
               "neither map, states nor report: metrics, steps, trajectories only");
  app.add_flag("--json", arguments->json, "print metrics.json to stdout");
  auto* quiet = app.add_flag("-q,--quiet", arguments->quiet, "warnings and errors only");
  app.add_flag("-v,--verbose", arguments->verbose, "debug messages too")->excludes(quiet);
  app.add_flag("--print-config", arguments->print_config, "print the resolved episode and stop");
  app.add_flag("--dry-run", arguments->dry_run, "check everything, run nothing");
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) option->disable_flag_override();
  }
  return [arguments] { return run_episode_command(*arguments); };
}

std::function<ExitCode()> declare_report(CLI::App& app) {
  auto directory = std::make_shared<fs::path>();
  app.add_option("dir", *directory, "folder of a run or of a study")->required();
  return [directory] {
    if (is_study_folder(*directory)) {
      const StudyResults results = read_study_results(*directory);
      write_study_page(results, evaluate(results));
    } else {
      write_report(*directory, report_sections(load_recorded(*directory).task));
    }
    fmt::print("{}\n", (*directory / "report.html").string());
    return ExitCode::done;
  };
}

std::function<ExitCode()> declare_replay(CLI::App& app) {
  auto directory = std::make_shared<fs::path>();
  app.add_option("dir", *directory, "run folder")->required();
  return [directory] {
    const ResolvedEpisode resolved = load_recorded(*directory);
    World world(model_source(resolved), resolved.setup.options.simulation);
    const ReplayResult result =
        replay(*directory, world, asset_hashes(resolved.setup, inputs(resolved.task)));
    if (!result.changed_files.empty()) {
      log_warning(
          fmt::format("changed since the recording: {}", fmt::join(result.changed_files, ", ")));
    }
    if (result.first_difference) {
      fmt::print("{}: differs first at step {} ({:.3f} s): {}\n", directory->string(),
                 *result.first_difference, result.time_s, result.what);
      return ExitCode::goal_failed;
    }
    fmt::print("{}: {} steps, every state the same, state hash {}\n", directory->string(),
               result.ticks, hash_text(result.state_hash));
    return ExitCode::done;
  };
}

Validation validate(const fs::path& file) {
  return is_study(file) ? validate_study(file) : validate_file(file);
}

std::function<ExitCode()> declare_validate(CLI::App& app) {
  auto files = std::make_shared<std::vector<fs::path>>();
  app.add_option("files", *files, "episodes and studies (.yaml), scenes (.xml), maps (.bt, .ot)")
      ->required();
  return [files] {
    ExitCode worst = ExitCode::done;
    for (const auto& file : *files) {
      const Validation found = validate(file);
      for (const auto& problem : found.problems) fmt::print("{}\n", problem);
      for (const auto& note : found.notes) fmt::print("{}\n", note);
      if (found.problems.empty()) fmt::print("{}: good\n", file.string());
      worst = std::max(worst, found.code);
    }
    return worst;
  };
}

std::function<ExitCode()> declare_list(CLI::App& app) {
  auto what = std::make_shared<std::string>();
  app.add_option("what", *what, "one of: " + fmt::format("{}", listing_topics_text()));
  return [what] {
    fmt::print("{}", listing(*what));
    return ExitCode::done;
  };
}

std::function<ExitCode()> declare_doctor(CLI::App&) {
  return [] {
    const DoctorReport report = examine();
    fmt::print("{}", report.text);
    return report.renderer_works ? ExitCode::done : ExitCode::no_renderer;
  };
}

}  // namespace

void remember_command_line(int argc, char** argv) { g_command_line.assign(argv, argv + argc); }

const std::vector<std::string>& command_line() { return g_command_line; }

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      {"run", "run an episode and write its run folder", declare_run},
      {"sweep", "run a study: an episode varied by factors", declare_sweep},
      {"report", "write the report page of a run or a study", declare_report},
      {"compare", "metrics of two runs or two studies side by side", declare_compare},
      {"replay", "run the recorded commands again and compare every state", declare_replay},
      {"view", "an episode in a window, as it runs or from its run folder", declare_view},
      {"validate", "everything wrong with a file; nothing is run", declare_validate},
      {"score-views", "rank views on an OctoMap of your own robot", declare_score_views},
      {"dataset", "render, inspect and show databases of objects", declare_dataset},
      {"train", "learn to recognise the objects of a dataset", declare_train},
      {"recognise", "what object views show, and from where to look next", declare_recognise},
      {"evaluate", "recognition over a dataset, every method from the same starts",
       declare_evaluate},
      {"list", "what there is to choose from", declare_list},
      {"doctor", "versions, renderer, codecs; what would not work and why", declare_doctor},
  };
  return table;
}

}  // namespace vantage
