/// How well unknown objects are told from known ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/information/resampling.hpp"
#include "vantage/recognition/evaluation/evaluation.hpp"

namespace vantage {

/// Probability that a value drawn of `high` is above one of `low`; equal ones count half. The area
/// under the receiver operating characteristic.  [HanleyMcNeil1982]
/// @param high, low at least one each
double area_under_curve(std::span<const double> high, std::span<const double> low);

/// The threshold that at least so large a share of `values` is above or at.
/// @param values at least one
double found_above(std::vector<double> values, double share);

/// By the probability of `unknown`; shares, with 95 % bootstrap intervals over objects.
struct UnknownDetection {
  double area = 0.0;  ///< area_under_curve()
  Interval area_interval = {};
  double threshold = 0.0;     ///< at which 90 % of the unknown ones are found
  double false_alarms = 0.0;  ///< share of known objects above it
  Interval false_alarms_interval = {};
  double found = 0.0;         ///< share of unknown objects that are held for unknown: above 0.5
  double known_missed = 0.0;  ///< share of known ones that are
  /// Of the unknown objects found: share whose category is right, where the model has it, and held
  /// for of none of the model's, where it has not. NaN: there are none.
  double category_known_right = 0.0;
  double category_unknown_right = 0.0;
};

struct UnknownTrials {
  std::vector<Trial> trials;
  std::vector<bool> category_known;  ///< of each trial, whether the model has its category
};

/// @param known trials of known objects, at least one; as many of unknown ones
UnknownDetection detection_of(std::span<const Trial> known, const UnknownTrials& unknown,
                              std::uint64_t seed);

}  // namespace vantage
