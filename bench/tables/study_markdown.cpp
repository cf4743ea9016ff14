// The tables of a study as a page has them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "bench/tables/study_tables.hpp"

namespace vantage::bench {
namespace {

std::string number(double value) {
  const double size = std::abs(value);
  if (size >= 1000.0 || size == std::round(size)) return fmt::format("{:.0f}", value);
  return size >= 10.0 ? fmt::format("{:.1f}", value) : fmt::format("{:.3f}", value);
}

/// @param planned episodes: told where not all came to a value
std::string cell_text(const ComparisonRow& row, std::size_t planned) {
  std::string text = number(row.mean);
  if (row.clusters > 1) {
    text += fmt::format(" [{}, {}]", number(row.interval.low), number(row.interval.high));
  }
  if (row.difference && row.difference->ratio) {
    text += fmt::format(", x {:.2f}, p {:.2g}", *row.difference->ratio, row.difference->p_value);
  }
  if (row.count < planned) text += fmt::format(" ({} of {})", row.count, planned);
  return text;
}

std::vector<std::string> levels_of(const Comparison& compared) {
  std::vector<std::string> levels;
  for (const ComparisonRow& row : compared.rows) {
    if (std::ranges::find(levels, row.level) == levels.end()) levels.push_back(row.level);
  }
  return levels;
}

}  // namespace

std::string StudyTables::markdown(const std::string& title) const {
  const Table& of = table(title);
  if (of.samples.empty()) return {};
  const Comparison compared =
      compare_levels(title, title, groups(), of.levels, of.reference, of.samples);
  auto columns = groups();
  if (columns.size() > 1) columns.emplace_back(kAllPanels);
  std::string text = fmt::format("| | {} |\n|---|", fmt::join(columns, " | "));
  for (std::size_t i = 0; i < columns.size(); ++i) text += "---|";
  for (const std::string& level : levels_of(compared)) {
    text += fmt::format("\n| {} |", level);
    for (const std::string& panel : columns) {
      const auto row = std::ranges::find_if(compared.rows, [&](const ComparisonRow& r) {
        return r.level == level && r.panel == panel;
      });
      text += row == compared.rows.end()
                  ? " |"
                  : ' ' + cell_text(*row, planned(panel, level_of(title, level))) + " |";
    }
  }
  return text + "\n";
}

}  // namespace vantage::bench
