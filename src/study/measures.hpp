/// What a study looks at in the metrics.json of episodes: the measures of all tasks, as columns.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/runtime/measure.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {

/// Numbers of an episode, in the order of the columns of results.csv.
const std::vector<MeasureName>& scalar_measures();
const std::vector<MeasureName>& curve_measures();
/// Along what the one of that index has its values.
const CurveAxis& curve_axis(std::size_t curve);

std::vector<std::string> scalar_names();
std::vector<std::string> curve_names();
/// Index in scalar_measures() or curve_measures(); none if there is none.
std::optional<std::size_t> find_scalar(std::string_view name);
std::optional<std::size_t> find_curve(std::string_view name);

struct EpisodeMeasures {
  std::vector<std::optional<double>> scalars;  ///< as scalar_measures(); none: does not apply
  std::vector<Curve> curves;                   ///< as curve_measures(); empty: does not apply
  PredictionErrors prediction_errors;
};

/// @throws nlohmann::json::exception if metrics.json lacks what the contract promises.
EpisodeMeasures measure(const nlohmann::ordered_json& metrics, const ResolvedEpisode& resolved);

}  // namespace vantage
