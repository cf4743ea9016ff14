#include "vantage/planners/objects/object_view_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <utility>

#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

double cost_of(const ObjectViewOptions& options, const ObjectViewAction& action) {
  if (options.weight_per_s + options.weight_per_m + options.weight_per_j == 0.0) return 1.0;
  const double cost = options.weight_per_s * action.time_s + options.weight_per_m * action.path_m +
                      options.weight_per_j * action.energy_j;
  expects(cost > 0.0, "a gain per cost needs the cost of every action");
  return cost;
}

std::vector<ObjectViewScore> scores_by(const RandomObjectView& /*choice*/,
                                       const ObjectViewOptions& /*options*/,
                                       const ObjectViewSituation& situation, Rng& rng) {
  std::vector<ObjectViewScore> scores(situation.actions.size());
  for (ObjectViewScore& score : scores) score.score = rng.uniform();
  return scores;
}

/// Half a turn and any number of whole ones score pi, no turn 0.
std::vector<ObjectViewScore> scores_by(const StarView& /*choice*/,
                                       const ObjectViewOptions& /*options*/,
                                       const ObjectViewSituation& situation, Rng& /*rng*/) {
  std::vector<ObjectViewScore> scores;
  for (const ObjectViewAction& action : situation.actions) {
    const double turn_rad = std::abs(std::remainder(action.yaw_rad, 2.0 * std::numbers::pi));
    scores.push_back({.gain = {}, .cost = 1.0, .score = turn_rad});
  }
  return scores;
}

/// Free views score above 0, the sooner the higher; the others below.
std::vector<ObjectViewScore> scores_by(const NearestFreeView& choice,
                                       const ObjectViewOptions& /*options*/,
                                       const ObjectViewSituation& situation, Rng& /*rng*/) {
  std::vector<ObjectViewScore> scores;
  for (const ObjectViewAction& action : situation.actions) {
    const bool free = action.visible >= choice.min_visible;
    const double score = free ? 1.0 / (1.0 + action.time_s) : action.visible - 1.0;
    scores.push_back({.gain = {}, .cost = 1.0, .score = score});
  }
  return scores;
}

template <class Measure>
requires std::constructible_from<InformationMeasure, Measure> std::vector<ObjectViewScore>
scores_by(const Measure& measure, const ObjectViewOptions& options,
          const ObjectViewSituation& situation, Rng& rng) {
  const Rng common(rng.next());
  std::vector<ObjectViewScore> scores;
  for (std::size_t i = 0; i < situation.actions.size(); ++i) {
    InformationQuery query{
        .likely = likely_states(situation.database, situation.predicted_belief[i], options.states),
        .features = situation.features,
        .tables = situation.tables,
        .weight = situation.weight};
    if (options.about_object) query.group = objects_of(situation.database, query.likely.states);
    Rng draws = common;
    InformationEstimate gain = measure(query, draws);
    if (options.by_visibility && gain.bits > 0.0) gain.bits *= situation.actions[i].visible;
    const double cost = cost_of(options, situation.actions[i]);
    scores.push_back({.gain = gain, .cost = cost, .score = gain_per_cost(gain.bits, cost)});
  }
  return scores;
}

/// The first of the highest.
std::size_t best_of(const std::vector<ObjectViewScore>& scores) {
  const auto best = std::ranges::max_element(scores, {}, &ObjectViewScore::score);
  return static_cast<std::size_t>(best - scores.begin());
}

}  // namespace

void require_no_weights(const ObjectViewOptions& options, std::string_view where) {
  for (const auto& [key, weight] : {std::pair("weight_per_s", options.weight_per_s),
                                    {"weight_per_m", options.weight_per_m},
                                    {"weight_per_j", options.weight_per_j}}) {
    if (weight == 0.0) continue;
    throw ConfigError(
        fmt::format("{}.{}: {} weighs what motions cost, and here they cost nothing; must be 0",
                    where, key, weight));
  }
}

Rng choice_stream(const ObjectViewChoice& choice, std::uint64_t seed) {
  const auto* random = std::get_if<RandomObjectView>(&choice);
  if (random == nullptr || random->draw == 0) return Rng::stream(seed, "recognition");
  return Rng::stream(seed, fmt::format("recognition {}", random->draw));
}

ObjectViewDecision choose_object_view(const ObjectViewOptions& options,
                                      const ObjectViewSituation& situation, Rng& rng) {
  expects(!situation.actions.empty(), "choose_object_view needs an action");
  expects(situation.predicted_belief.size() == situation.actions.size(),
          "choose_object_view needs a predicted belief for each action");
  ObjectViewDecision decision;
  decision.scores =
      std::visit([&](const auto& choice) { return scores_by(choice, options, situation, rng); },
                 options.choice);
  if (!std::ranges::all_of(situation.actions, &ObjectViewAction::visited)) {
    discount_visited(options, situation.actions, decision.scores);
  }
  decision.action = best_of(decision.scores);
  return decision;
}

void discount_visited(const ObjectViewOptions& options, std::span<const ObjectViewAction> actions,
                      std::span<ObjectViewScore> scores) {
  expects(actions.size() == scores.size(), "a score of each action");
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (!actions[i].visited) continue;
    double& score = scores[i].score;
    score = options.visited_weight > 0.0 ? score - (1.0 - options.visited_weight) * std::abs(score)
                                         : -std::numeric_limits<double>::infinity();
  }
}

std::optional<EnoughReason> seen_enough(const EnoughViews& enough, const ObjectStates& database,
                                        const Eigen::VectorXd& belief) {
  expects(belief.size() == database.size(), "a belief holds a probability for each state");
  const Eigen::VectorXd objects = belief.head(database.known_size())
                                      .reshaped(database.bins, database.object_count())
                                      .colwise()
                                      .sum();
  const double unknown = belief.tail(database.unknown_size()).sum();
  const double most =
      std::min(std::max(objects.maxCoeff(), unknown), 1.0);  // sums round to a little above
  if (most > enough.object_probability) return EnoughReason::probability;
  const double entropy = entropy_bits({belief.data(), static_cast<std::size_t>(belief.size())});
  if (entropy < enough.entropy_bits) return EnoughReason::entropy;
  return std::nullopt;
}

}  // namespace vantage
