/// How well changes of objects of a dataset are detected: unchanged, another object, turned.
/// [Potthast2016, tables 4.10-4.15]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/recognition/change_detection.hpp"
#include "vantage/recognition/evaluation/evaluation.hpp"

namespace vantage {

struct ChangeTrial {
  Change decision = Change::none;
  double p_changed = 0.0;
  int observations = 0;
  double time_s = 0.0;  ///< of features and choices
  bool detectable =
      false;  ///< the model tells what is expected from what is there: distinguishable()
};

struct ChangeTrials {
  std::string method;  ///< of choosing views
  Change scenario = Change::none;
  std::vector<ChangeTrial> trials;  ///< one a start

  /// Share that was held for changed if it was, and for unchanged if it was not.
  [[nodiscard]] double accuracy() const;
  /// The same of the changes that are detectable, NaN if none is; of all where there is no change.
  [[nodiscard]] double detectable_accuracy() const;
  [[nodiscard]] double detectable_share() const;
  /// Share whose decision is the scenario.
  [[nodiscard]] double kind_accuracy() const;
};

/// From each start, an object that is as expected, one where another was expected in any pose, and
/// one that was turned by one to seven bins; by each published choice of views.
std::vector<ChangeTrials> evaluate_changes(const Recogniser& recogniser, const TestViews& test,
                                           std::span<const Eigen::MatrixXf> log_likelihood,
                                           std::span<const Start> starts,
                                           const ChangeOptions& options, std::uint64_t seed,
                                           const LongWork& how);

}  // namespace vantage
