#include "vantage/tasks/mapping/mapping_metrics.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/runtime/json.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
using Scalar = std::optional<double>;

Json scan_json(const ScanRecord& scan) {
  Json predicted = Json::object();
  for (const auto& [gain, cells] : scan.predicted_cells) predicted[gain] = cells;
  return {{"time_s", scan.time_s},
          {"unobserved_cells", scan.unobserved_cells},
          {"observable_unobserved_cells", scan.observable_unobserved_cells},
          {"predicted", predicted},
          {"actual_new_cells", scan.actual_new_cells},
          {"chosen_view", scan.chosen_view},
          {"candidates", scan.candidates},
          {"plan_time_s", scan.plan_time_s},
          {"map_time_s", scan.map_time_s},
          {"scan_time_s", scan.scan_time_s},
          {"path_length_m", scan.path_length_m},
          {"leg_length_m", scan.leg_length_m},
          {"pose_error_m", scan.pose_error_m},
          {"pose_error_before_registration_m", scan.pose_error_before_registration_m},
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
  return episode.metrics.at("map").at(key).get<double>();
}

const auto kScalars = std::to_array<ScalarMeasure>({
    {{"area", "area under the curve of observable cells left, scans"},
     [](const MeasuredEpisode& e) { return area_from(e, 1); }},
    {{"area_from_scan_2",
      "area under the curve of observable cells left from the second scan on, the first chosen by "
      "the method, scans"},
     [](const MeasuredEpisode& e) { return area_from(e, 2); }},
    {{"observed_share", "share of the observable cells observed at the end"}, observed_share},
    {{"scans_to_95", "scans until 95 % of the observable cells are observed"}, scans_to_95},
    {{"prediction_error_cells", "mean error of the method's own prediction, cells"},
     own_prediction_error},
    {{"scans", "scans taken"},
     [](const MeasuredEpisode& e) -> Scalar {
       return static_cast<double>(e.metrics.at("scans").size());
     }},
    {{"fallbacks", "views out of reach"}, fallbacks},
    kPathLength,
    kCollisions,
    {{"precision", "precision of occupied cells"},
     [](const MeasuredEpisode& e) { return map_score(e, "precision"); }},
    {{"recall", "recall of occupied cells"},
     [](const MeasuredEpisode& e) { return map_score(e, "recall"); }},
    {{"pose_error_m", "mean position error after registration, m"},
     [](const MeasuredEpisode& e) { return mean_of(scan_values(e, "pose_error_m")); }},
    {{"pose_error_before_registration_m", "mean position error before registration, m"},
     [](const MeasuredEpisode& e) {
       return mean_of(scan_values(e, "pose_error_before_registration_m"));
     }},
    kSimulatedTime,
});

constexpr auto kHeadlines =
    std::to_array<std::string_view>({"observed_share", "scans", "path_length_m", "simulated_time_s",
                                     "precision", "recall", "collisions"});

constexpr auto kCurves = std::to_array<CurveMeasure>({
    {{"unobserved_cells", "unobserved cells"},
     [](const MeasuredEpisode& e) { return scan_values(e, "unobserved_cells"); }},
    {{"observable_unobserved_cells", "observable cells left"},
     [](const MeasuredEpisode& e) { return scan_values(e, "observable_unobserved_cells"); }},
    {{"share_left", "share of the observable cells left"}, share_left},
    {{"distance_m", "distance travelled, m"},
     [](const MeasuredEpisode& e) { return scan_values(e, "path_length_m"); }},
    {{"pose_error_m", "position error, m"},
     [](const MeasuredEpisode& e) { return scan_values(e, "pose_error_m"); }},
    {{"precision", "precision of occupied cells"},
     [](const MeasuredEpisode& e) { return scan_values(e, "precision"); }},
    {{"recall", "recall of occupied cells"},
     [](const MeasuredEpisode& e) { return scan_values(e, "recall"); }},
});

}  // namespace

void add_mapping_metrics(const MappingOptions& options, const MappingResult& run, Json& metrics) {
  const int tolerance_cells = options.metrics.tolerance_cells;
  const MapScore map = run.evaluator.score(run.grid, tolerance_cells);
  metrics["observable_cells"] = run.evaluator.observable_cells();
  metrics["scans"] = Json::array();
  for (const ScanRecord& scan : run.scans) metrics["scans"].push_back(scan_json(scan));
  metrics["map"] = {
      {"precision", map.precision}, {"recall", map.recall}, {"tolerance_cells", tolerance_cells}};
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
  return fmt::format(
      "{}: {} after {} scans, {:.1f} % of the observable cells observed\n"
      "path {:.2f} m, {} collisions, map precision {:.3f}, recall {:.3f}, {:.1f} x real time\n",
      metrics["method"].get<std::string>(), metrics["status"].get<std::string>(), scans.size(),
      total > 0.0 ? 100.0 * (1.0 - left / total) : 0.0, metrics["path_length_m"].get<double>(),
      metrics["collisions"].get<int>(), metrics["map"]["precision"].get<double>(),
      metrics["map"]["recall"].get<double>(), metrics["real_time_factor"].get<double>());
}

Measures mapping_measures() { return {kScalars, kCurves, prediction_errors, kHeadlines}; }

}  // namespace vantage
