/// What each combination of features is worth in a single view.  [Potthast2016, figure 4.4]
#pragma once

#include <span>
#include <vector>

#include "vantage/recognition/evaluation/evaluation.hpp"

namespace vantage {

/// One of a recogniser's features or more, in its order.
using FeatureCombination = std::vector<std::size_t>;

/// All of them, smaller ones first; of more than `kMaxCombined` features each alone and all.
inline constexpr std::size_t kMaxCombined = 5;
std::vector<FeatureCombination> feature_combinations(std::size_t features);

/// A trial from each start with these features and no other, as recognise() with one view has it.
/// @param log_likelihood as of log_likelihoods()
std::vector<Trial> combination_trials(const Recogniser& recogniser, const TestViews& test,
                                      std::span<const Eigen::MatrixXf> log_likelihood,
                                      std::span<const Start> starts,
                                      const FeatureCombination& features);

}  // namespace vantage
