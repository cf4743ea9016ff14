// Reads every #include of the sources and enforces the table of ARCHITECTURE.md: which folder may
// include which, and where each third-party library may appear. Also how long files are and how
// large rooms.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLines = 300;
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

using Rooms = std::vector<std::string>;

Rooms operator+(Rooms a, const Rooms& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Rooms kGround{"core", "core/cancellation", "geometry", "information"};
const Rooms kPerception{
    "perception",        "perception/search",   "perception/clouds",      "perception/clutter",
    "perception/images", "perception/features", "perception/features/kit"};
const Rooms kBelief{"belief/map", "belief/objects", "belief/observation", "belief/tracking"};
const Rooms kPlanners{"planners",
                      "planners/gains",
                      "planners/visibility",
                      "planners/views",
                      "planners/tours",
                      "planners/choice",
                      "planners/navigation",
                      "planners/objects",
                      "planners/trajectory",
                      "planners/trajectory/optimisers"};
const Rooms kSim{"sim/world", "sim/render", "sim/sensors", "sim/robots", "sim/faults"};
const Rooms kRuntime{"runtime", "runtime/log", "runtime/drawing", "runtime/process"};
const Rooms kRecognition{"recognition", "recognition/calibration", "recognition/dataset",
                         "recognition/evaluation"};
const Rooms kStudy{"study",       "study/cluster",     "study/figures",
                   "study/kit",   "study/recognition", "study/sweep",
                   "study/tables"};
/// What several tasks share; they never include each other.
const Rooms kSharedByTasks{
    "tasks/mapping",          "tasks/mapping/drawing",   "tasks/mapping/driving",
    "tasks/mapping/external", "tasks/mapping/hindsight", "tasks/mapping/measures",
    "tasks/mapping/plans",    "tasks/mapping/simulated", "tasks/flight",
    "tasks/object_flight",    "tasks/table_map"};
const Rooms kTask = kGround + kPerception + kBelief + kPlanners + kSim + kRuntime + kRecognition +
                    kSharedByTasks + Rooms{"control", "dataset", "localisation", "report"};

/// Which rooms each room may include besides itself.
const std::map<std::string, Rooms> kAllowed{
    {"core", {}},
    {"core/cancellation", {}},
    {"geometry", {"core"}},
    {"information", {"core"}},
    {"control", {"core", "geometry"}},
    {"perception/clouds", {"core", "geometry"}},
    {"perception/images", {"core"}},
    {"perception", kGround + Rooms{"perception/clouds", "perception/images"}},
    {"perception/clutter", kGround + Rooms{"perception"}},
    {"perception/search", kGround + Rooms{"perception"}},
    {"perception/features/kit", kGround + Rooms{"perception", "perception/clouds"}},
    {"perception/features/patches",
     kGround + Rooms{"perception", "perception/clouds", "perception/features/kit"}},
    {"perception/features",
     kGround + Rooms{"perception", "perception/clouds", "perception/features/kit",
                     "perception/features/patches"}},
    {"belief/map/octomap", {"core"}},
    {"belief/map", kGround + Rooms{"belief/map/octomap"}},
    {"belief/observation", kGround},
    {"belief/objects", kGround + Rooms{"belief/observation"}},
    {"belief/tracking", kGround},
    {"planners/visibility", kGround + Rooms{"belief/map"}},
    {"planners/gains", kGround + Rooms{"belief/map", "planners/visibility"}},
    {"planners/tours", {"core", "core/cancellation", "geometry"}},
    {"planners",
     kGround + Rooms{"belief/map", "planners/visibility", "planners/gains", "planners/tours"}},
    {"planners/views", kGround + Rooms{"belief/map", "planners"}},
    {"planners/choice", kGround + Rooms{"belief/map", "planners", "planners/navigation",
                                        "planners/views", "planners/tours", "planners/visibility"}},
    {"planners/navigation", kGround + Rooms{"belief/map"}},
    {"planners/objects", kGround + Rooms{"belief/objects", "belief/observation"}},
    {"planners/trajectory/optimisers", {"core", "geometry"}},
    {"planners/trajectory",
     kGround + Rooms{"belief/map", "control", "planners/trajectory/optimisers"}},
    {"recognition/dataset", kGround + kPerception + Rooms{"belief/objects", "belief/observation"}},
    {"recognition/calibration",
     kGround + kPerception +
         Rooms{"belief/objects", "belief/observation", "planners/objects", "recognition/dataset"}},
    {"recognition",
     kGround + kPerception +
         Rooms{"belief/objects", "belief/observation", "planners/objects", "planners/trajectory",
               "recognition/calibration", "recognition/dataset"}},
    {"recognition/evaluation", kGround + Rooms{"recognition", "recognition/dataset"}},
    {"sim/stepping", {"core", "geometry"}},
    {"sim/world", {"core", "geometry", "sim/stepping"}},
    {"sim/render", {"core", "geometry", "sim/world"}},
    {"sim/sensors", {"core", "geometry", "sim/world", "sim/render"}},
    {"sim/robots", {"core", "geometry", "control", "sim/world"}},
    {"sim/faults", {"core", "geometry", "sim/world"}},
    {"models/catalogue/shapes", {"core", "geometry"}},
    {"models/catalogue/objects", {"core", "geometry", "models/catalogue/shapes"}},
    {"models/catalogue/database",
     {"core", "geometry", "models/catalogue/shapes", "models/catalogue/objects"}},
    {"models/catalogue/table",
     {"core", "geometry", "models/catalogue/shapes", "models/catalogue/objects"}},
    {"models/catalogue/office", {"core", "geometry", "models/catalogue/shapes"}},
    {"models/catalogue/flight", {"core", "geometry", "models/catalogue/shapes"}},
    {"models/catalogue",
     {"core", "models/catalogue/table", "models/catalogue/office", "models/catalogue/flight"}},
    {"dataset",
     {"core", "geometry", "perception", "perception/search", "models/catalogue/shapes",
      "models/catalogue/database", "sim/render", "sim/sensors"}},
    {"dataset/pictures", {"core", "geometry", "perception", "perception/images", "dataset"}},
    {"recipe", kGround + Rooms{"belief/objects", "belief/observation", "perception", "recognition",
                               "recognition/dataset", "dataset", "sim/render"}},
    {"localisation", {"core", "geometry", "perception/clouds"}},
    {"report", {"core", "geometry", "perception/clouds", "planners/tours"}},
    {"bound", {"core", "geometry"}},
    {"building", {"core", "geometry", "planners/navigation"}},
    {"hindsight", kTask + Rooms{"bound", "tasks", "tasks/*"}},
    {"runtime/process", {"core"}},
    {"runtime/drawing", {"core", "geometry", "belief/map", "planners/tours"}},
    {"runtime/log",
     {"core", "geometry", "belief/map", "planners", "planners/tours", "sim/world", "sim/render"}},
    {"runtime",
     kGround + Rooms{"belief/map", "planners", "planners/choice", "report", "runtime/log",
                     "sim/faults", "sim/world", "sim/render", "sim/robots"}},
    {"tasks/mapping", kTask},
    {"tasks/mapping/drawing", kTask},
    {"tasks/mapping/driving", kTask},
    {"tasks/mapping/external", kTask},
    {"tasks/mapping/hindsight", kTask},
    {"tasks/mapping/measures", kTask},
    {"tasks/mapping/plans", kTask},
    {"tasks/mapping/simulated", kTask},
    {"tasks/flight", kTask},
    {"tasks/object_flight", kTask},
    {"tasks/table_map", kTask},
    {"tasks", kGround + kSim + kRuntime + Rooms{"belief/map", "report", "tasks/*"}},
    {"study/figures", {"core", "geometry", "information", "report"}},
    {"study/recognition", kGround + kRecognition + kRuntime +
                              Rooms{"belief/objects", "belief/observation", "study/figures"}},
    {"study/kit", kGround + kRuntime + Rooms{"tasks"}},
    {"study/cluster", {"core"}},
    {"study/tables", {"core", "information", "report", "runtime", "study/figures"}},
    {"study",
     kGround + kRuntime +
         Rooms{"report", "study/cluster", "study/figures", "study/kit", "study/tables", "tasks"}},
    {"study/sweep", kGround + kRuntime + Rooms{"study", "study/cluster", "tasks"}},
    {"arena", kGround + kRuntime + kStudy + Rooms{"report", "tasks"}},
    {"view", kGround + kRuntime + kSim + Rooms{"tasks"}},
    {"mcap", kGround + kRuntime + kSim +
                 Rooms{"belief/map", "perception/clouds", "planners", "report", "tasks"}},
    {"cli/export", {"core", "cli/hints", "mcap", "runtime"}},
    {"cli/arena", kGround + kRuntime + kStudy + Rooms{"arena", "cli/hints", "hindsight", "tasks"}},
    {"cli/hints", {"core", "study"}},
    {"cli/hindsight",
     kGround + kRuntime + Rooms{"sim/world", "cli/hints", "hindsight", "report", "tasks"}},
    {"cli/recognition", kGround + kPerception + kRecognition + kRuntime +
                            Rooms{"belief/objects", "belief/observation", "planners/objects"}},
    {"cli/pictures", kGround + kRuntime + Rooms{"cli/hints", "dataset/pictures", "perception"}},
    {"cli/scene", {"core", "geometry", "building", "runtime"}},
    {"cli/sweep", kGround + kRuntime + kStudy + Rooms{"cli/hints", "tasks"}},
    {"cli/reference",
     kGround + kPerception + kPlanners + kSim + kRuntime + kRecognition + kStudy +
         Rooms{"belief/objects", "belief/observation", "cli/hints", "dataset", "recipe", "tasks"}},
    {"cli/manual", {"core"}},
    {"cli/schema", kGround + kPerception + kSim + kRuntime + kRecognition + kStudy +
                       Rooms{"dataset", "recipe", "tasks"}},
    {"cli", kGround + kPerception + kPlanners + kSim + kRuntime + kRecognition + kStudy +
                Rooms{"cli/arena", "cli/export", "cli/hindsight", "cli/hints", "cli/manual",
                      "cli/pictures", "cli/recognition", "cli/reference", "cli/scene", "cli/schema",
                      "cli/sweep", "dataset", "hindsight", "models/catalogue/database", "recipe",
                      "report", "tasks", "view"}},
    {"bench/claims", {"core", "report", "study", "study/tables", "bench"}},
    {"bench/pages",
     {"core", "planners/trajectory", "report", "study/cluster", "study/figures", "bench",
      "bench/claims"}},
    {"bench/model", kTask + Rooms{"bench", "tasks", "tasks/*"}},
    {"bench", kTask + kStudy + Rooms{"bench/claims", "tasks", "tasks/*", "tests/support"}},
    {"python/kit", kGround + Rooms{"planners", "planners/views"}},
    {"python/planning", kGround + kBelief + kPlanners + Rooms{"python", "python/kit"}},
    {"python/recognition",
     kGround + kPerception + kBelief + kPlanners + kRecognition + Rooms{"python", "python/kit"}},
    {"python/episodes", kGround + kBelief + kPlanners + kRuntime +
                            Rooms{"tasks", "python", "python/kit", "python/planning"}},
    {"python", kGround + kPlanners + kRuntime + Rooms{"tasks", "python/kit"}},
};

/// What a room may include; none if it is not in the table. A folder of src/tasks is a task.
const Rooms* allowed_in(const std::string& room) {
  if (const auto found = kAllowed.find(room); found != kAllowed.end()) return &found->second;
  return room.starts_with("tasks/") ? &kTask : nullptr;
}

bool is_allowed(const Rooms& rooms, const std::string& other) {
  return std::ranges::any_of(rooms, [&](const std::string& room) {
    return room == other ||
           (room.ends_with("/*") && other.starts_with(room.substr(0, room.size() - 1)));
  });
}

/// Where the headers of a library may appear.
struct LibraryRule {
  std::string_view prefix;           ///< of the header's name
  std::vector<std::string> folders;  ///< and their rooms
  bool sources_only = false;         ///< not in our headers
};

const std::vector<LibraryRule> kLibraries{
    {"mujoco/", {"sim"}},
    {"GL/", {"sim/render"}},
    {"GLFW/", {"sim/render"}},
    {"embree", {"sim/sensors"}},
    {"octomap/", {"belief/map", "bench"}, true},
    {"opencv2/",
     {"perception", "recognition", "dataset", "runtime", "tasks", "view", "mcap", "cli", "bench"}},
    {"nanoflann", {"perception/clouds"}},
    {"yaml-cpp/", {"core"}, true},
    {"spdlog/", {"core"}, true},
    {"nlohmann/json_fwd.hpp",
     {"core", "runtime", "tasks", "report", "study", "arena", "hindsight", "mcap", "cli",
      "bench"}},  // declarations only
    {"nlohmann/",
     {"core", "runtime", "tasks", "report", "study", "arena", "hindsight", "mcap", "cli", "bench"},
     true},
    {"png", {"models/catalogue/shapes"}},
    {"CLI/", {"cli"}, true},
    {"Clp", {"bound"}, true},
    {"ceres/", {"localisation"}, true},
    {"assimp/", {"building"}, true},
    {"zlib", {"mcap"}, true},
    {"zstd", {"mcap"}, true},
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
  if (lines <= kMaxLines) return std::nullopt;
  return path + ": " + std::to_string(lines) + " lines";
}

/// Path from the repository root -> content, of every source file.
std::map<std::string, std::string> read_sources() {
  const fs::path repository = VANTAGE_SOURCE_DIR;
  std::map<std::string, std::string> sources;
  for (const auto& root : kRoots) {
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

TEST(Architecture, EveryRoomIsInTheTable) {
  std::size_t files = 0;
  for (const auto& [path, text] : read_sources()) {
    EXPECT_NE(allowed_in(room_of(path)), nullptr) << path;
    ++files;
  }
  EXPECT_GT(files, 20U);  // it read something
}

TEST(Architecture, RoomsAreSmall) {
  std::map<std::string, std::set<std::string>> units;
  std::map<std::string, std::size_t> lines;
  for (const auto& [path, text] : read_sources()) {
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
  for (const auto& [path, text] : read_sources()) {
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
}

}  // namespace
