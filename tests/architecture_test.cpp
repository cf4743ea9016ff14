// Reads every #include of the sources and enforces the table of ARCHITECTURE.md: which folder may
// include which, and where each third-party library may appear. Also how long files are and how
// large rooms.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture_table.hpp"
#include "tests/support/source_files.hpp"

namespace vantage::architecture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLines = 300;
constexpr std::size_t kMaxTestLines = 500;
constexpr std::size_t kMaxUnits = 15;
constexpr std::size_t kMaxRoomLines = 2500;
const std::vector<std::string> kRoots{"src", "sim", "planners", "models", "bench", "python"};

struct Include {
  std::size_t line = 0;
  std::string target;
  bool quoted = false;
};

/// The room that a path from the repository root is in: "core" for src/core/x.hpp,
/// "planners/gains" for planners/gains/x.hpp; empty if it is in none of the roots.
std::string room_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) return "";
  const std::string root = folder.begin()->string();
  if (std::ranges::find(kRoots, root) == kRoots.end()) return "";
  const std::string room = folder.generic_string();
  return root == "src" ? room.substr(std::min(room.size(), std::size_t{4})) : room;
}

/// The room of an include as it is written: "vantage/core/x.hpp" is in core.
std::string room_of_include(const std::string& target) {
  const std::string prefix = "vantage/";
  if (target.starts_with(prefix)) {
    return fs::path(target.substr(prefix.size())).parent_path().generic_string();
  }
  return fs::path(target).parent_path().generic_string();
}

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
std::string library_violation(const std::string& room, bool is_header, const std::string& target) {
  for (const LibraryRule& rule : kLibraries) {
    if (!target.starts_with(rule.prefix)) continue;
    const bool allowed = std::ranges::any_of(rule.folders, [&](const std::string& folder) {
      return room == folder || room.starts_with(folder + "/");
    });
    if (!allowed) return room + " may not use this library";
    if (rule.sources_only && is_header && room != "bench")
      return "this library may appear in .cpp files only";
    return "";
  }
  return "";
}

/// Why one of our headers may not be included there; empty if it may. The build makes what lies
/// under generated/, each folder for itself.
std::string layer_violation(const std::string& room, const std::string& target) {
  if (target.starts_with("generated/")) return "";
  const std::string other = room_of_include(target);
  const bool rooted = target.starts_with("vantage/") || target.starts_with("bench/") ||
                      target.starts_with("python/") || target.starts_with("tests/");
  if (!rooted) return "not vantage/<folder>/<file>.hpp";
  if (other == room) return "";
  const Rooms* allowed = allowed_in(room);
  if (allowed == nullptr) return "room " + room + " is not in the table";
  return is_allowed(*allowed, other) ? "" : room + " may not include " + other;
}

/// @param path from the repository root
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string room = room_of(path);
  const bool is_header = path.ends_with(".hpp");
  for (const Include& include : includes_of(text)) {
    std::string why = library_violation(room, is_header, include.target);
    if (why.empty() && include.quoted) why = layer_violation(room, include.target);
    if (why.empty()) continue;
    std::string place = path;
    place.append(":").append(std::to_string(include.line)).append(": ").append(include.target);
    found.push_back(place.append(": ").append(why));
  }
  return found;
}

std::optional<std::string> too_long(const std::string& path, const std::string& text) {
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  if (lines <= (path.starts_with("tests/") ? kMaxTestLines : kMaxLines)) return std::nullopt;
  return path + ": " + std::to_string(lines) + " lines";
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += "\n  " + line;
  return text;
}

TEST(Architecture, IncludesFollowTheTable) {
  std::vector<std::string> found;
  for (const auto& [path, text] : support::read_sources(kRoots)) {
    for (auto& violation : violations(path, text)) found.push_back(std::move(violation));
  }
  EXPECT_TRUE(found.empty()) << joined(found);
}

TEST(Architecture, FilesAreShort) {
  std::vector<std::string> found;
  for (const auto& roots : {kRoots, {"tests"}}) {
    for (const auto& [path, text] : support::read_sources(roots)) {
      if (auto offender = too_long(path, text)) found.push_back(*offender);
    }
  }
  EXPECT_TRUE(found.empty()) << joined(found);
}

TEST(Architecture, EveryRoomIsInTheTable) {
  std::size_t files = 0;
  for (const auto& [path, text] : support::read_sources(kRoots)) {
    EXPECT_NE(allowed_in(room_of(path)), nullptr) << path;
    ++files;
  }
  EXPECT_GT(files, 20U);  // it read something
}

TEST(Architecture, RoomsAreSmall) {
  std::map<std::string, std::set<std::string>> units;
  std::map<std::string, std::size_t> lines;
  for (const auto& [path, text] : support::read_sources(kRoots)) {
    const std::string room = fs::path(path).parent_path().generic_string();
    units[room].insert(fs::path(path).stem().string());
    lines[room] += static_cast<std::size_t>(std::ranges::count(text, '\n'));
  }
  for (const auto& [room, names] : units) {
    EXPECT_LE(names.size(), kMaxUnits) << room;
    EXPECT_LE(lines[room], kMaxRoomLines) << room;
  }
}

/// Rooms that include each other, however far around, are one room in disguise.
TEST(Architecture, NoArrowRunsBack) {
  std::map<std::string, std::set<std::string>> arrows;
  for (const auto& [path, text] : support::read_sources(kRoots)) {
    for (const Include& include : includes_of(text)) {
      const std::string other = room_of_include(include.target);
      if (include.quoted && include.target.starts_with("vantage/") && other != room_of(path)) {
        arrows[room_of(path)].insert(other);
      }
    }
  }
  for (const auto& [start, unused] : arrows) {
    std::set<std::string> reached;
    std::vector<std::string> open{start};
    while (!open.empty()) {
      const std::string room = open.back();
      open.pop_back();
      for (const std::string& next : arrows[room]) {
        if (reached.insert(next).second) open.push_back(next);
      }
    }
    EXPECT_FALSE(reached.contains(start)) << start << " includes itself by way of others";
  }
}

// The checker itself.

std::size_t count(const std::string& path, const std::string& text) {
  return violations(path, text).size();
}

TEST(ArchitectureChecker, RoomsOfPaths) {
  EXPECT_EQ(room_of("src/core/rng.hpp"), "core");
  EXPECT_EQ(room_of("src/tasks/mapping/map_panel.cpp"), "tasks/mapping");
  EXPECT_EQ(room_of("planners/gain.hpp"), "planners");
  EXPECT_EQ(room_of("planners/trajectory/esdf.hpp"), "planners/trajectory");
  EXPECT_EQ(room_of("bench/episode.cpp"), "bench");
  EXPECT_EQ(room_of("tests/support/x.hpp"), "");
  EXPECT_EQ(room_of("rng.hpp"), "");
  EXPECT_EQ(room_of_include("vantage/planners/gains/simple_gain.hpp"), "planners/gains");
}

TEST(ArchitectureChecker, LayersThatMayNotMeet) {
  EXPECT_EQ(count("src/core/a.cpp", "#include \"vantage/geometry/pose.hpp\"\n"), 1U);
  EXPECT_EQ(count("sim/world/a.cpp", "#include \"vantage/planners/gain.hpp\"\n"), 1U);
  EXPECT_EQ(count("planners/a.hpp", "#include \"vantage/sim/world/world.hpp\"\n"), 1U);
  EXPECT_EQ(count("planners/views/a.hpp", "#include \"vantage/perception/clouds/ply.hpp\"\n"), 1U);
  EXPECT_EQ(count("planners/trajectory/a.hpp", "#include \"vantage/planners/gain.hpp\"\n"), 1U);
  EXPECT_EQ(count("planners/gains/a.hpp", "#include \"vantage/planners/gain.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/belief/map/a.hpp", "#include \"vantage/perception/clouds/ply.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/perception/a.hpp", "#include \"vantage/belief/map/floor_map.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/information/a.hpp", "#include \"vantage/geometry/pose.hpp\"\n"), 1U);
  EXPECT_EQ(count("models/catalogue/table/a.cpp", "#include \"vantage/sim/world/world.hpp\"\n"),
            1U);
  EXPECT_EQ(count("src/runtime/a.cpp", "#include \"vantage/tasks/task.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/report/a.cpp", "#include \"vantage/sim/world/world.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/tasks/tabletop/a.cpp", "#include \"vantage/tasks/exploration/b.hpp\"\n"),
            1U);
  EXPECT_EQ(count("src/tasks/tabletop/a.cpp", "#include \"vantage/tasks/task.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/study/a.cpp", "#include \"vantage/tasks/tabletop/tabletop.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include \"bench/measures.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/brand_new/a.cpp", "#include \"vantage/core/rng.hpp\"\n"), 1U);
}

TEST(ArchitectureChecker, LayersThatMay) {
  EXPECT_EQ(count("src/geometry/a.cpp", "#include \"vantage/core/rng.hpp\"\n"), 0U);
  EXPECT_EQ(count("src/belief/map/a.cpp", "#include \"vantage/belief/map/b.hpp\"\n"), 0U);
  EXPECT_EQ(count("planners/a.cpp", "#include \"vantage/belief/map/occupancy_grid.hpp\"\n"), 0U);
  EXPECT_EQ(
      count("src/tasks/a_new_task/a.cpp",
            "#include \"vantage/planners/gain.hpp\"\n#include \"vantage/sim/world/world.hpp\"\n"),
      0U);
  EXPECT_EQ(count("src/tasks/task.hpp", "#include \"vantage/tasks/a_new_task/a.hpp\"\n"), 0U);
  EXPECT_EQ(count("bench/a.cpp", "#include \"bench/claims/b.hpp\"\n"), 0U);
}

TEST(ArchitectureChecker, IncludesReadAsTheyDoOnceInstalled) {
  EXPECT_EQ(count("src/core/a.cpp", "#include \"rng.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include \"../core/rng.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include \"src/core/rng.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include \"tests/support/x.hpp\"\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include <vector>\n#include <Eigen/Core>\n"), 0U);
}

TEST(ArchitectureChecker, LibrariesStayWhereTheyBelong) {
  EXPECT_EQ(count("src/tasks/mapping/a.cpp", "#include <mujoco/mujoco.h>\n"), 1U);
  EXPECT_EQ(count("src/tasks/a.cpp", "#include \"mujoco/mujoco.h\"\n"), 1U);
  EXPECT_EQ(count("sim/render/a.hpp", "#include <mujoco/mujoco.h>\n#include <GL/osmesa.h>\n"), 0U);
  EXPECT_EQ(count("sim/world/a.hpp", "#include <GL/osmesa.h>\n"), 1U);
  EXPECT_EQ(count("planners/a.cpp", "#include <embree3/rtcore.h>\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include <GLFW/glfw3.h>\n"), 1U);
  EXPECT_EQ(count("src/belief/map/a.cpp", "#include <octomap/OcTree.h>\n"), 0U);
  EXPECT_EQ(count("src/belief/map/a.hpp", "#include <octomap/OcTree.h>\n"), 1U);
  EXPECT_EQ(count("planners/a.cpp", "#include <octomap/OcTree.h>\n"), 1U);
  EXPECT_EQ(count("sim/world/a.cpp", "#include <opencv2/core.hpp>\n"), 1U);
  EXPECT_EQ(count("planners/trajectory/a.cpp", "#include <opencv2/core.hpp>\n"), 1U);
  EXPECT_EQ(count("src/perception/a.cpp", "#include <opencv2/core.hpp>\n"), 0U);
  EXPECT_EQ(count("src/belief/map/a.cpp", "#include <nanoflann.hpp>\n"), 1U);
  EXPECT_EQ(count("src/core/a.hpp", "#include <yaml-cpp/yaml.h>\n"), 1U);
  EXPECT_EQ(count("src/tasks/a.cpp", "#include <yaml-cpp/yaml.h>\n"), 1U);
  EXPECT_EQ(count("src/core/log.hpp", "#include <spdlog/spdlog.h>\n"), 1U);
  EXPECT_EQ(count("src/runtime/a.hpp", "#include <nlohmann/json.hpp>\n"), 1U);
  EXPECT_EQ(count("src/runtime/a.hpp", "#include <nlohmann/json_fwd.hpp>\n"), 0U);
  EXPECT_EQ(count("sim/world/a.hpp", "#include <nlohmann/json_fwd.hpp>\n"), 1U);
  EXPECT_EQ(count("src/cli/main.cpp", "#include <nlohmann/json.hpp>\n#include <CLI/CLI.hpp>\n"),
            0U);
  EXPECT_EQ(count("src/tasks/a.cpp", "#include <CLI/CLI.hpp>\n"), 1U);
  EXPECT_EQ(count("sim/world/a.cpp", "#include <png.h>\n"), 1U);
}

TEST(ArchitectureChecker, ReadsIncludesHoweverTheyAreWritten) {
  EXPECT_EQ(count("src/core/a.cpp", "  #  include  <mujoco/mujoco.h>  // why\n"), 1U);
  EXPECT_EQ(count("src/core/a.cpp", "#include\"vantage/sim/world/world.hpp\""), 1U);
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
  EXPECT_FALSE(too_long("tests/a.cpp", std::string(500, '\n')));
  EXPECT_TRUE(too_long("tests/a.cpp", std::string(501, '\n')));
}

}  // namespace
}  // namespace vantage::architecture
