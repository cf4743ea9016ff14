#include "vantage/tasks/mapping/mapping_metrics.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/runtime/json.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/mapping/forecast_measures.hpp"
#include "vantage/tasks/mapping/progress_measures.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
using Scalar = std::optional<double>;

Json bands_json(const std::vector<PredictionBand>& bands) {
  Json rows = Json::array();
  for (const PredictionBand& band : bands) {
    rows.push_back({{"from_m", band.from_m},
                    {"to_m", std::isfinite(band.to_m) ? Json(band.to_m) : Json()},
                    {"predicted_cells", band.predicted_cells},
                    {"actual_cells", band.actual_cells},
                    {"outside_cells", band.outside_cells}});
  }
  return rows;
}

Json scan_json(const ScanRecord& scan) {
  Json predicted = Json::object();
  for (const auto& [gain, cells] : scan.predicted_cells) predicted[gain] = cells;
  return {{"time_s", scan.time_s},
          {"unobserved_cells", scan.unobserved_cells},
          {"observable_unobserved_cells", scan.observable_unobserved_cells},
          {"predicted", predicted},
          {"actual_new_cells", scan.actual_new_cells},
          {"by_distance", bands_json(scan.by_distance)},
          {"hazard_scale", scan.hazard_scale},
          {"chosen_view", scan.chosen_view},
          {"candidates", scan.candidates},
          {"plan_time_s", scan.plan_time_s},
          {"map_time_s", scan.map_time_s},
          {"scan_time_s", scan.scan_time_s},
          {"energy_j", scan.energy_j},
          {"path_length_m", scan.path_length_m},
          {"leg_length_m", scan.leg_length_m},
          {"pose_error_m", scan.pose_error_m},
          {"pose_error_before_registration_m", scan.pose_error_before_registration_m},
          {"pose_error_tracked_m", scan.pose_error_tracked_m},
          {"yaw_error_rad", scan.yaw_error_rad},
          {"map_sigma_m", scan.map_sigma_m},
          {"registered", scan.registered},
          {"unconstrained", scan.unconstrained},
          {"fallback", scan.fallback},
          {"collisions", scan.collisions},
          {"precision", scan.precision},
          {"recall", scan.recall},
          {"view", view_json(scan.T_world_sensor)}};
}

Json localisation_json(const MappingOptions& options, std::span<const ScanRecord> scans) {
  double sigma_m = 0.0;
  int registered = 0;
  for (const ScanRecord& scan : scans) {
    sigma_m = std::max(sigma_m, scan.map_sigma_m);
    registered += scan.registered ? 1 : 0;
  }
  const double tolerance_m = map_tolerance_m(options);
  return {{"map_sigma_m", sigma_m},
          {"tolerance_m", tolerance_m},
          {"trusted", sigma_m <= tolerance_m},
          {"registered_scans", registered}};
}

/// The transmission that the gain in use assumes for an unobserved cell; null if it assumes none.
Json observability(const MappingOptions& options, const ClutterHazard& hazard) {
  if (std::holds_alternative<AdaptiveGain>(options.gain)) return hazard.global_transmission();
  const auto assumed = transmission_unobserved(options.gain);
  return assumed ? Json(*assumed) : Json();
}

Curve scan_values(const MeasuredEpisode& episode, const char* key) {
  return step_values(episode, "scans", key);
}

Curve share_left(const MeasuredEpisode& episode) {
  Curve shares = scan_values(episode, "observable_unobserved_cells");
  const double all = episode.metrics.at("observable_cells").get<double>();
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

PredictionErrors prediction_errors(const MeasuredEpisode& episode) {
  PredictionErrors errors;
  const Json& scans = episode.metrics.at("scans");
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const double actual = scans[k].at("actual_new_cells").get<double>();
    const Json& predicted = scans[k].at("predicted");
    if (errors.empty()) {
      for (const auto& [gain, cells] : predicted.items()) errors.emplace_back(gain, Curve{});
    }
    for (auto& [gain, curve] : errors) {
      curve.push_back(std::abs(predicted.at(gain).get<double>() - actual));
    }
  }
  return errors;
}

/// Sum over the planned scans, from number `first` on (counted from 1), of the share of observable
/// cells left; an episode that ends early has learnt all it could, so its last share counts for the
/// rest.
Scalar area_from(const MeasuredEpisode& episode, std::size_t first) {
  const Curve shares = share_left(episode);
  if (shares.empty()) return {};
  double sum = 0.0;
  for (std::size_t k = first - 1; k < episode.planned_steps; ++k) {
    sum += shares[std::min(k, shares.size() - 1)];
  }
  return sum;
}

Scalar observed_share(const MeasuredEpisode& episode) {
  const Curve shares = share_left(episode);
  return shares.empty() ? Scalar{} : 1.0 - shares.back();
}

/// An episode that never gets there counts with all its planned scans.
Scalar scans_to_95(const MeasuredEpisode& episode) {
  const Curve shares = share_left(episode);
  if (shares.empty()) return {};
  const auto there = std::ranges::find_if(shares, [](double share) { return share <= 0.05; });
  return there == shares.end() ? static_cast<double>(episode.planned_steps)
                               : static_cast<double>(there - shares.begin() + 1);
}

/// Of the gain the method itself goes by, if it goes by one.
Scalar own_prediction_error(const MeasuredEpisode& episode) {
  const auto method = episode.metrics.at("method").get<std::string>();
  for (const auto& [gain, curve] : prediction_errors(episode)) {
    if (gain == method && !curve.empty()) return mean_of(curve);
  }
  return {};
}

Scalar fallbacks(const MeasuredEpisode& episode) {
  double count = 0.0;
  for (const Json& scan : episode.metrics.at("scans")) {
    count += scan.at("fallback").get<bool>() ? 1.0 : 0.0;
  }
  return count;
}

Scalar map_score(const MeasuredEpisode& episode, const char* key) {
  const Json& value = episode.metrics.at("map").at(key);
  return value.is_null() ? Scalar{} : value.get<double>();
}

const auto kScalars = std::to_array<ScalarMeasure>({
    {{"area", "area under the curve of observable cells left, scans", Better::lower},
     [](const MeasuredEpisode& e) { return area_from(e, 1); }},
    {{"area_from_scan_2",
      "area under the curve of observable cells left from the second scan on, the first chosen by "
      "the method, scans",
      Better::lower},
     [](const MeasuredEpisode& e) { return area_from(e, 2); }},
    {{"observed_share", "share of the observable cells observed at the end", Better::higher},
     observed_share},
    {{"scans_to_95", "scans until 95 % of the observable cells are observed", Better::lower},
     scans_to_95},
    {{"reached_95", "whether 95 % of the observable cells were observed", Better::higher},
     reached_95},
    {{"time_to_80_s", "simulated time until 80 % are observed, s", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "time_to_80_s"); }},
    {{"time_to_90_s", "simulated time until 90 % are observed, s", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "time_to_90_s"); }},
    {{"time_to_95_s", "simulated time until 95 % are observed, s", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "time_to_95_s"); }},
    {{"time_to_97_s", "simulated time until 97 % are observed, s", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "time_to_97_s"); }},
    {{"path_to_80_m", "way driven until 80 % are observed, m", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "path_to_80_m"); }},
    {{"path_to_90_m", "way driven until 90 % are observed, m", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "path_to_90_m"); }},
    {{"path_to_95_m", "way driven until 95 % are observed, m", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "path_to_95_m"); }},
    {{"path_to_97_m", "way driven until 97 % are observed, m", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "path_to_97_m"); }},
    {{"area_over_time", "area under the curve of observable cells left against simulated time, s",
      Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "area_over_time"); }},
    {{"prediction_error_cells", "mean error of the method's own prediction, cells", Better::lower},
     own_prediction_error},
    {{"forecast_ratio", "cells forecast by adaptive over cells seen, from scan 2 on"},
     [](const MeasuredEpisode& e) { return forecast_ratio(e); }},
    {{"forecast_ratio_to_1_m", "the same of cells up to 1 m from the sensor"},
     [](const MeasuredEpisode& e) { return forecast_ratio(e, 0.0, 1.0); }},
    {{"forecast_ratio_to_2_m", "the same from 1 to 2 m"},
     [](const MeasuredEpisode& e) { return forecast_ratio(e, 1.0, 2.0); }},
    {{"forecast_ratio_to_3_m", "the same from 2 to 3 m"},
     [](const MeasuredEpisode& e) { return forecast_ratio(e, 2.0, 3.0); }},
    {{"forecast_ratio_beyond_3_m", "the same beyond 3 m"},
     [](const MeasuredEpisode& e) { return forecast_ratio(e, 3.0); }},
    {{"outside_share", "share of newly seen cells outside the field that forecasts are for"},
     outside_share},
    {{"scans", "scans taken"},
     [](const MeasuredEpisode& e) -> Scalar {
       return static_cast<double>(e.metrics.at("scans").size());
     }},
    {{"fallbacks", "views out of reach", Better::lower}, fallbacks},
    kPathLength,
    {{"energy_j", "energy used, J", Better::lower},
     [](const MeasuredEpisode& e) { return number_if_measured(e, "energy_j"); }},
    kCollisions,
    {{"precision", "precision of occupied cells", Better::higher},
     [](const MeasuredEpisode& e) { return map_score(e, "precision"); }},
    {{"recall", "recall of occupied cells", Better::higher},
     [](const MeasuredEpisode& e) { return map_score(e, "recall"); }},
    {{"pose_error_m", "mean error of the position that scans were taken into the map at, m",
      Better::lower},
     [](const MeasuredEpisode& e) { return mean_of(scan_values(e, "pose_error_m")); }},
    {{"pose_error_before_registration_m",
      "mean position error of the wheels alone since the scan before, m", Better::lower},
     [](const MeasuredEpisode& e) {
       return mean_of(scan_values(e, "pose_error_before_registration_m"));
     }},
    kSimulatedTime,
});

constexpr auto kHeadlines =
    std::to_array<std::string_view>({"observed_share", "scans", "path_length_m", "simulated_time_s",
                                     "precision", "recall", "collisions"});

constexpr auto kCurves = std::to_array<CurveMeasure>({
    {{"unobserved_cells", "unobserved cells", Better::lower},
     [](const MeasuredEpisode& e) { return scan_values(e, "unobserved_cells"); }},
    {{"observable_unobserved_cells", "observable cells left", Better::lower},
     [](const MeasuredEpisode& e) { return scan_values(e, "observable_unobserved_cells"); }},
    {{"share_left", "share of the observable cells left", Better::lower}, share_left},
    {{"share_left_over_time", "share of the observable cells left every 20 s", Better::lower},
     share_left_over_time},
    {{"share_left_over_path", "share of the observable cells left every metre", Better::lower},
     share_left_over_path},
    {{"forecast_ratio", "cells forecast by adaptive over cells seen"}, forecast_ratios},
    {{"distance_m", "distance travelled, m", Better::lower},
     [](const MeasuredEpisode& e) { return scan_values(e, "path_length_m"); }},
    {{"pose_error_m", "position error, m", Better::lower},
     [](const MeasuredEpisode& e) { return scan_values(e, "pose_error_m"); }},
    {{"precision", "precision of occupied cells", Better::higher},
     [](const MeasuredEpisode& e) { return scan_values(e, "precision"); }},
    {{"recall", "recall of occupied cells", Better::higher},
     [](const MeasuredEpisode& e) { return scan_values(e, "recall"); }},
});

}  // namespace

void add_mapping_metrics(const MappingOptions& options, const MappingResult& run, Json& metrics) {
  const int tolerance_cells = options.metrics.tolerance_cells;
  const MapScore map = run.evaluator.score(run.grid, tolerance_cells);
  metrics["observable_cells"] = run.evaluator.observable_cells();
  metrics["scans"] = Json::array();
  for (const ScanRecord& scan : run.scans) metrics["scans"].push_back(scan_json(scan));
  add_progress(run.scans, run.evaluator.observable_cells(), metrics);
  const auto score = [&](double value) { return run.scans.empty() ? Json() : Json(value); };
  metrics["map"] = {{"precision", score(map.precision)},
                    {"recall", score(map.recall)},
                    {"tolerance_cells", tolerance_cells}};
  metrics["observability"] = observability(options, run.hazard);
  metrics["observability_per_slice"] = run.hazard.transmission_per_slice();
  metrics["localisation"] = localisation_json(options, run.scans);
  metrics["region"] = box_json(run.grid.frame.box());
  metrics["candidates"] = candidates_json(run.views);
}

std::string mapping_outcome(const Json& metrics) {
  const auto& scans = metrics["scans"];
  const auto total = metrics["observable_cells"].get<double>();
  const double left =
      scans.empty() ? total : scans.back()["observable_unobserved_cells"].get<double>();
  const auto score = [&](const char* key) {
    const Json& value = metrics["map"][key];
    return value.is_null() ? std::string("unknown") : fmt::format("{:.3f}", value.get<double>());
  };
  return fmt::format(
      "{}: {} after {} scans, {:.1f} % of the observable cells observed\n"
      "path {:.2f} m, {} collisions, map precision {}, recall {}, {:.1f} x real time\n",
      metrics["method"].get<std::string>(), metrics["status"].get<std::string>(), scans.size(),
      total > 0.0 ? 100.0 * (1.0 - left / total) : 0.0, metrics["path_length_m"].get<double>(),
      metrics["collisions"].get<int>(), score("precision"), score("recall"),
      metrics["real_time_factor"].get<double>());
}

Measures mapping_measures() { return {kScalars, kCurves, prediction_errors, kHeadlines}; }

}  // namespace vantage
