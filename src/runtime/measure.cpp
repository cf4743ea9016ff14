#include "vantage/runtime/measure.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vantage/information/resampling.hpp"

namespace vantage {

const ScalarMeasure kPathLength{
    {"path_length_m", "path length, m", Better::lower},
    [](const MeasuredEpisode& episode) { return number_of(episode, "path_length_m"); }};
const ScalarMeasure kCollisions{
    {"collisions", "collisions", Better::lower},
    [](const MeasuredEpisode& episode) { return number_of(episode, "collisions"); }};
const ScalarMeasure kSimulatedTime{
    {"simulated_time_s", "simulated time, s", Better::lower},
    [](const MeasuredEpisode& episode) { return number_of(episode, "simulated_time_s"); }};

std::string_view direction_text(Better better) {
  switch (better) {
    case Better::lower: return "lower is better";
    case Better::higher: return "higher is better";
    case Better::unsaid: break;
  }
  return {};
}

std::string measure_text(const MeasureName& measure) {
  std::string text(measure.title);
  if (measure.better != Better::unsaid) text += fmt::format(", {}", direction_text(measure.better));
  return text;
}

std::optional<double> mean_of(const Curve& values) {
  return values.empty() ? std::optional<double>() : mean(values);
}

std::optional<double> number_of(const MeasuredEpisode& episode, const char* key) {
  const auto& value = episode.metrics.at(key);
  if (value.is_null()) return {};
  return value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>();
}

std::optional<double> number_if_measured(const MeasuredEpisode& episode, const char* key) {
  if (!episode.metrics.contains(key)) return {};
  return number_of(episode, key);
}

Curve step_values(const MeasuredEpisode& episode, const char* list, const char* key) {
  Curve values;
  for (const auto& step : episode.metrics.at(list)) values.push_back(step.at(key).get<double>());
  return values;
}

}  // namespace vantage
