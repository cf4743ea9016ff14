#include "bench/results_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage::bench {
namespace {

std::string number(double value) {
  const double size = std::abs(value);
  if (size >= 1000.0 || size == std::round(size)) return fmt::format("{:.0f}", value);
  return size >= 10.0 ? fmt::format("{:.1f}", value) : fmt::format("{:.3f}", value);
}

/// Of one episode there is none.
bool has_interval(const Json* found) {
  return found != nullptr && found->at("interval").is_array();
}

}  // namespace

Json read_json(const std::filesystem::path& file) {
  Json json = Json::parse(read_file(file), nullptr, false);
  if (json.is_discarded()) throw InputError(file.string() + ": not JSON");
  return json;
}

const Json* StudySummary::entry(const std::string& table, const std::string& panel,
                                const std::string& level) const {
  const Json* at = &json_.at("tables");
  for (const std::string& key : {table, panel, level}) {
    const auto found = at->find(key);
    if (found == at->end()) return nullptr;
    at = &*found;
  }
  return at;
}

const Json* StudySummary::difference(const std::string& table, const std::string& panel,
                                     const std::string& level) const {
  const Json* found = entry(table, panel, level);
  return found == nullptr || !found->contains("difference") ? nullptr : &found->at("difference");
}

std::optional<double> StudySummary::mean(const std::string& table, const std::string& panel,
                                         const std::string& level) const {
  const Json* found = entry(table, panel, level);
  if (found == nullptr) return std::nullopt;
  return found->at("mean").get<double>();
}

std::optional<double> StudySummary::least(const std::string& table, const std::string& panel,
                                          const std::string& level) const {
  const Json* found = entry(table, panel, level);
  if (found == nullptr || !found->contains("least")) return std::nullopt;
  return found->at("least").get<double>();
}

std::optional<double> StudySummary::ratio(const std::string& table, const std::string& panel,
                                          const std::string& level) const {
  const Json* found = difference(table, panel, level);
  if (found == nullptr || !found->contains("ratio")) return std::nullopt;
  return found->at("ratio").get<double>();
}

bool StudySummary::above_reference(const std::string& table, const std::string& panel,
                                   const std::string& level) const {
  const Json* found = difference(table, panel, level);
  return has_interval(found) && found->at("interval")[0].get<double>() > 0.0;
}

bool StudySummary::below_reference(const std::string& table, const std::string& panel,
                                   const std::string& level) const {
  const Json* found = difference(table, panel, level);
  return has_interval(found) && found->at("interval")[1].get<double>() < 0.0;
}

std::string StudySummary::ratio_text(const std::string& table, const std::string& panel,
                                     const std::string& level) const {
  const auto times = ratio(table, panel, level);
  if (!times || !has_interval(difference(table, panel, level))) return {};
  const Json& interval = difference(table, panel, level)->at("ratio_interval");
  return fmt::format("{:.2f} [{:.2f}, {:.2f}], {} pairs", *times, interval[0].get<double>(),
                     interval[1].get<double>(), pairs(table, panel, level));
}

std::string StudySummary::less_text(const std::string& table, const std::string& panel,
                                    const std::string& level, double scale, int digits) const {
  const Json* found = difference(table, panel, level);
  if (!has_interval(found)) return {};
  const Json& interval = found->at("interval");
  const auto less = [&](const Json& more) { return -scale * more.get<double>(); };
  return fmt::format("{:+.{}f} [{:+.{}f}, {:+.{}f}]", less(found->at("mean")), digits,
                     less(interval[1]), digits, less(interval[0]), digits);
}

int StudySummary::pairs(const std::string& table, const std::string& panel,
                        const std::string& level) const {
  const Json* found = difference(table, panel, level);
  return found == nullptr ? 0 : found->at("pairs").get<int>();
}

std::vector<std::string> StudySummary::panels(const std::string& table) const {
  std::vector<std::string> names;
  for (const auto& [panel, levels] : json_.at("tables").at(table).items()) {
    if (panel != "all") names.push_back(panel);
  }
  return names;
}

std::vector<std::string> StudySummary::levels(const std::string& table) const {
  std::vector<std::string> names;
  for (const auto& [panel, levels] : json_.at("tables").at(table).items()) {
    for (const auto& [level, value] : levels.items()) {
      if (std::ranges::find(names, level) == names.end()) names.push_back(level);
    }
  }
  return names;
}

std::string StudySummary::extent() const {
  return fmt::format("{} of {} episodes", json_.at("completed").get<int>(),
                     json_.at("episodes").get<int>());
}

std::string StudySummary::markdown(const std::string& table) const {
  std::vector<std::string> columns = panels(table);
  columns.emplace_back("all");
  std::string header = "| |";
  std::string rule = "|---|";
  for (const std::string& panel : columns) {
    header += fmt::format(" {} |", panel);
    rule += "---|";
  }
  std::string text = header + "\n" + rule + "\n";
  for (const std::string& level : levels(table)) {
    text += fmt::format("| {} |", level);
    for (const std::string& panel : columns) {
      const Json* cell = entry(table, panel, level);
      if (cell == nullptr) {
        text += " |";
        continue;
      }
      text += " " + number(cell->at("mean").get<double>());
      if (has_interval(cell)) {
        const Json& interval = cell->at("interval");
        text += fmt::format(" [{}, {}]", number(interval[0].get<double>()),
                            number(interval[1].get<double>()));
      }
      if (const auto times = ratio(table, panel, level)) {
        text += fmt::format(", x {:.2f}, p {:.2g}", *times,
                            cell->at("difference").at("p_value").get<double>());
      }
      text += " |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace vantage::bench
