// What is said of files before anything runs, and what an episode leaves to its robot.
#include "vantage/tasks/validate.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/support/octomap_bytes.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/robot_defaults.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ValidationOf, IsWhatIsFoundOrWhatIsThrown) {
  const Validation two = validation_of([]() -> Validation {
    throw ConfigError(std::vector<std::string>{"one thing", "another"});
  });
  EXPECT_THAT(two.problems, ElementsAre("one thing", "another"));
  EXPECT_EQ(two.code, ExitCode::usage);
  const Validation one = validation_of([]() -> Validation { throw InputError("no such file"); });
  EXPECT_THAT(one.problems, ElementsAre("no such file"));
  EXPECT_EQ(one.code, ExitCode::bad_input);
  const Validation noted = validation_of([] { return Validation{{}, {"a note"}, ExitCode::done}; });
  EXPECT_THAT(noted.problems, IsEmpty());
  EXPECT_THAT(noted.notes, ElementsAre("a note"));
  EXPECT_EQ(noted.code, ExitCode::done);
}

std::string problem(const fs::path& file, const std::vector<std::string>& overrides = {}) {
  const Validation found = validate_file(file, overrides);
  return found.problems.size() == 1 ? found.problems.front() : "";
}

TEST(ValidateFile, SaysWhatItDoesNotKnow) {
  const support::TemporaryDirectory folder;
  EXPECT_THAT(problem(folder / "none.yaml"), HasSubstr("none.yaml: no such file"));
  EXPECT_EQ(validate_file(folder / "none.yaml").code, ExitCode::bad_input);
  EXPECT_THAT(problem(folder.path()), HasSubstr("there is no robot.yaml in it"));
  write_file(folder / "a.txt", "text");
  EXPECT_THAT(problem(folder / "a.txt"), HasSubstr("a.txt: unknown kind of file '.txt'"));
  write_file(folder / "e.yml", "nonsense: 1\n");
  EXPECT_THAT(problem(folder / "e.yml"), HasSubstr("unknown key 'nonsense'"));
}

TEST(ValidateFile, OfAMapNeedsCells) {
  const support::TemporaryDirectory folder;
  write_file(folder / "free.bt", support::octomap_bytes({{{4, 5, 6}, 1, false}}, 0.1));
  write_file(folder / "occupied.bt", support::octomap_bytes({{{4, 5, 6}, 1, true}}, 0.1));
  EXPECT_THAT(validate_file(folder / "free.bt").problems, IsEmpty());
  EXPECT_THAT(validate_file(folder / "occupied.bt").problems, IsEmpty());
}

TEST(ValidateFile, SaysNothingOfTheShippedQuadrotors) {
  for (const char* robot : {"quadrotor", "quadrotor_mini"}) {
    const Validation found =
        validate_file(find_input(fs::path("models/robots") / robot, {}, "robot"));
    EXPECT_THAT(found.problems, IsEmpty()) << robot;
    EXPECT_THAT(found.notes, IsEmpty()) << robot;
  }
}

TEST(ValidateFile, SetsKeysOfEpisodesAndScenesAlone) {
  const support::TemporaryDirectory folder;
  write_file(folder / "map.bt", support::octomap_bytes({{{4, 5, 6}, 1, true}}, 0.1));
  const std::vector<std::string> set{"scans=3"};
  EXPECT_THAT(problem(folder / "map.bt", set), HasSubstr("--set is for episodes and scenes"));
  const fs::path robots = fs::path(VANTAGE_SOURCE_DIR) / "models/robots";
  EXPECT_THAT(problem(robots / "rover", set), HasSubstr("--set is for episodes and scenes"));
  EXPECT_THAT(problem(robots / "rover/robot.yaml", set), HasSubstr("--set is for"));
  EXPECT_EQ(validate_file(robots / "rover", set).code, ExitCode::usage);
}

std::string text_of(const ConfigNode& root, std::string_view key) {
  const ConfigNode* node = find_value(root, key);
  return node == nullptr ? "" : node->scalar;
}

RobotFolder robot_with(const std::string& defaults) {
  RobotFolder robot;
  robot.episode_defaults = parse_yaml(defaults, "robot.yaml");
  MobileBaseDescription base;
  base.footprint.circumscribed_radius_m = 0.25;
  robot.kind = base;
  return robot;
}

const ConfigNode kNoKeys = ConfigNode::make_map();

TEST(RobotDefaults, FillInWhatTheEpisodeLeavesOut) {
  const RobotFolder robot = robot_with(
      "tabletop: {scans: 7, candidates: {height_m: 1.4, radius_m: 2}, gain: {a: 3}, seed: 4}");
  const ConfigNode episode =
      parse_yaml("candidates: {height_m: 1.2}\ngain: simple\nscans: null\nseed: 9\n", "e.yaml");
  const ConfigNode filled = with_robot_defaults(episode, kNoKeys, robot, "tabletop");
  EXPECT_EQ(text_of(filled, "candidates.height_m"), "1.2");
  EXPECT_EQ(text_of(filled, "candidates.radius_m"), "2");
  EXPECT_EQ(text_of(filled, "gain"), "simple") << "it has no keys";
  EXPECT_EQ(text_of(filled, "scans"), "7");
  EXPECT_EQ(text_of(filled, "seed"), "9");
  EXPECT_EQ(find_value(filled, "navigation"), nullptr);
  const ConfigNode other = with_robot_defaults(episode, kNoKeys, robot, "exploration");
  EXPECT_EQ(find_value(other, "candidates.radius_m"), nullptr) << "of another task";
}

/// A centimetre more than the circle that covers it.
TEST(RobotDefaults, HaveTheFootprintOfABaseThatNavigates) {
  const RobotFolder robot = robot_with("{}");
  const ConfigNode keys = parse_yaml("navigation: {margin_m: 0.04}", "keys");
  const ConfigNode episode = parse_yaml("scans: 3", "e.yaml");
  const ConfigNode filled = with_robot_defaults(episode, keys, robot, "tabletop");
  EXPECT_EQ(text_of(filled, "navigation.footprint_radius_m"), "0.26");
  const ConfigNode said = parse_yaml("navigation: {footprint_radius_m: 0.5}", "e.yaml");
  EXPECT_EQ(
      text_of(with_robot_defaults(said, keys, robot, "tabletop"), "navigation.footprint_radius_m"),
      "0.5");
  RobotFolder flying = robot;
  flying.kind = QuadrotorDescription{};
  EXPECT_EQ(find_value(with_robot_defaults(episode, keys, flying, "tabletop"), "navigation"),
            nullptr);
}

TEST(ValidateFile, OfAModelReadsIt) {
  const support::TemporaryDirectory folder;
  write_file(folder / "a.model", "no model");
  EXPECT_THAT(problem(folder / "a.model"), HasSubstr("a.model"));
  EXPECT_EQ(validate_file(folder / "a.model").code, ExitCode::bad_input);
}

TEST(RobotDefaults, SayWhereTheFootprintComesFrom) {
  RobotFolder robot = robot_with("{}");
  robot.description = "mine/robot.yaml";
  const ConfigNode keys = parse_yaml("navigation: {margin_m: 0.04}", "keys");
  const ConfigNode filled =
      with_robot_defaults(parse_yaml("scans: 3", "e.yaml"), keys, robot, "tabletop");
  const ConfigNode* radius = find_value(filled, "navigation.footprint_radius_m");
  ASSERT_NE(radius, nullptr);
  EXPECT_EQ(radius->where(), "mine/robot.yaml: navigation.footprint_radius_m");
}

/// Of data and in a working directory that have a scene and no robots.
TEST(ValidateFile, OfASceneNamesTheKeyOfTheRobotThatIsMissing) {
  const support::TemporaryDirectory folder;
  write_file(folder / "scene.xml", "<mujoco/>");
  const fs::path before = fs::current_path();
  const char* set = std::getenv("VANTAGE_DATA");
  const std::string data = set == nullptr ? "" : set;  // empty is as good as none
  ::setenv("VANTAGE_DATA", folder.path().c_str(), 1);
  fs::current_path(folder.path());
  const std::string said = problem(folder / "scene.xml");
  fs::current_path(before);
  ::setenv("VANTAGE_DATA", data.c_str(), 1);
  EXPECT_THAT(said, testing::StartsWith("robot.model: models/robots/pr2: no such file (looked in "
                                        "., the working directory and " +
                                        folder.path().string()));
}

}  // namespace
}  // namespace vantage
