// What is said of episodes that older versions wrote.
#include "vantage/tasks/former_keys.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

#include "vantage/core/yaml.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

/// What is wrong with an episode; nothing: it is good.
std::vector<std::string> problems(const std::string& yaml) {
  EpisodeOptions options;
  Task task;
  try {
    read_episode(parse_yaml(yaml, "e.yaml"), options, task);
  } catch (const ConfigError& error) {
    return error.problems();
  }
  return {};
}

/// The one thing that is wrong with it.
std::string problem(const std::string& yaml) {
  const std::vector<std::string> found = problems(yaml);
  EXPECT_THAT(found, SizeIs(1)) << yaml;
  return found.empty() ? "" : found.front();
}

TEST(FormerKeys, ASettingIsATaskNow) {
  EXPECT_THAT(problem("scans: 3\nsetting: office\n"),
              AllOf(HasSubstr("e.yaml:2: setting"), HasSubstr("write 'task: exploration'")));
  EXPECT_THAT(problem("setting: tabletop\n"),
              AllOf(HasSubstr("e.yaml:1: setting"), HasSubstr("write 'task: tabletop'")));
}

TEST(FormerKeys, NextBestViewIsTwoTasksNow) {
  EXPECT_THAT(problem("task: next_best_view\n"),
              AllOf(HasSubstr("e.yaml:1: task"), HasSubstr("task: tabletop"),
                    HasSubstr("task: exploration")));
}

TEST(FormerKeys, ThoseOfATaskStandAtTheTopLevelNow) {
  for (const std::string section :
       {"exploration", "recognition", "change_detection", "trajectory"}) {
    EXPECT_THAT(problem(fmt::format("task: {0}\n{0}: {{model: m, horizon: 3}}\n", section)),
                AllOf(HasSubstr("e.yaml:2: " + section),
                      HasSubstr("write model in place of " + section + ".model")));
    EXPECT_THAT(problem(fmt::format("task: {0}\n{0}:\n  most_views: 3\n", section)),
                HasSubstr("top level"))
        << "said once, of the section";
  }
}

TEST(FormerKeys, AnOverrideOfASectionToo) {
  try {
    load_episode(std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition.yaml",
                 {"recognition.max_views=3"});
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("--set: recognition"),
                                    HasSubstr("write max_views in place of recognition.")));
  }
}

TEST(FormerKeys, EveryProblemIsNamed) {
  EXPECT_THAT(problems("setting: office\nmost_views: 3\ncandidates: {positions: 8}\n"), SizeIs(2))
      << "and of the new ones when the former are gone";
}

struct Renamed {
  std::string former;
  std::string now;
};

const std::vector<Renamed> kRenamed = {
    {"most_views", "max_views"},
    {"pilot", "tracking"},
    {"tracking.controller.push_per_s", "tracking.controller.disturbance_per_s"},
    {"tracking.controller.push_max_m_s2", "tracking.controller.disturbance_max_m_s2"},
    {"found", "tracker"},
    {"tracker.min_sightings", "tracker.min_detections"},
    {"looks", "observations"},
    {"observations.look_at_known", "observations.observe_known"},
    {"observations.least_gain_nats", "observations.min_gain_nats"},
    {"picture_rate_hz", "image_rate_hz"},
    {"planner.look_m", "planner.observation_distance_m"},
    {"planner.leash_m", "planner.path_deviation_tolerance_m"},
    {"planner.leash_weight", "planner.path_deviation_weight"},
    {"planner.search.least_m2", "planner.search.min_area_m2"},
    {"method.sensitivity", "method.inverse_temperature"},
    {"method.least_sigma", "method.min_sigma"},
    {"method.least_step", "method.min_step"},
    {"most_candidates", "max_candidates"},
    {"wall_novelty_m", "reference_novelty_m"},
    {"headroom.most_unseen", "headroom.max_unseen"},
    {"registration.min_pairs", "registration.min_correspondences"},
    {"registration.min_constraint_pairs", "registration.min_constraint_correspondences"},
};

/// "a: {b: {c: 1}}" of "a.b.c".
std::string yaml_of(const std::string& path) {
  ConfigNode root = ConfigNode::make_map();
  apply_overrides(root, {path + "=1"});
  return to_yaml(root);
}

TEST(FormerKeys, ThatWereRenamedSayWhatTheyAreCalled) {
  for (const auto& [former, now] : kRenamed) {
    EXPECT_THAT(problem(yaml_of(former)),
                AllOf(HasSubstr(": " + former + ": "), HasSubstr("is called '" + now + "' now")));
  }
}

void add_paths(const ConfigNode& node, const std::string& prefix, std::set<std::string>& paths) {
  for (const auto& [name, child] : node.entries) {
    const std::string path = fmt::format("{}{}{}", prefix, prefix.empty() ? "" : ".", name);
    paths.insert(path);
    add_paths(child, path, paths);
  }
}

/// Every key that an episode of any task may have, dotted.
std::set<std::string> all_keys() {
  std::set<std::string> paths;
  for_each_task([&](auto task) {
    ConfigNode node = ConfigNode::make_map();
    task.fields(FieldWriter(node));
    add_paths(node, "", paths);
  });
  for (const std::string_view name : strategy_names<TrajectoryMethod>()) {
    add_paths(write_node(make_strategy<TrajectoryMethod>(name)), "method", paths);
  }
  return paths;
}

TEST(FormerKeys, AreNoKeysAndWhatIsWrittenNowIsOne) {
  const std::set<std::string> keys = all_keys();
  for (const auto& [former, now] : kRenamed) {
    EXPECT_TRUE(keys.contains(now)) << now;
    EXPECT_FALSE(keys.contains(former)) << former;
  }
}

TEST(FormerKeys, NothingIsSaidOfKeysThatAreAlikeElsewhere) {
  EXPECT_THAT(
      problems("task: trajectory\nsimulation: {timestep_s: 0.002, control_period_s: 0.002}\n"
               "observations: {min_gain_nats: 0.07}\n"),
      testing::IsEmpty());
  EXPECT_THAT(problem("exploration: 3\n"), HasSubstr("unknown key 'exploration'"));
}

}  // namespace
}  // namespace vantage
