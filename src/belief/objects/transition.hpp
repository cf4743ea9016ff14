/// What becomes of the belief when the camera moves round the object: three models by name.
///
/// A motion is the yaw by which the object turns as the camera sees it, so that a belief in bin q
/// expects bin q + motion / bin_rad next. No motion, as between two features of one view, is no
/// transition in any of them: a belief must not leak while features are added.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "vantage/belief/objects/transition_kernel.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

/// Masses of groups, whatever the number of their members.  [Potthast2016, table 4.1]
struct TableTransition {
  static constexpr std::string_view name = "table";
  static constexpr StrategyText text{
      .summary =
          "The dissertation's table: fixed probabilities of the right yaw bin, the object's other "
          "bins, its category and all others.",
      .source = "Potthast2016, table 4.1"};
  double right_angle = 0.4;
  double wrong_angle = 0.3;
  double other_instance = 0.1;
  double other_category = 0.2;
  void fields(auto&& f) {
    f("right_angle", right_angle,
      "probability of the same object in the yaw bin that the motion leads to; the four "
      "probabilities sum to one",
      Range{0.0, 1.0, true});
    f("wrong_angle", wrong_angle,
      "probability of the object's other yaw bins together; higher trusts the motion less",
      between(0.0, 1.0));
    f("other_instance", other_instance,
      "probability of all other objects of its category together; higher forgets faster",
      between(0.0, 1.0));
    f("other_category", other_category,
      "probability of all objects of other categories together; higher forgets faster",
      between(0.0, 1.0));
  }
  void check() const;  ///< the masses sum to one
  [[nodiscard]] TransitionKernel kernel(double motion_rad, int bins) const;
};

/// A motion between two multiples of the bin is shared by the two bins next to it, in proportion.
struct RigidTransition {
  static constexpr std::string_view name = "rigid";
  static constexpr StrategyText text{
      .summary =
          "The object stays what it is, and its yaw changes as commanded, give or take a bin."};
  double slip = 0.1;
  void fields(auto&& f) {
    f("slip", slip,
      "probability of a yaw bin beside the expected one, half on either side; higher trusts the "
      "motion less",
      between(0.0, 1.0));
  }
  [[nodiscard]] TransitionKernel kernel(double motion_rad, int bins) const;
};

/// Learnt from sequences of views, see baum_welch.hpp. For each commanded motion, in whole bins,
/// the distribution of the slip, by how many bins the motion was another; and how much mass goes to
/// other objects. bins^2 + 2 free parameters, whatever the number of objects. A motion between two
/// multiples of the bin is a mixture of the two next to it.
struct LearnedTransition {
  static constexpr std::string_view name = "learned";
  static constexpr StrategyText text{
      .summary =
          "Learnt from sequences of views: how far the yaw slips at each commanded motion, and how "
          "often the object is taken for another. Without a `slip` of its own, what training has "
          "stored in the model.",
      .source = "Baum1970; Rabiner1989, III.C"};
  double same_object = 1.0;
  double other_instance = 0.0;
  double other_category = 0.0;
  std::vector<double> slip;
  void fields(auto&& f) {
    f("same_object", same_object,
      "probability that the object stays the same; sums to one with `other_instance` and "
      "`other_category`",
      between(0.0, 1.0));
    f("other_instance", other_instance,
      "probability of all other objects of its category together; higher forgets faster",
      between(0.0, 1.0));
    f("other_category", other_category,
      "probability of all objects of other categories together; higher forgets faster",
      between(0.0, 1.0));
    f("slip", slip,
      "p(slip | command) at index command * bins + slip, both in yaw bins; empty: as the model has "
      "learnt it, or else as `rigid`",
      between(0.0, 1.0));
  }
  void check() const;  ///< masses and every row of a square `slip` sum to one
  /// @throws ConfigError if `slip` was learnt with another number of bins.
  [[nodiscard]] TransitionKernel kernel(double motion_rad, int bins) const;
};

using TransitionModel = std::variant<TableTransition, RigidTransition, LearnedTransition>;
template <>
inline constexpr std::string_view strategy_family<TransitionModel> = "transition";

/// A motion as the two whole numbers of bins next to it.
struct MotionBins {
  int lower = 0;             ///< 0 .. bins - 1, as is `upper`
  int upper = 0;             ///< lower + 1, modulo bins
  double upper_share = 0.0;  ///< [0, 1): how far the motion is from `lower` to `upper`
};

/// @param motion_rad finite
MotionBins motion_bins(double motion_rad, int bins);

/// @param motion_rad finite; 0 is a full turn here, see the top
TransitionKernel kernel_of(const TransitionModel& model, double motion_rad, int bins);

}  // namespace vantage
