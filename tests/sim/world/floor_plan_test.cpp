#include "vantage/sim/world/floor_plan.hpp"

#include <gtest/gtest.h>

#include "tests/support/mjcf.hpp"

namespace vantage {
namespace {

std::vector<FloorOutline> plan_of(const std::string& geoms) {
  const auto made = test::compile_mjcf("<mujoco><worldbody><geom type='plane' size='9 9 .1'/>" +
                                       geoms + "</worldbody></mujoco>");
  return floor_plan(*made.model, *made.data);
}

/// By the shoelace formula: above 0 where corners go round counter-clockwise.
double area_m2(const FloorOutline& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

TEST(FloorPlan, OfABoxIsItsFootprintHoweverItIsTurned) {
  const auto plan = plan_of(
      "<geom type='box' size='.6 .4 .5' pos='2 -1 .5'/>"
      "<geom type='box' size='.6 .4 .5' pos='-2 -1 .5' euler='0 0 30'/>");
  ASSERT_EQ(plan.size(), 2U);
  EXPECT_EQ(plan[0].size(), 4U);
  EXPECT_NEAR(area_m2(plan[0]), 1.2 * 0.8, 1e-9);
  EXPECT_TRUE(plan[0].front().isApprox(Eigen::Vector2d(1.4, -1.4)));
  EXPECT_NEAR(area_m2(plan[1]), 1.2 * 0.8, 1e-9);
}

TEST(FloorPlan, OfACylinderIsRound) {
  const auto plan = plan_of("<geom type='cylinder' size='.5 .4' pos='0 0 .4'/>");
  ASSERT_EQ(plan.size(), 1U);
  EXPECT_NEAR(area_m2(plan[0]), 0.785, 0.02);
}

TEST(FloorPlan, LeavesRugsCeilingsAndTheRobotOut) {
  EXPECT_TRUE(plan_of("<geom type='box' size='3 3 .01' pos='0 0 .01'/>"
                      "<geom type='box' size='3 3 .05' pos='0 0 2.55'/>"
                      "<body name='robot/base'><geom type='box' size='.2 .2 .2' pos='0 0 .3'/>"
                      "</body>")
                  .empty());
}

TEST(FloorPlan, ReachesFrom5CentimetresTo2Metres) {
  const auto drawn = [](const char* half_height, const char* middle) {
    return plan_of(std::string("<geom type='box' size='.3 .2 ") + half_height + "' pos='1 2 " +
                   middle + "'/>")
        .size();
  };
  EXPECT_EQ(drawn(".02", ".02"), 0U);
  EXPECT_EQ(drawn(".03", ".03"), 1U);
  EXPECT_EQ(drawn(".05", "1.95"), 1U);
  EXPECT_EQ(drawn(".05", "2.15"), 0U);
}

TEST(FloorPlan, WhatEndsWhereTheBandBeginsIsDrawn) {
  const auto made = test::compile_mjcf(
      "<mujoco><worldbody><geom type='box' size='.25 .5 .125' pos='0 0 .125'/>"
      "<geom type='box' size='.5 .25 .25' pos='0 0 1.75'/></worldbody></mujoco>");
  EXPECT_EQ(floor_plan(*made.model, *made.data, {.low_m = 0.25, .high_m = 1.5}).size(), 2U);
  EXPECT_EQ(floor_plan(*made.model, *made.data, {.low_m = 0.26, .high_m = 1.49}).size(), 0U);
}

TEST(FloorPlan, OfARoundThingHasCornersEvery5Centimetres) {
  const auto plan = plan_of("<geom type='cylinder' size='.5 .4' pos='0 0 .4'/>");
  ASSERT_EQ(plan.size(), 1U);
  EXPECT_EQ(plan[0].size(), 63U);
}

TEST(FloorPlan, WhatFollowsARugOrALampIsDrawn) {
  const auto plan = plan_of(
      "<geom type='box' size='3 3 .01' pos='0 0 .01'/>"
      "<geom type='box' size='.1 .1 .05' pos='0 0 2.55'/>"
      "<geom type='box' size='.6 .4 .5' pos='2 -1 .5'/>");
  ASSERT_EQ(plan.size(), 1U);
  EXPECT_NEAR(area_m2(plan[0]), 1.2 * 0.8, 1e-9);
}

TEST(FloorPlan, ATentHasThreeCorners) {
  const auto made = test::compile_mjcf(
      "<mujoco><asset><mesh name='tent' vertex='0 0 0  1 0 0  0 1 0  .2 .2 1' "
      "face='0 2 1  0 1 3  1 2 3  2 0 3'/></asset><worldbody><geom type='mesh' mesh='tent'/>"
      "</worldbody></mujoco>");
  const auto plan = floor_plan(*made.model, *made.data);
  ASSERT_EQ(plan.size(), 1U);
  EXPECT_EQ(plan[0].size(), 3U);
  EXPECT_NEAR(area_m2(plan[0]), 0.5, 1e-6);
}

TEST(FloorPlan, AnOutlineBeginsAtItsLeftmostCorner) {
  const auto plan = plan_of("<geom type='box' size='.6 .4 .5' pos='-2 -1 .5' euler='0 0 30'/>");
  ASSERT_EQ(plan.size(), 1U);
  for (const Eigen::Vector2d& corner : plan[0]) EXPECT_LE(plan[0].front().x(), corner.x() + 1e-9);
}

}  // namespace
}  // namespace vantage
