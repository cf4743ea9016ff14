#include "vantage/cli/arena/arena_verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vantage/arena/arena_page.hpp"
#include "vantage/arena/foreign_planner.hpp"
#include "vantage/cli/hints/episode_file.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/hindsight/run_bound.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/collect.hpp"
#include "vantage/study/sweep/sweep.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// What a planner is measured by.
void require_mapping(const std::vector<PlannedEpisode>& plan, const std::string& study) {
  for (const PlannedEpisode& episode : plan) {
    if (chooses_views(episode.resolved.task)) continue;
    throw ConfigError(
        fmt::format("{}: {}: its task chooses no views; an arena is of tabletop and "
                    "exploration",
                    study, episode.name));
  }
}

/// Of every episode that has a result and no bound yet.
void add_bounds(const fs::path& arena, const std::vector<PlannedEpisode>& plan) {
  Progress progress("bounds", static_cast<double>(plan.size()));
  for (std::size_t i = 0; i < plan.size() && interrupt_signal() == 0; ++i) {
    const fs::path folder = episode_folder(arena, plan[i]);
    if (!fs::exists(folder / "metrics.json") || fs::exists(folder / "bound.json")) continue;
    try {
      const RunBound bound = bound_of_run(read_recorded_run(folder));
      write_file(folder / "bound.json", json_text(run_bound_json(bound)));
    } catch (const Interrupted&) {
      break;
    } catch (const InputError& error) {
      log_warning(fmt::format("{}: no bound: {}", plan[i].name, error.what()));
    }
    progress.update(static_cast<double>(i + 1), plan[i].name);
  }
}

ExitCode write_all(const fs::path& arena, bool json) {
  const StudyResults results = read_study_results(arena);
  require_mapping(results.plan, arena.string());
  write_collection(results, evaluate(results));
  const Leaderboard board = leaderboard_of(results);
  write_arena_page(results, board);
  const std::string page = (arena / "arena.html").string();
  if (json) {
    auto told = status_json(arena, results.plan, results.states);
    told["page"] = page;
    fmt::print("{}", json_text(told));
  } else {
    fmt::print("{}\n{}: {}page {}\n", leaderboard_text(board), arena.string(),
               status_text(arena, results.plan, results.states), page);
  }
  return results.complete() ? ExitCode::done : ExitCode::goal_failed;
}

std::vector<PlannedEpisode> plan_arena(const Study& study, const std::string& name) {
  auto plan = plan_study(study);
  require_mapping(plan, name);
  return plan;
}

ExitCode run_plan(const Study& study, const std::vector<PlannedEpisode>& plan,
                  const ArenaArguments& arguments, bool overwrite) {
  const StudySweepOptions options{.directory = arguments.directory,
                                  .jobs = arguments.jobs,
                                  .overwrite = overwrite,
                                  .single_thread = true};
  prepare_study_folder(study, options);
  if (overwrite && !arguments.name.empty()) {
    forget_episodes(arguments.directory, study, arguments.name);
  }
  run_sweep(plan, options);
  if (arguments.bounds) add_bounds(arguments.directory, plan);
  const ExitCode code = write_all(arguments.directory, arguments.json);
  return interrupt_signal() == 0 ? code : static_cast<ExitCode>(128 + interrupt_signal());
}

}  // namespace

ExitCode run_arena(const ArenaArguments& given) {
  ArenaArguments arguments = given;
  std::error_code error;
  const bool is_folder = fs::is_directory(arguments.study, error);
  if (is_folder) {
    if (!arguments.directory.empty()) {
      throw ConfigError(fmt::format("--out: {} is an arena's folder already", arguments.study));
    }
    require_study_folder(arguments.study);
    arguments.directory = arguments.study;
  }
  const fs::path file =
      is_folder ? arguments.directory / "study.yaml" : find_study(arguments.study);
  const Study study = read_study(file, arguments.overrides, arguments.split);
  if (arguments.directory.empty()) {
    arguments.directory =
        fs::path("out") / (study.name + (study.split.empty() ? "" : "_" + study.split));
  }
  const auto plan = plan_arena(study, arguments.study);
  catch_interrupts();
  return run_plan(study, plan, arguments, arguments.overwrite);
}

ExitCode add_to_arena(const ArenaArguments& arguments) {
  require_study_folder(arguments.directory);
  const Study study =
      study_with(arguments.directory, {arguments.name, arguments.command, arguments.timeout_s},
                 arguments.overwrite);
  const auto plan = plan_arena(study, arguments.directory.string());
  catch_interrupts();
  try_planner(plan, study, arguments.name);
  return run_plan(study, plan, arguments, true);
}

ExitCode write_arena(const ArenaArguments& arguments) {
  require_study_folder(arguments.directory);
  return write_all(arguments.directory, arguments.json);
}

}  // namespace vantage
