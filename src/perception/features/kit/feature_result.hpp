/// What extracting a feature from a view comes to.
#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

#include "vantage/information/censored_gaussian.hpp"

namespace vantage {

/// Either a vector of finite numbers or the reason why there is none.
struct FeatureResult {
  Eigen::VectorXf vector;  ///< of the feature's dimension; empty if it was skipped
  std::string skipped;     ///< why; empty if it was extracted
  /// What each number of `vector` tells; empty: all are exact.
  std::vector<Reading> readings = {};
  /// What the likelihood's logarithm is multiplied by, (0, 1]: of a part that was seen of the
  /// object, which tells as much less of it as it is smaller.
  double weight = 1.0;

  [[nodiscard]] bool extracted() const { return skipped.empty(); }
  static FeatureResult skip(std::string reason) {
    return {.vector = {}, .skipped = std::move(reason)};
  }
};

}  // namespace vantage
