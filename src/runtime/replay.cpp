#include "vantage/runtime/replay.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/log/recording.hpp"
#include "vantage/runtime/log/state_log.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

using ActionRow = std::vector<RecordedAction>::const_iterator;

std::optional<std::string> state_difference(std::span<const double> expected,
                                            std::span<const double> actual) {
  const auto [e, a] = std::ranges::mismatch(expected, actual);
  if (e == expected.end()) return std::nullopt;
  return fmt::format("state[{}] is {}, recorded {}", e - expected.begin(), *a, *e);
}

nlohmann::json read_manifest(const std::filesystem::path& run_dir) {
  auto manifest = json_object_or_null<nlohmann::json>(read_file(run_dir / "manifest.json"));
  if (manifest.is_object()) return manifest;
  throw InputError((run_dir / "manifest.json").string() + ": not a JSON object");
}

std::vector<std::string> changed_files(const nlohmann::json& manifest,
                                       const std::map<std::string, std::string>& present) {
  std::vector<std::string> changed;
  const auto recorded = manifest.value("assets", nlohmann::json::object());
  for (const auto& [name, hash] : present) {
    if (!recorded.contains(name) || recorded[name] != hash) changed.push_back(name);
  }
  for (const auto& [name, hash] : recorded.items()) {
    if (!present.contains(name)) changed.push_back(name);
  }
  return changed;
}

void note_difference(ReplayResult& result, const RecordedStates& recorded, std::uint64_t tick,
                     std::string what) {
  result.first_difference = tick;
  result.time_s = recorded.state(tick)[0];
  result.what = std::move(what);
}

/// What is other than recorded in this tick; nothing if all is as it was.
/// @param next the row of actions.csv that comes next
std::optional<std::string> replay_tick(const RecordedStates& recorded, std::uint64_t tick,
                                       ActionRow& next, ActionRow end, World& world) {
  if (next != end && next->tick <= tick) {
    if (!next->canonical) return "actions.csv was changed in this row";
    world.set_controls(next->controls);
    ++next;
  }
  if (!std::ranges::equal(world.controls(), recorded.controls(tick + 1))) {
    return "the commands in actions.csv are not the ones recorded";
  }
  try {
    world.advance_tick();
  } catch (const DivergedError& error) {
    return error.what();
  }
  return state_difference(recorded.state(tick + 1), world.state());
}

bool has_state_hash(const std::filesystem::path& metrics_file, std::uint64_t hash) {
  const auto metrics = json_object_or_null<nlohmann::json>(read_file(metrics_file));
  return metrics.is_object() && metrics.contains("state_hash") &&
         metrics["state_hash"] == hash_text(hash);
}

}  // namespace

ReplayResult replay(const std::filesystem::path& run_dir, World& world,
                    const std::map<std::string, std::string>& assets) {
  const RecordedStates recorded = load_states(run_dir, world);
  const auto actions = read_actions(run_dir / "actions.csv", actuator_names(world));
  world.set_state(recorded.finite_state(0));
  ReplayResult result;
  result.changed_files = changed_files(read_manifest(run_dir), assets);
  result.state_hash = hash_doubles(recorded.state(0));
  ActionRow next = actions.begin();
  constexpr std::uint64_t kTicksBetweenWords = 256;
  Progress progress("replay", static_cast<double>(recorded.count()));
  for (std::uint64_t tick = 0; tick + 1 < recorded.count(); ++tick) {
    if (tick % kTicksBetweenWords == 0) {
      throw_if_interrupted();
      progress.update(static_cast<double>(tick));
    }
    if (auto what = replay_tick(recorded, tick, next, actions.end(), world)) {
      note_difference(result, recorded, tick, std::move(*what));
      return result;
    }
    result.state_hash =
        hash_doubles(world.state(), hash_doubles(world.controls(), result.state_hash));
    result.ticks = tick + 1;
  }
  progress.update(static_cast<double>(recorded.count()));
  if (!has_state_hash(run_dir / "metrics.json", result.state_hash)) {
    note_difference(result, recorded, result.ticks, "metrics.json has another state_hash");
  }
  if (next != actions.end()) {
    note_difference(result, recorded, result.ticks,
                    "actions.csv goes on after the last recorded state");
    result.first_difference = std::max(next->tick, result.ticks);
  }
  return result;
}

}  // namespace vantage
