// What an episode leaves in its folder beside its texts, and what is as it is unless told
// otherwise.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

#include "tests/sim/test_world.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/recorder.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/faults/robot_faults.hpp"

namespace vantage {
namespace {

/// Of a ball over a floor, beside a grey panel.
class FilmedRecorder : public EpisodeRecorder {
 public:
  FilmedRecorder(const EpisodeRun& run, World& world, const RobotFaults* faults = nullptr)
      : EpisodeRecorder(run,
                        {.world = world,
                         .T_world_body = [] { return Pose::Identity(); },
                         .T_world_estimated = [] { return Pose::Identity(); },
                         .faults = faults},
                        "time_s,scan", 2.0) {
    log().set_panel([](cv::Size size) { return cv::Mat(size, CV_8UC3, cv::Scalar::all(9)); });
  }
  using EpisodeRecorder::step;
};

class RunFolders : public testing::Test {
 protected:
  RunFolders() {
    setup_.name = "ball";
    setup_.scene = setup_.robot.mjcf = setup_.robot.description = scene_.path();
    setup_.options.recording.height_px = 120;
    set_verbosity(Verbosity::quiet);
  }
  ~RunFolders() override {
    log_to_file({});
    release_run_directory(run_dir());
    set_verbosity(Verbosity::normal);
  }
  [[nodiscard]] std::filesystem::path run_dir() const { return folder_ / "new/run"; }
  RunRequest request() {
    RunOptions options;
    options.directory = run_dir();
    return {setup_, "exploration", "greedy", "a: 1\n", {}, options};
  }
  test::SceneFolder scene_{
      test::scene_mjcf("<body pos='0 0 1'><freejoint/><geom size='.1'/></body>")};
  World world_{scene_.alone()};
  support::TemporaryDirectory folder_;
  EpisodeSetup setup_;
};

TEST_F(RunFolders, AreMadeWhereThereAreNone) {
  const RunRequest asked = request();
  const EpisodeRun run(asked);
  EXPECT_TRUE(std::filesystem::is_directory(run_dir()));
}

TEST_F(RunFolders, HoldAVideoAndItsStillsWhereTheyAreAskedFor) {
  if (const std::string missing = missing_video_codec(); !missing.empty()) {
    GTEST_SKIP() << missing;
  }
  RunRequest asked = request();
  asked.options.video = true;
  EpisodeRun run(asked);
  run.begin();
  FilmedRecorder recorder(run, world_);
  world_.advance_tick();
  recorder.step("0.025,3", 3, 1.0, "three");
  EXPECT_TRUE(std::filesystem::exists(run_dir() / "frames/scan_03.png"));
  EXPECT_FALSE(std::filesystem::exists(run_dir() / "video.mp4"));
  run.finish({.reason = "done"}, {}, recorder, [](nlohmann::ordered_json&) {});
  EXPECT_TRUE(std::filesystem::exists(run_dir() / "video.mp4")) << "of a single frame";
}

TEST_F(RunFolders, CountFaultsInTheirMetrics) {
  FaultOptions options;
  options.dropped_frames = 1.0;
  RobotFaults faults(options, 1);
  EXPECT_FALSE(faults.arriving({}, 0.5));
  const RunRequest asked = request();
  EpisodeRun run(asked);
  run.begin();
  FilmedRecorder recorder(run, world_, &faults);
  const RunOutcome outcome =
      run.finish({.reason = "done"}, {}, recorder, [](nlohmann::ordered_json&) {});
  EXPECT_EQ(nlohmann::json::parse(outcome.metrics).at("faults"),
            nlohmann::json({{name_of(Fault::dropped_frames), 1}}));
}

/// What was told before counts as well, so a process of its own has to do it.
TEST_F(RunFolders, TellHowFarTheEpisodeIs) {
  const auto told = [&] {
    set_verbosity(Verbosity::normal);
    const RunRequest asked = request();
    const EpisodeRun run(asked);
    FilmedRecorder recorder(run, world_);
    recorder.step("0.5,1", 1, 1.0, "one");
    std::filesystem::remove_all(folder_.path());
    std::filesystem::remove_all(scene_.path().parent_path());
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(told(), testing::ExitedWithCode(0), "ball: 50 % one\n");
  GTEST_FLAG_SET(death_test_style, "fast");
}

TEST_F(RunFolders, EndNoRunThatHasNotBegun) {
  const auto ended = [&] {
    const RunRequest asked = request();
    EpisodeRun run(asked);
    FilmedRecorder recorder(run, world_);
    run.finish({.reason = "done"}, {}, recorder, [](nlohmann::ordered_json&) {});
    std::_Exit(0);
  };
  EXPECT_EXIT(ended(), testing::ExitedWithCode(70), "begin\\(\\) comes before finish\\(\\)");
}

TEST(ScratchFolder, IsThereForAsLongAsItIsNeeded) {
  std::filesystem::path place;
  {
    const ScratchFolder folder;
    const ScratchFolder other;
    place = folder.path();
    EXPECT_NE(place, other.path());
    write_file(place / "more", "x");
    EXPECT_TRUE(std::filesystem::exists(place / "more"));
  }
  EXPECT_FALSE(place.empty());
  EXPECT_FALSE(std::filesystem::exists(place));
}

TEST(RuntimeDefaults, AreOfNothing) {
  EXPECT_FALSE(RunOptions{}.overwrite);
  EXPECT_FALSE(RunOptions{}.video);
  EXPECT_FALSE(RunOptions{}.lean);
  EXPECT_EQ(RunTotals{}.simulated_time_s, 0.0);
  EXPECT_EQ(RunTotals{}.collisions, 0);
  EXPECT_EQ(TaskExtent{}.count, 0U);
  EXPECT_EQ(WindowContent{}.scans, 0U);
  EXPECT_FALSE(WindowContent{}.follows_height);
  EXPECT_EQ(WindowContent{}.overview_m.min(), Eigen::Vector2d(-0.5, -0.5));
  EXPECT_EQ(WindowContent{}.overview_m.max(), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(CurveAxis{}.first, 1.0);
  EXPECT_EQ(CurveAxis{}.step, 1.0);
  EXPECT_FALSE(MeasureName{}.wall);
  const nlohmann::ordered_json metrics;
  EXPECT_EQ(MeasuredEpisode{metrics}.planned_steps, 0U);
}

}  // namespace
}  // namespace vantage
