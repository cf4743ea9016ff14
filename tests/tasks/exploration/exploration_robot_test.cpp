// How the simulated robot of an exploration turns its head, and how high it lifts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "tests/tasks/exploration/scripted_drive.hpp"

namespace vantage {
namespace {

/// With the base that it drives.
struct HeadTurner : SimulatedExplorationRobot {
  using SimulatedExplorationRobot::SimulatedExplorationRobot;
  struct Turn {
    double moved_rad;   ///< by the faster joint, in a tick
    double rate_rad_s;  ///< after it
    bool rests;
  };
  /// To where it shall look, tick by tick.
  std::vector<Turn> turns(int ticks) {
    const World& world = base_.world();
    std::vector<Turn> seen;
    for (int i = 0; i < ticks; ++i) {
      const double pan_rad = base_.robot().head_pan_rad(world);
      const double tilt_rad = base_.robot().head_tilt_rad(world);
      base_.tick();
      const double moved_rad = std::max(std::abs(base_.robot().head_pan_rad(world) - pan_rad),
                                        std::abs(base_.robot().head_tilt_rad(world) - tilt_rad));
      seen.push_back({moved_rad, base_.robot().head_rate_rad_s(world), head_rests()});
    }
    return seen;
  }
  [[nodiscard]] bool may_look_from(Exploration task, double height_m) {
    task.frontiers.height_m = height_m;
    try {
      check_camera_reach(base_.world(), base_.robot(), task);
    } catch (const ConfigError&) {
      return false;
    }
    return true;
  }
  [[nodiscard]] double lift_m() { return base_.robot().lift_m(base_.world()); }
  [[nodiscard]] double lift_max_m() { return base_.robot().lift_max_m(); }
};

struct HeadScene {
  support::TemporaryDirectory folder;
  const ResolvedEpisode episode = support::scripted_episode(folder.path(), {});
  Exploration task = std::get<Exploration>(episode.task);
};

/// In five ticks at least.
std::size_t ticks_until_rest(const std::vector<HeadTurner::Turn>& turns, double at_rest_rad) {
  std::size_t ticks = 5;
  while (ticks < turns.size() && turns[ticks - 1].moved_rad >= at_rest_rad) ++ticks;
  return ticks;
}

TEST(ExplorationRobot, TakesItsImageOnceItsHeadHardlyMoves) {
  const HeadScene scene;
  HeadTurner robot(scene.episode.setup, scene.task);
  HeadTurner twin(scene.episode.setup, scene.task);
  const std::size_t image = 15;  // of the lower row, to the left
  const Gaze gaze = robot.sweep_images().gazes()[image];
  ASSERT_GT(std::abs(gaze.pan_rad), 0.5);
  ASSERT_GT(gaze.tilt_rad, 0.5);
  twin.look(gaze);
  const auto turns = twin.turns(150);
  const std::size_t ticks = ticks_until_rest(turns, 1e-4);
  ASSERT_LT(ticks, 150U);
  ASSERT_GT(ticks_until_rest(turns, 0.5e-4), ticks);
  ASSERT_LT(ticks_until_rest(turns, 2e-4), ticks);
  const double start_s = robot.time_s();
  const ExplorationObservation seen = robot.observe(std::vector<std::size_t>{image});
  EXPECT_NEAR(robot.time_s() - start_s,
              static_cast<double>(ticks) * scene.episode.setup.options.simulation.control_period_s,
              1e-6);
  EXPECT_FALSE(seen.base_scan.azimuth_rad.empty());
  EXPECT_EQ(seen.base_scan_height_m, robot.base_scan_height_m());
  EXPECT_GT(seen.base_scan_height_m, 0.05);

  robot.turns(150);
  const auto after = robot.take_image();
  ASSERT_TRUE(after);
  EXPECT_GT(after->T_base_camera.linear().col(2).x(), std::cos(0.02)) << "straight on again";
}

/// At 0.05 rad/s by its faster joint.
TEST(ExplorationRobot, SaysWhenItsHeadRests) {
  const HeadScene scene;
  HeadTurner robot(scene.episode.setup, scene.task);
  robot.look({.pan_rad = 0.8, .tilt_rad = 0.3});
  int slower = 0;
  int faster = 0;
  for (const HeadTurner::Turn& turn : robot.turns(120)) {
    EXPECT_EQ(turn.rests, turn.rate_rad_s < 0.05) << turn.rate_rad_s;
    slower += turn.rate_rad_s > 0.025 && turn.rate_rad_s < 0.05 ? 1 : 0;
    faster += turn.rate_rad_s > 0.05 && turn.rate_rad_s < 0.1 ? 1 : 0;
  }
  EXPECT_GT(slower, 0);
  EXPECT_GT(faster, 0);
}

/// Its camera has a resolution, as that of a sweep.
TEST(ExplorationRobot, MeasuresImagesOnTheWayToo) {
  const HeadScene scene;
  HeadTurner robot(scene.episode.setup, scene.task);
  robot.look({.pan_rad = 0.0, .tilt_rad = 0.7});
  robot.turns(100);
  const auto view = robot.take_image();
  ASSERT_TRUE(view);
  int readings = 0;
  for (const float depth_m : view->image.depth_m) {
    if (depth_m == 0.0F || std::isinf(depth_m)) continue;
    const double steps =
        1.0 / (scene.task.camera.quantisation_per_m * static_cast<double>(depth_m));
    EXPECT_NEAR(steps, std::round(steps), 1e-3);
    ++readings;
  }
  EXPECT_GT(readings, 1000) << "it looks down on the floor";
}

/// From 1 cm below where its lift begins, whatever it is at.
TEST(ExplorationRobot, LooksFromAsHighAsItsLiftReaches) {
  HeadScene scene;
  for (const double raised_m : {0.0, 0.1}) {
    if (raised_m > 0.0) {
      const HeadTurner low(scene.episode.setup, scene.task);
      scene.task.frontiers.height_m = low.T_base_sweep().translation().z() + raised_m;
    }
    HeadTurner robot(scene.episode.setup, scene.task);
    const double lowest_m = robot.T_base_sweep().translation().z() - robot.lift_m();
    const double highest_m = lowest_m + robot.lift_max_m();
    ASSERT_GT(robot.lift_max_m(), 0.1);
    ASSERT_GT(robot.lift_m(), 0.5 * raised_m - 0.01);
    EXPECT_TRUE(robot.may_look_from(scene.task, lowest_m - 0.009));
    EXPECT_FALSE(robot.may_look_from(scene.task, lowest_m - 0.011));
    EXPECT_TRUE(robot.may_look_from(scene.task, highest_m + 0.9e-6));
    EXPECT_FALSE(robot.may_look_from(scene.task, highest_m + 1.1e-6));
  }
}

}  // namespace
}  // namespace vantage
