// What every task says of itself, and which keys an episode of it may have.
#include "vantage/tasks/task.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kEpisodes = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes";

std::vector<fs::path> shipped_episodes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kEpisodes)) files.push_back(entry.path());
  return files;
}

std::set<std::string> keys_of(auto options) {
  ConfigNode node = ConfigNode::make_map();
  options.fields(FieldWriter(node));
  std::set<std::string> keys;
  for (const auto& [key, value] : node.entries) keys.insert(key);
  return keys;
}

/// What is said of an episode that is wrong; empty: it is good.
std::string complaint(const std::function<void()>& read) {
  try {
    read();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(Tasks, HaveTheNamesThatEpisodesAndListingsKnow) {
  EXPECT_THAT(strategy_names<Task>(), testing::ElementsAre("tabletop", "exploration", "recognition",
                                                           "change_detection", "trajectory"));
  for_each_task([](const auto& task) {
    EXPECT_EQ(strategy_name_of(make_strategy<Task>(task.name)), task.name);
  });
}

TEST(Tasks, AShippedEpisodeOfEachResolves) {
  std::set<std::string_view> resolved;
  for (const fs::path& file : shipped_episodes()) {
    const ResolvedEpisode episode = load_episode(file, {});
    resolved.insert(strategy_name_of(episode.task));
    EXPECT_TRUE(fs::exists(episode.setup.scene)) << file;
    EXPECT_GT(extent(episode).count, 0U) << file;
  }
  for (const std::string_view name : strategy_names<Task>()) EXPECT_TRUE(resolved.contains(name));
}

TEST(Tasks, AnEpisodeWithoutTaskIsATableTop) {
  EXPECT_EQ(strategy_name_of(resolve_episode(parse_yaml("scans: 2", "e.yaml"), "e.yaml").task),
            "tabletop");
}

TEST(Tasks, AnUnknownOneNamesThoseThereAre) {
  EpisodeOptions options;
  Task task;
  const std::string said =
      complaint([&] { read_episode(parse_yaml("task: flying", "e.yaml"), options, task); });
  EXPECT_THAT(said, testing::AllOf(HasSubstr("e.yaml:1: task"), HasSubstr("'flying'"),
                                   HasSubstr("tabletop, exploration, recognition, "
                                             "change_detection, trajectory")));
}

TEST(Tasks, TheConfigurationBeginsWithTheTaskAndHasItsKeysAlone) {
  for (const fs::path& file : shipped_episodes()) {
    const ResolvedEpisode episode = load_episode(file, {});
    const ConfigNode node = episode_node(episode);
    ASSERT_FALSE(node.entries.empty());
    EXPECT_EQ(node.entries.front().first, "task");
    EXPECT_EQ(node.entries.front().second.scalar, strategy_name_of(episode.task));
    std::set<std::string> expected = keys_of(EpisodeOptions{});
    expected.merge(std::visit([](const auto& task) { return keys_of(task); }, episode.task));
    expected.insert("task");
    std::set<std::string> written;
    for (const auto& [key, value] : node.entries) {
      EXPECT_TRUE(written.insert(key).second) << file << ": " << key << " twice";
    }
    EXPECT_EQ(written, expected) << file;
    EXPECT_EQ(episode_yaml(resolve_episode(parse_yaml(episode_yaml(episode), "again"), file)),
              episode_yaml(episode))
        << file;
  }
}

TEST(Tasks, HaveKeysThatOthersHaveNot) {
  const std::vector<std::pair<std::string_view, std::string>> own = {
      {"tabletop", "candidates"},
      {"exploration", "frontiers"},
      {"change_detection", "scenario"},
      {"trajectory", "horizon"}};
  for (const auto& [owner, key] : own) {
    for_each_task([&owner = owner, &key = key](const auto& task) {
      EXPECT_EQ(keys_of(task).contains(key), task.name == owner) << task.name << " " << key;
    });
  }
}

TEST(Tasks, NoKeyOfATaskIsOneOfEveryEpisode) {
  for_each_task([](const auto& task) {
    std::set<std::string> common = keys_of(EpisodeOptions{});
    common.insert("task");
    for (const std::string& key : keys_of(task)) {
      EXPECT_FALSE(common.contains(key)) << task.name << ": " << key;
    }
  });
}

/// The complaint about the key of `of`, set in an episode of the task `in`.
std::string complaint_of_foreign_key(std::string_view in, const std::string& key,
                                     const ConfigNode& value) {
  ConfigNode root = ConfigNode::make_map();
  root.set("task", ConfigNode::make_scalar(std::string(in)));
  root.set(key, value);
  EpisodeOptions options;
  Task task;
  return complaint([&] { read_episode(root, options, task); });
}

TEST(Tasks, AKeyOfAnotherTaskNamesThatTask) {
  int foreign = 0;
  for_each_task([&](auto owner) {
    ConfigNode theirs = ConfigNode::make_map();
    owner.fields(FieldWriter(theirs));
    for_each_task([&](const auto& task) {
      const std::set<std::string> known = keys_of(task);
      for (const auto& [key, value] : theirs.entries) {
        if (known.contains(key)) continue;
        ++foreign;
        const std::string said = complaint_of_foreign_key(task.name, key, value);
        EXPECT_THAT(said, HasSubstr("unknown key '" + key + "'")) << task.name;
        const std::size_t belongs = said.find("it belongs to ");
        ASSERT_NE(belongs, std::string::npos) << said;
        EXPECT_THAT(said.substr(belongs), HasSubstr(std::string(owner.name)));
        EXPECT_THAT(said.substr(belongs), testing::Not(HasSubstr(std::string(task.name))));
      }
    });
  });
  EXPECT_GT(foreign, 100);
}

TEST(Tasks, AnOverrideOfAnotherTaskNamesItToo) {
  const auto said = [](const char* episode, const std::string& assignment) {
    return complaint([&] { load_episode(kEpisodes / episode, {assignment}); });
  };
  EXPECT_THAT(said("office_small.yaml", "candidates.positions=8"),
              testing::AllOf(HasSubstr("--set"), HasSubstr("candidates"),
                             testing::EndsWith("it belongs to tabletop")));
  EXPECT_THAT(said("tabletop.yaml", "frontiers.min_cells=5"),
              testing::EndsWith("it belongs to exploration"));
  EXPECT_THAT(said("recognition.yaml", "scenario=pose"),
              testing::EndsWith("it belongs to change_detection"));
  EXPECT_THAT(said("trajectory.yaml", "scans=3"),
              testing::EndsWith("it belongs to tabletop, exploration"));
  EXPECT_THAT(said("tabletop.yaml", "nonsense=1"), testing::Not(HasSubstr("belongs")));
}

TEST(Tasks, AnswerWithoutAnEpisodeThatRan) {
  for_each_task([](const auto& task) {
    EXPECT_FALSE(task.method_name().empty()) << task.name;
    EXPECT_FALSE(task.metrics_task().empty()) << task.name;
    EXPECT_FALSE(task.report().step_word.empty()) << task.name;
    EXPECT_FALSE(task.window().overview_m.isEmpty()) << task.name;
    EXPECT_EQ(task.window().map.has_value(), task.report().map) << task.name;
  });
}

TEST(Tasks, WhatIsLeftToTheSceneIsAutoInDescriptions) {
  for (const Task& task : {Task(Tabletop{}), Task(Exploration{})}) {
    int open = 0;
    for (const KeyDescription& key : describe_episode(task)) {
      if (key.key == "robot.start_pose") {
        EXPECT_EQ(key.default_value, "null");
        EXPECT_THAT(key.type, testing::EndsWith(", or null"));
      } else if (key.key.starts_with("map.")) {
        ++open;
        EXPECT_EQ(key.default_value, "auto") << key.key;
        EXPECT_THAT(key.type, testing::EndsWith(", or auto")) << key.key;
      }
    }
    EXPECT_EQ(open, 3) << "centre, size and cells";
  }
}

TEST(Tasks, ARecognitionHasTheKeysOfItsParts) {
  std::set<std::string> keys;
  for (const KeyDescription& key : describe_episode(RecognitionTask{})) keys.insert(key.key);
  for (const char* key : {"clutter.objects", "map.margin_m", "separation.gap_m",
                          "separation.min_share", "targets_at_once", "time_limit_s"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
}

TEST(Tasks, FilesOfATaskAreFoundBesideItsEpisode) {
  const support::TemporaryDirectory folder;
  write_file(folder / "mine.model", "bytes");
  ConfigNode root = read_yaml(kEpisodes / "recognition.yaml");
  root.set("model", ConfigNode::make_scalar("mine.model"));
  const ResolvedEpisode episode = resolve_episode(root, folder / "e.yaml");
  EXPECT_EQ(std::get<RecognitionTask>(episode.task).model, (folder / "mine.model").string());
}

TEST(Tasks, AnEpisodeIsAMapOrSaysNothing) {
  EpisodeOptions options;
  Task task;
  EXPECT_EQ(complaint([&] { read_episode(ConfigNode{}, options, task); }), "");
  for (const char* text : {"words", "[scans, 3]"}) {
    EXPECT_THAT(complaint([&] { read_episode(parse_yaml(text, "e.yaml"), options, task); }),
                testing::AllOf(HasSubstr("e.yaml:1"), HasSubstr("expected a map")))
        << text;
  }
}

TEST(Tasks, AnExplorationHasTheKeysOfItsParts) {
  std::set<std::string> keys;
  for (const KeyDescription& key : describe_episode(Exploration{})) keys.insert(key.key);
  for (const char* key :
       {"camera.range_max_m", "enough.scans", "floor_detail.parts", "frontiers.min_cells",
        "gaze.worth", "headroom.high_m", "passages.margin_m", "stop.confidence", "sweep.pans"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
}

TEST(Tasks, AMapThatIsAutoIsLeftToTheScene) {
  const auto map_of = [](const std::string& yaml) {
    EpisodeOptions options;
    Task task;
    read_episode(parse_yaml(yaml, "e.yaml"), options, task);
    return std::get<Tabletop>(task).map;
  };
  const MapOptions whole = map_of("map: auto\n");
  EXPECT_FALSE(whole.centre_m || whole.size_m || whole.cells);
  const MapOptions part = map_of("map: {centre_m: auto, cells: [3, 5, 7]}\n");
  EXPECT_FALSE(part.centre_m || part.size_m);
  ASSERT_TRUE(part.cells);
  EXPECT_THAT(*part.cells, testing::ElementsAre(3, 5, 7));
  EXPECT_THROW(map_of("map: 'auto'\n"), ConfigError) << "a text";
  EXPECT_THROW(map_of("map: {centre_m: 'auto'}\n"), ConfigError) << "a text";
}

TEST(Tasks, HaveAllTheirKeys) {
  const std::map<std::string_view, std::set<std::string>> keys = {
      {"tabletop",
       {"base_scanner", "budget",   "candidates", "choice",       "clutter_hazard", "drive",
        "floor_map",    "forecast", "free_space", "gain",         "hole_filling",   "intervals",
        "laser",        "map",      "metrics",    "localisation", "navigation",     "objects",
        "odometry",     "planning", "scans",      "registration", "sensor_model",   "table"}},
      {"change_detection",
       {"aim_height_m",    "arc_rad",     "bearings",      "camera",     "colour_noise",
        "database",        "distance_m",  "elevation_rad", "exposure",   "model",
        "object",          "placement_m", "recogniser",    "scenario",   "segmentation",
        "settle_s",        "table_m",     "tracking",      "turned_rad", "expected_object",
        "expected_yaw_rad"}},
      {"trajectory",
       {"camera", "camera_pitch_rad", "colour_noise", "database", "exposure", "horizon",
        "image_rate_hz", "latency_s", "map", "method", "model", "observations", "placement_m",
        "planner", "recogniser", "search", "tracker", "tracking", "transition"}}};
  std::size_t found = 0;
  for_each_task([&](const auto& task) {
    const auto of_task = keys.find(task.name);
    if (of_task == keys.end()) return;
    ++found;
    EXPECT_THAT(keys_of(task), testing::IsSupersetOf(of_task->second)) << task.name;
  });
  EXPECT_EQ(found, keys.size());
}

TEST(Tasks, ATableTopHasTheKeysOfItsParts) {
  std::set<std::string> keys;
  for (const KeyDescription& key : describe_episode(Tabletop{})) keys.insert(key.key);
  for (const char* key :
       {"budget.energy_j", "budget.return_to_start", "budget.time_s", "localisation.accept_drift",
        "localisation.loops.close", "localisation.max_contradicted",
        "localisation.max_unregistered", "localisation.tolerance_cells", "map.cells",
        "map.centre_m", "map.size_m", "metrics.distance_band_m", "metrics.predictors",
        "metrics.tolerance_cells"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
}

/// As a study sets keys over those of its episode.
TEST(Tasks, AStartOfAnotherFileTakesThePlaceOfTheEpisodes) {
  const auto started = [](const std::string& robot, const std::string& key,
                          const std::string& value) {
    ConfigNode root = parse_yaml("task: exploration\nrobot: " + robot + "\n", "e.yaml");
    set_values(root, {{key, parse_yaml(value, "study.yaml")}});
    EpisodeOptions options;
    Task task;
    read_episode(root, options, task);
    return options.robot;
  };
  const RobotOptions posed = started("{start_site: here}", "robot.start_pose", "[1, 2, 0.5]");
  EXPECT_EQ(posed.start_site, "");
  ASSERT_TRUE(posed.start_pose);
  EXPECT_THAT(*posed.start_pose, testing::ElementsAre(1.0, 2.0, 0.5));
  const RobotOptions sited = started("{start_pose: [1, 2, 0.5]}", "robot.start_site", "there");
  EXPECT_EQ(sited.start_site, "there");
  EXPECT_FALSE(sited.start_pose);
}

TEST(Tasks, WhatDoesNotGoTogetherIsSaidOfItsFile) {
  EpisodeOptions options;
  Task task;
  const ConfigNode root = parse_yaml(
      "task: recognition\nsimulation: {timestep_s: 0.002, control_period_s: 0.02}\n", "e.yaml");
  EXPECT_THAT(complaint([&] { read_episode(root, options, task); }),
              testing::StartsWith("e.yaml:1: simulation.control_period_s: 0.02 must equal "
                                  "simulation.timestep_s = 0.002"));
}

TEST(Tasks, AnEmptyFileIsNoEpisode) {
  const support::TemporaryDirectory folder;
  write_file(folder / "e.yaml", "# nothing\n");
  EXPECT_THAT(complaint([&] { load_episode(folder / "e.yaml", {}); }), HasSubstr("e.yaml: empty"));
  write_file(folder / "e.yaml", "scans: 2\n");
  EXPECT_EQ(complaint([&] { load_episode(folder / "e.yaml", {}); }), "");
}

/// A page is made of what is in the folder: the scene may be elsewhere, the keys those of a former
/// version.
TEST(Tasks, APageIsMadeOfARunWhoseSceneIsGone) {
  const support::TemporaryDirectory folder;
  write_file(folder / "config.yaml", "task: trajectory\nscene: gone.xml\nsetting: 3\n");
  EXPECT_EQ(recorded_sections(folder.path()).figures, kFlightFigures);
  write_file(folder / "config.yaml", "task: juggling\n");
  EXPECT_THROW(recorded_sections(folder.path()), InputError);
  std::filesystem::remove(folder / "config.yaml");
  EXPECT_THROW(recorded_sections(folder.path()), InputError);
}

TEST(Tasks, FilesThatCannotBeUsedAreNamedByKeyAndPlace) {
  const auto said = [](const std::string& yaml) -> std::string {
    try {
      resolve_episode(parse_yaml(yaml, "e.yaml"), "e.yaml");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(said("scans: 2\nscene: no/such.xml\n"), testing::StartsWith("e.yaml:2: scene: "));
  EXPECT_THAT(said("robot:\n  model: no/such\n"), testing::StartsWith("e.yaml:2: robot.model: "));
  EXPECT_THAT(said("robot:\n  model: models/scenes\n"),
              testing::AllOf(testing::StartsWith("e.yaml:2: robot.model: "),
                             HasSubstr("no robot.yaml in it")));
}

TEST(Tasks, FilesKeepNamesThatAreFoundFromAnywhere) {
  const fs::path source = VANTAGE_SOURCE_DIR;
  const fs::path scene = source / "models/scenes/recognition/scene.xml";
  const fs::path robot = source / "models/robots/quadrotor_mini";
  const ResolvedEpisode episode = load_episode(
      kEpisodes / "recognition.yaml", {"scene=" + scene.string(), "robot.model=" + robot.string()});
  EXPECT_EQ(episode.setup.name, "recognition");
  EXPECT_EQ(episode.setup.scene, scene);
  EXPECT_EQ(episode.setup.options.scene, lasting_name(scene));
  EXPECT_EQ(episode.setup.options.robot.model, lasting_name(robot));
  EXPECT_EQ(episode.setup.robot.description, robot / "robot.yaml");
  const std::vector<InputFile> files = inputs(episode.task);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].key, "model");
}

TEST(Tasks, DescriptionsHaveDefaultsAndStandInConfigurations) {
  Tabletop task;
  task.scans = 77;
  const std::vector<KeyDescription> keys = describe_episode(task);
  EXPECT_EQ(keys.front().key, "task");
  EXPECT_EQ(keys.front().default_value, "tabletop");
  EXPECT_THAT(keys.front().type,
              HasSubstr("tabletop, exploration, recognition, change_detection, trajectory"));
  const auto scans = std::ranges::find(keys, "scans", &KeyDescription::key);
  ASSERT_NE(scans, keys.end());
  EXPECT_EQ(scans->default_value, "10");
  EXPECT_EQ(std::ranges::count(keys, "seed", &KeyDescription::key), 1);
  ResolvedEpisode episode;
  episode.task = task;
  const std::string plain = episode_yaml(episode);
  const std::string commented = commented_episode_yaml(episode);
  EXPECT_THAT(plain, testing::StartsWith("task: tabletop\n"));
  EXPECT_THAT(plain, HasSubstr("scans: 77"));
  EXPECT_GT(commented.size(), plain.size());
  EXPECT_EQ(to_yaml(parse_yaml(commented, "e.yaml")), to_yaml(parse_yaml(plain, "e.yaml")));
}

}  // namespace
}  // namespace vantage
