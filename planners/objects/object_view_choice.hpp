/// From where to look at an object next, and when that is enough.
/// [Potthast2016, 4.4]
///
/// Motions are turns about the object; what is believed after each, before anything is measured
/// there, comes from the caller.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/planners/objects/information_measure.hpp"

namespace vantage {

struct RandomObjectView {
  static constexpr std::string_view name = "random";
  static constexpr StrategyText text{
      .summary = "Takes any view of the object, each as likely as the other. The baseline."};
  int draw = 0;
  void fields(auto&& f) {
    f("draw", draw,
      "which of the sequences of views that one seed has a flight takes; another for each of "
      "several flights that differ by nothing else",
      at_least(0));
  }
};

struct StarView {
  static constexpr std::string_view name = "star";
  static constexpr StrategyText text{
      .summary =
          "Takes the view most nearly opposite to the present one; as views are not taken twice, "
          "the way is a star.",
      .formula = "argmax of the turn about the object, at most half a turn",
      .source = "Potthast2016, 4.5.6"};
  void fields(auto&&) {}
};

struct NearestFreeView {
  static constexpr std::string_view name = "nearest_free";
  static constexpr StrategyText text{
      .summary =
          "Takes the view that is flown to soonest among those from which enough of the object is "
          "expected to be seen; if there is none, the one that sees most of it."};
  double min_visible = 0.5;
  void fields(auto&& f) {
    f("min_visible", min_visible,
      "share of the object's surface that is expected to be seen, from which a view counts as "
      "free; higher flies farther for a better sight",
      between(0.0, 1.0));
  }
};

/// A measure of information chooses the view that it rates highest.
using ObjectViewChoice =
    std::variant<MutualInformation, InformationUpperBound, MeanFeatureInformation,
                 MonteCarloInformation, LossOfEntropy, JeffreysDivergence, RandomObjectView,
                 StarView, NearestFreeView>;
template <>
inline constexpr std::string_view strategy_family<ObjectViewChoice> = "object view choice";

struct ObjectViewOptions {
  ObjectViewChoice choice = MutualInformation{};
  int states = 48;
  bool about_object = true;
  bool by_visibility = true;
  double weight_per_s = 0.0;
  double weight_per_m = 0.0;
  double weight_per_j = 0.0;
  double visited_weight = 0.0;
  void fields(auto&& f) {
    f("choice", choice,
      "how the next view is chosen: by a measure of information, at random, or from opposite");
    f("states", states,
      "number of the most probable states that are told apart; higher is more exact, at its square "
      "in time",
      between(1, 100'000));
    f("about_object", about_object,
      "true: only information about the object counts; false: about its yaw as well");
    f("by_visibility", by_visibility,
      "true: information counts times the share of the object that the map says will be seen; "
      "where nothing is mapped, all of it; false: whatever stands in the way");
    f("weight_per_s", weight_per_s,
      "weight of a motion's time in the cost that gains are divided by; higher prefers quick "
      "motions; all weights 0: gains as they are",
      at_least(0.0));
    f("weight_per_m", weight_per_m,
      "weight of a motion's path length in the cost that gains are divided by; higher prefers "
      "short ways",
      at_least(0.0));
    f("weight_per_j", weight_per_j,
      "weight of a motion's energy in the cost that gains are divided by; higher prefers frugal "
      "motions",
      at_least(0.0));
    f("visited_weight", visited_weight,
      "factor on the score of a view that was taken before; higher takes it again more readily; 0: "
      "not while others are left",
      between(0.0, 1.0));
  }
};

/// For actions that cost nothing: a gain cannot be divided by that.
/// @param where `options` are, "recognition.views"
/// @throws ConfigError naming the key of a weight that is not 0
void require_no_weights(const ObjectViewOptions& options, std::string_view where);

struct ObjectViewAction {
  double yaw_rad = 0.0;  ///< turn about the object from where the sensor is
  double time_s = 0.0;
  double path_m = 0.0;
  double energy_j = 0.0;
  bool visited = false;  ///< the view it leads to was taken before
  double visible = 1.0;  ///< share of the object's surface that is expected to be seen there
};

struct ObjectViewSituation {
  const ObjectStates& database;
  FeatureModels features;                     ///< that will be extracted at the view
  const DivergenceTables* tables = nullptr;   ///< of these features together; null: none
  std::span<const ObjectViewAction> actions;  ///< at least one
  std::span<const Eigen::VectorXd>
      predicted_belief;  ///< after each action, a probability per state
  double weight = 1.0;   ///< as InformationQuery::weight
};

struct ObjectViewScore {
  InformationEstimate gain;  ///< 0 of choices that do not ask for information
  double cost = 1.0;         ///< what the gain was divided by
  double score = 0.0;        ///< what the choice compares; -inf: left out
};

/// The random numbers that a choice draws in a flight of that seed.
Rng choice_stream(const ObjectViewChoice& choice, std::uint64_t seed);

struct ObjectViewDecision {
  std::size_t action = 0;
  std::vector<ObjectViewScore> scores;  ///< of each action
};

/// The action with the highest score, of equal ones the first. Measures that sample look at all
/// actions with the same random numbers, so that differences are less noisy than values.
ObjectViewDecision choose_object_view(const ObjectViewOptions& options,
                                      const ObjectViewSituation& situation, Rng& rng);

/// Scores of views that were taken before, as `visited_weight` has them while others are left. The
/// choice above does so among its own actions; where all of those were taken but there are others
/// elsewhere, whoever compares them does.
void discount_visited(const ObjectViewOptions& options, std::span<const ObjectViewAction> actions,
                      std::span<ObjectViewScore> scores);

/// When to look no further.
struct EnoughViews {
  double object_probability = 0.9;
  double entropy_bits = 0.1;
  void fields(auto&& f) {
    f("object_probability", object_probability,
      "probability of an object, whatever its yaw, or of an unknown one, above which no further "
      "view "
      "is taken; higher takes more views",
      Range{0.0, 1.0, true});
    f("entropy_bits", entropy_bits,
      "entropy of the state, object and yaw bin, below which no further view is taken; lower takes "
      "more views",
      at_least(0.0));
  }
};

enum class EnoughReason { probability, entropy };

/// An object is more probable, or the state less uncertain, than `enough` asks for; none: look on.
/// That it is unknown is an answer like any object.
/// @param belief a probability per state
std::optional<EnoughReason> seen_enough(const EnoughViews& enough, const ObjectStates& database,
                                        const Eigen::VectorXd& belief);

}  // namespace vantage
