#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

#include "vantage/cli/hindsight/hindsight_commands.hpp"
#include "vantage/cli/hints/folder.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/runtime/replay.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct ReplayArguments {
  fs::path directory;
  bool json = false;
};

nlohmann::ordered_json replay_json(const fs::path& directory, const ReplayResult& result) {
  nlohmann::ordered_json difference = nullptr;
  if (result.first_difference) {
    difference = {
        {"step", *result.first_difference}, {"time_s", result.time_s}, {"what", result.what}};
  }
  return {{"directory", directory.string()},
          {"steps", result.ticks},
          {"state_hash", hash_text(result.state_hash)},
          {"first_difference", difference},
          {"changed_files", result.changed_files}};
}

}  // namespace

std::function<ExitCode()> declare_replay(CLI::App& app) {
  auto arguments = std::make_shared<ReplayArguments>();
  app.add_option("dir", arguments->directory, "run folder")->required();
  app.add_flag("--json", arguments->json, "print one JSON object");
  return [arguments] {
    const fs::path& directory = arguments->directory;
    require_run_folder(directory);
    catch_interrupts();
    const ResolvedEpisode resolved = load_recorded(directory);
    World world(model_source(resolved), resolved.setup.options.simulation);
    add_outside_effects(resolved, world);
    const ReplayResult result =
        replay(directory, world, asset_hashes(resolved.setup, inputs(resolved.task)));
    if (!result.changed_files.empty()) {
      log_warning(
          fmt::format("changed since the recording: {}", fmt::join(result.changed_files, ", ")));
    }
    if (arguments->json) {
      fmt::print("{}", json_text(replay_json(directory, result)));
      return result.first_difference ? ExitCode::goal_failed : ExitCode::done;
    }
    if (result.first_difference) {
      fmt::print("{}: differs first at step {} ({:.3f} s): {}\n", directory.string(),
                 *result.first_difference, result.time_s, result.what);
      return ExitCode::goal_failed;
    }
    fmt::print("{}: {} steps, every state the same, state hash {}\n", directory.string(),
               result.ticks, hash_text(result.state_hash));
    return ExitCode::done;
  };
}

}  // namespace vantage
