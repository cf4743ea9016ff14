/// Means with intervals, and paired differences of each level to a reference level.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

#include "vantage/information/resampling.hpp"
#include "vantage/runtime/measure.hpp"

namespace vantage {

/// A value of one episode. Samples of two levels belong together if they have the same `pair`;
/// those of one level and one pair are draws of the same, and their mean counts.
struct Sample {
  std::size_t panel = 0;
  std::size_t level = 0;
  std::size_t pair = 0;
  double value = 0.0;
  /// The same for samples that are alike, as those of one scene; none: its pair is alone.
  std::optional<std::size_t> cluster = {};
};

struct Difference {
  std::size_t pairs = 0;
  std::size_t clusters = 0;     ///< that they fall into
  double mean = 0.0;            ///< level - reference
  Interval interval;            ///< 95 % bootstrap
  std::optional<double> ratio;  ///< mean level / mean reference, if that is not 0
  std::optional<Interval> ratio_interval;
  double p_value = 1.0;  ///< sign-flip test, two-sided
};

struct ComparisonRow {
  std::string panel;
  std::string level;
  std::size_t count = 0;
  std::size_t clusters = 0;  ///< that they fall into: of one there is no interval
  double mean = 0.0;
  Interval interval;  ///< 95 % bootstrap of clusters
  double least = 0.0;
  double most = 0.0;
  std::optional<Difference> difference;  ///< none for the reference itself
};

struct Comparison {
  std::string name;   ///< of its files
  std::string title;  ///< what is compared, with unit and the direction that is better
  std::string reference;
  std::vector<ComparisonRow> rows;  ///< panel by panel, then "all"; levels without samples left out
  Better better = Better::unsaid;
  std::string cluster = {};  ///< factor whose levels are resampled; empty: pairs are
};

/// Deterministic: each number is drawn from a stream of its own, named by table, panel and level.
Comparison compare_levels(std::string name, std::string title,
                          const std::vector<std::string>& panels,
                          const std::vector<std::string>& levels, std::size_t reference,
                          const std::vector<Sample>& samples);

std::string comparison_csv(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace vantage
