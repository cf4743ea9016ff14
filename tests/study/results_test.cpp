// When a run folder counts as a result.
#include "vantage/study/results.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/study/manifest_of_files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

class Results : public testing::Test {
 protected:
  Results() {
    const auto base = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
    episode_ = {"near/simple", {0, 0}, load_episode(base, {"gain=simple"})};
    folder_ = episode_folder(study_.path(), episode_);
    fs::create_directories(folder_);
    write("config.yaml", episode_yaml(episode_.resolved));
    write("manifest.json", manifest_of_files(episode_.resolved));
    write("metrics.json", R"({"status": "completed"})");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  EpisodeState state() { return ResultCheck()(study_.path(), episode_); }

  support::TemporaryDirectory study_;
  PlannedEpisode episode_;
  fs::path folder_;
};

TEST_F(Results, WholeAndOfThisConfiguration) { EXPECT_EQ(state(), EpisodeState::completed); }

TEST_F(Results, ThreadsDoNotMatter) {
  episode_.resolved.setup.options.threads = 7;
  EXPECT_EQ(state(), EpisodeState::completed);
}

TEST_F(Results, AnotherConfigurationIsStale) {
  std::get<Tabletop>(episode_.resolved.task).scans = 9;
  EXPECT_EQ(state(), EpisodeState::stale);
}

TEST_F(Results, AnotherTaskIsStale) {
  RecognitionTask task;
  task.decision.max_views = 3;
  episode_.resolved.task = task;
  EXPECT_EQ(state(), EpisodeState::stale);
  write("config.yaml", episode_yaml(episode_.resolved));
  write("manifest.json", manifest_of_files(episode_.resolved));
  EXPECT_EQ(state(), EpisodeState::completed);
  std::get<RecognitionTask>(episode_.resolved.task).decision.max_views = 4;
  EXPECT_EQ(state(), EpisodeState::stale);
}

TEST_F(Results, AnotherFileOfSceneOrRobotIsStale) {
  const std::string whole = manifest_of_files(episode_.resolved);
  for (const std::string file : {"scene.xml", "robot.yaml", "pr2.xml"}) {
    nlohmann::ordered_json manifest = nlohmann::ordered_json::parse(whole);
    ASSERT_TRUE(manifest["assets"].contains(file)) << whole;
    manifest["assets"][file] = "0";
    write("manifest.json", manifest.dump());
    EXPECT_EQ(state(), EpisodeState::stale) << file;
  }
  write("manifest.json", "{}");
  EXPECT_EQ(state(), EpisodeState::stale);
  write("manifest.json", whole);
  EXPECT_EQ(state(), EpisodeState::completed);
}

TEST_F(Results, HalfWrittenFoldersAreNoResult) {
  fs::remove(folder_ / "config.yaml");
  EXPECT_FALSE(is_result(state()));
  write("config.yaml", "scans: [");
  EXPECT_FALSE(is_result(state()));
  write("metrics.json", R"({"status": "comp)");
  EXPECT_EQ(state(), EpisodeState::missing);
  fs::remove(folder_ / "metrics.json");
  EXPECT_EQ(state(), EpisodeState::missing);
}

TEST_F(Results, EveryEndOfAnEpisode) {
  write("metrics.json", R"({"status": "diverged", "reason": "at 3 s"})");
  EXPECT_EQ(state(), EpisodeState::diverged);
  EXPECT_TRUE(is_result(state()));
  EXPECT_THAT(status_text(study_.path(), {episode_}, {state()}),
              testing::HasSubstr("near/simple: at 3 s"));
  write("metrics.json", R"({"status": "interrupted"})");
  EXPECT_EQ(state(), EpisodeState::interrupted);
  EXPECT_FALSE(is_result(state()));
  fs::remove(folder_ / "metrics.json");
  write("failure.json", R"({"exit_code": 3, "reason": "error: no table"})");
  EXPECT_EQ(state(), EpisodeState::crashed);
  EXPECT_FALSE(is_result(state()));
}

/// In the order from what is done to what is missing; what others are at comes second.
TEST_F(Results, AStatusTellsWhatEachEpisodeThatIsNotCompletedIsAt) {
  std::vector<PlannedEpisode> plan;
  for (const char* name : {"a", "b", "c", "d"}) plan.push_back({name, {0, 0}, episode_.resolved});
  const std::vector<EpisodeState> states{EpisodeState::missing, EpisodeState::completed,
                                         EpisodeState::stale, EpisodeState::missing};
  EXPECT_EQ(status_text(study_.path(), plan, states),
            "1 completed, 1 stale, 2 missing of 4 episodes\nmissing     a\nstale       c: the "
            "configuration, or a file of scene, robot or model, has changed since\nmissing     "
            "d\n");
  const std::vector<EpisodeActivity> activities{{"queued", ""}, {}, {"running", "on n1"}, {}};
  EXPECT_EQ(status_text(study_.path(), plan, states, activities),
            "1 completed, 1 running, 1 queued, 1 missing of 4 episodes\nqueued      a\n"
            "running     c: on n1\nmissing     d\n");
  EXPECT_EQ(status_text(study_.path(), {plan[0], plan[1]},
                        {EpisodeState::diverged, EpisodeState::missing}, {{}, {"running", ""}}),
            "1 running, 1 diverged of 2 episodes\ndiverged    a\nrunning     b\n");
  const auto json = status_json(study_.path(), plan, states, activities);
  EXPECT_EQ(json["directory"], study_.path().string());
  EXPECT_EQ(json["episodes"], 4);
  EXPECT_EQ(json["completed"], 1);
  EXPECT_EQ(json["running"], 1);
  EXPECT_EQ(json["queued"], 1);
  EXPECT_EQ(json["missing"], 1);
  EXPECT_EQ(json["stale"], 0);
  ASSERT_EQ(json["not_completed"].size(), 3U);
  EXPECT_EQ(json["not_completed"][1]["episode"], "c");
  EXPECT_EQ(json["not_completed"][1]["state"], "running");
  EXPECT_EQ(json["not_completed"][1]["reason"], "on n1");
}

TEST_F(Results, AStatusThatIsNoneIsStale) {
  write("metrics.json", R"({"status": "dreaming"})");
  EXPECT_EQ(state(), EpisodeState::stale);
  write("metrics.json", R"({"status": "failed"})");
  EXPECT_EQ(state(), EpisodeState::failed);
  write("metrics.json", "{}");
  EXPECT_EQ(state(), EpisodeState::missing);
  write("metrics.json", R"({"status": 5})");
  EXPECT_EQ(state(), EpisodeState::missing);
}

/// One check of them all: what is hashed for one is not taken for another.
TEST_F(Results, OfOtherScenesRobotsAndModelsAreHeldAgainstTheirOwnFiles) {
  ResultCheck check;
  EXPECT_EQ(check(study_.path(), episode_), EpisodeState::completed);
  const auto expect_completed = [&](const std::string& name, const ResolvedEpisode& resolved) {
    const PlannedEpisode other{name, {0, 0}, resolved};
    folder_ = episode_folder(study_.path(), other);
    fs::create_directories(folder_);
    write("config.yaml", episode_yaml(resolved));
    write("manifest.json", manifest_of_files(resolved));
    write("metrics.json", R"({"status": "completed"})");
    EXPECT_EQ(check(study_.path(), other), EpisodeState::completed) << name;
  };
  const auto base = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
  expect_completed("scene", load_episode(base, {"scene=models/scenes/clutter_dev_4/scene.xml"}));
  expect_completed("robot", load_episode(base, {"robot.model=models/robots/rover"}));
  for (const std::string name : {"a", "b"}) {
    std::ofstream(study_ / name) << name;
    RecognitionTask task;
    task.model = study_ / name;
    ResolvedEpisode resolved = episode_.resolved;
    resolved.task = task;
    expect_completed(name, resolved);
  }
}

}  // namespace
}  // namespace vantage
