#include "vantage/runtime/log/run_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/sim/test_world.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/runtime/log/video_recorder.hpp"

namespace vantage {
namespace {

constexpr int kLoggedTicks = 41;

/// A world of falling things; of the robot the test says where it is.
struct LoggedWorld {
  test::SceneFolder scene{
      test::scene_mjcf("<body pos='0 0 1'><freejoint/><geom size='.1'/></body>")};
  World world{scene.alone()};
  support::TemporaryDirectory folder;
  int tick = 0;

  RecordedRobot robot() {
    return {.world = world,
            .T_world_body =
                [this] {
                  return make_pose({0.3 * tick, 0.4 * tick, 1.0}, 0.6);
                },
            .T_world_estimated =
                [this] {
                  return make_pose({7.0, 8.0, 9.0 + tick}, 0.0);
                }};
  }
  void advance() {
    for (int i = 0; i < kLoggedTicks; ++i) {
      ++tick;
      world.advance_tick();
    }
  }
};

std::vector<std::vector<double>> rows_of(const std::filesystem::path& path) {
  std::istringstream lines(read_file(path));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream numbers(line);
    std::vector<double>& row = rows.emplace_back();
    for (double number = 0.0; numbers >> number;) row.push_back(number);
  }
  return rows;
}

TEST(RunLog, HasTheWayAndTheHashOfAllTicks) {
  LoggedWorld logged;
  std::uint64_t hash = hash_doubles(logged.world.state());
  RunLog log(logged.robot(), {}, logged.folder.path(), false, true, {});
  for (int i = 0; i < 3; ++i) {
    ++logged.tick;
    logged.world.advance_tick();
    hash = hash_doubles(logged.world.state(), hash);
  }
  EXPECT_EQ(log.state_hash(), hash);
  EXPECT_NEAR(log.path_length_m(), 2 * 0.5, 1e-12);
  EXPECT_FALSE(log.watched());
  log.commit();
  EXPECT_FALSE(std::filesystem::exists(logged.folder / "states.bin")) << "a lean one";
}

TEST(RunLog, HasRowsOfTheTrajectoriesTenTimesASecond) {
  LoggedWorld logged;
  RunLog log(logged.robot(), {}, logged.folder.path(), false, false, {});
  logged.advance();
  EXPECT_FALSE(std::filesystem::exists(logged.folder / "trajectory.tum"));
  log.commit();
  EXPECT_TRUE(std::filesystem::exists(logged.folder / "states.bin"));
  EXPECT_TRUE(read_file(logged.folder / "trajectory.tum")
                  .starts_with("# time_s x y z qx qy qz qw\n0.025 0.300000 0.400000 1.000000 "));
  EXPECT_TRUE(read_file(logged.folder / "trajectory_estimated.tum")
                  .starts_with("# time_s x y z qx qy qz qw\n0.025 7.000000 8.000000 11.000000 "));
  const auto truth = rows_of(logged.folder / "trajectory.tum");
  const auto estimate = rows_of(logged.folder / "trajectory_estimated.tum");
  ASSERT_EQ(truth.size(), estimate.size());
  EXPECT_GE(truth.size(), 8U);
  EXPECT_LE(truth.size(), 11U);
  ASSERT_EQ(truth[0].size(), 8U);
  EXPECT_NEAR(truth[0][6], std::sin(0.3), 1e-6);
  EXPECT_NEAR(truth[0][7], std::cos(0.3), 1e-6);
  // The world ticks before the estimate does: what is believed at the second tick is of the first.
  EXPECT_EQ(estimate[0][0], 0.025);
  EXPECT_EQ(estimate[0][1], 7.0);
  EXPECT_EQ(estimate[0][3], 11.0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    EXPECT_EQ(estimate[i][0], truth[i][0]);
    EXPECT_NEAR(truth[i][1], 0.3 * truth[i][0] / 0.025, 1e-3) << "where it was then";
  }
}

TEST(RunLog, TellsWhoWatches) {
  LoggedWorld logged;
  int ticks = 0;
  std::uint64_t told_tick = 0;
  {
    RunLog log(logged.robot(), {}, logged.folder.path(), false, true,
               {.on_tick = [&](const World&) { ++ticks; },
                .on_event = [&](const EpisodeEvent& event) { told_tick = event.tick; },
                .on_step = {}});
    EXPECT_EQ(ticks, 1) << "as it begins";
    EXPECT_TRUE(log.watched());
    logged.advance();
    EXPECT_EQ(ticks, 1 + kLoggedTicks);
    EpisodeEvent event{0, MapChange{}};
    log.tell(event);
    EXPECT_EQ(told_tick, static_cast<std::uint64_t>(kLoggedTicks));
    EXPECT_TRUE(logged.world.on_tick);
  }
  EXPECT_FALSE(logged.world.on_tick);
}

TEST(RunLog, HasBodiesAsTheyLie) {
  LoggedWorld logged;
  RecordedRobot robot = logged.robot();
  robot.T_world_body = [] { return make_pose({0.0, 0.0, 1.0}, 0.6, 0.4); };
  RunLog log(robot, {}, logged.folder.path(), false, true, {});
  logged.advance();
  log.commit();
  const Eigen::Quaterniond q(make_pose({0.0, 0.0, 1.0}, 0.6, 0.4).linear());
  const auto truth = rows_of(logged.folder / "trajectory.tum");
  ASSERT_FALSE(truth.empty());
  EXPECT_NEAR(truth[0][4], q.x(), 1e-6);
  EXPECT_NEAR(truth[0][5], q.y(), 1e-6);
  EXPECT_NEAR(truth[0][6], q.z(), 1e-6);
  EXPECT_NEAR(truth[0][7], q.w(), 1e-6);
}

}  // namespace
}  // namespace vantage
