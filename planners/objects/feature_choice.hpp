/// Which feature to extract next from a view, or that it is not worth while.
/// [Potthast2016, 4.3]
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/planners/objects/information_measure.hpp"

namespace vantage {

struct GainBelow {
  static constexpr std::string_view name = "gain_below";
  static constexpr StrategyText text{
      .summary = "Stops when no feature is expected to tell more than a threshold.",
      .formula = "max gain < threshold",
      .source = "Potthast2016, 4.3.1"};
  double threshold = 0.02;
  void fields(auto&& f) {
    f("threshold", threshold,
      "gain, in bits or with `per_cost` in bits/s, below which no further feature is extracted; "
      "higher stops earlier; 0: only below a gain that comes out negative",
      at_least(0.0));
  }
  [[nodiscard]] bool operator()(double best, std::optional<double> /*last*/) const {
    return best < threshold;
  }
};

struct GainDecreasing {
  static constexpr std::string_view name = "gain_decreasing";
  static constexpr StrategyText text{.summary =
                                         "Stops when the best feature is expected to tell less "
                                         "than the one chosen before it was. Needs no threshold.",
                                     .formula = "max gain < gain of the last choice",
                                     .source = "Potthast2016, 4.3.2"};
  void fields(auto&&) {}
  [[nodiscard]] bool operator()(double best, std::optional<double> last) const {
    return last.has_value() && best < *last;
  }
};

using FeatureStop = std::variant<GainBelow, GainDecreasing>;
template <>
inline constexpr std::string_view strategy_family<FeatureStop> = "feature stop";

struct FeatureChoice {
  InformationMeasure measure = MutualInformation{};
  std::string first = {};
  int states = 48;
  bool about_object = true;
  bool per_cost = false;
  FeatureStop stop = GainBelow{};
  void fields(auto&& f) {
    f("measure", measure, "measure of information that features are chosen by");
    f("first", first,
      "feature that is extracted first at every view; empty: chosen like all others");
    f("states", states,
      "number of the most probable states that are told apart; higher is more exact, at its square "
      "in time",
      between(1, 100'000));
    f("about_object", about_object,
      "true: only information about the object counts; false: about its yaw as well");
    f("per_cost", per_cost, "true: gains are compared per second of extraction");
    f("stop", stop, "when no further feature is extracted from a view");
  }
};

struct FeatureOption {
  const ObservationModel* model = nullptr;
  const DivergenceTables* tables = nullptr;  ///< of this feature; null: none
  bool extracted = false;                    ///< from this view
};

struct FeatureSituation {
  const ObjectStates& database;
  const Eigen::VectorXd& belief;  ///< a probability per state
  std::span<const FeatureOption> features;
  std::optional<double> last_score = {};  ///< of the feature chosen before at this view, if any
  double weight = 1.0;                    ///< as InformationQuery::weight
};

struct FeatureScore {
  std::size_t feature = 0;
  InformationEstimate gain;
  double score = 0.0;  ///< gain in bits, or per second
};

enum class FeatureReason { first, best, not_worth_while, none_left };

struct FeatureDecision {
  std::optional<std::size_t> feature;  ///< none: stop
  FeatureReason reason = FeatureReason::none_left;
  std::vector<FeatureScore> scores;  ///< of every feature not extracted; none for the first one
  std::optional<double> score;       ///< of the chosen one, the `last_score` of the next decision
};

/// The best feature not extracted, of equal ones the cheaper, then the one before. Measures that
/// sample look at all features with the same random numbers.
/// @throws ConfigError if no feature is called `choice.first`.
FeatureDecision choose_feature(const FeatureChoice& choice, const FeatureSituation& situation,
                               Rng& rng);

}  // namespace vantage
