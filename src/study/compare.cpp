#include "vantage/study/compare.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "vantage/core/error.hpp"
#include "vantage/study/results.hpp"
#include "vantage/study/study_page.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxDifferences = 40;

/// What depends on the machine and its load.
constexpr auto kWallTimes = std::to_array<std::string_view>(
    {"wall_time_s", "real_time_factor", "plan_time_s", "map_time_s", "feature_time_s",
     "selection_time_s", "late_plans", "replan_time_s", "replan_time_p95_s"});
/// Texts that must agree under any tolerance.
constexpr auto kBinding = std::to_array<std::string_view>({"task", "status", "study"});

using Leaf = std::pair<std::string, Json>;

void flatten(const Json& json, const std::string& key, std::vector<Leaf>& leaves) {
  if (json.is_object()) {
    for (const auto& [name, child] : json.items()) {
      if (std::ranges::find(kWallTimes, name) != kWallTimes.end()) continue;
      flatten(child, key.empty() ? name : fmt::format("{}.{}", key, name), leaves);
    }
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      flatten(json[i], fmt::format("{}[{}]", key, i), leaves);
    }
  } else {
    leaves.emplace_back(key, json);
  }
}

std::vector<Leaf> leaves_of(const fs::path& folder, bool study) {
  const fs::path file = folder / (study ? "summary.json" : "metrics.json");
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    throw InputError(fmt::format("{}: no such file; {}", file.string(),
                                 study ? "vantage sweep collect writes it" : "not a run folder"));
  }
  const Json json = read_json_or_null(file);
  if (json.is_null()) throw InputError(file.string() + ": not a JSON object");
  std::vector<Leaf> leaves;
  flatten(json, "", leaves);
  return leaves;
}

ComparedValue compared(const std::string& key, const Json* first, const Json* second,
                       double tolerance) {
  ComparedValue value{key, first == nullptr ? "" : first->dump(),
                      second == nullptr ? "" : second->dump()};
  if (first == nullptr || second == nullptr) {
    value.beyond = true;
  } else if (first->is_number() && second->is_number()) {
    const double a = first->get<double>();
    const double b = second->get<double>();
    value.difference = b - a;
    if (a != b) value.relative = std::abs(b - a) / std::max(std::abs(a), std::abs(b));
    value.beyond = value.relative > tolerance;
  } else if (*first != *second) {
    const bool text = first->is_string() && second->is_string();
    value.beyond = tolerance == 0.0 || !text || std::ranges::find(kBinding, key) != kBinding.end();
  }
  return value;
}

bool concerns_the_whole(const ComparedValue& value) {
  return value.key.find('[') == std::string::npos && value.key.find("tables.") != 0;
}

}  // namespace

FolderComparison compare_folders(const fs::path& first, const fs::path& second, double tolerance) {
  const bool study = is_study_folder(first);
  if (study != is_study_folder(second)) {
    throw InputError(fmt::format("{} is a {}, {} a {}: they cannot be compared", first.string(),
                                 study ? "study" : "run", second.string(),
                                 study ? "run" : "study"));
  }
  const auto ours = leaves_of(first, study);
  const auto theirs = leaves_of(second, study);
  std::map<std::string, const Json*> by_key;
  for (const Leaf& leaf : theirs) by_key[leaf.first] = &leaf.second;
  FolderComparison comparison;
  for (const auto& [key, json] : ours) {
    const auto other = by_key.find(key);
    const Json* found = other == by_key.end() ? nullptr : other->second;
    comparison.values.push_back(compared(key, &json, found, tolerance));
    if (found != nullptr) by_key.erase(other);
  }
  for (const auto& [key, json] : theirs) {
    if (by_key.contains(key)) comparison.values.push_back(compared(key, nullptr, &json, tolerance));
  }
  comparison.beyond =
      static_cast<std::size_t>(std::ranges::count_if(comparison.values, &ComparedValue::beyond));
  return comparison;
}

std::string comparison_text(const FolderComparison& comparison) {
  std::string text;
  std::size_t shown = 0;
  for (const ComparedValue& value : comparison.values) {
    if (!value.beyond && !concerns_the_whole(value)) continue;
    if (value.beyond && ++shown > kMaxDifferences) continue;
    text += fmt::format("{} {:<44} {:>24} {:>24}", value.beyond ? "!" : " ", value.key,
                        value.first.empty() ? "-" : value.first,
                        value.second.empty() ? "-" : value.second);
    if (value.difference != 0.0) {
      text += fmt::format("  {:+.4g} ({:.2g} %)", value.difference, 100.0 * value.relative);
    }
    text += "\n";
  }
  if (shown > kMaxDifferences) {
    text += fmt::format("! and {} more\n", shown - kMaxDifferences);
  }
  return text + fmt::format("{} of {} values differ beyond the tolerance\n", comparison.beyond,
                            comparison.values.size());
}

Json comparison_json(const FolderComparison& comparison, double tolerance) {
  const auto side = [](const std::string& text) {
    return text.empty() ? Json(nullptr) : Json::parse(text);
  };
  Json json = {{"tolerance", tolerance}, {"beyond", comparison.beyond}, {"values", Json::object()}};
  for (const ComparedValue& value : comparison.values) {
    json["values"][value.key] = {{"first", side(value.first)},
                                 {"second", side(value.second)},
                                 {"difference", value.difference},
                                 {"relative", value.relative},
                                 {"beyond", value.beyond}};
  }
  return json;
}

}  // namespace vantage
