#include "vantage/report/former_run.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <optional>

namespace vantage {
namespace {

constexpr auto kPath = "path_length_m";
constexpr auto kLeg = "leg_length_m";

template <class Json>
bool has_legs_called_paths(const Json& step) {
  return step.is_object() && step.contains(kPath) && step[kPath].is_number() &&
         !step.contains(kLeg);
}

std::optional<std::size_t> column(const CsvTable& table, const char* name) {
  const auto found = std::ranges::find(table.columns, name);
  if (found == table.columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.columns.begin());
}

void count_from_one(CsvTable& steps, std::size_t column) {
  if (steps.rows.empty() || steps.rows.front()[column] != "0") return;
  for (auto& row : steps.rows) {
    int number = 0;
    std::from_chars(row[column].data(), row[column].data() + row[column].size(), number);
    row[column] = std::to_string(number + 1);
  }
}

/// Whether these are the objects of a flight along a path.
template <class Json>
bool are_observed_objects(const Json& objects) {
  return objects.is_array() && std::ranges::all_of(objects, [](const Json& object) {
           return object.is_object() && object.contains("observations") &&
                  object["observations"].is_number() && object.contains("entropy_nats") &&
                  object["entropy_nats"].is_number();
         });
}

/// A flight along a path whose metrics hold the mean entropy of all objects alone.
template <class Json>
void tell_unseen_objects_apart(Json& metrics) {
  if (!metrics.contains("mean_entropy_nats") || !metrics.contains("objects") ||
      metrics.contains("objects_unseen") || !are_observed_objects(metrics["objects"])) {
    return;
  }
  double observed = 0.0;
  double sum_nats = 0.0;
  for (const Json& object : metrics["objects"]) {
    if (object.at("observations").template get<double>() == 0.0) continue;
    observed += 1.0;
    sum_nats += object.at("entropy_nats").template get<double>();
  }
  metrics["objects_unseen"] = metrics["objects"].size() - static_cast<std::size_t>(observed);
  metrics["mean_entropy_observed_nats"] = nullptr;
  if (observed > 0.0) metrics["mean_entropy_observed_nats"] = sum_nats / observed;
}

}  // namespace

template <class Json>
void bring_up_to_date(Json& metrics) {
  if (!metrics.is_object()) return;
  tell_unseen_objects_apart(metrics);
  for (const char* list : {"scans", "observations"}) {
    if (!metrics.contains(list) || !metrics[list].is_array()) continue;
    double sum_m = 0.0;
    for (Json& step : metrics[list]) {
      if (step.is_object() && step.contains("flight") && has_legs_called_paths(step["flight"])) {
        step["flight"][kLeg] = step["flight"][kPath];
        step["flight"].erase(kPath);
      }
      if (!has_legs_called_paths(step)) continue;
      sum_m += step[kPath].template get<double>();
      step[kLeg] = step[kPath];
      step[kPath] = sum_m;
    }
  }
}

template void bring_up_to_date(nlohmann::json&);
template void bring_up_to_date(nlohmann::ordered_json&);

void bring_up_to_date(CsvTable& steps) {
  const auto scan = column(steps, "scan");
  const auto view = column(steps, "view");
  const auto path = column(steps, kPath);
  if ((scan || view) && path && !column(steps, kLeg)) steps.columns[*path] = kLeg;
  for (const auto& counts : {scan, view, column(steps, "waypoint")}) {
    if (counts) count_from_one(steps, *counts);
  }
}

}  // namespace vantage
