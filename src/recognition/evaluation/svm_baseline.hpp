/// What a discriminative classifier makes of the same features of a single view: a baseline.
/// It is trained on all objects at once and knows neither pose nor how sure it is.
#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

struct LinearSvm {
  static constexpr std::string_view name = "linear_svm";
  static constexpr StrategyText text{
      .summary =
          "Linear support vector machine on the features of a single view: a baseline that knows "
          "neither pose nor how sure it is."};
  double c = 10.0;
  void fields(auto&& f) {
    f("c", c, "weight of training errors; higher fits the training views closer", above(0.0));
  }
};

struct KernelSvm {
  static constexpr std::string_view name = "kernel_svm";
  static constexpr StrategyText text{
      .summary =
          "Support vector machine with a Gaussian kernel on the features of a single view: a "
          "slower, less linear baseline.",
      .formula = "kernel exp(-gamma |x - y|^2)"};
  double c = 10.0;
  double gamma = 1.0;
  void fields(auto&& f) {
    f("c", c, "weight of training errors; higher fits the training views closer", above(0.0));
    f("gamma", gamma,
      "gamma of the kernel exp(-gamma |x - y|^2), for vectors scaled to a mean square distance of "
      "1; "
      "higher is more local",
      above(0.0));
  }
};

using Svm = std::variant<LinearSvm, KernelSvm>;
template <>
inline constexpr std::string_view strategy_family<Svm> = "svm";

/// Views with a label each.
struct LabelledFeatures {
  std::span<const ViewFeatures> views;
  std::span<const int> label;
};

/// Label of each test view, one object against one; features are centred, scaled to equal
/// mean squares, and strung together. A view that lacks one has zeros in its place.
/// @throws ConfigError if options are out of range.
std::vector<int> svm_predictions(const Svm& svm, const LabelledFeatures& training,
                                 std::span<const ViewFeatures> test);

/// The label of the training view nearest to each test view, all features together, each centred
/// and scaled as for the machines: the plainest way there is.
std::vector<int> nearest_predictions(const LabelledFeatures& training,
                                     std::span<const ViewFeatures> test);

}  // namespace vantage
