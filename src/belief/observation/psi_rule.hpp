/// How far each feature's density is believed: psi, the exponent on it.
///
/// Neighbouring bins of a histogram say the same thing twice, and the model takes them for
/// independent: with psi = 1 the first feature decides with certainty, right or wrong.
/// [Potthast2016, (4.10)]
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/belief/observation/observation_model.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

/// Views that no model was trained on, of known states.
struct HeldOutViews {
  std::vector<int> state;  ///< of each view
  int bins = 1;            ///< consecutive states that are one object
  /// Of each feature, states x views: log_density(); single precision up to a constant a view
  std::vector<Eigen::MatrixXf> log_density;
};

/// What a rule may look at.
struct PsiContext {
  std::span<const ObservationModel> models;  ///< one a feature
  const HeldOutViews& held_out;              ///< features in the same order
};

/// The temperature is for what the features repeat of each other. About states, the likelihood is
/// that of a logistic regression, concave in every psi. About objects it is not, but its derivative
/// falls from above zero to below, and where that happens is the answer.
struct CalibratedPsi {
  static constexpr std::string_view name = "calibrated";
  static constexpr StrategyText text{
      .summary =
          "Psi such that what views held out of training show is as likely as can be: each feature "
          "alone, then all times one temperature.",
      .formula = "argmax of the mean of ln p(truth | held-out view)"};
  /// Views between two bins are mistaken in pose however good a feature is.
  bool about_object = true;
  int joint_rounds = 0;
  void fields(auto&& f) {
    f("about_object", about_object,
      "true: the object is to be likely, whatever its yaw; false: its yaw bin too, which counts "
      "views between two bins against a feature");
    f("joint_rounds", joint_rounds,
      "rounds in which each psi is adjusted to all features together; higher is better where all "
      "features are extracted, worse where only some are",
      between(0, 100));
  }
  /// @throws InputError if no view was held out.
  [[nodiscard]] std::vector<double> operator()(const PsiContext& context) const;
};

struct PerDimensionPsi {
  static constexpr std::string_view name = "per_dimension";
  static constexpr StrategyText text{
      .summary =
          "Every feature is worth one dimension, whatever its size. Needs no held-out views.",
      .formula = "psi = 1 / dimensions"};
  void fields(auto&&) {}
  [[nodiscard]] std::vector<double> operator()(const PsiContext& context) const;
};

struct DissertationPsi {
  static constexpr std::string_view name = "dissertation";
  static constexpr StrategyText text{
      .summary = "The published factors, by the name of the feature.",
      .source = "Potthast2016, 4.5.1"};
  double colour = 1.0;
  double bounding_box = 0.02;
  double sift = 0.2;
  double vfh = 0.001;
  double other = 1.0;
  void fields(auto&& f) {
    f("colour", colour, "psi of the feature `colour`; higher trusts it more", at_least(0.0));
    f("bounding_box", bounding_box, "psi of the feature `bounding_box`; higher trusts it more",
      at_least(0.0));
    f("sift", sift, "psi of the feature `sift`; higher trusts it more", at_least(0.0));
    f("vfh", vfh, "psi of the feature `vfh`; higher trusts it more", at_least(0.0));
    f("other", other,
      "psi of all other features, such as kernel descriptors; higher trusts them more",
      at_least(0.0));
  }
  [[nodiscard]] std::vector<double> operator()(const PsiContext& context) const;
};

using PsiRule = std::variant<CalibratedPsi, PerDimensionPsi, DissertationPsi>;
template <>
inline constexpr std::string_view strategy_family<PsiRule> = "psi rule";

/// psi of each feature.
/// @throws ConfigError if `rule` is out of range, and what it throws itself.
std::vector<double> choose_psi(const PsiRule& rule, const PsiContext& context);

/// Mean over the held-out views of ln p(state | all features), from a uniform prior.
double mean_log_posterior(const HeldOutViews& held_out, std::span<const double> psi);

}  // namespace vantage
