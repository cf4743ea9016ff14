#include "vantage/study/compare.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "vantage/core/error.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/study/results.hpp"
#include "vantage/study/study_page.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Texts that must agree under any tolerance.
constexpr auto kBinding = std::to_array<std::string_view>({"task", "status", "title"});

using Leaf = std::pair<std::string, Json>;

void flatten(const Json& json, const std::string& key, std::vector<Leaf>& leaves) {
  if (json.is_object()) {
    for (const auto& [name, child] : json.items()) {
      if (is_wall_time(name)) continue;
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

Json numbers_of(const fs::path& folder, bool study) {
  const fs::path file = folder / (study ? "summary.json" : "metrics.json");
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    throw InputError(fmt::format("{}: no such file; {}", file.string(),
                                 study ? "vantage sweep collect writes it" : "not a run folder"));
  }
  Json json = read_json_or_null(file);
  if (json.is_null()) throw InputError(file.string() + ": not a JSON object");
  bring_up_to_date(json);
  return json;
}

std::vector<Leaf> leaves_of(const Json& json) {
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
    value.relative = relative_difference(a, b);
    value.beyond = value.relative > tolerance;
  } else if (*first != *second) {
    const bool text = first->is_string() && second->is_string();
    value.beyond = tolerance == 0.0 || !text || std::ranges::find(kBinding, key) != kBinding.end();
  }
  return value;
}

}  // namespace

FolderComparison compare_folders(const fs::path& first, const fs::path& second, double tolerance) {
  const bool study = is_study_folder(first);
  if (study != is_study_folder(second)) {
    throw InputError(fmt::format("{} is a {}, {} a {}: they cannot be compared", first.string(),
                                 study ? "study" : "run", second.string(),
                                 study ? "run" : "study"));
  }
  const Json our_numbers = numbers_of(first, study);
  const Json their_numbers = numbers_of(second, study);
  const auto ours = leaves_of(our_numbers);
  const auto theirs = leaves_of(their_numbers);
  std::map<std::string, const Json*> by_key;
  for (const Leaf& leaf : theirs) by_key[leaf.first] = &leaf.second;
  FolderComparison comparison{first.string(), second.string(), {}, {}, 0};
  comparison.headlines =
      (study ? study_headlines : run_headlines)(our_numbers, their_numbers, tolerance);
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

std::string comparison_text(const FolderComparison& comparison, bool all) {
  std::string text = headlines_text(comparison.headlines, comparison.first, comparison.second);
  for (const ComparedValue& value : comparison.values) {
    if (!all || !value.beyond) continue;
    text +=
        fmt::format("! {:<44} {:>24} {:>24}", value.key, value.first.empty() ? "-" : value.first,
                    value.second.empty() ? "-" : value.second);
    if (value.difference != 0.0) {
      text += fmt::format("  {:+.4g} ({:.2g} %)", value.difference, 100.0 * value.relative);
    }
    text += "\n";
  }
  return text + fmt::format("{} of {} values differ beyond the tolerance{}\n", comparison.beyond,
                            comparison.values.size(),
                            all || comparison.beyond == 0 ? "" : "; --all lists them");
}

Json comparison_json(const FolderComparison& comparison, double tolerance) {
  const auto side = [](const std::string& text) {
    return text.empty() ? Json(nullptr) : Json::parse(text);
  };
  Json json = {{"first", comparison.first},
               {"second", comparison.second},
               {"tolerance", tolerance},
               {"beyond", comparison.beyond},
               {"headlines", headlines_json(comparison.headlines)},
               {"values", Json::object()}};
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
