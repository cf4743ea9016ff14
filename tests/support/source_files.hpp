/// The project's own sources, for tests that read them.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace vantage::support {

/// Path from the repository root -> content, of every source and header below these folders.
inline std::map<std::string, std::string> read_sources(const std::vector<std::string>& roots) {
  namespace fs = std::filesystem;
  const fs::path repository = VANTAGE_SOURCE_DIR;
  std::map<std::string, std::string> sources;
  for (const auto& root : roots) {
    if (!fs::is_directory(repository / root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(repository / root)) {
      const auto extension = entry.path().extension();
      if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".hpp")) continue;
      std::ostringstream content;
      content << std::ifstream(entry.path()).rdbuf();
      sources[fs::relative(entry.path(), repository).generic_string()] = content.str();
    }
  }
  return sources;
}

}  // namespace vantage::support
