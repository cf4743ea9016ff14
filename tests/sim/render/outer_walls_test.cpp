// What stands between a room and who looks in, and from where people do.
#include "vantage/sim/render/outer_walls.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/support/mjcf.hpp"
#include "vantage/sim/render/overview.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

OuterWalls walls_of(const std::string& geoms) {
  return outer_walls(
      *test::compile_mjcf("<mujoco><worldbody>" + geoms + "</worldbody></mujoco>").model);
}

/// 4 m x 3 m x 2.5 m; what moves is no part of it.
const char* const kHall =
    "<geom type='plane' size='20 20 .1'/>"
    "<geom name='west' type='box' size='.05 1.5 1.25' pos='-1.95 0 1.25'/>"
    "<geom name='east' type='box' size='.05 1.5 1.25' pos='1.95 0 1.25'/>"
    "<geom name='south' type='box' size='1.8 .05 1.25' pos='0 -1.45 1.25'/>"
    "<geom name='north' type='box' size='1.8 .05 1.25' pos='0 1.45 1.25'/>"
    "<geom name='ceiling' type='box' size='2 1.5 .05' pos='0 0 2.45'/>"
    "<geom name='picture' type='box' size='.01 .3 .2' pos='1.85 0 1.5' group='5'/>"
    "<geom name='cupboard' type='box' size='.3 .4 1' pos='0 .5 1'/>"
    "<body pos='9 9 9'><freejoint/><geom size='.1'/></body>";

TEST(OuterWallsOfAHall, AreNumberedBySide) {
  const OuterWalls walls = walls_of(kHall);
  EXPECT_TRUE(walls.extent_m.min().isApprox(Eigen::Vector3d(-2.0, -1.5, 0.0), 1e-9));
  EXPECT_TRUE(walls.extent_m.max().isApprox(Eigen::Vector3d(2.0, 1.5, 2.5), 1e-9));
  EXPECT_THAT(walls.geoms[0], ElementsAre(1));
  EXPECT_THAT(walls.geoms[1], ElementsAre(2, 6));
  EXPECT_THAT(walls.geoms[2], ElementsAre(3));
  EXPECT_THAT(walls.geoms[3], ElementsAre(4));
  EXPECT_THAT(walls.geoms[4], ElementsAre(5));
}

TEST(OuterWallsOfAHall, HideItFromBeyondTheirSide) {
  const OuterWalls walls = walls_of(kHall);
  EXPECT_THAT(walls.before({0.0, 0.0, 1.0}), IsEmpty());
  EXPECT_THAT(walls.before({-2.1, 0.0, 1.0}), ElementsAre(1));
  EXPECT_THAT(walls.before({2.1, 0.0, 1.0}), ElementsAre(2, 6));
  EXPECT_THAT(walls.before({0.0, -1.6, 1.0}), ElementsAre(3));
  EXPECT_THAT(walls.before({0.0, 1.6, 1.0}), ElementsAre(4));
  EXPECT_THAT(walls.before({0.0, 0.0, 2.6}), ElementsAre(5));
  EXPECT_THAT(walls.before({2.1, -1.6, 2.6}), ElementsAre(2, 3, 5, 6));
  EXPECT_THAT(walls.before({-1.9, 1.4, -9.0}), IsEmpty());
}

TEST(OuterWallsOfAHall, HideNothingFromTheirSideItself) {
  const OuterWalls walls = walls_of(kHall);
  const Eigen::Vector3d low_m = walls.extent_m.min();
  const Eigen::Vector3d high_m = walls.extent_m.max();
  for (const Eigen::Vector3d& eye_m :
       {Eigen::Vector3d(low_m.x(), 0.0, 1.0), Eigen::Vector3d(high_m.x(), 0.0, 1.0),
        Eigen::Vector3d(0.0, low_m.y(), 1.0), Eigen::Vector3d(0.0, high_m.y(), 1.0),
        Eigen::Vector3d(0.0, 0.0, high_m.z())}) {
    EXPECT_THAT(walls.before(eye_m), IsEmpty()) << eye_m.transpose();
  }
}

/// A plate of 4 m x 3 m on the floor, and what else there is.
std::vector<int> on_side(std::size_t side, const std::string& more) {
  return walls_of("<geom type='box' size='2 1.5 .05' pos='0 0 .05'/>" + more).geoms[side];
}

TEST(OuterWallsLimits, AWallIsThin) {
  EXPECT_THAT(on_side(1, "<geom type='box' size='.1 1.4 .9' pos='1.9 0 1'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(1, "<geom type='box' size='.15 1.4 .9' pos='1.85 0 1'/>"), IsEmpty());
  EXPECT_THAT(on_side(0, "<geom type='box' size='.1 1.4 .9' pos='-1.9 0 1'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(0, "<geom type='box' size='.15 1.4 .9' pos='-1.85 0 1'/>"), IsEmpty());
}

TEST(OuterWallsLimits, AWallIsHigh) {
  EXPECT_THAT(on_side(2, "<geom type='box' size='1.9 .1 .8' pos='0 -1.4 1'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(2, "<geom type='box' size='1.9 .1 .7' pos='0 -1.4 1'/>"), IsEmpty());
}

TEST(OuterWallsLimits, AWallIsMostOfItsSide) {
  EXPECT_THAT(on_side(1, "<geom type='box' size='.1 .95 .9' pos='1.9 0 1'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(1, "<geom type='box' size='.1 .85 .9' pos='1.9 0 1'/>"), IsEmpty());
  EXPECT_THAT(on_side(3, "<geom type='box' size='1.25 .1 .9' pos='0 1.4 1'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(3, "<geom type='box' size='1.15 .1 .9' pos='0 1.4 1'/>"), IsEmpty());
  EXPECT_THAT(on_side(3,
                      "<geom type='box' size='.65 .1 .9' pos='-1 1.4 1'/>"
                      "<geom type='box' size='.6 .1 .9' pos='1 1.4 1'/>"),
              ElementsAre(1, 2));
}

TEST(OuterWallsLimits, ACeilingIsMostOfTheArea) {
  EXPECT_THAT(on_side(4, "<geom type='box' size='1.9 1 .1' pos='0 0 2.4'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(4, "<geom type='box' size='1.7 1 .1' pos='0 0 2.4'/>"), IsEmpty());
}

TEST(OuterWallsLimits, ACeilingIsHighAndNoWorktop) {
  const std::string leg = "<geom type='box' size='.05 .05 .35' pos='0 0 .35'/>";
  EXPECT_THAT(walls_of(leg + "<geom type='box' size='1 .5 .02' pos='0 0 .72'/>").geoms[4],
              IsEmpty());
  EXPECT_THAT(on_side(4, "<geom type='box' size='2 1.5 .1' pos='0 0 1.65'/>"), ElementsAre(1));
  EXPECT_THAT(on_side(4, "<geom type='box' size='2 1.5 .1' pos='0 0 1.55'/>"), IsEmpty());
}

TEST(OuterWallsLimits, RoundThingsAreCutEvery30Centimetres) {
  const OuterWalls walls = walls_of("<geom type='cylinder' size='2 .5'/>");
  EXPECT_NEAR(walls.extent_m.min().x(), -2.0, 1e-9);
  EXPECT_NEAR(walls.extent_m.max().y(), 2.0 * std::cos(std::numbers::pi / 42.0), 1e-9);
  EXPECT_TRUE(walls_of("").extent_m.isEmpty());
}

FreeCamera overview_of(const std::string& statistic, const std::string& geoms) {
  const auto scene =
      test::compile_mjcf("<mujoco><statistic extent='" + statistic +
                         "'/><visual><global fovy='60'/><map zfar='40'/></visual><worldbody>" +
                         geoms + "</worldbody></mujoco>");
  return std::get<FreeCamera>(overview_camera(*scene.model));
}

TEST(OverviewCamera, IsSoFarOffThatAllThatStandsStillIsInSight) {
  const std::string box = "<geom type='box' size='1 1.5 .5' pos='3 -2 .5'/>";
  const FreeCamera camera = overview_of("10", box);
  EXPECT_TRUE(camera.lookat_m.isApprox(Eigen::Vector3d(3.0, -2.0, 0.5), 1e-9));
  EXPECT_EQ(camera.azimuth_rad, 0.8);
  EXPECT_EQ(camera.elevation_rad, -0.8);
  EXPECT_NEAR(camera.distance_m, 2.0 * (1.2 + 0.4 * std::sqrt(13.0)), 1e-6);
  EXPECT_NEAR(overview_of("0.1", box).distance_m, 3.6 - (1.2 + 0.4 * std::sqrt(13.0)), 1e-6)
      << "the far plane is 4 m away";
  EXPECT_NEAR(overview_of("0.01", box).distance_m, 0.1, 1e-12);
}

TEST(OverviewCamera, OfNothingLooksAtWhereARobotMayBe) {
  const FreeCamera camera = overview_of("10", "");
  EXPECT_TRUE(camera.lookat_m.isApprox(Eigen::Vector3d(0.0, 0.0, 0.8), 1e-12));
  EXPECT_NEAR(camera.distance_m, 2.4, 1e-6);
}

TEST(OverviewCamera, IsTheScenesOwnIfItHasOne) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><camera name='other'/><camera name='overview'/><geom size='.1'/>"
      "</worldbody></mujoco>");
  const CameraView view = overview_camera(*scene.model);
  ASSERT_TRUE(std::holds_alternative<FixedCamera>(view));
  EXPECT_EQ(std::get<FixedCamera>(view).camera_id, 1);
}

TEST(OverviewCamera, MayBeTheFirstOfTheScene) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><camera name='overview'/><geom size='.1'/></worldbody></mujoco>");
  const CameraView view = overview_camera(*scene.model);
  ASSERT_TRUE(std::holds_alternative<FixedCamera>(view));
  EXPECT_EQ(std::get<FixedCamera>(view).camera_id, 0);
  EXPECT_FALSE(std::get<FixedCamera>(view).fovy_rad) << "the scene's own";
}

}  // namespace
}  // namespace vantage
