#include "bench/pages/origins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

const fs::path kSource = VANTAGE_SOURCE_DIR;

/// The file that `#include "vantage/PATH"` names, below the source; empty: none of ours.
std::string file_of(const std::string& path) {
  for (const char* base : {"src", ""}) {
    const fs::path file = fs::path(base) / path;
    if (fs::exists(kSource / file)) return file.string();
  }
  return "";
}

/// Adds the file, what it includes, and what defines that.
void add_with_includes(const std::string& file, std::set<std::string>& files) {
  if (file.empty() || !fs::exists(kSource / file) || !files.insert(file).second) return;
  constexpr std::string_view kInclude = "#include \"vantage/";
  std::ifstream stream(kSource / file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(kInclude)) {
      add_with_includes(file_of(line.substr(kInclude.size(), line.rfind('"') - kInclude.size())),
                        files);
    }
  }
  if (file.ends_with(".hpp")) {
    add_with_includes(file.substr(0, file.size() - 4) + ".cpp", files);
  }
}

bool is_below(const std::string& file, const std::vector<std::string>& folders) {
  return std::ranges::any_of(folders,
                             [&](const auto& folder) { return file.starts_with(folder + "/"); });
}

/// Results of mapping tasks are not stale for what they cannot depend on, and for nothing else.
TEST(MappingCode, IsAllThatTheTasksInclude) {
  std::set<std::string> files;
  for (const char* task : {"src/tasks/tabletop", "src/tasks/exploration", "src/tasks/mapping"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / task)) {
      if (entry.is_regular_file()) add_with_includes(fs::relative(entry, kSource), files);
    }
  }
  EXPECT_GT(files.size(), 300U);
  for (const std::string& file : files) {
    if (file.starts_with("src/report/")) continue;  // the page of a run
    EXPECT_TRUE(is_below(file, mapping_code())) << file;
    EXPECT_FALSE(is_below(file, mapping_does_without())) << file;
  }
}

TEST(MappingCode, IsThere) {
  for (const auto* paths : {&mapping_code(), &mapping_does_without()}) {
    for (const std::string& path : *paths) EXPECT_TRUE(fs::exists(kSource / path)) << path;
  }
}

}  // namespace
}  // namespace vantage::bench
