// Whoever decides cannot name ground truth: follows the includes of every deciding source through
// our own headers and allows none that leads to the truth, the simulated world or a simulated
// robot.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <queue>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/source_files.hpp"

namespace {

namespace fs = std::filesystem;

/// Path from the repository root -> content.
using Sources = std::map<std::string, std::string>;

constexpr std::string_view kInclude = "vantage/";

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

/// Those that perceive, believe, plan and control, whole folders of them.
const std::vector<std::string> kDecidingFolders{"planners/",        "src/belief/",
                                                "src/perception/",  "src/recognition/",
                                                "src/information/", "src/control/"};

/// Those of a task that do: beginnings and ends of file names.
const std::vector<std::string> kDecidingEnds{"_parts.hpp", "_parts.cpp", "_belief.hpp",
                                             "_belief.cpp", "_robot_interface.hpp"};
const std::vector<std::string> kDecidingNames{
    "navigator.",      "object_inquiry.",   "table_map.",       "target_tour.",
    "visited_places.", "mapping_decision.", "outside_decision."};

bool decides(const std::string& path) {
  const auto begins = [&](const std::string& folder) { return path.starts_with(folder); };
  if (std::ranges::any_of(kDecidingFolders, begins)) return true;
  if (!path.starts_with("src/tasks/")) return false;
  const std::string name = file_name(path);
  return std::ranges::any_of(kDecidingEnds, [&](auto& end) { return name.ends_with(end); }) ||
         std::ranges::any_of(kDecidingNames, [&](auto& stem) { return name.starts_with(stem); });
}

/// Headers that declare what is really so. An evaluator's header declares the truth by name alone.
bool is_truth(const std::string& path) {
  const std::string name = file_name(path);
  return name.ends_with("ground_truth.hpp") || name.starts_with("simulated_") ||
         path == "sim/world/world.hpp" || path == "sim/sensors/ray_scene.hpp" ||
         path == "sim/render/renderer.hpp";
}

/// Where the file that is included by that name lies: "vantage/core/rng.hpp" in src/core.
std::string path_of(const std::string& target) {
  const std::string path = target.substr(kInclude.size());
  for (const char* root : {"planners/", "sim/", "models/"}) {
    if (path.starts_with(root)) return path;
  }
  return "src/" + path;
}

/// What stands between the quotes or brackets of each #include.
std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> targets;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') continue;
    const auto word = line.find_first_not_of(" \t", hash + 1);
    if (word == std::string::npos || line.compare(word, 7, "include") != 0) continue;
    const auto open = line.find_first_of("<\"", word);
    if (open == std::string::npos) continue;
    const auto close = line.find_first_of(">\"", open + 1);
    if (close != std::string::npos) targets.push_back(line.substr(open + 1, close - open - 1));
  }
  return targets;
}

/// Our headers that a text includes.
std::vector<std::string> headers_of(const std::string& text) {
  std::vector<std::string> headers;
  for (const std::string& target : includes_of(text)) {
    if (target.starts_with(kInclude)) headers.push_back(path_of(target));
  }
  return headers;
}

/// The first type or member of truth that a text names; empty: none. An evaluator may be named.
std::string named_truth(const std::string& text) {
  static const std::regex pattern(R"(\b(\w*GroundTruth\b|Simulated[A-Z]\w*|ground_truth *\())");
  std::smatch found;
  return std::regex_search(text, found, pattern) ? found[0].str() : std::string();
}

/// "a.cpp -> b.hpp -> c_ground_truth.hpp", the shortest way to each header of truth that a file
/// includes, itself or through others.
std::vector<std::string> ways_to_truth(const Sources& sources, const std::string& file) {
  std::vector<std::string> ways;
  std::set<std::string> seen{file};
  std::queue<std::pair<std::string, std::string>> open;
  open.emplace(file, file);
  for (; !open.empty(); open.pop()) {
    const auto [path, way] = open.front();
    const auto found = sources.find(path);
    if (found == sources.end()) continue;
    for (const std::string& header : headers_of(found->second)) {
      if (!seen.insert(header).second) continue;
      const std::string on = std::string(way).append(" -> ").append(header);
      if (is_truth(header)) {
        ways.push_back(on);
      } else {
        open.emplace(header, on);
      }
    }
  }
  return ways;
}

const Sources& sources() {
  static const Sources all = vantage::support::read_sources({"src", "sim", "planners", "models"});
  return all;
}

TEST(GroundTruth, IsOutOfReachOfDecidingFiles) {
  for (const auto& [path, text] : sources()) {
    if (!decides(path)) continue;
    for (const std::string& way : ways_to_truth(sources(), path)) ADD_FAILURE() << way;
  }
}

/// Not even by a forward declaration, to pass it on.
TEST(GroundTruth, IsNamedByNoDecidingFile) {
  for (const auto& [path, text] : sources()) {
    if (!decides(path)) continue;
    EXPECT_EQ(named_truth(text), "") << path;
  }
}

/// A rule about files that are not there holds for nothing.
TEST(GroundTruth, EveryRuleMeetsAFile) {
  const auto count = [](const auto& wanted) {
    return std::ranges::count_if(sources(), [&](const auto& file) { return wanted(file.first); });
  };
  for (const std::string& folder : kDecidingFolders) {
    EXPECT_GT(count([&](const auto& path) { return path.starts_with(folder); }), 0) << folder;
  }
  const auto in_tasks = [](const std::string& path) { return path.starts_with("src/tasks/"); };
  for (const std::string& end : kDecidingEnds) {
    EXPECT_GT(count([&](const auto& path) { return in_tasks(path) && path.ends_with(end); }), 0)
        << end;
  }
  for (const std::string& stem : kDecidingNames) {
    EXPECT_GT(count([&](const auto& path) {
                return in_tasks(path) && file_name(path).starts_with(stem);
              }),
              0)
        << stem;
  }
  for (const char* path :
       {"sim/world/world.hpp", "sim/sensors/ray_scene.hpp", "sim/render/renderer.hpp"}) {
    EXPECT_TRUE(sources().contains(path)) << path;
  }
  EXPECT_GT(count([](const auto& path) { return path.ends_with("ground_truth.hpp"); }), 3);
  EXPECT_GT(count([](const auto& path) { return file_name(path).starts_with("simulated_"); }), 3);
}

/// Else a way would end there unseen.
TEST(GroundTruth, EveryIncludeOfOursIsFound) {
  for (const auto& [path, text] : sources()) {
    for (const std::string& target : includes_of(text)) {
      if (target.starts_with(kInclude)) {
        EXPECT_TRUE(sources().contains(path_of(target))) << path << ": " << target;
      }
      EXPECT_FALSE(target.starts_with(".")) << path << ": " << target;
    }
  }
}

/// Those who may: the check above is no blank one.
TEST(GroundTruth, IsWithinReachOfSimulatedRobotsAndEvaluators) {
  EXPECT_FALSE(ways_to_truth(sources(), "src/tasks/mapping/simulated/driven_by_base.hpp").empty());
  EXPECT_FALSE(
      ways_to_truth(sources(), "src/tasks/mapping/ground_truth_map_evaluator.cpp").empty());
}

// The checker itself.

TEST(GroundTruthChecker, TellsTheWay) {
  const Sources made_up{
      {"src/tasks/a/a_parts.cpp", "#include \"vantage/tasks/a/a_parts.hpp\"\n"},
      {"src/tasks/a/a_parts.hpp",
       "#include <vector>\n#include \"vantage/core/rng.hpp\"\n"
       "  #  include \"vantage/tasks/a/record.hpp\"\n"},
      {"src/tasks/a/record.hpp",
       "#include \"vantage/tasks/a/a_parts.hpp\"\n#include <vantage/tasks/a/a_ground_truth.hpp>\n"},
      {"src/tasks/a/a_ground_truth.hpp", "#include \"vantage/sim/world/world.hpp\"\n"}};
  EXPECT_EQ(ways_to_truth(made_up, "src/tasks/a/a_parts.cpp"),
            std::vector<std::string>{"src/tasks/a/a_parts.cpp -> src/tasks/a/a_parts.hpp -> "
                                     "src/tasks/a/record.hpp -> src/tasks/a/a_ground_truth.hpp"});
  EXPECT_TRUE(ways_to_truth(made_up, "src/core/rng.hpp").empty());
}

TEST(GroundTruthChecker, NamesOfTruth) {
  EXPECT_EQ(named_truth("const MobileGroundTruth& truth"), "MobileGroundTruth");
  EXPECT_EQ(named_truth("class SimulatedOrbitRobot;"), "SimulatedOrbitRobot");
  EXPECT_EQ(named_truth("robot.ground_truth()"), "ground_truth(");
  EXPECT_EQ(named_truth("const GroundTruthMapEvaluator& e; // simulated, ground truth"), "");
}

TEST(GroundTruthChecker, WhoDecides) {
  for (const char* path :
       {"planners/choice/view_choice.cpp", "src/belief/map/occupancy_grid.hpp",
        "src/tasks/tabletop/tabletop_parts.cpp", "src/tasks/mapping/driving/navigator.hpp",
        "src/tasks/mapping/driving/mobile_robot_interface.hpp", "src/tasks/wait/wait_belief.hpp"}) {
    EXPECT_TRUE(decides(path)) << path;
  }
  for (const char* path :
       {"src/tasks/tabletop/tabletop.cpp", "src/tasks/mapping/ground_truth_map_evaluator.hpp",
        "src/runtime/recorder.hpp", "sim/robots/pr2.hpp",
        "src/tasks/mapping/simulated/driven_by_base.hpp"}) {
    EXPECT_FALSE(decides(path)) << path;
  }
}

TEST(GroundTruthChecker, WhatIsTruth) {
  for (const char* path :
       {"src/tasks/mapping/mobile_ground_truth.hpp", "sim/sensors/ground_truth.hpp",
        "src/tasks/tabletop/simulated_tabletop_robot.hpp", "sim/world/world.hpp"}) {
    EXPECT_TRUE(is_truth(path)) << path;
  }
  for (const char* path :
       {"src/tasks/mapping/ground_truth_map_evaluator.hpp", "sim/world/world_options.hpp",
        "src/tasks/trajectory/trajectory_evaluator.hpp"}) {
    EXPECT_FALSE(is_truth(path)) << path;
  }
}

}  // namespace
