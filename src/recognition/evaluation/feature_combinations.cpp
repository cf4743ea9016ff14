#include "vantage/recognition/evaluation/feature_combinations.hpp"

#include <algorithm>

namespace vantage {

std::vector<FeatureCombination> feature_combinations(std::size_t features) {
  std::vector<FeatureCombination> combinations;
  const std::size_t all = (std::size_t{1} << features) - 1;
  for (std::size_t set = 1; set <= all; ++set) {
    FeatureCombination combination;
    for (std::size_t f = 0; f < features; ++f) {
      if ((set >> f & 1U) != 0) combination.push_back(f);
    }
    const bool few = combination.size() == 1 || set == all;
    if (few || features <= kMaxCombined) combinations.push_back(std::move(combination));
  }
  std::ranges::stable_sort(combinations, {}, &FeatureCombination::size);
  return combinations;
}

std::vector<Trial> combination_trials(const Recogniser& recogniser, const TestViews& test,
                                      std::span<const Eigen::MatrixXf> log_likelihood,
                                      std::span<const Start> starts,
                                      const FeatureCombination& features) {
  const ObjectStates& states = recogniser.states;
  const auto category = [&](int object) {
    return states.category_of[static_cast<std::size_t>(object)];
  };
  std::vector<Trial> trials;
  for (const Start& start : starts) {
    ObjectBelief belief = uniform_belief(states);
    Trial trial{.object = states.object_of(test.shown[start.view]), .observations = 1};
    for (const std::size_t f : features) {
      trial.feature_time_s += recogniser.features[f].observation.cost_s;
      if (!test.views[start.view].features[f].extracted()) continue;
      const auto view = static_cast<Eigen::Index>(start.view);
      if (update(belief, log_likelihood[f].col(view).cast<double>()).used()) ++trial.features;
    }
    trial.estimate = most_probable_object(states, belief);
    trial.correct = trial.estimate == trial.object;
    trial.category_correct = category(trial.estimate) == category(trial.object);
    trial.bin_error = bin_error(states, expected_state(states, belief), test.shown[start.view]);
    trial.entropy_bits = state_entropy_bits(belief);
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace vantage
