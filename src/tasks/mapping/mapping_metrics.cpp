#include "vantage/tasks/mapping/mapping_metrics.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/runtime/json.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/mapping/measures/progress_measures.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

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

Json forecast_json(const std::optional<ForecastRecord>& forecast) {
  if (!forecast) return {};
  return {{"cells", forecast->cells},
          {"low_cells", forecast->interval.low},
          {"high_cells", forecast->interval.high}};
}

Json left_json(const std::optional<LeftRecord>& left) {
  if (!left) return {};
  return {{"expected_cells", left->expected_cells},
          {"share", left->share},
          {"confidence", left->confidence}};
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
          {"forecast", forecast_json(scan.forecast)},
          {"left", left_json(scan.left)},
          {"hazard_scale", scan.hazard_scale},
          {"chosen_view", scan.chosen_view},
          {"candidates", scan.candidates},
          {"plan_time_s", scan.plan_time_s},
          {"map_time_s", scan.map_time_s},
          {"scan_time_s", scan.scan_time_s},
          {"scan_share", scan.scan_share},
          {"images_on_the_way", scan.images_on_the_way},
          {"energy_j", scan.energy_j},
          {"path_length_m", scan.path_length_m},
          {"leg_length_m", scan.leg_length_m},
          {"pose_error_m", scan.pose_error_m},
          {"pose_error_before_registration_m", scan.pose_error_before_registration_m},
          {"pose_error_tracked_m", scan.pose_error_tracked_m},
          {"pose_error_at_scan_m", scan.pose_error_at_scan_m},
          {"yaw_error_rad", scan.yaw_error_rad},
          {"pose_sigma_m", scan.pose_sigma_m},
          {"map_sigma_m", scan.map_sigma_m},
          {"registered", scan.registered},
          {"unconstrained", scan.unconstrained},
          {"fallback", scan.fallback},
          {"collisions", scan.collisions},
          {"precision", scan.precision},
          {"recall", scan.recall},
          {"view", view_json(scan.T_world_sensor)}};
}

Json localisation_json(const MappingOptions& options, std::span<const ScanRecord> scans,
                       const LocalisationSummary& summary) {
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
          {"registered_scans", registered},
          {"pose_sigma_m", summary.pose_sigma_m},
          {"loops", summary.loops},
          {"loops_refused", summary.loops_refused},
          {"corrections", summary.corrections},
          {"contradicted_share",
           summary.contradicted_share ? Json(*summary.contradicted_share) : Json()},
          {"map_in_doubt", sigma_m > tolerance_m || !summary.doubt.empty()},
          {"doubt", summary.doubt.empty() ? Json() : Json(summary.doubt)}};
}

/// The transmission that the gain in use assumes for an unobserved cell; null if it assumes none.
Json observability(const MappingOptions& options, const MappingResult& run) {
  if (std::holds_alternative<AdaptiveGain>(options.gain)) {
    const double scale = run.scans.empty() ? 1.0 : run.scans.back().hazard_scale;
    return std::pow(run.hazard.global_transmission(), scale);
  }
  const auto assumed = transmission_unobserved(options.gain);
  return assumed ? Json(*assumed) : Json();
}

/// A line, where there is something.
std::string left_out_text(const Json& metrics) {
  const auto found = metrics.find("unreachable");
  if (found == metrics.end() || (*found)["rooms"] == 0) return {};
  const int rooms = (*found)["rooms"].get<int>();
  return fmt::format(
      "not counted: {} room{} that the robot cannot get to, {:.1f} % of all that "
      "could be seen\n",
      rooms, rooms == 1 ? "" : "s", 100.0 * (*found)["share"].get<double>());
}

}  // namespace

void add_mapping_metrics(const MappingOptions& options, const MappingResult& run, Json& metrics) {
  const int tolerance_cells = options.metrics.tolerance_cells;
  const MapScore map = run.evaluator.score(run.grid, tolerance_cells);
  metrics["observable_cells"] = run.evaluator.observable_cells();
  if (const auto& left_out = run.evaluator.left_out()) {
    const std::size_t all = run.evaluator.observable_cells() + left_out->cells;
    metrics["unreachable"] = {
        {"rooms", left_out->rooms},
        {"cells", left_out->cells},
        {"share", all > 0 ? static_cast<double>(left_out->cells) / static_cast<double>(all) : 0.0}};
  }
  metrics["scans"] = Json::array();
  for (const ScanRecord& scan : run.scans) metrics["scans"].push_back(scan_json(scan));
  add_progress(run.scans, run.evaluator.observable_cells(), metrics);
  const auto score = [&](double value) { return run.scans.empty() ? Json() : Json(value); };
  metrics["map"] = {{"precision", score(map.precision)},
                    {"recall", score(map.recall)},
                    {"tolerance_cells", tolerance_cells}};
  metrics["observability"] = observability(options, run);
  metrics["observability_per_slice"] = run.hazard.transmission_per_slice();
  metrics["localisation"] = localisation_json(options, run.scans, run.localisation);
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
             metrics["method"].get<std::string>(), metrics["status"].get<std::string>(),
             scans.size(), total > 0.0 ? 100.0 * (1.0 - left / total) : 0.0,
             metrics["path_length_m"].get<double>(), metrics["collisions"].get<int>(),
             score("precision"), score("recall"), metrics["real_time_factor"].get<double>()) +
         left_out_text(metrics);
}

}  // namespace vantage
