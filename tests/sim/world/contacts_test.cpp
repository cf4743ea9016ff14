#include "vantage/sim/world/contacts.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/support/mjcf.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A ball, 5 mm deep in a plane that leans by that angle.
test::MjcfModel ball_on_slope(double slope_deg) {
  const double slope_rad = slope_deg * std::numbers::pi / 180.0;
  return test::compile_mjcf(
      fmt::format("<mujoco><worldbody><geom type='plane' size='9 9 .1' euler='0 {} 0'/>"
                  "<body name='robot' pos='{} 0 {}'><freejoint/><geom name='wheel' size='.1'/>"
                  "</body></worldbody></mujoco>",
                  slope_deg, 0.095 * std::sin(slope_rad), 0.095 * std::cos(slope_rad)));
}

TEST(Contacts, AWheelStandsWithin30DegreesOfLevel) {
  for (const auto& [slope_deg, counts] : {std::pair(25.0, false), std::pair(35.0, true)}) {
    const auto scene = ball_on_slope(slope_deg);
    const std::vector<int> wheel{scene.geom("wheel")};
    const auto touched = [&](std::span<const int> on_floor) {
      return touched_geoms(*scene.model, *scene.data, scene.body("robot"), on_floor);
    };
    EXPECT_THAT(touched({}), ElementsAre(0)) << slope_deg;
    EXPECT_EQ(touched(wheel).size(), counts ? 1U : 0U) << slope_deg;
  }
}

TEST(Contacts, WhatIsWithinAMarginDoesNotTouchYet) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/><body name='robot' pos='0 0 .11'>"
      "<freejoint/><geom size='.1' margin='.05'/></body></worldbody></mujoco>");
  ASSERT_EQ(scene.data->ncon, 1);
  EXPECT_THAT(contact_points(*scene.model, *scene.data, scene.body("robot")), IsEmpty());
}

TEST(Contacts, AreThoseOfTheRobotWithOthers) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom name='floor' type='plane' size='9 9 .1'/>"
      "<body name='crate' pos='3 0 .19'><freejoint/><geom type='box' size='.2 .2 .2'/></body>"
      "<body name='robot' pos='0 0 .099'><freejoint/><geom type='box' size='.1 .1 .1'/>"
      "<body pos='0 0 1'><joint type='slide'/><geom size='.1'/></body>"
      "<body pos='0 0 1.15'><joint type='slide'/><geom size='.1'/></body></body>"
      "</worldbody></mujoco>");
  ASSERT_EQ(scene.data->ncon, 9) << "of crate, of robot, and between its own parts";
  const int floor = scene.geom("floor");
  EXPECT_THAT(contact_points(*scene.model, *scene.data, scene.body("robot")),
              ElementsAre(floor, floor, floor, floor));
  EXPECT_THAT(touched_geoms(*scene.model, *scene.data, scene.body("robot")), ElementsAre(floor));
}

TEST(Contacts, TouchedGeomsAscendEachOnce) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom name='a' type='box' size='.2 .2 .2'/>"
      "<geom name='b' type='box' size='.2 .2 .2' pos='1 0 0'/>"
      "<body name='robot' pos='1 0 .29'><freejoint/><geom size='.1'/>"
      "<body pos='-1 0 0'><joint type='slide'/><geom size='.1'/><geom size='.1' pos='.9 0 0'/>"
      "</body></body></worldbody></mujoco>");
  EXPECT_EQ(contact_points(*scene.model, *scene.data, scene.body("robot")).size(), 3U);
  EXPECT_THAT(touched_geoms(*scene.model, *scene.data, scene.body("robot")), ElementsAre(0, 1));
}

TEST(CollisionCounter, TouchingAgainSoonIsTheSameCollision) {
  const std::vector<int> wall{3};
  const std::vector<int> both{3, 7};
  CollisionCounter counter;
  EXPECT_EQ(counter.update(wall, 0.25), 1);
  EXPECT_EQ(counter.update(wall, 0.75), 0);
  EXPECT_EQ(counter.update({}, 1.0), 0);
  EXPECT_EQ(counter.update(both, 1.1875), 1);
  EXPECT_EQ(counter.update(both, 1.75), 2);
  EXPECT_EQ(counter.count(), 4);
}

TEST(CollisionCounter, HowSoonIsForTheCallerToSay) {
  const std::vector<int> wall{3};
  CollisionCounter counter(2.0);
  EXPECT_EQ(counter.update(wall, 0.0), 1);
  EXPECT_EQ(counter.update(wall, 2.0), 0);
  EXPECT_EQ(counter.update(wall, 4.25), 1);
}

TEST(Contacts, WhatJustTouchesTouches) {
  const auto scene = test::compile_mjcf(
      "<mujoco><worldbody><geom type='plane' size='9 9 .1'/><body name='robot' pos='0 0 .125'>"
      "<freejoint/><geom size='.125'/></body></worldbody></mujoco>");
  ASSERT_EQ(scene.data->ncon, 1);
  ASSERT_EQ(scene.data->contact[0].dist, 0.0);
  EXPECT_THAT(contact_points(*scene.model, *scene.data, scene.body("robot")), ElementsAre(0));
}

}  // namespace
}  // namespace vantage
