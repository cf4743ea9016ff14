#include "bench/pages/origins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "bench/pages/freshness.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage::bench {
namespace {

/// What any result depends on.
std::vector<std::string> code_with(const std::vector<std::string>& more) {
  std::vector<std::string> code{"src", "planners", "sim", "models", "assets"};
  code.insert(code.end(), more.begin(), more.end());
  return code;
}

/// What only shows or passes on; what makes the scenes that lie in models/scenes.
const std::vector<std::string> kWithoutEffect{"src/view",
                                              "src/mcap",
                                              "src/report",
                                              "src/arena",
                                              "assets/report",
                                              "models/catalogue/office",
                                              "models/catalogue/table",
                                              "models/catalogue/flight"};

/// The sources of the program that printed a benchmark of that name.
std::vector<std::string> sources_of(const std::string& benchmark) {
  if (benchmark == "env")
    return {"bench/env/env.py", "bench/env/swept.cpp", "bench/episode.cpp", "python"};
  if (benchmark == "scaling") return {"bench/decision.cpp"};
  if (benchmark.starts_with("planning_")) return {"bench/planning.cpp"};
  return {fmt::format("bench/{}.cpp", benchmark == "office_views" ? "office" : benchmark)};
}

}  // namespace

std::string marked_commit(const std::string& benchmark, const std::string& commit,
                          const std::filesystem::path& file,
                          const std::filesystem::path& repository) {
  std::vector<std::string> sources = sources_of(benchmark);
  for (const char* shared : {"bench/situation.cpp", "bench/castray.cpp", "bench/measures.cpp"}) {
    sources.emplace_back(shared);
  }
  const std::vector<std::string> code = code_with(sources);
  for (const std::string& source : code) {
    if (std::filesystem::exists(repository / source)) continue;
    throw InputError(
        fmt::format("{}: benchmark {}: there is no {}, which it is of; name its "
                    "sources in bench/pages/origins.cpp",
                    file.string(), benchmark, source));
  }
  const Freshness freshness = freshness_of(
      {.commits = {commit}, .file = file, .code = code, .but = kWithoutEffect}, repository);
  return commit + mark(freshness);
}

std::set<std::string> entries_of(const std::filesystem::path& csv, const std::string& column) {
  std::set<std::string> entries;
  if (!std::filesystem::exists(csv)) return entries;
  const CsvTable table = read_csv(csv);
  const auto at = std::ranges::find(table.columns, column) - table.columns.begin();
  for (const auto& row : table.rows) {
    if (at < std::ssize(row)) entries.insert(row[static_cast<std::size_t>(at)]);
  }
  entries.erase("");
  return entries;
}

const std::vector<std::string>& mapping_code() {
  static const std::vector<std::string> code{
      "src/core",    "src/geometry",     "src/information", "src/control",     "src/perception",
      "src/belief",  "src/localisation", "src/runtime",     "src/tasks",       "planners",
      "sim",         "models/robots",    "models/scenes",   "assets/episodes", "assets/studies",
      "assets/views"};
  return code;
}

const std::vector<std::string>& mapping_does_without() {
  static const std::vector<std::string> without{
      "src/belief/objects",      "src/belief/observation",     "src/belief/tracking",
      "src/perception/clutter",  "src/perception/features",    "src/perception/images",
      "src/perception/search",   "src/tasks/change_detection", "src/tasks/flight",
      "src/tasks/object_flight", "src/tasks/recognition",      "src/tasks/table_map",
      "src/tasks/trajectory",    "planners/objects",           "planners/trajectory"};
  return without;
}

std::string opening_comment(const std::filesystem::path& yaml) {
  std::istringstream lines(read_file(yaml));
  std::string text;
  for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
    const std::size_t from = line.find_first_not_of("# ");
    if (from == std::string::npos) continue;
    text += (text.empty() ? "" : " ") + line.substr(from);
  }
  return text;
}

std::string commits_text(const std::set<std::string>& commits, const std::filesystem::path& file,
                         bool mapping) {
  const std::string marked =
      mark(freshness_of({commits, file, mapping ? mapping_code() : code_with({}),
                         mapping ? mapping_does_without() : kWithoutEffect}));
  return (commits.empty() ? "a commit not recorded" : fmt::format("{}", fmt::join(commits, ", "))) +
         marked;
}

}  // namespace vantage::bench
