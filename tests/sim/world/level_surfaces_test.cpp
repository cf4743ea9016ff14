#include "vantage/sim/world/level_surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/mjcf.hpp"

namespace vantage {
namespace {

std::vector<LevelSurface> surfaces_of(const std::string& geoms) {
  const auto made = test::compile_mjcf("<mujoco><worldbody><geom type='plane' size='9 9 .1'/>" +
                                       geoms + "</worldbody></mujoco>");
  return level_surfaces(*made.model, *made.data);
}

TEST(LevelSurfaces, ATableIsItsUpperSide) {
  const auto found = surfaces_of(
      "<geom name='top' type='box' size='.6 .4 .02' pos='2 -1 .40'/>"
      "<geom type='box' size='.05 .05 .19' pos='2 -1 .19'/>"
      "<geom type='box' size='.1 .15 .02' pos='2 -1 .45'/>");  // a book
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "top");
  EXPECT_NEAR(found[0].height_m, 0.42, 1e-9);
  EXPECT_NEAR(found[0].area_m2, 1.2 * 0.8, 1e-9);
  EXPECT_NEAR(found[0].extent_m.min().x(), 1.4, 1e-9);
  EXPECT_NEAR(found[0].extent_m.max().y(), -0.6, 1e-9);
  EXPECT_NEAR(found[1].height_m, 0.47, 1e-9);
}

TEST(LevelSurfaces, BoardsThatMeetAreOneTable) {
  const auto found = surfaces_of(
      "<geom type='box' size='.3 .4 .02' pos='-.31 0 .7'/>"
      "<geom type='box' size='.3 .4 .02' pos='.31 0 .7'/>"
      "<geom type='box' size='.3 .4 .02' pos='2 0 .7'/>");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].extent_m.sizes().x(), 1.22, 1e-9);
  EXPECT_NEAR(found[0].area_m2, 0.96, 1e-9);
}

TEST(LevelSurfaces, RoundTablesCountAndWhatIsTiltedLowOrSmallDoesNot) {
  const auto found = surfaces_of(
      "<geom type='cylinder' size='.5 .02' pos='0 0 .7'/>"
      "<geom type='box' size='.6 .6 .02' pos='3 0 .7' euler='0 10 0'/>"
      "<geom type='box' size='.6 .6 .02' pos='6 0 .2'/>"
      "<geom type='box' size='.05 .05 .02' pos='-3 0 .7'/>"
      "<geom type='sphere' size='.4' pos='-5 0 .4'/>");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].height_m, 0.72, 1e-9);
  EXPECT_NEAR(found[0].area_m2, 0.785, 0.02);
}

std::optional<NearSurface> nearest_among(const std::string& geoms) {
  const auto made = test::compile_mjcf("<mujoco><worldbody><geom type='plane' size='9 9 .1'/>" +
                                       geoms + "</worldbody></mujoco>");
  return nearest_to_level(*made.model, *made.data);
}

TEST(NearestToLevel, IsTheLargestThatIsTooLowTooHighOrTilted) {
  const std::string low = "<geom name='low' type='box' size='.6 .4 .015' pos='0 0 .365'/>";
  const std::string tilted =
      "<geom name='lean' type='box' size='.6 .6 .02' pos='3 0 .7' euler='0 8 0'/>";
  const auto lower = nearest_among(low);
  ASSERT_TRUE(lower);
  EXPECT_EQ(lower->name, "low");
  EXPECT_NEAR(lower->height_m, 0.38, 1e-9);
  EXPECT_NEAR(lower->area_m2, 0.96, 1e-9);
  EXPECT_EQ(lower->tilt_rad, 0.0);
  const auto steeper = nearest_among(low + tilted);
  ASSERT_TRUE(steeper);
  EXPECT_EQ(steeper->name, "lean");
  EXPECT_NEAR(steeper->tilt_rad, 8.0 * 3.14159265 / 180.0, 1e-6);
  EXPECT_NEAR(steeper->height_m, 0.7 + 0.02 * std::cos(steeper->tilt_rad), 1e-3);
}

TEST(NearestToLevel, ASmallOneIsNearAndAFloorIsNot) {
  const auto small = nearest_among("<geom type='box' size='.09 .09 .02' pos='0 0 .7'/>");
  ASSERT_TRUE(small);
  EXPECT_NEAR(small->area_m2, 0.0324, 1e-9);
  EXPECT_FALSE(nearest_among("<geom type='box' size='2 2 .02' pos='0 0 0'/>"));
}

}  // namespace
}  // namespace vantage
