/// What a study reads from the metrics.json of an episode: numbers, and curves against its steps.
/// Each task lists its own.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vantage {

enum class Better { unsaid, lower, higher };
/// "lower is better"; empty where neither is.
std::string_view direction_text(Better better);

struct MeasureName {
  std::string_view name;   ///< column of results.csv
  std::string_view title;  ///< with unit
  Better better = Better::unsaid;
  bool wall = false;  ///< of wall time: another run gives another value
};

/// Its title and which direction is better.
std::string measure_text(const MeasureName& measure);

using Curve = std::vector<double>;  ///< a value a step, or along a CurveAxis

/// What every measure is taken of.
struct MeasuredEpisode {
  const nlohmann::ordered_json& metrics;
  std::size_t planned_steps = 0;  ///< as the task's extent says
};

struct ScalarMeasure {
  MeasureName name;
  std::optional<double> (*of)(const MeasuredEpisode& episode);  ///< none: does not apply
};
/// Along what a curve has its values.
struct CurveAxis {
  std::string_view label = {};  ///< with unit; empty: the steps of the task
  double first = 1.0;
  double step = 1.0;
};
struct CurveMeasure {
  MeasureName name;
  Curve (*of)(const MeasuredEpisode& episode);
  CurveAxis along = {};
};

/// |predicted - actual new cells| of each gain, for every scan after the first.
using PredictionErrors = std::vector<std::pair<std::string, Curve>>;

/// The measures of a task.
struct Measures {
  std::span<const ScalarMeasure> scalars;
  std::span<const CurveMeasure> curves = {};
  PredictionErrors (*prediction_errors)(const MeasuredEpisode& episode) = nullptr;
  std::span<const std::string_view> headlines = {};  ///< names of the scalars to look at first
};

/// Those that every task has.
extern const ScalarMeasure kPathLength;
extern const ScalarMeasure kCollisions;
extern const ScalarMeasure kSimulatedTime;

std::optional<double> mean_of(const Curve& values);  ///< none of none
/// A number or truth value; none if it is null.
std::optional<double> number_of(const MeasuredEpisode& episode, const char* key);
/// Of a run of an earlier version, which has no such key, none.
std::optional<double> number_if_measured(const MeasuredEpisode& episode, const char* key);
/// One value a step of a list in the metrics.
Curve step_values(const MeasuredEpisode& episode, const char* list, const char* key);

}  // namespace vantage
