#include "vantage/planners/objects/feature_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

namespace vantage {
namespace {

std::optional<std::size_t> first_feature(const std::string& name,
                                         std::span<const FeatureOption> features) {
  if (name.empty()) return std::nullopt;
  const auto found =
      std::ranges::find(features, name, [](const FeatureOption& f) { return f.model->feature; });
  if (found == features.end()) {
    std::vector<std::string> known;
    for (const FeatureOption& f : features) known.push_back(f.model->feature);
    throw ConfigError(
        fmt::format("first: unknown feature '{}'; known: {}", name, fmt::join(known, ", ")));
  }
  if (found->extracted) return std::nullopt;
  return static_cast<std::size_t>(found - features.begin());
}

double score_of(const FeatureChoice& choice, const ObservationModel& model, double gain_bits) {
  if (!choice.per_cost) return gain_bits;
  expects(model.cost_s > 0.0, "a gain per cost needs the cost of every feature");
  return gain_per_cost(gain_bits, model.cost_s);
}

std::vector<FeatureScore> scores_of(const FeatureChoice& choice, const FeatureSituation& situation,
                                    Rng& rng) {
  const ObservationModel* model = nullptr;
  InformationQuery query{
      .likely = likely_states(situation.database, situation.belief, choice.states),
      .features = {&model, 1},
      .weight = situation.weight};
  if (choice.about_object) query.group = objects_of(situation.database, query.likely.states);
  const Rng common(rng.next());
  std::vector<FeatureScore> scores;
  for (std::size_t i = 0; i < situation.features.size(); ++i) {
    const FeatureOption& option = situation.features[i];
    if (option.extracted) continue;
    model = option.model;
    query.tables = option.tables;
    Rng draws = common;
    const InformationEstimate gain = expected_information(choice.measure, query, draws);
    scores.push_back({.feature = i, .gain = gain, .score = score_of(choice, *model, gain.bits)});
  }
  return scores;
}

}  // namespace

FeatureDecision choose_feature(const FeatureChoice& choice, const FeatureSituation& situation,
                               Rng& rng) {
  if (const auto first = first_feature(choice.first, situation.features)) {
    return {.feature = first, .reason = FeatureReason::first, .scores = {}, .score = {}};
  }
  FeatureDecision decision{.feature = {},
                           .reason = FeatureReason::none_left,
                           .scores = scores_of(choice, situation, rng),
                           .score = {}};
  if (decision.scores.empty()) return decision;
  const auto rank = [&](const FeatureScore& s) {
    return std::tuple(-s.score, situation.features[s.feature].model->cost_s, s.feature);
  };
  const FeatureScore& best = *std::ranges::min_element(decision.scores, {}, rank);
  const bool stop =
      std::visit([&](const auto& s) { return s(best.score, situation.last_score); }, choice.stop);
  decision.reason = stop ? FeatureReason::not_worth_while : FeatureReason::best;
  if (!stop) {
    decision.feature = best.feature;
    decision.score = best.score;
  }
  return decision;
}

}  // namespace vantage
