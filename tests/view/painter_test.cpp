// From where people look at a scene and at the robot in it.
#include "vantage/view/painter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

/// Of a region of 3 x 4 m.
FreeCamera overview(const std::string& camera) {
  const support::TemporaryDirectory folder;
  write_file(folder / "scene.xml",
             "<mujoco><worldbody><geom type='plane' size='5 5 .1'/><body pos='0 0 1'><freejoint/>"
             "<geom size='.1'/></body>" +
                 camera + "</worldbody></mujoco>");
  const World world(ModelSource{folder / "scene.xml", {}});
  WindowContent content;
  content.overview_m = {Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(4.0, 6.0)};
  return overview_of(world, content);
}

TEST(Overview, LooksObliquelyAtTheRegionAndTheRobotBesideIt) {
  const FreeCamera camera = overview("");
  const double radius_m = 0.75 * 2.5 + 1.2;
  EXPECT_TRUE(camera.lookat_m.isApprox(Eigen::Vector3d(2.5, 4.0, 0.7), 1e-12));
  EXPECT_NEAR(camera.distance_m, radius_m / std::sin(std::numbers::pi / 8.0), 1e-9);
  EXPECT_EQ(camera.azimuth_rad, 0.8);
  EXPECT_EQ(camera.elevation_rad, -0.6);
  EXPECT_NEAR(camera.fovy_rad.value(), 0.25 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(camera.cutaway_m.value(), radius_m, 1e-12);
}

TEST(Overview, LooksFromWhereTheScenesOwnCameraDoes) {
  const FreeCamera camera =
      overview("<camera name='overview' pos='0 -9 9' xyaxes='1 0 0 0 .8 .6'/>");
  EXPECT_NEAR(camera.azimuth_rad, 0.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(camera.elevation_rad, std::asin(-0.8), 1e-9);
  EXPECT_TRUE(camera.lookat_m.isApprox(Eigen::Vector3d(2.5, 4.0, 0.7), 1e-12)) << "but where";
}

TEST(FollowOfRobot, LooksObliquelyAtItsMiddle) {
  const FreeCamera camera = follow_of_robot();
  EXPECT_TRUE(camera.lookat_m.isApprox(Eigen::Vector3d(0.0, 0.0, 0.7), 1e-12));
  EXPECT_EQ(camera.distance_m, 3.0);
  EXPECT_EQ(camera.azimuth_rad, 0.8);
  EXPECT_EQ(camera.elevation_rad, -0.5);
  EXPECT_NEAR(camera.fovy_rad.value(), 0.25 * std::numbers::pi, 1e-12);
  EXPECT_EQ(camera.cutaway_m, 1.5);
}

}  // namespace
}  // namespace vantage
