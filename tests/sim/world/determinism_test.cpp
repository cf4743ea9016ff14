// The same commands give the same bits: again, in another thread, in another process, and after a
// restart from a recorded state.

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/sim/test_world.hpp"
#include "vantage/core/hash.hpp"

namespace vantage {
namespace {

// The robot shoves a crate into a stack of boxes: contacts, friction, several islands.
const std::string kShove =
    "<body name='crate' pos='0.7 0 .2'><freejoint/>"
    "<geom type='box' size='.15 .15 .2' mass='5'/></body>"
    "<body name='low' pos='1.1 0.05 .15'><freejoint/>"
    "<geom type='box' size='.15 .15 .15' mass='3'/></body>"
    "<body name='high' pos='1.1 0.02 .45'><freejoint/>"
    "<geom type='box' size='.12 .12 .15' mass='2'/></body>"
    "<body name='ball' pos='1.1 0.02 .7'><freejoint/><geom size='.1' mass='.5'/></body>";
constexpr int kTicks = 120;

void command(test::RobotWorld& scene, int tick) {
  const double t = 0.025 * tick;
  scene.robot.command_twist(scene.world, {0.5, 0.1 * std::sin(3.0 * t), 0.2 * std::cos(t)});
  scene.robot.command_laser_tilt(scene.world, 0.5 * std::sin(2.0 * t));
}

std::vector<double> run_to_the_end(bool look_at_snapshots = false) {
  test::RobotWorld scene(kShove);
  CollisionCounter counter;
  if (look_at_snapshots) {
    scene.world.on_step = [&](const World& world) { counter.update(scene.robot, world); };
  }
  for (int tick = 0; tick < kTicks; ++tick) {
    command(scene, tick);
    scene.world.advance_tick();
    if (look_at_snapshots) {
      EXPECT_EQ(scene.world.snapshot().time, scene.world.time_s());
      const DataPtr plan = scene.world.copy_data();
      mj_forward(&scene.world.model(), plan.get());
    }
  }
  EXPECT_EQ(counter.count() > 0, look_at_snapshots);
  return scene.world.state();
}

TEST(Determinism, SameBitsAgain) {
  const std::vector<double> first = run_to_the_end();
  EXPECT_EQ(first, run_to_the_end());
  std::srand(7);
  EXPECT_EQ(first, run_to_the_end()) << "whatever the state of rand()";
}

TEST(Determinism, SameBitsInAnotherThread) {
  std::vector<double> there;
  std::vector<double> beside;
  std::thread one([&] { there = run_to_the_end(); });
  std::thread two([&] { beside = run_to_the_end(); });
  one.join();
  two.join();
  EXPECT_EQ(run_to_the_end(), there);
  EXPECT_EQ(there, beside);
}

// Run by the test below in a process of its own.
TEST(Determinism, PrintsItsHash) {
  std::printf("state=%s\n", hash_text(hash_doubles(run_to_the_end())).c_str());
}

TEST(Determinism, SameBitsInAnotherProcess) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string call = "'" + self + "' --gtest_filter=Determinism.PrintsItsHash";
  FILE* process = popen(call.c_str(), "r");
  ASSERT_NE(process, nullptr);
  std::string output;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), process) != nullptr) output += line.data();
  EXPECT_EQ(pclose(process), 0);
  EXPECT_THAT(output,
              ::testing::HasSubstr("state=" + hash_text(hash_doubles(run_to_the_end())) + "\n"));
}

TEST(Determinism, LookingAndPlanningChangeNothing) {
  EXPECT_EQ(run_to_the_end(true), run_to_the_end(false));
}

TEST(Determinism, ReplayOfRecordedControlsFromAnyState) {
  test::RobotWorld recorded(kShove);
  std::vector<std::vector<double>> states;
  std::vector<std::vector<double>> controls;
  for (int tick = 0; tick < kTicks; ++tick) {
    command(recorded, tick);
    const auto now = recorded.world.controls();
    states.push_back(recorded.world.state());
    controls.emplace_back(now.begin(), now.end());
    recorded.world.advance_tick();
  }
  states.push_back(recorded.world.state());

  for (const std::size_t from : {std::size_t{0}, std::size_t{61}}) {
    World replay(recorded.folder.with_pr2());
    replay.set_state(states[from]);
    for (std::size_t tick = from; tick < controls.size(); ++tick) {
      ASSERT_EQ(replay.ticks(), tick);
      replay.set_controls(controls[tick]);
      replay.advance_tick();
      ASSERT_EQ(replay.state(), states[tick + 1]) << "tick " << tick << " from " << from;
    }
  }
}

TEST(Determinism, TheWarmstartIsPartOfTheState) {
  test::RobotWorld scene(kShove);
  scene.robot.command_twist(scene.world, {0.5, 0.0, 0.0});
  scene.run(2.0);
  std::vector<double> state = scene.world.state();
  const auto nv = static_cast<std::size_t>(scene.world.model().nv);
  std::fill(state.end() - static_cast<std::ptrdiff_t>(nv), state.end(), 0.0);
  const std::vector<double> controls(scene.world.controls().begin(), scene.world.controls().end());
  scene.world.advance_tick();
  const std::vector<double> expected = scene.world.state();
  scene.world.set_state(state);
  scene.world.set_controls(controls);
  scene.world.advance_tick();
  EXPECT_NE(scene.world.state(), expected);
}

}  // namespace
}  // namespace vantage
