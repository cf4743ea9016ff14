#include "vantage/study/kit/headlines.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/runtime/measure.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

constexpr auto kWallTimes = std::to_array<std::string_view>(
    {"wall_time_s", "real_time_factor", "plan_time_s", "map_time_s", "feature_time_s",
     "selection_time_s", "view_time_s", "late_plans", "replan_time_s", "replan_time_p95_s"});

/// Of the task that metrics.json is of; of none if there is no such task.
Measures measures_of(const Json& metrics) {
  Measures found;
  const Json name = metrics.value("task", Json());
  for_each_task([&](const auto& task) {
    if (name == task.metrics_task()) found = task.measures();
  });
  return found;
}

std::optional<double> value_of(const Json& metrics, std::string_view name) {
  for (const ScalarMeasure& measure : measures_of(metrics).scalars) {
    if (measure.name.name != name) continue;
    try {
      return measure.of({metrics, metrics.value("scans", Json::array()).size()});
    } catch (const nlohmann::json::exception&) {
      return std::nullopt;  // of a run that does not have it
    }
  }
  return std::nullopt;
}

Headline headline(std::string name, std::optional<double> first, std::optional<double> second,
                  double tolerance) {
  const bool both = first && second;
  const bool beyond =
      both ? relative_difference(*first, *second) > tolerance : first.has_value() || second;
  return {std::move(name), first, second, beyond};
}

const Json* entry(const Json* json, const std::string& key) {
  if (json == nullptr || !json->is_object() || !json->contains(key)) return nullptr;
  return &json->at(key);
}

/// Over all panels, or of the only one there is.
const Json* whole_table(const Json& summary, const std::string& name) {
  const Json* table = entry(entry(&summary, "tables"), name);
  if (table == nullptr || table->empty()) return nullptr;
  return &table->back();
}

std::string number(const std::optional<double>& value) {
  if (!value) return "-";
  return std::abs(*value) >= 9999.5 ? fmt::format("{:.0f}", *value) : fmt::format("{:.4g}", *value);
}

std::string difference_of(const Headline& row) {
  if (!row.first || !row.second) return "";
  const double difference = *row.second - *row.first;
  return difference == 0.0 ? "same" : fmt::format("{:+.3g}", difference);
}

}  // namespace

bool is_wall_time(std::string_view key) {
  return std::ranges::find(kWallTimes, key) != kWallTimes.end();
}

double relative_difference(double a, double b) {
  return a == b ? 0.0 : std::abs(b - a) / std::max(std::abs(a), std::abs(b));
}

std::vector<Headline> run_headlines(const Json& first, const Json& second, double tolerance) {
  std::vector<Headline> rows;
  for (const std::string_view name : measures_of(first).headlines) {
    rows.push_back(
        headline(std::string(name), value_of(first, name), value_of(second, name), tolerance));
  }
  return rows;
}

std::vector<Headline> study_headlines(const Json& first, const Json& second, double tolerance) {
  const auto mean = [](const Json* level) -> std::optional<double> {
    const Json* value = entry(level, "mean");
    return value != nullptr && value->is_number() ? value->get<double>() : std::optional<double>{};
  };
  const auto completed = [](const Json& summary) {
    const Json* value = entry(&summary, "completed");
    return value != nullptr && value->is_number() ? value->get<double>() : 0.0;
  };
  std::vector<Headline> rows{headline("completed", completed(first), completed(second), tolerance)};
  const Json tables = first.value("tables", Json::object());
  for (const auto& [name, panels] : tables.items()) {
    const Json* ours = whole_table(first, name);
    if (ours == nullptr || is_wall_time(name)) continue;
    for (const auto& [level, row] : ours->items()) {
      rows.push_back(headline(fmt::format("{}, {}", name, level), mean(&row),
                              mean(entry(whole_table(second, name), level)), tolerance));
    }
  }
  return rows;
}

std::string headlines_text(const std::vector<Headline>& headlines, const std::string& first,
                           const std::string& second) {
  std::size_t width = 0;
  for (const Headline& row : headlines) width = std::max(width, row.name.size());
  const std::size_t a = std::max<std::size_t>(first.size(), 10);
  const std::size_t b = std::max<std::size_t>(second.size(), 10);
  std::string text =
      fmt::format("  {:<{}}  {:>{}}  {:>{}}  difference\n", "", width, first, a, second, b);
  for (const Headline& row : headlines) {
    text += fmt::format("{} {:<{}}  {:>{}}  {:>{}}  {:>10}\n", row.beyond ? "!" : " ", row.name,
                        width, number(row.first), a, number(row.second), b, difference_of(row));
  }
  return text;
}

Json headlines_json(const std::vector<Headline>& headlines) {
  const auto side = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json rows = Json::array();
  for (const Headline& row : headlines) {
    const bool both = row.first && row.second;
    rows.push_back({{"name", row.name},
                    {"first", side(row.first)},
                    {"second", side(row.second)},
                    {"difference", both ? Json(*row.second - *row.first) : Json()},
                    {"beyond", row.beyond}});
  }
  return rows;
}

}  // namespace vantage
