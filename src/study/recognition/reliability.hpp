/// Whether what is held for probable is as often right.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vantage/information/resampling.hpp"
#include "vantage/recognition/evaluation/evaluation.hpp"
#include "vantage/study/figures/figure.hpp"

namespace vantage {

/// Trials of one object are alike, those of one view the same.
Clusters clusters_of_objects(std::span<const Trial> trials);

inline constexpr int kReliabilityBins = 15;

/// Of the trials whose estimate has a probability in one of the bins of equal width.
struct ReliabilityBin {
  std::size_t count = 0;
  std::size_t objects = 0;  ///< that they are of
  double confidence = 0.0;  ///< mean probability of the estimate
  double accuracy = 0.0;    ///< share that is right
  Interval interval;        ///< of the accuracy, 95 % bootstrap over objects
};

struct Reliability {
  std::array<ReliabilityBin, kReliabilityBins> bins;
  /// Expected calibration error: mean over the trials of |accuracy - confidence| of their bin.
  double error = 0.0;
  Interval error_interval = {};  ///< 95 % bootstrap over objects
  double confidence = 0.0;       ///< mean over all trials
  double accuracy = 0.0;         ///< share of all trials that is right
};

/// [GuoPleissSunWeinberger2017, (3)]. Trials of one object are alike: whole objects are resampled.
/// @param trials at least one
Reliability reliability_of(std::span<const Trial> trials, std::uint64_t seed);

/// A panel a group of methods, a line a method, and the diagonal.
struct ReliabilityPanel {
  std::string title;
  std::vector<std::pair<std::string, Reliability>> methods;
};
Figure reliability_figure(const std::vector<ReliabilityPanel>& panels);

}  // namespace vantage
