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
  std::vector<Trial> trials;
  for (const Start& start : starts) {
    ObjectBelief belief = begin_recognition(recogniser).belief;
    double feature_time_s = 0.0;
    int used = 0;
    for (const std::size_t f : features) {
      feature_time_s += recogniser.features[f].observation.cost_s;
      if (!test.views[start.view].features[f].extracted()) continue;
      const auto view = static_cast<Eigen::Index>(start.view);
      if (update(belief, log_likelihood[f].col(view).cast<double>()).used()) ++used;
    }
    Trial trial = judged(states, test, start.view, belief);
    trial.features = used;
    trial.feature_time_s = feature_time_s;
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace vantage
