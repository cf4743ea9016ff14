#include "vantage/cli/commands.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "vantage/cli/arena/arena_command.hpp"
#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/dataset_commands.hpp"
#include "vantage/cli/doctor.hpp"
#include "vantage/cli/explain_command.hpp"
#include "vantage/cli/export/export_command.hpp"
#include "vantage/cli/hindsight/hindsight_commands.hpp"
#include "vantage/cli/hints/episode_file.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/cli/listing.hpp"
#include "vantage/cli/recognition_commands.hpp"
#include "vantage/cli/scene_commands.hpp"
#include "vantage/cli/schema/schema_command.hpp"
#include "vantage/cli/score_views_command.hpp"
#include "vantage/cli/sweep_commands.hpp"
#include "vantage/cli/validation/settings_file.hpp"
#include "vantage/cli/view_command.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/report.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
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
  bool print_config = false;
  bool dry_run = false;
};

void print_config(const ResolvedEpisode& resolved, bool json) {
  fmt::print("{}", json ? json_text(config_json(episode_node(resolved)))
                        : commented_episode_yaml(resolved));
}

void print_plan(const ResolvedEpisode& resolved, const std::vector<std::string>& notes, bool json) {
  const EpisodeSetup& setup = resolved.setup;
  const TaskExtent longest = extent(resolved);
  if (json) {
    fmt::print("{}", json_text({{"episode", setup.name},
                                {longest.key, longest.count},
                                {"scene", setup.scene.string()},
                                {"method", method_name(resolved.task)},
                                {"seed", setup.options.seed},
                                {"notes", notes}}));
    return;
  }
  for (const auto& note : notes) fmt::print("{}\n", note);
  fmt::print("{}: {} {} in {} by {}, seed {}\n", setup.name, longest.count, longest.text,
             setup.scene.string(), method_name(resolved.task), setup.options.seed);
}

void print_outcome(const ResolvedEpisode& resolved, const RunOutcome& outcome) {
  const auto metrics = nlohmann::ordered_json::parse(outcome.metrics);
  fmt::print("{}ended by: {}\nstate hash {}\n", outcome_text(resolved, outcome),
             metrics["reason"].get<std::string>(), metrics["state_hash"].get<std::string>());
  for (const auto& [label, file] : {std::pair("report", "report.html"), {"video ", "video.mp4"}}) {
    if (fs::exists(outcome.directory / file)) {
      fmt::print("{} {}\n", label, (outcome.directory / file).string());
    }
  }
}

ExitCode run_episode_command(const RunArguments& arguments) {
  const auto path = find_episode(arguments.episode);
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) overrides.push_back("seed=" + arguments.seed);
  if (arguments.dry_run && !arguments.print_config) {
    const Validation found = validate_episode(path, overrides);
    for (const auto& problem : found.problems) log_error(problem);
    if (found.problems.empty()) {
      print_plan(load_episode(path, overrides), found.notes, arguments.json);
    }
    return found.code;
  }
  const ResolvedEpisode resolved = load_episode(path, overrides);
  if (arguments.print_config) {
    print_config(resolved, arguments.json);
    return ExitCode::done;
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

void add_set(CLI::App& app, std::vector<std::string>& overrides, const std::string& help) {
  app.add_option("--set", overrides, help)->type_size(1)->allow_extra_args(false);
}

std::function<ExitCode()> declare_run(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  app.add_option("episode", arguments->episode, "episode file")->capture_default_str();
  add_set(app, arguments->overrides, "key=value, same keys as the file");
  app.add_option("--seed", arguments->seed, "seed of every random stream")->check(whole_number);
  app.add_option("--out", arguments->options.directory, "run folder; default out/<episode>-<seed>")
      ->check([](const std::string& text) { return text.empty() ? "is empty" : ""; });
  add_overwrite(app, arguments->options.overwrite);
  app.add_flag("--video", arguments->options.video, "record video.mp4 and frames/");
  app.add_flag("--lean", arguments->options.lean,
               "neither map, states nor report: metrics, steps, trajectories only");
  add_json(app, arguments->json);
  app.add_flag("--print-config", arguments->print_config, "print the resolved episode and stop");
  app.add_flag("--dry-run", arguments->dry_run, "check everything, run nothing");
  return [arguments] { return run_episode_command(*arguments); };
}

/// A command that takes one folder.
struct FolderArguments {
  fs::path directory;
  bool json = false;
};

std::function<ExitCode()> declare_report(CLI::App& app) {
  auto arguments = std::make_shared<FolderArguments>();
  app.add_option("dir", arguments->directory, "folder of a run or of a study")->required();
  add_json(app, arguments->json);
  return [arguments] {
    const fs::path& directory = arguments->directory;
    require_result_folder(directory);
    if (is_study_folder(directory)) {
      const StudyResults results = read_study_results(directory);
      write_study_page(results, evaluate(results));
    } else {
      write_report(directory, recorded_sections(directory));
    }
    const std::string page = (directory / "report.html").string();
    fmt::print("{}", arguments->json ? json_text({{"report", page}}) : page + "\n");
    return ExitCode::done;
  };
}

Validation validate(const fs::path& file, const std::vector<std::string>& overrides) {
  const SettingsCheck check = settings_check(file);
  if (check == nullptr) return validate_file(file, overrides);
  if (overrides.empty()) return check(file);
  return {{file.string() + ": --set is for episodes and scenes"}, {}, ExitCode::usage};
}

void print_validation(const fs::path& file, const Validation& found) {
  for (const auto& problem : found.problems) fmt::print("{}\n", problem);
  for (const auto& note : found.notes) fmt::print("{}\n", note);
  if (found.problems.empty()) fmt::print("{}: good\n", file.string());
}

std::function<ExitCode()> declare_validate(CLI::App& app) {
  struct Arguments {
    std::vector<fs::path> files;
    std::vector<std::string> overrides;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("files", arguments->files,
                 "episodes, studies, recipes and sensors (.yaml), scenes (.xml), maps (.bt, .ot), "
                 "models of recognition (.model), folders of robots")
      ->required();
  add_set(app, arguments->overrides, "key=value, as run has it; for episodes and scenes");
  add_json(app, arguments->json);
  return [arguments] {
    ExitCode worst = ExitCode::done;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const auto& file : arguments->files) {
      const Validation found = validate(file, arguments->overrides);
      files.push_back(
          {{"file", file.string()}, {"problems", found.problems}, {"notes", found.notes}});
      if (!arguments->json) print_validation(file, found);
      worst = std::max(worst, found.code);
    }
    if (arguments->json) fmt::print("{}", json_text({{"files", files}}));
    return worst;
  };
}

std::function<ExitCode()> declare_list(CLI::App& app) {
  struct Arguments {
    std::string what;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("what", arguments->what, "one of: " + fmt::format("{}", listing_topics_text()));
  add_json(app, arguments->json);
  return [arguments] {
    const bool explained = verbosity() == Verbosity::verbose;
    fmt::print("{}", arguments->json ? json_text(listing_json(arguments->what, explained))
                                     : listing_text(arguments->what, explained));
    return ExitCode::done;
  };
}

}  // namespace

void remember_command_line(int argc, char** argv) { g_command_line.assign(argv, argv + argc); }

const std::vector<std::string>& command_line() { return g_command_line; }

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      {"run", "run an episode and write its run folder", declare_run},
      {"sweep", "run a study: an episode varied by factors", declare_sweep},
      {"arena", "planners side by side, yours among them", declare_arena},
      {"report", "write the report page of a run or a study", declare_report},
      {"compare", "metrics of two runs or two studies side by side", declare_compare},
      {"replay", "run the recorded commands again and compare every state", declare_replay},
      {"bound", "what any policy would have needed at least, beside what a run took",
       declare_bound},
      {"branch", "what another choice at a decision of a run would have brought", declare_branch},
      {"view", "an episode in a window, as it runs or from its run folder", declare_view},
      {"export", "a run for other programs: an MCAP file", declare_export},
      {"validate", "everything wrong with a file; nothing is run", declare_validate},
      {"scene", "scenes from what others drew", declare_scene},
      {"score-views", "rank views on an OctoMap of your own robot", declare_score_views},
      {"dataset", "render, inspect and show databases of objects", declare_dataset},
      {"train", "learn to recognise the objects of a dataset", declare_train},
      {"recognise", "what object views show, and from where to look next", declare_recognise},
      {"evaluate", "recognition over a dataset, every method from the same starts",
       declare_evaluate},
      {"list", "what there is to choose from", declare_list},
      {"explain", "what a key, a strategy, a column or a file means", declare_explain},
      {"schema", "JSON schema of a kind of file, for editors", declare_schema},
      {"doctor", "versions, renderer, codecs; what would not work and why", declare_doctor},
  };
  return table;
}

}  // namespace vantage
