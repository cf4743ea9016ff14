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

/// About objects, the difference of two such bounds, which is an approximation (see
/// pairwise_group_information_bits).  [KolchinskyTracey2017]
struct MutualInformation {
  static constexpr std::string_view name = "mutual_information";
  static constexpr StrategyText text{
      .summary =
          "Lower bound of the mutual information of state and features, from the distances of all "
          "pairs of states; without sampling. Fast, and nearly as good a ranking as `monte_carlo`.",
      .formula =
          "-sum_i b_i log2 sum_j b_j exp(-D_ij), D_ij the Bhattacharyya distance of states i and j",
      .source = "KolchinskyTracey2017; Potthast2016, (4.23), (4.26)"};
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// An upper bound about objects, too.  [KolchinskyTracey2017]
struct InformationUpperBound {
  static constexpr std::string_view name = "kl_upper_bound";
  static constexpr StrategyText text{
      .summary =
          "Upper bound of the mutual information of state and features, from the KL divergences of "
          "all pairs of states; without sampling.",
      .formula = "-sum_i b_i log2 sum_j b_j exp(-D_ij), D_ij the KL divergence of state i from j",
      .source = "KolchinskyTracey2017"};
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// [Potthast2016, (4.18)] with the prior its denominator lacks and without the weight that
/// overflows. Where a narrow state lies near the mean of a wide one it is negative by any number of
/// bits: means of -27 nats have been seen.
struct MeanFeatureInformation {
  static constexpr std::string_view name = "mean_feature";
  static constexpr StrategyText text{
      .summary =
          "Mutual information with the features replaced by their means. For the record: without "
          "noise it overrates what is told, and it can be negative by many bits.",
      .formula = "sum_i b_i log2 [ p(mean_i | i) / sum_j b_j p(mean_i | j) ]",
      .source = "Potthast2016, (4.18)"};
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

struct MonteCarloInformation {
  static constexpr std::string_view name = "monte_carlo";
  static constexpr StrategyText text{
      .summary =
          "Mutual information by many samples, with its standard error: the reference for all "
          "others, and the slowest.",
      .formula = "H(b) - mean over s of H(b | f_s), f_s drawn from p(f | i), i from b",
      .source = "Potthast2016, (4.17)"};
  int samples = 1000;
  void fields(auto&& f) {
    f("samples", samples,
      "number of samples; the standard error falls with its root, time rises with it",
      between(2, 1'000'000));
  }
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

struct LossOfEntropy {
  static constexpr std::string_view name = "loss_of_entropy";
  static constexpr StrategyText text{
      .summary =
          "Expected loss of entropy, which is the mutual information, by few samples or at the "
          "means of the features. One of the dissertation's measures.",
      .formula = "H(b) - mean over s of H(b | f_s), or H(b) - sum_i b_i H(b | mean_i)",
      .source = "Potthast2016, (4.13)-(4.16), (4.21), (4.24)"};
  int samples = 64;
  bool at_mean = false;
  void fields(auto&& f) {
    f("samples", samples, "number of samples; higher is less noisy and takes longer",
      between(2, 1'000'000));
    f("at_mean", at_mean, "true: one feature per state, its mean, instead of samples");
  }
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

/// About objects, pairs of the same object do not count.  [Potthast2016, (4.20), (4.27)]
struct JeffreysDivergence {
  static constexpr std::string_view name = "jeffreys";
  static constexpr StrategyText text{
      .summary =
          "How different the features of any two states are, in bits of divergence, which the "
          "entropy does not bound. Cheap; ranks worse than `mutual_information`.",
      .formula = "sum_ij b_i b_j J(p_i, p_j), J(p, q) = KL(p || q) + KL(q || p)",
      .source = "Potthast2016, (4.20), (4.27)"};
  void fields(auto&&) {}
  InformationEstimate operator()(const InformationQuery& query, Rng& rng) const;
};

using InformationMeasure =
    std::variant<MutualInformation, InformationUpperBound, MeanFeatureInformation,
                 MonteCarloInformation, LossOfEntropy, JeffreysDivergence>;
template <>
inline constexpr std::string_view strategy_family<InformationMeasure> = "information measure";

/// Gain per cost; a gain below 0, as some measures have it, is the worse the more it costs.
/// @pre cost > 0
inline double gain_per_cost(double gain_bits, double cost) {
  return gain_bits < 0.0 ? gain_bits * cost : gain_bits / cost;
}

inline InformationEstimate expected_information(const InformationMeasure& measure,
                                                const InformationQuery& query, Rng& rng) {
  return std::visit([&](const auto& m) { return m(query, rng); }, measure);
}

}  // namespace vantage
