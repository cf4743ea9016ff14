// The path that a flight leads on to, told before it is taken.
#include "vantage/tasks/trajectory/trajectory_rig.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = VANTAGE_SOURCE_DIR;

FlightWaypoint at(double x_m, double y_m, double yaw_rad) {
  return {.p_world_m = {x_m, y_m, 1.8}, .yaw_rad = yaw_rad};
}

const LookAt kNothing = [](const FlightPicture&) {};

class Rig : public testing::Test {
 protected:
  const ResolvedEpisode episode_ = load_episode(
      kSource / "assets/episodes/trajectory.yaml",
      {fmt::format("scene={}", (kSource / "models/scenes/trajectory_4/scene.xml").string()),
       "trajectory.camera={width_px: 32, height_px: 24}"});
};

TEST_F(Rig, TellsThePathThatItLeadsOnTo) {
  TrajectoryRig rig(episode_, at(-2.7, -1.9, 0.0));
  rig.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2), at(-1.6, -1.8, 0.4)});
  rig.fly_for(0.9, kNothing);
  const std::vector<FlightWaypoint> others = {at(-1.6, -1.9, 0.0), at(-1.0, -1.9, -0.3)};
  constexpr double kDelay_s = 0.4;
  const int passed = rig.passed(kDelay_s);
  const FlightPath told = rig.path_in(kDelay_s, others);
  const FlightPath from_here = rig.path_in(0.0, others);
  rig.fly_for(kDelay_s, kNothing);
  EXPECT_EQ(rig.passed(), passed);
  rig.follow(others);
  for (int i = 1; i <= 4; ++i) {
    rig.fly_for(0.25, kNothing);
    const Eigen::Vector3d p_m = rig.path_in(0.0, others).at(0.0).p_world_m;
    EXPECT_NEAR((told.at(0.25 * i).p_world_m - p_m).norm(), 0.0, 1e-6);
    EXPECT_GT((from_here.at(0.25 * i).p_world_m - p_m).norm(), 0.01) << "a delay makes another";
  }
}

TEST_F(Rig, TellsWhatIsLeftOfThePathThatItFlies) {
  TrajectoryRig rig(episode_, at(-2.7, -1.9, 0.0));
  EXPECT_FALSE(rig.path_on(0.1)) << "none yet";
  rig.follow(std::vector{at(-2.5, -1.9, 0.0), at(-2.1, -1.8, 0.2), at(-1.6, -1.8, 0.4),
                         at(-1.1, -1.9, 0.0), at(-0.6, -1.9, 0.0)});
  rig.fly_for(0.9, kNothing);
  constexpr double kDelay_s = 0.4;
  const auto on = rig.path_on(kDelay_s);
  ASSERT_TRUE(on);
  EXPECT_EQ(on->knots_s().size(), 6U - static_cast<std::size_t>(rig.passed(kDelay_s)));
  rig.fly_for(kDelay_s, kNothing);
  for (const double t : {0.0, 0.1, 0.2, 0.3}) {
    const auto now = rig.path_on(0.0);
    ASSERT_TRUE(now);
    EXPECT_NEAR((on->at(t).p_world_m - now->at(0.0).p_world_m).norm(), 0.0, 1e-6);
    rig.fly_for(0.1, kNothing);
  }
  ASSERT_LE(rig.passed(), 2);
  rig.fly_past(2 - rig.passed(), kNothing);
  EXPECT_TRUE(rig.path_on(0.0)) << "three are left";
  rig.fly_past(1, kNothing);
  EXPECT_FALSE(rig.path_on(0.0)) << "two are left";
}

}  // namespace
}  // namespace vantage
