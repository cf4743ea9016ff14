/// What training keeps of the views it saw: enough to go on with more of them, in any order.
#pragma once

#include <Eigen/Core>

#include <string_view>
#include <variant>
#include <vector>

#include "vantage/belief/observation/observation_model.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

/// Of one feature. The states are independent of each other: adding an object appends columns and
/// leaves the others as they are, to the bit.
struct GaussianStatistics {
  std::vector<int> count;             ///< training views of each state
  Eigen::MatrixXf mean;               ///< dimensions x states; 0 where count is 0
  Eigen::MatrixXf squared_deviation;  ///< dimensions x states, sum over views of (x - mean)^2

  [[nodiscard]] int dimensions() const { return static_cast<int>(mean.rows()); }
  [[nodiscard]] int states() const { return static_cast<int>(mean.cols()); }
};

/// @param dimensions >= 1
GaussianStatistics empty_statistics(int dimensions, int states);

/// Appends states without views.
void add_states(GaussianStatistics& statistics, int states);

/// @param feature of `dimensions()` finite numbers  [Welford1962]
void add_view(GaussianStatistics& statistics, int state,
              const Eigen::Ref<const Eigen::VectorXf>& feature);

/// Adds the views of `other`, which has the same dimensions and states.  [ChanGolubLeVeque1983]
void merge(GaussianStatistics& statistics, const GaussianStatistics& other);

/// s_pool^2 is the variance within states, over all of them. The mean of a scaled inverse
/// chi-squared posterior, nearly.  [Gelman2013, 3.2]
struct ShrunkVariance {
  static constexpr std::string_view name = "shrunk";
  static constexpr StrategyText text{
      .summary =
          "Variances of a state, drawn towards what all states have in common: for states with few "
          "views.",
      .formula = "(nu0 s_pool^2 + d) / (nu0 + n - 1), d the sum of squared deviations of n views",
      .source = "Gelman2013, 3.2"};
  double nu0 = 5.0;
  double floor = 0.01;
  void fields(auto&& f) {
    f("nu0", nu0,
      "number of views that the pooled variance is worth; higher makes the variances of states "
      "more alike",
      above(0.0));
    f("floor", floor,
      "least variance, as a share of the mean pooled variance of all dimensions; higher flattens "
      "the densities",
      above(0.0));
  }
  /// @param count >= 1
  [[nodiscard]] Eigen::ArrayXd operator()(int count, const Eigen::ArrayXd& squared_deviation,
                                          const Eigen::ArrayXd& pooled) const;
};

/// s_pool^2 for a state of a single view, which has none.  [Potthast2016, 4.1.3]
struct LiteralVariance {
  static constexpr std::string_view name = "literal";
  static constexpr StrategyText text{
      .summary =
          "Maximum-likelihood variances of each state by itself, as the dissertation has them. "
          "Overfits states with few views.",
      .formula = "d / n, d the sum of squared deviations of n views",
      .source = "Potthast2016, 4.1.3"};
  double floor = 0.01;  ///< bins of a histogram that no view fills have none of their own
  void fields(auto&& f) {
    f("floor", floor,
      "least variance, as a share of the mean pooled variance of all dimensions; higher flattens "
      "the densities",
      above(0.0));
  }
  /// @param count >= 1
  [[nodiscard]] Eigen::ArrayXd operator()(int count, const Eigen::ArrayXd& squared_deviation,
                                          const Eigen::ArrayXd& pooled) const;
};

using VarianceEstimate = std::variant<ShrunkVariance, LiteralVariance>;
template <>
inline constexpr std::string_view strategy_family<VarianceEstimate> = "variance estimate";

/// The model that the views so far amount to, with psi = 1 and no name or cost.
///
/// A state without views is the Gaussian with the moments of a mixture of equal parts, each about
/// the mean of one of its object's other bins with the variance s_pool^2; of all states if its
/// object has no views at all. Where no state has two views, s_pool^2 is the variance between the
/// states.
/// @param bins consecutive states that are one object
/// @throws ConfigError if `estimate` is out of range; InputError if no state has a view.
ObservationModel make_observation_model(const GaussianStatistics& statistics, int bins,
                                        const VarianceEstimate& estimate);

}  // namespace vantage
