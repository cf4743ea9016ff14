#include "vantage/arena/episode_score.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <concepts>
#include <map>

#include "vantage/core/error.hpp"
#include "vantage/study/study_layout.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::optional<double> budget_s(const Task& task) {
  return std::visit(
      []<class T>(const T& t) -> std::optional<double> {
        if constexpr (std::derived_from<T, MappingOptions>) return t.budget.time_s;
        return std::nullopt;
      },
      task);
}

std::vector<ShareSeen> steps_of(const Json& metrics) {
  std::vector<ShareSeen> steps;
  const auto all = metrics.value("observable_cells", 0.0);
  for (const Json& scan : metrics.value("scans", Json::array())) {
    const auto left = scan.value("observable_unobserved_cells", 0.0);
    steps.push_back({scan.value("time_s", 0.0), all > 0.0 ? 1.0 - left / all : 0.0});
  }
  return steps;
}

/// The first scan is no decision.
std::vector<double> decision_times_s(const Json& metrics) {
  std::vector<double> times_s;
  const Json scans = metrics.value("scans", Json::array());
  for (std::size_t k = 1; k < scans.size(); ++k) {
    times_s.push_back(scans[k].value("plan_time_s", 0.0));
  }
  return times_s;
}

std::optional<double> time_over_bound(const fs::path& folder, int percent) {
  const Json bound = read_json_or_null(folder / "bound.json");
  if (!bound.is_object()) return std::nullopt;
  for (const Json& share : bound.value("shares", Json::array())) {
    if (share.value("percent", 0) != percent) continue;
    const Json ratios = share.value("run_over_least", Json());
    if (ratios.is_object() && ratios.value("time_s", Json()).is_number()) return ratios["time_s"];
  }
  return std::nullopt;
}

/// Of a decision: cells that the chosen view showed less than the best one, over those.
std::optional<double> regret_of(const Json& decision) {
  const Json regret = decision.value("regret", Json());
  if (!regret.is_object()) return std::nullopt;
  double best = 0.0;
  for (const Json& branch : decision.value("branches", Json::array())) {
    const Json cells = branch.value("new_cells", Json());
    if (cells.is_number()) best = std::max(best, cells.get<double>());
  }
  return best > 0.0 ? std::optional(regret.value("cells", 0.0) / best) : std::nullopt;
}

std::optional<double> mean_regret(const fs::path& folder) {
  const Json branches = read_json_or_null(folder / "branches.json");
  if (!branches.is_object()) return std::nullopt;
  std::vector<double> regrets;
  for (const Json& decision : branches.value("decisions", Json::array())) {
    if (const auto regret = regret_of(decision)) regrets.push_back(*regret);
  }
  return mean_of(regrets);
}

EpisodeScore score_from_files(const StudyResults& results, std::size_t i) {
  EpisodeScore score;
  score.episode = i;
  score.failed = results.states[i] != EpisodeState::completed;
  const fs::path folder = episode_folder(results.directory, results.plan[i]);
  if (!results.measures[i]) {
    const Json failure = read_json_or_null(folder / "failure.json");
    score.reason = std::string(state_name(results.states[i]));
    if (failure.is_object()) score.reason += ": " + failure.value("reason", std::string());
    return score;
  }
  const Json metrics = episode_metrics(results, i);
  if (score.failed) score.reason = metrics.value("reason", std::string());
  score.steps = steps_of(metrics);
  score.seen_share = score.steps.empty() ? 0.0 : score.steps.back().share;
  const auto number = [&](const char* key) {
    return metrics.contains(key) ? std::optional(metrics[key].get<double>()) : std::nullopt;
  };
  score.path_length_m = number("path_length_m");
  score.collisions = number("collisions");
  score.decision_times_s = decision_times_s(metrics);
  score.time_over_bound_90 = time_over_bound(folder, 90);
  score.regret_share = mean_regret(folder);
  return score;
}

/// @throws InputError naming the episode whose files hold something of another kind than they
/// should
EpisodeScore score_of(const StudyResults& results, std::size_t i) {
  try {
    return score_from_files(results, i);
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: metrics.json, bound.json, branches.json or failure.json: {}",
                                 episode_folder(results.directory, results.plan[i]).string(),
                                 error.what()));
  }
}

bool came_to_something(EpisodeState state) {
  return is_result(state) || state == EpisodeState::crashed;
}

}  // namespace

bool chooses_views(const Task& task) {
  return std::visit([]<class T>(const T&) { return std::derived_from<T, MappingOptions>; }, task);
}

double mean_share_seen(const std::vector<ShareSeen>& steps, double horizon_s) {
  if (horizon_s <= 0.0) return 0.0;
  double sum_s = 0.0;
  double share = 0.0;
  double since_s = 0.0;
  for (const ShareSeen& step : steps) {
    if (step.time_s >= horizon_s) break;
    sum_s += share * (step.time_s - since_s);
    share = step.share;
    since_s = step.time_s;
  }
  return (sum_s + share * (horizon_s - since_s)) / horizon_s;
}

std::vector<double> sampled_share_seen(const std::vector<ShareSeen>& steps, double horizon_s,
                                       std::size_t samples) {
  std::vector<double> shares;
  std::size_t done = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double time_s = horizon_s * static_cast<double>(k) / static_cast<double>(samples - 1);
    while (done < steps.size() && steps[done].time_s <= time_s) ++done;
    shares.push_back(done == 0 ? 0.0 : steps[done - 1].share);
  }
  return shares;
}

std::vector<EpisodeScore> episode_scores(const StudyResults& results) {
  std::vector<EpisodeScore> scores;
  std::map<std::size_t, double> longest_s;  // of the episodes that differ by their planner alone
  const StudyLayout layout(results.study);
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    if (!came_to_something(results.states[i])) continue;
    scores.push_back(score_of(results, i));
    const auto& steps = scores.back().steps;
    double& longest = longest_s[layout.place(results.plan[i].levels).pair];
    if (!steps.empty()) longest = std::max(longest, steps.back().time_s);
  }
  for (EpisodeScore& score : scores) {
    const PlannedEpisode& planned = results.plan[score.episode];
    score.horizon_s =
        budget_s(planned.resolved.task).value_or(longest_s[layout.place(planned.levels).pair]);
    score.score = mean_share_seen(score.steps, score.horizon_s);
  }
  return scores;
}

}  // namespace vantage
