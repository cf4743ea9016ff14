/// Names in a run folder that nobody says anything about.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "vantage/runtime/record_text.hpp"

namespace vantage::test {

/// Dotted keys of a JSON value, of the elements of a list key[].
inline void collect_keys(const nlohmann::json& node, const std::string& prefix,
                         std::set<std::string>& keys) {
  if (node.is_array()) {
    for (const auto& item : node) {
      if (item.is_object()) collect_keys(item, prefix + "[]", keys);
    }
  } else if (node.is_object()) {
    for (const auto& [name, child] : node.items()) {
      const std::string path = fmt::format("{}{}{}", prefix, prefix.empty() ? "" : ".", name);
      keys.insert(path);
      collect_keys(child, path, keys);
    }
  }
}

/// With <gain> for what differs from run to run.
inline std::string generic(const std::string& name) {
  return std::regex_replace(
      std::regex_replace(name, std::regex("^predicted_.+_cells$"), "predicted_<gain>_cells"),
      std::regex("\\.predicted\\..+$"), ".predicted.<gain>");
}

class Described {
 public:
  explicit Described(const RecordTexts& records) {
    for (const RecordText& record : records) {
      if (!record.text.empty())
        names_.insert(std::string(record.file) + ":" + std::string(record.name));
    }
  }
  /// The name itself, what it holds, or as a whole what holds it, as a pose is.
  [[nodiscard]] bool has(const std::string& file, const std::string& name) const {
    const std::string full = file + ":" + generic(name);
    if (names_.contains(full) || holds_some(full)) return true;
    for (auto dot = full.rfind('.'); dot != full.npos && dot > file.size();
         dot = full.rfind('.', dot - 1)) {
      std::string holder = full.substr(0, dot);
      if (holder.ends_with("[]")) holder.resize(holder.size() - 2);
      if (names_.contains(holder) && !holds_some(holder)) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool holds_some(const std::string& name) const {
    return std::ranges::any_of(names_, [&](const std::string& known) {
      return known.starts_with(name + ".") || known.starts_with(name + "[].");
    });
  }
  std::set<std::string> names_;
};

inline std::vector<std::string> undescribed(const std::filesystem::path& run_dir,
                                            RecordTexts records) {
  const RecordTexts common = run_records();
  records.insert(records.end(), common.begin(), common.end());
  const Described described(records);
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(run_dir)) {
    const std::string file = entry.path().filename().string();
    if (!described.has(std::string(kRunFolder), file)) found.push_back(file);
    if (entry.path().extension() != ".csv" || file == "actions.csv") continue;
    std::string header;
    std::ifstream stream(entry.path());
    std::getline(stream, header);
    std::istringstream columns(header);
    for (std::string column; std::getline(columns, column, ',');) {
      if (!described.has(file, column)) found.push_back(fmt::format("{}: {}", file, column));
    }
  }
  std::set<std::string> keys;
  std::ifstream metrics(run_dir / "metrics.json");
  collect_keys(nlohmann::json::parse(metrics), "", keys);
  for (const std::string& key : keys) {
    if (!described.has("metrics.json", key)) found.push_back("metrics.json: " + key);
  }
  return found;
}

}  // namespace vantage::test
