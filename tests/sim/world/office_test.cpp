// The checked-in offices carry the robot.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

class OfficeWorld : public testing::TestWithParam<std::string> {
 protected:
  static ModelSource source() {
    return {std::filesystem::path(VANTAGE_SOURCE_DIR) / "models/scenes" / GetParam() / "scene.xml",
            test::pr2_file()};
  }
};

TEST_P(OfficeWorld, TheRobotTurnsOnTheSpotAtEveryStart) {
  for (int i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    World world(source());
    EXPECT_TRUE(world.warnings().empty());
    const MobileBase robot = test::pr2(world);
    const int site = model_id(world.model(), ModelObject::site, "start_" + std::to_string(i));
    const Pose2 start = project_to_se2(site_pose(world, site));
    robot.place(world, start);
    robot.command_twist(world, {0.0, 0.0, 1.0});
    for (int tick = 0; tick < 260; ++tick) {
      world.advance_tick();
      ASSERT_EQ(robot.contacts(world), 0) << "tick " << tick;
    }
    EXPECT_NEAR(robot.T_world_base(world).x_m, start.x_m, 0.01);
    EXPECT_NEAR(robot.T_world_base(world).y_m, start.y_m, 0.01);
  }
}

/// Furniture has contacts although it ignores other furniture.
TEST_P(OfficeWorld, StopsTheRobot) {
  World world(source());
  const MobileBase robot = test::pr2(world);
  const int site = model_id(world.model(), ModelObject::site, "start_0");
  robot.place(world, project_to_se2(site_pose(world, site)));
  robot.command_twist(world, {-0.5, 0.0, 0.0});
  bool touched = false;
  for (int tick = 0; tick < 800 && !touched; ++tick) {
    world.advance_tick();
    touched = robot.contacts(world) > 0;
  }
  EXPECT_TRUE(touched);
}

INSTANTIATE_TEST_SUITE_P(Scenes, OfficeWorld,
                         testing::Values("office_small_1", "office_small_4", "office_large_1",
                                         "office_large_4"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace vantage
