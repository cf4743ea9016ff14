// Reads every #include of the sources and enforces the table of ARCHITECTURE.md: which folder may
// include which, and where each third-party library may appear. Also the length of files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLines = 300;
const std::vector<std::string> kRoots{"src", "sim", "planners", "models"};

struct Include {
  std::size_t line = 0;
  std::string target;
  bool quoted = false;
};

/// The folder of ARCHITECTURE.md that a path from the repository root belongs to: "core" for
/// src/core/x.hpp, "sim" for sim/a/b.cpp, "main" for src/main.cpp; empty if it is in none.
std::string folder_of(const std::string& path) {
  const auto slash = path.find('/');
  if (slash == std::string::npos) return "";
  const std::string root = path.substr(0, slash);
  if (root != "src") return std::ranges::find(kRoots, root) != kRoots.end() ? root : "";
  const auto second = path.find('/', slash + 1);
  return second == std::string::npos ? "main" : path.substr(slash + 1, second - slash - 1);
}

/// Which folders each folder may include besides itself.
const std::map<std::string, std::vector<std::string>> kAllowed{
    {"core", {}},
    {"geometry", {"core"}},
    {"information", {"core"}},
    {"perception", {"core", "geometry", "information"}},
    {"belief", {"core", "geometry", "information"}},
    {"planners", {"core", "geometry", "information", "belief"}},
    {"recognition", {"core", "geometry", "information", "perception", "belief", "planners"}},
    {"sim", {"core", "geometry"}},
    {"models", {"core", "geometry"}},
    {"dataset", {"core", "geometry", "perception", "models", "sim"}},
    {"episode",
     {"core", "geometry", "information", "perception", "belief", "planners", "recognition", "sim",
      "models", "dataset"}},
    {"study", {"core", "information", "belief", "recognition", "episode"}},
    {"view", {"core", "geometry", "belief", "planners", "sim", "episode"}},
    {"main",
     {"core", "geometry", "information", "perception", "belief", "planners", "recognition", "sim",
      "models", "dataset", "episode", "study", "view"}},
};

/// Where the headers of a library may appear.
struct LibraryRule {
  std::string_view prefix;  ///< of the header's name
  std::vector<std::string> folders;
  bool sources_only = false;  ///< not in our headers
};

const std::vector<LibraryRule> kLibraries{
    {"mujoco/", {"sim"}},
    {"GL/", {"sim"}},
    {"GLFW/", {"sim"}},
    {"embree", {"sim"}},
    {"octomap/", {"belief"}, true},
    {"opencv2/", {"perception", "recognition", "dataset", "episode", "view"}},
    {"nanoflann", {"perception"}},
    {"yaml-cpp/", {"core"}, true},
    {"spdlog/", {"core"}, true},
    {"nlohmann/json_fwd.hpp", {"core", "episode", "study", "main"}},  // declarations only
    {"nlohmann/", {"core", "episode", "study", "main"}, true},
    {"png", {"models"}},
    {"CLI/", {"main"}, true},
};

/// The includes of a source text; those in comments do not count.
std::vector<Include> includes_of(const std::string& text) {
  std::vector<Include> includes;
  std::istringstream stream(text);
  std::string line;
  bool in_comment = false;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (in_comment) {
      in_comment = line.find("*/") == std::string::npos;
      continue;
    }
    const auto start = line.find_first_not_of(" \t");
    if (start == std::string::npos) continue;
    if (line.compare(start, 2, "/*") == 0) {
      in_comment = line.find("*/", start + 2) == std::string::npos;
      continue;
    }
    if (line[start] != '#') continue;
    const auto word = line.find_first_not_of(" \t", start + 1);
    if (word == std::string::npos || line.compare(word, 7, "include") != 0) continue;
    const auto open = line.find_first_of("<\"", word);
    if (open == std::string::npos) continue;
    const bool quoted = line[open] == '"';
    const auto close = line.find(quoted ? '"' : '>', open + 1);
    if (close == std::string::npos) continue;
    includes.push_back({number, line.substr(open + 1, close - open - 1), quoted});
  }
  return includes;
}

/// Why a library's header may not be included there; empty if it may.
std::string library_violation(const std::string& folder, bool is_header,
                              const std::string& target) {
  for (const LibraryRule& rule : kLibraries) {
    if (!target.starts_with(rule.prefix)) continue;
    if (std::ranges::find(rule.folders, folder) == rule.folders.end()) {
      return folder + " may not use this library";
    }
    if (rule.sources_only && is_header) return "this library may appear in .cpp files only";
    return "";
  }
  return "";
}

/// Why one of our headers may not be included there; empty if it may. The build makes what lies
/// under generated/, each folder for itself.
std::string layer_violation(const std::string& folder, const std::string& target) {
  if (target.starts_with("generated/")) return "";
  const std::string other = folder_of(target);
  if (other.empty()) return "not a path from the repository root";
  if (other == folder) return "";
  const auto allowed = kAllowed.find(folder);
  if (allowed == kAllowed.end()) return "folder " + folder + " is not in the table";
  if (std::ranges::find(allowed->second, other) == allowed->second.end()) {
    return folder + " may not include " + other;
  }
  return "";
}

/// @param path from the repository root
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string folder = folder_of(path);
  const bool is_header = path.ends_with(".hpp");
  for (const Include& include : includes_of(text)) {
    std::string why = library_violation(folder, is_header, include.target);
    if (why.empty() && include.quoted) why = layer_violation(folder, include.target);
    if (why.empty()) continue;
    std::string place = path;
    place.append(":").append(std::to_string(include.line)).append(": ").append(include.target);
    found.push_back(place.append(": ").append(why));
  }
  return found;
}

std::optional<std::string> too_long(const std::string& path, const std::string& text) {
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  if (lines <= kMaxLines) return std::nullopt;
  return path + ": " + std::to_string(lines) + " lines";
}

/// Path from the repository root -> content, of every source file.
std::map<std::string, std::string> read_sources() {
  const fs::path repository = VANTAGE_SOURCE_DIR;
  std::map<std::string, std::string> sources;
  for (const auto& root : kRoots) {
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

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += "\n  " + line;
  return text;
}

TEST(Architecture, IncludesFollowTheTable) {
  std::vector<std::string> found;
  for (const auto& [path, text] : read_sources()) {
    for (auto& violation : violations(path, text)) found.push_back(std::move(violation));
  }
  EXPECT_TRUE(found.empty()) << joined(found);
}

TEST(Architecture, FilesAreShort) {
  std::vector<std::string> found;
  for (const auto& [path, text] : read_sources()) {
    if (auto offender = too_long(path, text)) found.push_back(*offender);
  }
  EXPECT_TRUE(found.empty()) << joined(found);
}

TEST(Architecture, EveryFolderIsInTheTable) {
  std::size_t files = 0;
  for (const auto& [path, text] : read_sources()) {
    EXPECT_TRUE(kAllowed.contains(folder_of(path))) << path;
    ++files;
  }
  EXPECT_GT(files, 20U);  // it read something
}

// The checker itself.

std::size_t count(const std::string& path, const std::string& text) {
  return violations(path, text).size();
}

TEST(ArchitectureChecker, FoldersOfPaths) {
  EXPECT_EQ(folder_of("src/core/rng.hpp"), "core");
  EXPECT_EQ(folder_of("src/main.cpp"), "main");
  EXPECT_EQ(folder_of("planners/gain.hpp"), "planners");
  EXPECT_EQ(folder_of("models/catalogue/catalogue.cpp"), "models");
  EXPECT_EQ(folder_of("tests/support/x.hpp"), "");
  EXPECT_EQ(folder_of("rng.hpp"), "");
}

TEST(ArchitectureChecker, LayersThatMayNotMeet) {
  EXPECT_EQ(count("src/core/a.cpp", "#include \"src/geometry/pose.hpp\"\n"), 1U);
  EXPECT_EQ(count("sim/a.cpp", "#include \"planners/gain.hpp\"\n"), 1U);
  EXPECT_EQ(count("planners/a.hpp", "#include \"sim/world.hpp\"\n"), 1U);
  EXPECT_EQ(count("planners/a.hpp", "#include \"src/perception/ply.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/belief/a.hpp", "#include \"src/perception/ply.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/perception/a.hpp", "#include \"src/belief/floor_map.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/information/a.hpp", "#include \"src/geometry/pose.hpp\"\n"), 1U);
  EXPECT_EQ(count("models/a.cpp", "#include \"sim/world.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/dataset/a.cpp", "#include \"src/episode/interrupt.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/episode/a.cpp", "#include \"src/commands.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/brand_new/a.cpp", "#include \"src/core/rng.hpp\"\n"), 1U);
}

TEST(ArchitectureChecker, LayersThatMay) {
  EXPECT_EQ(count("src/geometry/a.cpp", "#include \"src/core/rng.hpp\"\n"), 0U);
  EXPECT_EQ(count("src/belief/a.cpp", "#include \"src/belief/b.hpp\"\n"), 0U);
  EXPECT_EQ(count("planners/a.cpp", "#include \"src/belief/occupancy_grid.hpp\"\n"), 0U);
  EXPECT_EQ(
      count("src/episode/a.cpp", "#include \"planners/gain.hpp\"\n#include \"sim/world.hpp\"\n"),
      0U);
  EXPECT_EQ(count("src/main.cpp", "#include \"src/episode/run.hpp\"\n"), 0U);
}

TEST(ArchitectureChecker, PathsStartAtTheRepositoryRoot) {
  EXPECT_EQ(count("src/core/a.cpp", "#include \"rng.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include \"../core/rng.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include \"tests/support/x.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include <vector>\n#include <Eigen/Core>\n"), 0U);
}

TEST(ArchitectureChecker, LibrariesStayWhereTheyBelong) {
  EXPECT_EQ(count("src/episode/a.cpp", "#include <mujoco/mujoco.h>\n"), 1U);
  EXPECT_EQ(count("src/episode/a.cpp", "#include \"mujoco/mujoco.h\"\n"), 1U);
  EXPECT_EQ(count("sim/a.hpp", "#include <mujoco/mujoco.h>\n#include <GL/osmesa.h>\n"), 0U);
  EXPECT_EQ(count("planners/a.cpp", "#include <embree3/rtcore.h>\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include <GLFW/glfw3.h>\n"), 1U);
  EXPECT_EQ(count("src/belief/a.cpp", "#include <octomap/OcTree.h>\n"), 0U);
  EXPECT_EQ(count("src/belief/a.hpp", "#include <octomap/OcTree.h>\n"), 1U);
  EXPECT_EQ(count("planners/a.cpp", "#include <octomap/OcTree.h>\n"), 1U);
  EXPECT_EQ(count("sim/a.cpp", "#include <opencv2/core.hpp>\n"), 1U);
  EXPECT_EQ(count("src/perception/a.cpp", "#include <opencv2/core.hpp>\n"), 0U);
  EXPECT_EQ(count("src/belief/a.cpp", "#include <nanoflann.hpp>\n"), 1U);
  EXPECT_EQ(count("src/core/a.hpp", "#include <yaml-cpp/yaml.h>\n"), 1U);
  EXPECT_EQ(count("src/episode/a.cpp", "#include <yaml-cpp/yaml.h>\n"), 1U);
  EXPECT_EQ(count("src/core/log.hpp", "#include <spdlog/spdlog.h>\n"), 1U);
  EXPECT_EQ(count("src/episode/a.hpp", "#include <nlohmann/json.hpp>\n"), 1U);
  EXPECT_EQ(count("src/episode/a.hpp", "#include <nlohmann/json_fwd.hpp>\n"), 0U);
  EXPECT_EQ(count("sim/a.hpp", "#include <nlohmann/json_fwd.hpp>\n"), 1U);
  EXPECT_EQ(count("src/main.cpp", "#include <nlohmann/json.hpp>\n#include <CLI/CLI.hpp>\n"), 0U);
  EXPECT_EQ(count("src/episode/a.cpp", "#include <CLI/CLI.hpp>\n"), 1U);
  EXPECT_EQ(count("sim/a.cpp", "#include <png.h>\n"), 1U);
}

TEST(ArchitectureChecker, ReadsIncludesHoweverTheyAreWritten) {
  EXPECT_EQ(count("src/core/a.cpp", "  #  include  <mujoco/mujoco.h>  // why\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include\"sim/world.hpp\""), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#ifdef X\n#include <mujoco/mujoco.h>\n#endif\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "// #include <mujoco/mujoco.h>\n"), 0U);
  EXPECT_EQ(count("src/core/a.cpp", "/*\n#include <mujoco/mujoco.h>\n*/\n#include <vector>\n"), 0U);
  EXPECT_EQ(violations("src/core/a.cpp", "\n#include <mujoco/mujoco.h>\n"),
            std::vector<std::string>{"src/core/a.cpp:2: mujoco/mujoco.h: "
                                     "core may not use this library"});
}

TEST(ArchitectureChecker, LengthLimit) {
  EXPECT_FALSE(too_long("a.cpp", std::string(300, '\n')));
  EXPECT_EQ(too_long("a.cpp", std::string(301, '\n')), "a.cpp: 301 lines");
}

}  // namespace
