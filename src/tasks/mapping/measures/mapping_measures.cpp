#include "vantage/tasks/mapping/measures/mapping_measures.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/tasks/mapping/measures/forecast_measures.hpp"
#include "vantage/tasks/mapping/measures/progress_measures.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
using Scalar = std::optional<double>;

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
template <int percent>
Scalar scans_to(const MeasuredEpisode& episode) {
  const Curve shares = share_left(episode);
  if (shares.empty()) return {};
  const auto there =
      std::ranges::find_if(shares, [](double share) { return share <= 0.01 * (100 - percent); });
  return there == shares.end() ? static_cast<double>(episode.planned_steps)
                               : static_cast<double>(there - shares.begin() + 1);
}

/// A key of metrics.json as a template argument.
template <std::size_t length>
struct Key {
  std::array<char, length> text;
  consteval Key(const char (&literal)[length]) : text(std::to_array(literal)) {}
};

template <Key key>
Scalar number(const MeasuredEpisode& episode) {
  return number_if_measured(episode, key.text.data());
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

/// Of the map as it is at the end, corrected over loops.
Scalar worst_pose_error(const MeasuredEpisode& episode) {
  const Curve errors = scan_values(episode, "pose_error_m");
  return errors.empty() ? Scalar{} : *std::ranges::max_element(errors);
}

Scalar map_score(const MeasuredEpisode& episode, const char* key) {
  const Json& value = episode.metrics.at("map").at(key);
  return value.is_null() ? Scalar{} : value.get<double>();
}

Scalar map_in_doubt(const MeasuredEpisode& episode) {
  const Json found = episode.metrics.value("localisation", Json::object());
  return found.contains("map_in_doubt") ? Scalar(found["map_in_doubt"].get<bool>() ? 1.0 : 0.0)
                                        : Scalar{};
}

Scalar budget_kept(const MeasuredEpisode& episode) {
  const Json budget = episode.metrics.value("budget", Json());
  return budget.is_null() ? Scalar{} : Scalar(budget.at("kept").get<bool>() ? 1.0 : 0.0);
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
    {{"scans_to_80", "scans until 80 % of the observable cells are observed, or all of the plan",
      Better::lower},
     scans_to<80>},
    {{"scans_to_90", "scans until 90 % of the observable cells are observed, or all of the plan",
      Better::lower},
     scans_to<90>},
    {{"scans_to_95", "scans until 95 % of the observable cells are observed, or all of the plan",
      Better::lower},
     scans_to<95>},
    {{"scans_to_97", "scans until 97 % of the observable cells are observed, or all of the plan",
      Better::lower},
     scans_to<97>},
    {{"scans_to_98", "scans until 98 % of the observable cells are observed, or all of the plan",
      Better::lower},
     scans_to<98>},
    {{"reached_95", "whether 95 % of the observable cells were observed", Better::higher},
     reached_95},
    {{"time_to_80_s", "simulated time until 80 % are observed, s", Better::lower},
     number<"time_to_80_s">},
    {{"time_to_90_s", "simulated time until 90 % are observed, s", Better::lower},
     number<"time_to_90_s">},
    {{"time_to_95_s", "simulated time until 95 % are observed, s", Better::lower},
     number<"time_to_95_s">},
    {{"time_to_97_s", "simulated time until 97 % are observed, s", Better::lower},
     number<"time_to_97_s">},
    {{"time_to_98_s", "simulated time until 98 % are observed, s", Better::lower},
     number<"time_to_98_s">},
    {{"path_to_80_m", "way driven until 80 % are observed, m", Better::lower},
     number<"path_to_80_m">},
    {{"path_to_90_m", "way driven until 90 % are observed, m", Better::lower},
     number<"path_to_90_m">},
    {{"path_to_95_m", "way driven until 95 % are observed, m", Better::lower},
     number<"path_to_95_m">},
    {{"path_to_97_m", "way driven until 97 % are observed, m", Better::lower},
     number<"path_to_97_m">},
    {{"path_to_98_m", "way driven until 98 % are observed, m", Better::lower},
     number<"path_to_98_m">},
    {{"area_over_time",
      "area under the curve of observable cells left against simulated time, until the last scan, "
      "s"},
     number<"area_over_time">},
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
    {{"interval_coverage",
      "share of scans, from the second on, whose new cells were within the interval of the "
      "forecast"},
     interval_coverage},
    {{"stop_confidence",
      "probability that the robot gave, at the end, to having seen the share that `stop` asks for"},
     stop_confidence},
    {{"outside_share", "share of newly seen cells outside the field that forecasts are for"},
     outside_share},
    {{"scans", "scans taken"},
     [](const MeasuredEpisode& e) -> Scalar {
       return static_cast<double>(e.metrics.at("scans").size());
     }},
    {{"fallbacks", "views out of reach", Better::lower}, fallbacks},
    kPathLength,
    {{"energy_j", "energy used, J", Better::lower}, number<"energy_j">},
    {{"budget_kept",
      "1 if the episode kept its budget and came back where it had to, else 0; none without one",
      Better::higher},
     budget_kept},
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
    {{"worst_pose_error_m",
      "greatest error of the position that a scan was taken into the map at, m", Better::lower},
     worst_pose_error},
    {{"map_in_doubt", "1 if the run says itself that its map is in doubt, else 0"}, map_in_doubt},
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
    {{"share_left_over_time", "share of the observable cells left, every 20 s", Better::lower},
     share_left_over_time,
     kAlongTime},
    {{"share_left_over_path", "share of the observable cells left, every metre", Better::lower},
     share_left_over_path,
     kAlongPath},
    {{"forecast_ratio", "cells forecast by adaptive over cells seen, one more of each"},
     forecast_ratios},
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

Measures mapping_measures() { return {kScalars, kCurves, prediction_errors, kHeadlines}; }

}  // namespace vantage
