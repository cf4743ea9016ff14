#include "vantage/study/measures.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/information/resampling.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
using Scalar = std::optional<double>;

bool recognises(const Json& metrics) { return metrics.contains("observations"); }
bool flies_path(const Json& metrics) { return metrics.contains("objects"); }
bool maps(const Json& metrics) { return metrics.contains("scans"); }

Curve step_values(const Json& steps, const char* key) {
  Curve values;
  for (const Json& step : steps) values.push_back(step.at(key).get<double>());
  return values;
}

/// Of each scan; none where nothing is mapped.
Curve scan_values(const Json& metrics, const char* key) {
  return maps(metrics) ? step_values(metrics.at("scans"), key) : Curve{};
}
/// Of each view of an object; none where nothing is recognised.
Curve view_values(const Json& metrics, const char* key) {
  return recognises(metrics) ? step_values(metrics.at("observations"), key) : Curve{};
}

Curve share_left(const Json& metrics) {
  Curve shares = scan_values(metrics, "observable_unobserved_cells");
  if (shares.empty()) return shares;
  const double all = metrics.at("observable_cells").get<double>();
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

Curve distance_m(const Json& metrics) {
  Curve legs = scan_values(metrics, "path_length_m");
  double sum = 0.0;
  for (double& leg : legs) leg = sum += leg;
  return legs;
}

std::vector<std::pair<std::string, Curve>> prediction_errors(const Json& metrics) {
  std::vector<std::pair<std::string, Curve>> errors;
  if (!maps(metrics)) return errors;
  const Json& scans = metrics.at("scans");
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

/// Sum over the planned scans of the share of observable cells left; an episode that ends early has
/// learnt all it could, so its last share counts for the rest.
Scalar area(const Json& metrics, const Episode& episode) {
  const Curve shares = share_left(metrics);
  if (shares.empty()) return {};
  double sum = 0.0;
  for (int k = 0; k < episode.scans; ++k) {
    sum += shares[std::min(static_cast<std::size_t>(k), shares.size() - 1)];
  }
  return sum;
}

Scalar observed_share(const Json& metrics, const Episode&) {
  const Curve shares = share_left(metrics);
  return shares.empty() ? Scalar{} : 1.0 - shares.back();
}

/// An episode that never gets there counts with all its planned scans.
Scalar scans_to_95(const Json& metrics, const Episode& episode) {
  const Curve shares = share_left(metrics);
  if (shares.empty()) return {};
  const auto there = std::ranges::find_if(shares, [](double share) { return share <= 0.05; });
  return there == shares.end() ? static_cast<double>(episode.scans)
                               : static_cast<double>(there - shares.begin() + 1);
}

/// Of the gain the method itself goes by, if it goes by one.
Scalar own_prediction_error(const Json& metrics, const Episode&) {
  const auto method = metrics.at("method").get<std::string>();
  for (const auto& [gain, curve] : prediction_errors(metrics)) {
    if (gain == method && !curve.empty()) return mean(curve);
  }
  return {};
}

Scalar mean_of(const Curve& values) { return values.empty() ? Scalar{} : mean(values); }

/// A number or truth value of an episode that recognises.
Scalar of_recognition(const Json& metrics, const char* key) {
  if (!metrics.contains(key) || metrics.at(key).is_null()) return {};
  const Json& value = metrics.at(key);
  return value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>();
}

/// A number of a flight along a path; `inner` of an object of numbers.
Scalar of_path_flight(const Json& metrics, const char* key, const char* inner = nullptr) {
  if (!flies_path(metrics)) return {};
  const Json& value = inner == nullptr ? metrics.at(key) : metrics.at(key).at(inner);
  return value.get<double>();
}

/// Kinds of collisions are not told apart: one ends the flight.
Scalar ended_by_collision(const Json& metrics) {
  if (!flies_path(metrics)) return {};
  return metrics.at("collisions").get<double>() > 0.0 ? 1.0 : 0.0;
}

struct ScalarMeasure {
  MeasureName name;
  Scalar (*of)(const Json& metrics, const Episode& episode);
};

constexpr auto kScalars = std::to_array<ScalarMeasure>({
    {{"area", "area under the curve of observable cells left, scans"}, area},
    {{"observed_share", "share of the observable cells observed at the end"}, observed_share},
    {{"scans_to_95", "scans until 95 % of the observable cells are observed"}, scans_to_95},
    {{"prediction_error_cells", "mean error of the method's own prediction, cells"},
     own_prediction_error},
    {{"scans", "scans taken"},
     [](const Json& m, const Episode&) -> Scalar {
       if (!maps(m)) return {};
       return static_cast<double>(m.at("scans").size());
     }},
    {{"fallbacks", "views out of reach"},
     [](const Json& m, const Episode&) -> Scalar {
       if (!maps(m)) return {};
       double count = 0.0;
       for (const Json& scan : m.at("scans")) count += scan.at("fallback").get<bool>() ? 1.0 : 0.0;
       return count;
     }},
    {{"path_length_m", "path length, m"},
     [](const Json& m, const Episode&) -> Scalar { return m.at("path_length_m").get<double>(); }},
    {{"collisions", "collisions"},
     [](const Json& m, const Episode&) -> Scalar { return m.at("collisions").get<double>(); }},
    {{"precision", "precision of occupied cells"},
     [](const Json& m, const Episode&) -> Scalar {
       return maps(m) ? m.at("map").at("precision").get<double>() : Scalar{};
     }},
    {{"recall", "recall of occupied cells"},
     [](const Json& m, const Episode&) -> Scalar {
       return maps(m) ? m.at("map").at("recall").get<double>() : Scalar{};
     }},
    {{"pose_error_m", "mean position error after registration, m"},
     [](const Json& m, const Episode&) { return mean_of(scan_values(m, "pose_error_m")); }},
    {{"pose_error_before_registration_m", "mean position error before registration, m"},
     [](const Json& m, const Episode&) {
       return mean_of(scan_values(m, "pose_error_before_registration_m"));
     }},
    {{"simulated_time_s", "simulated time, s"},
     [](const Json& m, const Episode&) -> Scalar {
       return m.at("simulated_time_s").get<double>();
     }},
    {{"correct", "recognised the object, or what has changed, share"},
     [](const Json& m, const Episode&) { return of_recognition(m, "correct"); }},
    {{"category_correct", "recognised the category, share"},
     [](const Json& m, const Episode&) { return of_recognition(m, "category_correct"); }},
    {{"changed_correct", "told changed from unchanged, share"},
     [](const Json& m, const Episode&) { return of_recognition(m, "changed_correct"); }},
    {{"change_probability", "probability of a change at the end"},
     [](const Json& m, const Episode&) { return of_recognition(m, "change_probability"); }},
    {{"views", "views taken"},
     [](const Json& m, const Episode&) -> Scalar {
       if (!recognises(m)) return {};
       return static_cast<double>(m.at("observations").size());
     }},
    {{"entropy_bits", "entropy of the state at the end, bits"},
     [](const Json& m, const Episode&) { return of_recognition(m, "entropy_bits"); }},
    {{"map_probability", "probability of the estimate at the end"},
     [](const Json& m, const Episode&) { return of_recognition(m, "map_probability"); }},
    {{"bin_error", "error of the pose, bins"},
     [](const Json& m, const Episode&) { return of_recognition(m, "bin_error"); }},
    {{"view_position_error_m", "mean position error of a view, m"},
     [](const Json& m, const Episode&) { return mean_of(view_values(m, "position_error_m")); }},
    {{"view_angle_error_rad", "mean angle error of a view, rad"},
     [](const Json& m, const Episode&) { return mean_of(view_values(m, "angle_error_rad")); }},
    {{"accuracy", "objects of the scene recognised, share"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "accuracy"); }},
    {{"observations", "observations of all objects"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "observations_total"); }},
    {{"mean_entropy_nats", "mean entropy of the scene's objects at the end, nats"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "mean_entropy_nats"); }},
    {{"objects_found", "objects of the scene found"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "objects_found"); }},
    {{"false_objects", "objects found where there are none"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "false_objects"); }},
    {{"flight_time_s", "flight time, s"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "flight_time_s"); }},
    {{"minimum_clearance_m", "minimum clearance, m"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "minimum_clearance_m"); }},
    {{"collided", "flights that touched something, share"},
     [](const Json& m, const Episode&) { return ended_by_collision(m); }},
    {{"tracking_error_m", "mean distance from the reference, m"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "tracking_error_m", "mean"); }},
    {{"replan_time_s", "median time of a replan, s", true},
     [](const Json& m, const Episode&) { return of_path_flight(m, "plan_time_s", "median"); }},
    {{"replan_time_p95_s", "95 % quantile of the time of a replan, s", true},
     [](const Json& m, const Episode&) { return of_path_flight(m, "plan_time_s", "p95"); }},
    {{"late_plans", "replans that took longer than the latency charged", true},
     [](const Json& m, const Episode&) { return of_path_flight(m, "late_plans"); }},
    {{"missed_deadlines", "replans that came after the next waypoint"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "missed_deadlines"); }},
    {{"energy_j", "energy of the rotors, J"},
     [](const Json& m, const Episode&) { return of_path_flight(m, "energy_j"); }},
});

struct CurveMeasure {
  MeasureName name;
  Curve (*of)(const Json& metrics);
};

constexpr auto kCurves = std::to_array<CurveMeasure>({
    {{"unobserved_cells", "unobserved cells"},
     [](const Json& m) { return scan_values(m, "unobserved_cells"); }},
    {{"observable_unobserved_cells", "observable cells left"},
     [](const Json& m) { return scan_values(m, "observable_unobserved_cells"); }},
    {{"share_left", "share of the observable cells left"}, share_left},
    {{"distance_m", "distance travelled, m"}, distance_m},
    {{"pose_error_m", "position error, m"},
     [](const Json& m) { return scan_values(m, "pose_error_m"); }},
    {{"precision", "precision of occupied cells"},
     [](const Json& m) { return scan_values(m, "precision"); }},
    {{"recall", "recall of occupied cells"},
     [](const Json& m) { return scan_values(m, "recall"); }},
    {{"view_entropy_bits", "entropy of the state, bits"},
     [](const Json& m) { return view_values(m, "entropy_bits"); }},
});

std::vector<MeasureName> names_of(const auto& measures) {
  std::vector<MeasureName> names;
  names.reserve(measures.size());
  for (const auto& measure : measures) names.push_back(measure.name);
  return names;
}

std::vector<std::string> texts_of(const std::vector<MeasureName>& names) {
  std::vector<std::string> texts;
  texts.reserve(names.size());
  for (const MeasureName& name : names) texts.emplace_back(name.name);
  return texts;
}

std::optional<std::size_t> find(const std::vector<MeasureName>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name, &MeasureName::name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

const std::vector<MeasureName>& scalar_measures() {
  static const auto names = names_of(kScalars);
  return names;
}
const std::vector<MeasureName>& curve_measures() {
  static const auto names = names_of(kCurves);
  return names;
}

std::vector<std::string> scalar_names() { return texts_of(scalar_measures()); }
std::vector<std::string> curve_names() { return texts_of(curve_measures()); }
std::optional<std::size_t> find_scalar(std::string_view name) {
  return find(scalar_measures(), name);
}
std::optional<std::size_t> find_curve(std::string_view name) {
  return find(curve_measures(), name);
}

EpisodeMeasures measure(const Json& metrics, const Episode& episode) {
  EpisodeMeasures measures;
  for (const auto& scalar : kScalars) measures.scalars.push_back(scalar.of(metrics, episode));
  for (const auto& curve : kCurves) measures.curves.push_back(curve.of(metrics));
  measures.prediction_errors = prediction_errors(metrics);
  return measures;
}

}  // namespace vantage
