#include "vantage/study/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/runtime/manifest.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr auto kStateNames = std::to_array<std::string_view>(
    {"missing", "stale", "interrupted", "crashed", "failed", "diverged", "completed"});

/// One text for all configurations that give the same results.
std::string canonical(std::string_view yaml, const std::string& name) {
  ConfigNode root = parse_yaml(yaml, name);
  root.set("threads", ConfigNode::make_scalar("1"));
  return to_yaml(root);
}

/// What a text field says; empty if there is none.
std::string text(const Json& json, const char* key) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_string()) return {};
  return json[key].get<std::string>();
}

bool same_configuration(const fs::path& folder, const ResolvedEpisode& resolved) {
  const fs::path file = folder / "config.yaml";
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  try {
    return canonical(read_file(file), file.string()) == canonical(episode_yaml(resolved), "plan");
  } catch (const Error&) {
    return false;
  }
}

std::string reason(const fs::path& folder, EpisodeState state) {
  if (state == EpisodeState::crashed) {
    return text(read_json_or_null(folder / "failure.json"), "reason");
  }
  if (is_result(state)) return text(read_json_or_null(folder / "metrics.json"), "reason");
  if (state == EpisodeState::stale)
    return "the configuration, or a file of scene, robot or model, has changed since";
  return {};
}

/// What a status says of an episode.
struct Shown {
  std::string state;
  std::string reason;
};

std::vector<Shown> shown(const fs::path& study_dir, const std::vector<PlannedEpisode>& plan,
                         const std::vector<EpisodeState>& states,
                         const std::vector<EpisodeActivity>& activities) {
  std::vector<Shown> all;
  all.reserve(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i < activities.size() && !activities[i].state.empty()) {
      all.push_back({activities[i].state, activities[i].reason});
    } else {
      const bool completed = states[i] == EpisodeState::completed;
      all.push_back({std::string(state_name(states[i])),
                     completed ? "" : reason(episode_folder(study_dir, plan[i]), states[i])});
    }
  }
  return all;
}

/// In the order in which a status tells them.
std::vector<std::string> shown_states() {
  std::vector<std::string> names(kStateNames.rbegin(), kStateNames.rend());
  names.insert(names.begin() + 1, {"running", "queued"});
  return names;
}

}  // namespace

std::string_view state_name(EpisodeState state) {
  return kStateNames.at(static_cast<std::size_t>(state));
}

fs::path episode_folder(const fs::path& study_dir, const PlannedEpisode& episode) {
  return study_dir / "episodes" / episode.name;
}

Json read_json_or_null(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return nullptr;
  return json_object_or_null<Json>(read_file(file));
}

/// Hashed once for all episodes that have the same.
const ResultCheck::Hashes& ResultCheck::assets(const ResolvedEpisode& resolved) {
  const std::vector<InputFile> read = inputs(resolved.task);
  const RobotFolder& robot = resolved.setup.robot;
  std::string names = fmt::format("{}\n{}\n{}", resolved.setup.scene.string(),
                                  robot.description.string(), robot.mjcf.string());
  for (const InputFile& input : read) names += "\n" + input.path.string();
  auto [entry, is_new] = assets_.try_emplace(names);
  if (is_new) entry->second = asset_hashes(resolved.setup, read);
  return entry->second;
}

EpisodeState ResultCheck::operator()(const fs::path& study_dir, const PlannedEpisode& episode) {
  return in_folder(episode_folder(study_dir, episode), episode);
}

EpisodeState ResultCheck::in_folder(const fs::path& folder, const PlannedEpisode& episode) {
  const std::string status = text(read_json_or_null(folder / "metrics.json"), "status");
  if (status.empty()) {
    std::error_code error;
    return fs::exists(folder / "failure.json", error) ? EpisodeState::crashed
                                                      : EpisodeState::missing;
  }
  const Json manifest = read_json_or_null(folder / "manifest.json");
  if (!same_configuration(folder, episode.resolved) || !manifest.is_object() ||
      manifest.value("assets", Json()) != Json(assets(episode.resolved))) {
    return EpisodeState::stale;
  }
  for (const EpisodeState state : {EpisodeState::interrupted, EpisodeState::failed,
                                   EpisodeState::diverged, EpisodeState::completed}) {
    if (status == state_name(state)) return state;
  }
  return EpisodeState::stale;
}

std::vector<EpisodeState> episode_states(const fs::path& study_dir,
                                         const std::vector<PlannedEpisode>& plan) {
  ResultCheck check;
  std::vector<EpisodeState> states;
  states.reserve(plan.size());
  for (const auto& episode : plan) states.push_back(check(study_dir, episode));
  return states;
}

std::string status_text(const fs::path& study_dir, const std::vector<PlannedEpisode>& plan,
                        const std::vector<EpisodeState>& states,
                        const std::vector<EpisodeActivity>& activities) {
  const std::vector<Shown> all = shown(study_dir, plan, states, activities);
  std::vector<std::string> counts;
  for (const std::string& state : shown_states()) {
    const auto count = std::ranges::count(all, state, &Shown::state);
    if (count > 0) counts.push_back(fmt::format("{} {}", count, state));
  }
  std::string lines = fmt::format("{} of {} episodes\n", fmt::join(counts, ", "), plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const auto& [state, why] = all[i];
    if (states[i] == EpisodeState::completed) continue;
    lines += fmt::format("{:<11} {}{}{}\n", state, plan[i].name, why.empty() ? "" : ": ", why);
  }
  return lines;
}

Json status_json(const fs::path& study_dir, const std::vector<PlannedEpisode>& plan,
                 const std::vector<EpisodeState>& states,
                 const std::vector<EpisodeActivity>& activities) {
  const std::vector<Shown> all = shown(study_dir, plan, states, activities);
  Json json = {{"directory", study_dir.string()}, {"episodes", plan.size()}};
  for (const std::string& state : shown_states()) {
    json[state] = std::ranges::count(all, state, &Shown::state);
  }
  json["not_completed"] = Json::array();
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (states[i] == EpisodeState::completed) continue;
    json["not_completed"].push_back(
        {{"episode", plan[i].name}, {"state", all[i].state}, {"reason", all[i].reason}});
  }
  return json;
}

}  // namespace vantage
