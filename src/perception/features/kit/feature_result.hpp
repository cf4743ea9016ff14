/// What extracting a feature from a view comes to.
#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>

namespace vantage {

/// Either a vector of finite numbers or the reason why there is none.
struct FeatureResult {
  Eigen::VectorXf vector;  ///< of the feature's dimension; empty if it was skipped
  std::string skipped;     ///< why; empty if it was extracted

  [[nodiscard]] bool extracted() const { return skipped.empty(); }
  static FeatureResult skip(std::string reason) { return {{}, std::move(reason)}; }
};

}  // namespace vantage
