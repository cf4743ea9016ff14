#include "vantage/tasks/mapping/measures/forecast_measures.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Former runs have none.
Json bands_of(const Json& scan) { return scan.value("by_distance", Json::array()); }

/// Cells of one scan between two distances from the sensor: forecast by `adaptive`, and seen.
std::pair<double, double> forecast_of(const Json& scan, double from_m, double to_m) {
  std::pair<double, double> cells{0.0, 0.0};
  for (const Json& band : bands_of(scan)) {
    const double middle_m =
        band.at("to_m").is_null()
            ? std::numeric_limits<double>::infinity()
            : 0.5 * (band.at("from_m").get<double>() + band.at("to_m").get<double>());
    if (middle_m < from_m || (middle_m >= to_m && std::isfinite(to_m))) continue;
    cells.first += band.at("predicted_cells").get<double>();
    cells.second += band.at("actual_cells").get<double>();
  }
  return cells;
}

std::optional<double> ratio_of(const std::pair<double, double>& cells) {
  return cells.second > 0.0 ? cells.first / cells.second : std::optional<double>();
}

}  // namespace

std::optional<double> forecast_ratio(const MeasuredEpisode& episode, double from_m, double to_m) {
  const Json& scans = episode.metrics.at("scans");
  std::pair<double, double> sum{0.0, 0.0};
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const auto [predicted, actual] = forecast_of(scans[k], from_m, to_m);
    sum.first += predicted;
    sum.second += actual;
  }
  return ratio_of(sum);
}

Curve forecast_ratios(const MeasuredEpisode& episode) {
  Curve ratios;
  for (const Json& scan : episode.metrics.at("scans")) {
    if (bands_of(scan).empty()) return {};
    const auto [predicted, actual] =
        forecast_of(scan, 0.0, std::numeric_limits<double>::infinity());
    ratios.push_back((predicted + 1.0) / (actual + 1.0));
  }
  return ratios;
}

std::optional<double> interval_coverage(const MeasuredEpisode& episode) {
  double asked = 0.0;
  double within = 0.0;
  for (const Json& scan : episode.metrics.at("scans")) {
    const Json forecast = scan.value("forecast", Json());
    if (forecast.is_null()) continue;
    const double actual = scan.at("actual_new_cells").get<double>();
    ++asked;
    if (forecast.at("low_cells").get<double>() <= actual &&
        actual <= forecast.at("high_cells").get<double>()) {
      ++within;
    }
  }
  return ratio_of({within, asked});
}

std::optional<double> stop_confidence(const MeasuredEpisode& episode) {
  const Json& scans = episode.metrics.at("scans");
  const Json left = scans.empty() ? Json() : scans.back().value("left", Json());
  return left.is_null() ? std::optional<double>() : left.at("confidence").get<double>();
}

std::optional<double> outside_share(const MeasuredEpisode& episode) {
  std::pair<double, double> sum{0.0, 0.0};
  for (const Json& scan : episode.metrics.at("scans")) {
    for (const Json& band : bands_of(scan)) {
      sum.first += band.at("outside_cells").get<double>();
      sum.second += band.at("actual_cells").get<double>();
    }
  }
  return ratio_of(sum);
}

}  // namespace vantage
