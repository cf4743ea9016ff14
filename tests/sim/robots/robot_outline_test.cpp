#include "vantage/sim/robots/robot_outline.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/sim/test_world.hpp"
#include "tests/support/mjcf.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

FloorOutline outline_with(const std::string& parts, const std::string& assets = "") {
  const auto scene = test::compile_mjcf(
      "<mujoco><asset>" + assets +
      "</asset><worldbody><geom type='plane' size='9 9 .1'/><geom type='box' size='2 2 2'/>"
      "<body name='robot/base' pos='5 6 7' euler='10 20 30'><freejoint/>" +
      parts + "</body></worldbody></mujoco>");
  return outline_of_geoms(*scene.model, scene.body("robot/base"), "robot.yaml");
}

/// That an outline reaches so far in each of the 64 directions, given by cosine and sine.
void expect_reaches(const FloorOutline& outline,
                    const std::function<double(double, double)>& expected, double tolerance_m) {
  for (int i = 0; i < 64; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 64.0;
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    double reach_m = -1e9;
    for (const Eigen::Vector2d& corner : outline) reach_m = std::max(reach_m, along.dot(corner));
    EXPECT_NEAR(reach_m, expected(along.x(), along.y()), tolerance_m) << i;
  }
}

TEST(RobotOutline, OfABoxAndOfABall) {
  expect_reaches(
      outline_with("<geom type='box' size='.3 .2 .1' pos='.05 -.1 2'/>"),
      [](double c, double s) { return 0.05 * c - 0.1 * s + 0.3 * std::abs(c) + 0.2 * std::abs(s); },
      1e-9);
  expect_reaches(
      outline_with("<geom size='.15' pos='.1 -.2 .3'/>"),
      [](double c, double s) { return 0.1 * c - 0.2 * s + 0.15; }, 1e-9);
}

TEST(RobotOutline, OfRoundThingsUprightAndLying) {
  const auto same = [](double reach_m) { return [=](double, double) { return reach_m; }; };
  expect_reaches(outline_with("<geom type='cylinder' size='.2 .5'/>"), same(0.2), 1e-9);
  expect_reaches(outline_with("<geom type='capsule' size='.2 .5'/>"), same(0.2), 1e-9);
  expect_reaches(
      outline_with("<geom type='cylinder' size='.1 .3' euler='0 90 0'/>"),
      [](double c, double s) { return 0.3 * std::abs(c) + 0.1 * std::abs(s); }, 1e-9);
  expect_reaches(
      outline_with("<geom type='capsule' size='.1 .3' euler='0 90 0'/>"),
      [](double c, double) { return 0.3 * std::abs(c) + 0.1; }, 1e-9);
  expect_reaches(
      outline_with("<geom type='ellipsoid' size='.3 .2 .1'/>"),
      [](double c, double s) { return std::hypot(0.3 * c, 0.2 * s); }, 1e-9);
}

TEST(RobotOutline, OfAMeshByItsVertices) {
  const FloorOutline outline = outline_with(
      "<geom type='mesh' mesh='wedge' pos='.1 .2 .3'/>",
      "<mesh name='other' vertex='0 0 0  1 0 0  0 1 0  0 0 1' face='0 2 1 0 1 3 0 3 2 1 2 3'/>"
      "<mesh name='wedge' vertex='0 0 0  .4 0 0  0 .3 0  0 0 .2' face='0 2 1  0 1 3  0 3 2  1 2 "
      "3'/>");
  expect_reaches(
      outline,
      [](double c, double s) {
        return 0.1 * c + 0.2 * s + std::max({0.0, 0.4 * c, 0.3 * s});
      },
      1e-6);
}

TEST(RobotOutline, PartsAreWhereTheirBodiesAre) {
  const FloorOutline outline = outline_with(
      "<geom size='.01' pos='.4 .1 0'/><body pos='.4 .1 .5' euler='0 0 90'><joint/>"
      "<geom type='box' size='.3 .05 .1' contype='0'/></body>"
      "<body pos='0 0 1'><geom type='box' size='1 1 1' contype='0' conaffinity='0'/></body>");
  expect_reaches(
      outline,
      [](double c, double s) { return 0.4 * c + 0.1 * s + 0.05 * std::abs(c) + 0.3 * std::abs(s); },
      1e-9);
}

TEST(RobotOutline, SomethingOfARobotMustBeAbleToTouch) {
  EXPECT_EQ(test::message_of<InputError>(
                [] { outline_with("<geom size='.1' contype='0' conaffinity='0'/>"); }),
            "robot.yaml: none of the geoms of body 'robot/base' can touch anything");
}

TEST(RobotOutline, CornersThatAreGivenWin) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><body name='robot/base'><freejoint/><geom size='.1'/></body>"
      "</worldbody></mujoco>");
  const std::vector<std::array<double, 2>> corners{{-0.4, -0.3}, {0.5, -0.3}, {0.0, 0.7}};
  EXPECT_THAT(robot_outline(*scene.model, 1, corners, "robot.yaml"),
              testing::ElementsAre(Eigen::Vector2d(-0.4, -0.3), Eigen::Vector2d(0.5, -0.3),
                                   Eigen::Vector2d(0.0, 0.7)));
  expect_reaches(
      robot_outline(*scene.model, 1, {}, "robot.yaml"), [](double, double) { return 0.1; }, 1e-9);
}

TEST(RobotOutline, EveryVertexOfAMeshCounts) {
  expect_reaches(
      outline_with("<geom type='mesh' mesh='kite'/>",
                   "<mesh name='kite' vertex='-.5 0 0  .4 0 0  0 .3 0  0 0 .2' "
                   "face='0 2 1  0 1 3  0 3 2  1 2 3'/>"),
      [](double c, double s) {
        return std::max({-0.5 * c, 0.4 * c, 0.3 * s, 0.0});
      },
      1e-6);
}

}  // namespace
}  // namespace vantage
