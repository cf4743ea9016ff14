/// How much measuring features is expected to tell of what is looked at, in bits but for
/// `jeffreys`.
///
/// Each measure takes the likely states for all there are. What that loses: whether it is one of
/// them at all, and what is told of the others; with m their share of the belief and I' the answer,
/// m I' <= I <= m I' + (1 - m) log2(other states) + h(m). Answers are not scaled by m: that ranks
/// worse.
#pragma once

#include <string_view>
#include <variant>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/objects/information_query.hpp"

namespace vantage {

/// A lower bound of the mutual information of state and features, from Bhattacharyya distances of
/// all pairs of states; without sampling. About objects, the difference of two such bounds, which
/// is an approximation (see pairwise_group_information_bits).  [KolchinskyTracey2017]
struct MutualInformation {
  static constexpr std::string_view name = "mutual_information";
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// An upper bound of the same, from KL divergences; also about objects.  [KolchinskyTracey2017]
struct InformationUpperBound {
  static constexpr std::string_view name = "kl_upper_bound";
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// sum_i b_i log2 [ p(mean_i | i) / sum_j b_j p(mean_i | j) ]: features replaced by their means.
/// [Potthast2016, (4.18)] with the prior its denominator lacks and without the weight that
/// overflows.
///
/// For the record only. Without the noise of a measurement it overrates what is told, and where a
/// narrow state lies near the mean of a wide one it is negative by any number of bits: means of
/// -27 nats have been seen.
struct MeanFeatureInformation {
  static constexpr std::string_view name = "mean_feature";
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// The mutual information by sampling, with its standard error: the reference for all others.
struct MonteCarloInformation {
  static constexpr std::string_view name = "monte_carlo";
  int samples = 1000;
  void fields(auto&& f) {
    f("samples", samples, ">= 2; the standard error falls with its root, time rises with it",
      between(2, 1'000'000));
  }
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// Expected loss of entropy, which is the mutual information, by few samples or at the means of the
/// features.  [Potthast2016, (4.13)-(4.16), (4.21), (4.24)]
struct LossOfEntropy {
  static constexpr std::string_view name = "loss_of_entropy";
  int samples = 64;
  bool at_mean = false;
  void fields(auto&& f) {
    f("samples", samples, ">= 2; more are less noisy and take longer", between(2, 1'000'000));
    f("at_mean", at_mean, "one feature per state, its mean, instead of samples");
  }
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// sum_ij b_i b_j J(p_i, p_j): how different the features of any two states are. In units of its
/// own (bits of divergence), not bounded by the entropy. About objects, pairs of the same object do
/// not count.  [Potthast2016, (4.20), (4.27)]
struct JeffreysDivergence {
  static constexpr std::string_view name = "jeffreys";
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

using InformationMeasure =
    std::variant<MutualInformation, InformationUpperBound, MeanFeatureInformation,
                 MonteCarloInformation, LossOfEntropy, JeffreysDivergence>;
template <>
inline constexpr std::string_view strategy_family<InformationMeasure> = "information measure";

inline InformationEstimate expected_information(const InformationMeasure& measure,
                                                const InformationQuery& query, Rng& rng) {
  return std::visit([&](const auto& m) { return m(query, rng); }, measure);
}

}  // namespace vantage
