// The path that a flight leads on to, told before it is taken.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <type_traits>

#include "tests/support/temporary_directory.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/trajectory/simulated_trajectory_robot.hpp"
#include "vantage/tasks/trajectory/trajectory_recorder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

const fs::path kSourceTree = VANTAGE_SOURCE_DIR;

FlightWaypoint at(double x_m, double y_m, double yaw_rad) {
  return {.p_world_m = {x_m, y_m, 1.8}, .yaw_rad = yaw_rad};
}

/// The robot of the episode in its world.
struct FlyingRobot : SimulatedTrajectoryRobot {
  FlyingRobot(const ResolvedEpisode& resolved, const FlightWaypoint& start)
      : SimulatedTrajectoryRobot(resolved.setup, model_source(resolved),
                                 std::get<TrajectoryFlight>(resolved.task), start) {}
};

const ImageCallback kNothing = [](const FlightImage&) {};

class Interface : public testing::Test {
 protected:
  const ResolvedEpisode episode_ = load_episode(
      kSourceTree / "assets/episodes/trajectory.yaml",
      {fmt::format("scene={}", (kSourceTree / "models/scenes/trajectory_4/scene.xml").string()),
       "camera={width_px: 32, height_px: 24}"});
};

TEST_F(Interface, TellsThePathThatItLeadsOnTo) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  robot.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2), at(-1.6, -1.8, 0.4)});
  robot.fly_for(0.9, kNothing);
  const std::vector<FlightWaypoint> others = {at(-1.6, -1.9, 0.0), at(-1.0, -1.9, -0.3)};
  constexpr double kDelay_s = 0.4;
  const int passed = robot.passed(kDelay_s);
  const MinimumJerkTrajectory told = robot.path_in(kDelay_s, others);
  const MinimumJerkTrajectory from_here = robot.path_in(0.0, others);
  robot.fly_for(kDelay_s, kNothing);
  EXPECT_EQ(robot.passed(), passed);
  robot.follow(others);
  for (int i = 1; i <= 4; ++i) {
    robot.fly_for(0.25, kNothing);
    const Eigen::Vector3d p_m = robot.path_in(0.0, others).at(0.0).p_world_m;
    EXPECT_NEAR((told.at(0.25 * i).p_world_m - p_m).norm(), 0.0, 1e-6);
    EXPECT_GT((from_here.at(0.25 * i).p_world_m - p_m).norm(), 0.01) << "a delay makes another";
  }
}

TEST_F(Interface, TellsWhatIsLeftOfThePathThatItFlies) {
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  EXPECT_FALSE(robot.path_on(0.1)) << "none yet";
  robot.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2), at(-1.6, -1.8, 0.4),
                           at(-1.1, -1.9, 0.0), at(-0.6, -1.9, 0.0)});
  robot.fly_for(0.9, kNothing);
  constexpr double kDelay_s = 0.4;
  const auto on = robot.path_on(kDelay_s);
  ASSERT_TRUE(on);
  EXPECT_EQ(on->knots_s().size(), 6U - static_cast<std::size_t>(robot.passed(kDelay_s)));
  robot.fly_for(kDelay_s, kNothing);
  for (const double t : {0.0, 0.1, 0.2, 0.3}) {
    const auto now = robot.path_on(0.0);
    ASSERT_TRUE(now);
    EXPECT_NEAR((on->at(t).p_world_m - now->at(0.0).p_world_m).norm(), 0.0, 1e-6);
    robot.fly_for(0.1, kNothing);
  }
  ASSERT_LE(robot.passed(), 2);
  robot.fly_past(2 - robot.passed(), kNothing);
  EXPECT_TRUE(robot.path_on(0.0)) << "three are left";
  robot.fly_past(1, kNothing);
  EXPECT_FALSE(robot.path_on(0.0)) << "two are left";
}

/// With nothing of its own that could not be copied.
struct BareTrajectoryRobot : TrajectoryRobotInterface {
  using TrajectoryRobotInterface::passed;
  [[nodiscard]] double time_s() const override { return 0.0; }
  void follow(std::span<const FlightWaypoint> /*waypoints*/) override {}
  void fly_for(double /*duration_s*/, const ImageCallback& /*on_image*/) override {}
  void fly_past(int /*waypoints*/, const ImageCallback& /*on_image*/) override {}
  [[nodiscard]] MinimumJerkTrajectory path_in(
      double /*delay_s*/, std::span<const FlightWaypoint> waypoints) const override {
    return {FlightReference{}, waypoints};
  }
  [[nodiscard]] std::optional<MinimumJerkTrajectory> path_on(double /*delay_s*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] int passed(double /*in_s*/) const override { return 0; }
  void capture_now(const ImageCallback& /*on_image*/) override {}
  [[nodiscard]] Pose estimated_body() const override { return Pose::Identity(); }
  [[nodiscard]] Pose T_body_camera() const override { return Pose::Identity(); }
};

TEST_F(Interface, IsOfOneRobotThatIsNotCopied) {
  EXPECT_TRUE(std::is_default_constructible_v<BareTrajectoryRobot>);
  EXPECT_FALSE(std::is_copy_constructible_v<BareTrajectoryRobot>);
  EXPECT_FALSE(std::is_copy_assignable_v<BareTrajectoryRobot>);
}

using LeanFlight = Interface;

TEST_F(LeanFlight, KeepsNoImagesEventsOrScene) {
  const support::TemporaryDirectory folder;
  FlyingRobot robot(episode_, at(-2.7, -1.9, 0.0));
  const auto& task = std::get<TrajectoryFlight>(episode_.task);
  RunOptions options;
  options.directory = folder / "run";
  options.lean = true;
  const RunRequest request{episode_.setup,         "trajectory", task.method_name(),
                           episode_yaml(episode_), {},           options};
  const EpisodeRun run(request);
  TrajectoryRecorder recorder(run, robot.quadrotor(), task.camera);
  ObjectView view;
  view.width_px = view.height_px = 2;
  view.rgb.assign(12, 100);
  view.mask.assign(4, 1);
  recorder.observation(0, {}, 1, view);
  recorder.commit();
  EXPECT_TRUE(fs::exists(options.directory / "looks.csv"));
  for (const char* name : {"views", "story.bin", "scene.bin", "candidates.csv", "states.bin"}) {
    EXPECT_FALSE(fs::exists(options.directory / name)) << name;
  }
  release_run_directory(options.directory);
}

}  // namespace
}  // namespace vantage
