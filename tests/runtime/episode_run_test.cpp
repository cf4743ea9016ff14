// The loop of an episode, how it ends, and the folder that it runs into.
#include "vantage/runtime/episode_run.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "tests/sim/test_world.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/recorder.hpp"

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

TEST_F(EpisodeRuns, HaveTheirFolderAloneUntilItIsReleased) {
  const RunRequest asked = request(false);
  EXPECT_TRUE(is_open_to_others());
  const EpisodeRun run(asked);
  EXPECT_FALSE(is_open_to_others());
  EXPECT_NO_THROW(EpisodeRun{asked}) << "this process may run into it again";
  release_run_directory(folder_.path());
  EXPECT_TRUE(is_open_to_others());
  EXPECT_NO_THROW(release_run_directory(folder_.path()));
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
}

}  // namespace
}  // namespace vantage
