// The loop of an episode, how it ends, and the folder that it runs into.
#include "vantage/runtime/episode_run.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "tests/sim/test_world.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/report/drawn_scene.hpp"
#include "vantage/runtime/recorder.hpp"
#include "vantage/runtime/scene_file.hpp"
#include "vantage/sim/faults/robot_faults.hpp"
#include "vantage/sim/render/scene_surfaces.hpp"

namespace vantage {
namespace {

/// Writes down what it is asked for.
struct ToldParts {
  std::string calls;
  int scans = 0;
  int observe() {
    calls += "observe ";
    return 7;
  }
  void update(int observation) { calls += "update" + std::to_string(observation) + " "; }
  void record() { calls += "record "; }
  std::string finished() {
    ++scans;
    return scans == 2 ? "two scans" : "";
  }
  std::vector<int> propose() {
    calls += "propose ";
    return {10, 20, 30};
  }
  void score(std::vector<int>& candidates) {
    calls += "score ";
    candidates[1] += 1;
  }
  std::size_t choose(const std::vector<int>& candidates) {
    calls += "choose ";
    return candidates.size() - 2;
  }
  void act(int candidate) { calls += "act" + std::to_string(candidate) + " "; }
};

TEST(EpisodeLoop, GoesRoundUntilItIsFinished) {
  ToldParts parts;
  EXPECT_EQ(run_episode(parts), "two scans");
  EXPECT_EQ(parts.calls,
            "observe update7 record propose score choose act21 observe update7 record ");
}

/// Is interrupted in that part.
struct InterruptedParts : ToldParts {
  std::string part;
  void record() {
    ToldParts::record();
    if (part == "record") std::raise(SIGINT);
  }
  void score(std::vector<int>& candidates) {
    ToldParts::score(candidates);
    if (part == "score") std::raise(SIGINT);
  }
};

TEST(EpisodeLoop, GoesNoFurtherThanThePartInWhichItIsInterrupted) {
  const auto interrupted_in = [](const char* part) {
    set_verbosity(Verbosity::quiet);
    catch_interrupts();
    InterruptedParts parts;
    parts.part = part;
    try {
      run_episode(parts);
    } catch (const Interrupted&) {
      std::fputs(parts.calls.c_str(), stderr);
      std::_Exit(7);
    }
    std::_Exit(1);
  };
  EXPECT_EXIT(interrupted_in("record"), testing::ExitedWithCode(7), "^observe update7 record $");
  EXPECT_EXIT(interrupted_in("score"), testing::ExitedWithCode(7),
              "^observe update7 record propose score $");
}

TEST(Interrupt, HasTheCodeOfItsSignal) {
  EXPECT_EQ(interrupt_signal(), 0);
  EXPECT_EQ(static_cast<int>(Interrupted(SIGINT).code()), 130);
  EXPECT_EQ(static_cast<int>(Interrupted(SIGTERM).code()), 143);
  EXPECT_STREQ(Interrupted(SIGINT).what(), "interrupted");
  EXPECT_STREQ(Interrupted(SIGTERM).what(), "terminated");
}

class EpisodeRuns : public testing::Test {
 protected:
  EpisodeRuns() { set_verbosity(Verbosity::quiet); }
  ~EpisodeRuns() override {
    log_to_file({});
    release_run_directory(folder_.path());
    set_verbosity(Verbosity::normal);
  }
  RunRequest request(bool overwrite) {
    RunOptions options;
    options.directory = folder_.path();
    options.overwrite = overwrite;
    return {setup_, "exploration", "greedy", "a: 1\n", {}, options};
  }
  void make(const std::string& name) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, "x");
  }
  [[nodiscard]] bool is_there(const std::string& name) const {
    return std::filesystem::exists(folder_ / name);
  }
  /// Whether somebody else may run into the folder.
  [[nodiscard]] bool is_open_to_others() const {
    const int other = ::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool locked = ::flock(other, LOCK_EX | LOCK_NB) == 0;
    ::close(other);
    return locked;
  }
  support::TemporaryDirectory folder_;
  EpisodeSetup setup_;
};

Ending ending_by(const std::function<void()>& fails) {
  return ending_of([&]() -> std::string {
    fails();
    return "";
  });
}

TEST_F(EpisodeRuns, EndAsTheirLoopDoes) {
  const Ending completed = ending_of([] { return std::string("all scans taken"); });
  EXPECT_EQ(completed.status, EpisodeStatus::completed);
  EXPECT_EQ(completed.code, ExitCode::done);
  EXPECT_EQ(completed.reason, "all scans taken");
  const Ending diverged = ending_by([] { throw DivergedError("it flew apart"); });
  EXPECT_EQ(diverged.status, EpisodeStatus::diverged);
  EXPECT_EQ(diverged.code, ExitCode::diverged);
  EXPECT_EQ(diverged.reason, "it flew apart");
  const Ending failed = ending_by([] { throw EpisodeFailed("no way"); });
  EXPECT_EQ(failed.status, EpisodeStatus::failed);
  EXPECT_EQ(failed.code, ExitCode::goal_failed);
  EXPECT_EQ(failed.reason, "no way");
  const Ending interrupted = ending_by([] { throw Interrupted(SIGTERM); });
  EXPECT_EQ(interrupted.status, EpisodeStatus::interrupted);
  EXPECT_EQ(interrupted.code, ExitCode::terminated);
  EXPECT_EQ(interrupted.reason, "terminated");
  EXPECT_THROW(ending_by([] { throw InputError("another"); }), InputError);
}

TEST_F(EpisodeRuns, HaveAFolderByNameAndSeed) {
  setup_.name = "tabletop";
  setup_.options.seed = 7;
  EXPECT_EQ(run_directory(setup_, {}), std::filesystem::path("out/tabletop-7"));
  EXPECT_EQ(run_directory(setup_, request(false).options), folder_.path());
}

TEST_F(EpisodeRuns, ReplaceNoFormerRunUnasked) {
  make("notes.txt");
  make("log.txt");
  const RunRequest asked = request(false);
  EXPECT_NO_THROW(EpisodeRun{asked});
  for (const char* name : {"steps.csv", "metrics.json", "frames/scan_01.png"}) {
    make(name);
    try {
      const EpisodeRun run(asked);
      ADD_FAILURE() << "it would replace " << name;
    } catch (const ConfigError& error) {
      const std::string first = std::filesystem::path(name).begin()->string();
      EXPECT_EQ(error.what(), "--out " + folder_.path().string() + ": holds " + first +
                                  " already; --overwrite replaces it");
    }
    std::filesystem::remove_all(folder_ / std::filesystem::path(name).begin()->string());
  }
}

TEST_F(EpisodeRuns, ReplaceAFormerRunAndNothingElseAsTheyBegin) {
  for (const char* name : {"manifest.json", "metrics.json", "frames/scan_01.png", "log.txt",
                           "views/a.png", "notes.txt", "more/metrics.json"}) {
    make(name);
  }
  const RunRequest asked = request(true);
  EpisodeRun run(asked);
  EXPECT_TRUE(is_there("metrics.json")) << "until it begins";
  run.begin();
  for (const char* name : {"manifest.json", "metrics.json", "frames", "views", "log.txt"}) {
    EXPECT_FALSE(is_there(name)) << name;
  }
  EXPECT_TRUE(is_there("notes.txt"));
  EXPECT_TRUE(is_there("more/metrics.json"));
  log_to_file({});
  EXPECT_TRUE(is_there("log.txt"));
  EXPECT_EQ(run.directory(), folder_.path());
}

TEST_F(EpisodeRuns, RemoveWhatAKilledOneWasWriting) {
  for (const char* name : {"states.part.bin", "video.part.mp4", "notes.part.txt"}) make(name);
  const RunRequest asked = request(false);
  const EpisodeRun run(asked);
  EXPECT_FALSE(is_there("states.part.bin") || is_there("video.part.mp4"));
  EXPECT_TRUE(is_there("notes.part.txt"));
}

TEST_F(EpisodeRuns, HaveTheirFolderAloneUntilItIsReleased) {
  const RunRequest asked = request(false);
  EXPECT_TRUE(is_open_to_others());
  {
    const EpisodeRun run(asked);
    EXPECT_FALSE(is_open_to_others());
    try {
      const EpisodeRun second(asked);
      ADD_FAILURE() << "one runs into it";
    } catch (const OutputError& error) {
      EXPECT_EQ(error.what(),
                folder_.path().string() + ": another episode of this process runs into it");
    }
    EXPECT_THROW(EpisodeRun{asked}, OutputError) << "a failed one does not let the next in";
  }
  EXPECT_FALSE(is_open_to_others()) << "its results may be on their way";
  EXPECT_NO_THROW(EpisodeRun{asked}) << "this process may run into it again";
  release_run_directory(folder_.path());
  EXPECT_TRUE(is_open_to_others());
  EXPECT_NO_THROW(release_run_directory(folder_.path()));
  const EpisodeRun again(asked);
  EXPECT_FALSE(is_open_to_others());
}

TEST_F(EpisodeRuns, DoNotRunIntoAFolderOfAnotherProcess) {
  const int other = ::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  const RunRequest asked = request(false);
  try {
    const EpisodeRun run(asked);
    ADD_FAILURE() << "another runs into it";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), folder_.path().string() + ": another process runs into it");
  }
  ::close(other);
  EXPECT_NO_THROW(EpisodeRun{asked});
}

/// Of a world in which nothing is done.
class IdleRecorder : public EpisodeRecorder {
 public:
  IdleRecorder(const EpisodeRun& run, World& world)
      : EpisodeRecorder(run,
                        {.world = world, .T_world_body = at_rest, .T_world_estimated = at_rest},
                        "tick", 1.0) {}

 private:
  static Pose at_rest() { return make_pose({0.0, 0.0, 1.0}, 0.0); }
};

TEST_F(EpisodeRuns, TakeTheTimeFromWhenTheirFolderIsMade) {
  const test::SceneFolder scene(
      test::scene_mjcf("<body pos='0 0 1'><freejoint/><geom size='.1'/></body>"));
  World world(scene.alone());
  setup_.scene = setup_.robot.mjcf = setup_.robot.description = scene.path();
  const RunRequest asked = request(false);
  const double before_s = wall_s();
  EpisodeRun run(asked);
  IdleRecorder recorder(run, world);
  run.begin();
  const RunOutcome outcome =
      run.finish({.reason = "nothing to do"}, {}, recorder, [](nlohmann::ordered_json&) {});
  const auto wall_time_s = nlohmann::json::parse(outcome.metrics).at("wall_time_s").get<double>();
  EXPECT_GE(wall_time_s, 0.0);
  EXPECT_LE(wall_time_s, wall_s() - before_s);
  EXPECT_FALSE(is_there("candidates.csv")) << "it chooses from nothing";
}

/// Of a world in which the body moves 10 cm a tick.
class ToldRecorder : public EpisodeRecorder {
 public:
  ToldRecorder(const EpisodeRun& run, World& world, const RobotFaults* faults = nullptr)
      : EpisodeRecorder(run,
                        {.world = world,
                         .T_world_body =
                             [&world] {
                               return make_pose({4.0 * world.time_s(), 0.0, 0.0}, 0.0);
                             },
                         .T_world_estimated = [] { return Pose::Identity(); },
                         .faults = faults},
                        "time_s,scan", 2.0, "x_m,y_m") {}
  using EpisodeRecorder::add_candidates;
  using EpisodeRecorder::keeps_candidates;
  using EpisodeRecorder::step;
};

/// A ball over a floor.
struct ToldWorld {
  test::SceneFolder scene{
      test::scene_mjcf("<body pos='0 0 1'><freejoint/><geom size='.1'/></body>")};
  World world{scene.alone()};
};

/// Who works on a scene while an episode runs changes another one.
TEST_F(EpisodeRuns, TellTheirFilesAsTheyWereWhenTheyWereAsked) {
  ToldWorld told;
  RunRequest asked = request(false);
  asked.inputs = {"of the scene", {{"scene.xml", "of the scene"}}};
  EpisodeRun run(asked);
  run.begin();
  ToldRecorder recorder(run, told.world);
  run.finish({.reason = "nothing to do"}, {}, recorder, [](nlohmann::ordered_json&) {});
  const auto manifest = nlohmann::json::parse(read_file(folder_ / "manifest.json"));
  EXPECT_EQ(manifest.at("scene_hash"), "of the scene");
  EXPECT_EQ(manifest.at("assets").at("scene.xml"), "of the scene");
}

TEST_F(EpisodeRuns, WriteWhatEveryRunFolderHas) {
  ToldWorld told;
  setup_.scene = setup_.robot.mjcf = setup_.robot.description = told.scene.path();
  setup_.options.scene = "some.xml";
  setup_.options.seed = 4;
  const RunRequest asked = request(false);
  EpisodeRun run(asked);
  run.begin();
  ToldRecorder recorder(run, told.world);
  for (int tick = 0; tick < 5; ++tick) told.world.advance_tick();
  bool whole = false;
  const RunOutcome outcome = run.finish(
      {EpisodeStatus::failed, ExitCode::goal_failed, "no way"}, {12.5, 3}, recorder,
      [](nlohmann::ordered_json& metrics) { metrics["more"] = 7; },
      [&] { whole = is_there("metrics.json") && is_there("states.bin"); });
  EXPECT_TRUE(whole) << "before the task's own files";
  EXPECT_EQ(outcome.directory, folder_.path());
  EXPECT_EQ(outcome.code, ExitCode::goal_failed);
  EXPECT_EQ(outcome.metrics, read_file(folder_ / "metrics.json"));
  EXPECT_EQ(read_file(folder_ / "config.yaml"), "a: 1\n");
  const auto metrics = nlohmann::json::parse(outcome.metrics);
  EXPECT_EQ(metrics.at("task"), "exploration");
  EXPECT_EQ(metrics.at("method"), "greedy");
  EXPECT_EQ(metrics.at("scene"), "some.xml");
  EXPECT_EQ(metrics.at("seed"), 4);
  EXPECT_EQ(metrics.at("status"), "failed");
  EXPECT_EQ(metrics.at("reason"), "no way");
  EXPECT_EQ(metrics.at("simulated_time_s"), 12.5);
  EXPECT_EQ(metrics.at("collisions"), 3);
  EXPECT_NEAR(metrics.at("path_length_m").get<double>(), 0.4, 1e-9);
  EXPECT_EQ(metrics.at("state_hash"), hash_text(recorder.state_hash()));
  EXPECT_EQ(metrics.at("faults"), nlohmann::json::object());
  EXPECT_EQ(metrics.at("more"), 7);
  const auto manifest = nlohmann::json::parse(read_file(folder_ / "manifest.json"));
  EXPECT_EQ(manifest.at("status"), "failed");
  EXPECT_EQ(manifest.at("simulated_time_s"), 12.5);
}

TEST_F(EpisodeRuns, RecordTheirStepsAndTellWhoeverWatches) {
  ToldWorld told;
  std::string heard;
  RunRequest asked = request(false);
  asked.options.spectator.on_step = [&](std::string_view columns, std::string_view row) {
    heard += std::string(columns) + "|" + std::string(row) + ";";
  };
  const EpisodeRun run(asked);
  ToldRecorder recorder(run, told.world);
  recorder.step("1.5,1", 1, 1.0, "one");
  recorder.step("2.5,2", 2, 2.0, "two");
  EXPECT_TRUE(recorder.keeps_candidates());
  recorder.add_candidates(std::array{CandidateRow{5, "1,2"}, CandidateRow{7, "3,4"}}, 1);
  EXPECT_FALSE(is_there("steps.csv") || is_there("candidates.csv")) << "until all is there";
  recorder.commit();
  EXPECT_EQ(heard, "time_s,scan|1.5,1;time_s,scan|2.5,2;");
  EXPECT_EQ(read_file(folder_ / "steps.csv"), "time_s,scan\n1.5,1\n2.5,2\n");
  EXPECT_EQ(read_file(folder_ / "candidates.csv"),
            "decision,candidate,x_m,y_m,chosen\n1,5,1,2,0\n1,7,3,4,1\n");
  EXPECT_TRUE(is_there("states.bin") && is_there("trajectory.tum"));
  EXPECT_FALSE(is_there("faults.csv"));
}

TEST_F(EpisodeRuns, KeepNeitherStatesNorCandidatesWhereTheyAreLean) {
  ToldWorld told;
  RunRequest asked = request(false);
  asked.options.lean = true;
  const EpisodeRun run(asked);
  ToldRecorder recorder(run, told.world);
  EXPECT_FALSE(recorder.keeps_candidates());
  recorder.add_candidates(std::array{CandidateRow{5, "1,2"}}, 0);
  recorder.step("1.5,1", 1, 1.0, "one");
  recorder.commit();
  EXPECT_EQ(read_file(folder_ / "steps.csv"), "time_s,scan\n1.5,1\n");
  EXPECT_TRUE(is_there("trajectory.tum") && is_there("trajectory_estimated.tum"));
  EXPECT_FALSE(is_there("candidates.csv") || is_there("states.bin") || is_there("actions.csv"));
}

TEST_F(EpisodeRuns, CountTheFaultsThatAreOn) {
  ToldWorld told;
  const RunRequest asked = request(false);
  const EpisodeRun run(asked);
  {
    const RobotFaults none({}, 1);
    ToldRecorder recorder(run, told.world, &none);
    EXPECT_TRUE(recorder.faults().empty());
    recorder.commit();
    EXPECT_FALSE(is_there("faults.csv"));
  }
  FaultOptions options;
  options.dropped_frames = 1.0;
  options.gust_N = 5.0;
  RobotFaults faults(options, 1);
  for (const double time_s : {0.5, 0.75}) EXPECT_FALSE(faults.arriving({}, time_s));
  ToldRecorder recorder(run, told.world, &faults);
  const std::string dropped(name_of(Fault::dropped_frames));
  const std::vector<std::pair<std::string, std::int64_t>> expected{
      {dropped, 2}, {std::string(name_of(Fault::gust)), 0}};
  EXPECT_EQ(recorder.faults(), expected);
  recorder.commit();
  EXPECT_EQ(read_file(folder_ / "faults.csv"), "time_s,fault\n0.500," + dropped + "\n");
}

TEST(SceneFile, HoldsTheSurfacesOfItsWorld) {
  const test::SceneFolder scene(
      test::scene_mjcf("<geom type='box' pos='1 2 .5' size='.5 .25 .5' rgba='1 0 0 1'/>"));
  const support::TemporaryDirectory folder;
  const World world(scene.alone());
  write_scene_file(world, folder.path());
  const DrawnScene drawn = read_drawn_scene(folder / "scene.bin");
  const SceneSurfaces surfaces = scene_surfaces(world.model(), world.snapshot());
  ASSERT_FALSE(surfaces.vertices_m.empty());
  EXPECT_EQ(drawn.vertices_m, surfaces.vertices_m);
  EXPECT_EQ(drawn.colours, surfaces.colours);
  EXPECT_EQ(drawn.triangles, surfaces.triangles);
  const Eigen::AlignedBox3f extent_m = surfaces.extent_m.cast<float>();
  EXPECT_EQ(drawn.extent_m.min(), extent_m.min());
  EXPECT_EQ(drawn.extent_m.max(), extent_m.max());
  const std::vector<FloorOutline> plan = scene_floor_plan(scene.alone());
  ASSERT_EQ(plan.size(), 1U);
  Eigen::AlignedBox2d box_m;
  for (const Eigen::Vector2d& corner : plan[0]) box_m.extend(corner);
  EXPECT_LT((box_m.min() - Eigen::Vector2d(0.5, 1.75)).norm(), 1e-5);
  EXPECT_LT((box_m.max() - Eigen::Vector2d(1.5, 2.25)).norm(), 1e-5);
}

}  // namespace
}  // namespace vantage
