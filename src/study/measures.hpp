/// What a study looks at in an episode's metrics.json: numbers, and curves against scans.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct MeasureName {
  std::string_view name;   ///< column of results.csv
  std::string_view title;  ///< with unit
  bool wall = false;       ///< of wall time: another run gives another value
};

/// Numbers of an episode, in the order of the columns of results.csv.
const std::vector<MeasureName>& scalar_measures();
/// Curves against scans.
const std::vector<MeasureName>& curve_measures();

std::vector<std::string> scalar_names();
std::vector<std::string> curve_names();
/// Index in scalar_measures() or curve_measures(); none if there is none.
std::optional<std::size_t> find_scalar(std::string_view name);
std::optional<std::size_t> find_curve(std::string_view name);

using Curve = std::vector<double>;  ///< a value a scan

struct EpisodeMeasures {
  std::vector<std::optional<double>> scalars;  ///< as scalar_measures(); none: does not apply
  std::vector<Curve> curves;                   ///< as curve_measures()
  /// |predicted - actual new cells| of each gain, for every scan after the first.
  std::vector<std::pair<std::string, Curve>> prediction_errors;
};

/// @throws nlohmann::json::exception if metrics.json lacks what the contract promises.
EpisodeMeasures measure(const nlohmann::ordered_json& metrics, const Episode& episode);

}  // namespace vantage
