#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

#include "bench/tables/study_tables.hpp"

namespace vantage::bench {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::size_t column_of(const CsvTable& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name);
  return found == table.columns.end() ? kNone
                                      : static_cast<std::size_t>(found - table.columns.begin());
}

}  // namespace

CsvTable of_results(CsvTable table, const CsvTable& results) {
  const bool by_hash = column_of(table, "state_hash") != kNone;
  const auto key = [by_hash](const CsvTable& of, const std::vector<std::string>& row) {
    const std::size_t episode = column_of(of, "episode");
    const std::size_t hash = by_hash ? column_of(of, "state_hash") : kNone;
    return std::pair(episode == kNone ? "" : row[episode], hash == kNone ? "" : row[hash]);
  };
  std::set<std::pair<std::string, std::string>> known;
  for (const auto& row : results.rows) known.insert(key(results, row));
  std::erase_if(table.rows, [&](const auto& row) { return !known.contains(key(table, row)); });
  return table;
}

}  // namespace vantage::bench
