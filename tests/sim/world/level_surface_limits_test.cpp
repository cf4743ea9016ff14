// Which surfaces are level, large and near enough: on both sides of each limit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/mjcf.hpp"
#include "vantage/sim/world/level_surfaces.hpp"

namespace vantage {
namespace {

test::MjcfModel things(const std::string& bodies, const std::string& assets = "") {
  return test::compile_mjcf("<mujoco><asset>" + assets + "</asset><worldbody>" + bodies +
                            "</worldbody></mujoco>");
}

std::vector<LevelSurface> tops_of(const std::string& bodies, const std::string& assets = "") {
  const auto scene = things(bodies, assets);
  return level_surfaces(*scene.model, *scene.data);
}

std::optional<NearSurface> nearest_of(const std::string& bodies) {
  const auto scene = things(bodies);
  return nearest_to_level(*scene.model, *scene.data);
}

/// A board of 4 cm, half its edges in x and y, by its middle.
std::string board(const std::string& half, const std::string& at, const std::string& more = "") {
  return "<geom type='box' size='" + half + " .02' pos='" + at + "' " + more + "/>";
}

TEST(LevelSurfaceLimits, Heights) {
  EXPECT_TRUE(tops_of(board(".5 .5", "0 0 .37")).empty());
  EXPECT_TRUE(tops_of(board(".5 .5", "0 0 1.24")).empty());
  for (const char* z : {".39", "1.17"}) {
    const auto found = tops_of(board(".5 .5", std::string("0 0 ") + z));
    ASSERT_EQ(found.size(), 1U) << z;
    EXPECT_NEAR(found[0].height_m, std::stod(z) + 0.02, 1e-9);
    EXPECT_NEAR(found[0].area_m2, 1.0, 1e-9);
  }
}

TEST(LevelSurfaceLimits, Tilt) {
  const auto level = tops_of(board(".2 .2", "0 0 .7", "euler='0 2 0'"));
  ASSERT_EQ(level.size(), 1U);
  EXPECT_NEAR(level[0].area_m2, 0.16, 1e-9);
  EXPECT_TRUE(tops_of(board(".2 .2", "0 0 .7", "euler='0 4 0'")).empty());
}

TEST(LevelSurfaceLimits, Area) {
  EXPECT_TRUE(tops_of(board(".09 .09", "0 0 .7")).empty());
  const auto found = tops_of(board(".12 .11", "0 0 .7"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].area_m2, 0.0528, 1e-9);
}

TEST(LevelSurfaceLimits, BoardsThatDifferByACentimetreAreTwo) {
  const std::string large = board(".3 .4", ".31 0 .7", "name='large'");
  const auto one = tops_of(board(".2 .4", "-.21 0 .708", "name='small'") + large);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].name, "large");
  EXPECT_NEAR(one[0].height_m, 0.72, 1e-9);
  EXPECT_NEAR(one[0].area_m2, 0.8, 1e-9);
  EXPECT_EQ(tops_of(board(".2 .4", "-.21 0 .712") + large).size(), 2U);
}

TEST(LevelSurfaceLimits, BoardsThreeCentimetresApartAreTwo) {
  EXPECT_EQ(tops_of(board(".3 .4", "-.3125 0 .7") + board(".3 .4", ".3125 0 .7")).size(), 1U);
  EXPECT_EQ(tops_of(board(".3 .4", "-.3175 0 .7") + board(".3 .4", ".3175 0 .7")).size(), 2U);
}

TEST(LevelSurfaceLimits, BoardsMayMeetThroughAThirdOne) {
  const auto found =
      tops_of(board(".3 .4", "-.62 0 .7") + board(".28 .4", ".6 0 .7") + board(".31 .3", "0 0 .7"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].area_m2, 1.3, 1e-9);
  EXPECT_NEAR(found[0].extent_m.min().x(), -0.92, 1e-9);
  EXPECT_NEAR(found[0].extent_m.max().x(), 0.88, 1e-9);
}

TEST(LevelSurfaceLimits, TheLargestIsFirstOnceAllAreJoined) {
  const auto found = tops_of(board(".5 .5", "5 0 .7", "name='big'") + board(".4 .4", "-.4 0 .7") +
                             board(".4 .4", ".4 0 .7"));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].area_m2, 1.28, 1e-9);
  EXPECT_EQ(found[1].name, "big");
}

/// A square of 1 m at a height of 0.6 m, and over it a smaller one at 0.7 m.
LevelSurface top_of_step(const std::string& half) {
  const std::string mesh = "<mesh name='step' vertex='-.5 -.5 0  .5 -.5 0  .5 .5 0  -.5 .5 0  -" +
                           half + " -" + half + " .1  " + half + " -" + half + " .1  " + half +
                           " " + half + " .1  -" + half + " " + half +
                           " .1' face='0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 "
                           "6 3 0 4 3 4 7'/>";
  const auto found = tops_of("<geom type='mesh' mesh='step' pos='0 0 .6'/>", mesh);
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? LevelSurface{} : found.front();
}

TEST(LevelSurfaceLimits, AHigherFaceCountsFromHalfTheAreaOfTheLargest) {
  EXPECT_NEAR(top_of_step(".4").height_m, 0.7, 1e-5);
  EXPECT_NEAR(top_of_step(".4").area_m2, 0.64, 1e-5);
  EXPECT_NEAR(top_of_step(".3").height_m, 0.6, 1e-5);
  EXPECT_NEAR(top_of_step(".3").area_m2, 1.0, 1e-5);
}

TEST(LevelSurfaceLimits, APlaneIsAsLargeAsItIsDrawn) {
  const auto found =
      tops_of("<body name='desk' pos='1 2 .7'><geom type='plane' size='.5 .3 .1'/></body>");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "desk");
  EXPECT_NEAR(found[0].area_m2, 0.6, 1e-9);
  EXPECT_LT((found[0].extent_m.min() - Eigen::Vector2d(0.5, 1.7)).norm(), 1e-9);
  EXPECT_LT((found[0].extent_m.max() - Eigen::Vector2d(1.5, 2.3)).norm(), 1e-9);
}

TEST(NearestToLevelLimits, HeightsAndAreas) {
  const auto low = nearest_of(board(".6 .4", "0 0 .1"));
  ASSERT_TRUE(low);
  EXPECT_NEAR(low->height_m, 0.12, 1e-9);
  EXPECT_FALSE(nearest_of(board(".6 .4", "0 0 .06")));
  const auto high = nearest_of(board(".6 .4", "0 0 1.88"));
  ASSERT_TRUE(high);
  EXPECT_NEAR(high->height_m, 1.9, 1e-9);
  EXPECT_FALSE(nearest_of(board(".6 .4", "0 0 2.18")));
  const auto small = nearest_of(board(".06 .06", "0 0 .7"));
  ASSERT_TRUE(small);
  EXPECT_NEAR(small->area_m2, 0.0144, 1e-9);
  EXPECT_FALSE(nearest_of(board(".045 .045", "0 0 .7")));
}

TEST(NearestToLevelLimits, Tilt) {
  const auto steep = nearest_of(board(".6 .5", "0 0 .7", "euler='0 25 0'"));
  ASSERT_TRUE(steep);
  const double tilt_rad = 25.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(steep->tilt_rad, tilt_rad, 1e-9);
  EXPECT_NEAR(steep->height_m, 0.7 + 0.02 * std::cos(tilt_rad), 1e-9);
  EXPECT_NEAR(steep->area_m2, 1.2, 1e-9);
  EXPECT_FALSE(nearest_of(board(".6 .5", "0 0 .7", "euler='0 32 0'")));
}

TEST(NearestToLevelLimits, TheLargestLeaningOneInWhateverOrder) {
  const std::string large = board(".6 .6", "0 0 .7", "name='large' euler='0 8 0'");
  const std::string small = board(".5 .5", "5 0 .7", "name='small' euler='0 9 0'");
  for (const std::string& both : {large + small, small + large}) {
    const auto nearest = nearest_of(both);
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->name, "large");
  }
}

/// A square of 1 m, and 10 cm over it a smaller one, that lean together.
TEST(NearestToLevelLimits, OfALeaningThingTheLargestSideCounts) {
  const auto scene = things(
      "<geom type='mesh' mesh='step' pos='0 0 .6' euler='0 8 0'/>",
      "<mesh name='step' vertex='-.5 -.5 0  .5 -.5 0  .5 .5 0  -.5 .5 0  -.4 -.4 .1  .4 -.4 .1  "
      ".4 .4 .1  -.4 .4 .1' face='0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 "
      "4 3 4 7'/>");
  const auto nearest = nearest_to_level(*scene.model, *scene.data);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->area_m2, 1.0, 1e-5);
  EXPECT_NEAR(nearest->height_m, 0.6, 1e-5);
  EXPECT_NEAR(nearest->tilt_rad, 8.0 * std::numbers::pi / 180.0, 1e-4);
}

TEST(LevelSurfaceLimits, ARoundTopHasCornersEvery10Centimetres) {
  const auto found = tops_of("<geom type='cylinder' size='.5 .02' pos='0 0 .7'/>");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].area_m2, 4.0 * std::sin(2.0 * std::numbers::pi / 32.0), 1e-9);
}

/// A sheet of 1 m that leans by 8 degrees, folded along its middle by twice that angle.
double side_of_fold_m2(double half_angle_rad) {
  const double low = -0.5 * std::tan(half_angle_rad);
  std::string vertices;
  for (const double z : {0.0, -0.04}) {
    for (const auto& [x, y] :
         {std::pair(-.5, -.5), {0., -.5}, {.5, -.5}, {-.5, .5}, {0., .5}, {.5, .5}}) {
      vertices += fmt::format("{} {} {:.9f}  ", x, y, x == 0.0 ? z : z + low);
    }
  }
  const auto scene = things(
      "<geom type='mesh' mesh='fold' pos='0 0 .7' euler='0 8 0'/>",
      "<mesh name='fold' vertex='" + vertices +
          "' face='0 1 4 0 4 3 1 2 5 1 5 4 6 10 7 6 9 10 7 11 8 7 10 11 0 6 7 0 7 1 1 7 8 1 8 2 "
          "3 10 9 3 4 10 4 11 10 4 5 11 0 3 9 0 9 6 2 8 11 2 11 5'/>");
  const auto nearest = nearest_to_level(*scene.model, *scene.data);
  EXPECT_TRUE(nearest);
  return nearest ? nearest->area_m2 : 0.0;
}

TEST(NearestToLevelLimits, ASideEndsWhereItTurnsByAHundredthOfARadian) {
  EXPECT_NEAR(side_of_fold_m2(0.0045), 1.0, 1e-3);
  EXPECT_NEAR(side_of_fold_m2(0.0055), 0.5, 1e-3);
  EXPECT_NEAR(side_of_fold_m2(0.0), 1.0, 1e-3);
}

TEST(NearestToLevelLimits, OfLeaningThingsAreThoseOfLevelOnes) {
  const auto found = [](const std::string& half, const std::string& z_m) {
    return nearest_of(board(half, "0 0 " + z_m, "euler='0 8 0'")).has_value();
  };
  EXPECT_TRUE(found(".6 .4", ".085")) << "its upper side is 2 cm higher";
  EXPECT_FALSE(found(".6 .4", ".075"));
  EXPECT_TRUE(found(".6 .4", "1.975"));
  EXPECT_FALSE(found(".6 .4", "1.985"));
  EXPECT_TRUE(found(".051 .051", ".7")) << "104 cm2";
  EXPECT_FALSE(found(".049 .049", ".7"));
}

TEST(NearestToLevelLimits, ALevelOneThatIsLargerThanALeaningOneWins) {
  const auto nearest = nearest_of(board(".5 .5", "5 0 .7", "name='leans' euler='0 9 0'") +
                                  board(".6 .6", "0 0 .2", "name='low'"));
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->name, "low");
}

TEST(LevelSurfaceLimits, HoldTheirEnds) {
  LevelSurfaceOptions options;
  options.min_height_m = options.max_height_m = 0.5;
  options.min_area_m2 = 1.0;
  const auto scene = things("<geom type='box' size='.5 .5 .125' pos='0 0 .375'/>");
  EXPECT_EQ(level_surfaces(*scene.model, *scene.data, options).size(), 1U);
}

TEST(LevelSurfaceLimits, BoardsAStepApartAreTwoAndBoardsAGapApartAreOne) {
  LevelSurfaceOptions options;
  options.height_step_m = 0.125;
  options.gap_m = 0.25;
  const auto count = [&](const char* z_m) {
    const auto scene = things(std::string("<geom type='box' size='.5 .5 .125' pos='0 0 .375'/>"
                                          "<geom type='box' size='.5 .5 .125' pos='1.25 0 ") +
                              z_m + "'/>");
    return level_surfaces(*scene.model, *scene.data, options).size();
  };
  EXPECT_EQ(count(".5"), 2U);
  EXPECT_EQ(count(".375"), 1U);
}

TEST(LevelSurfaceLimits, OfEquallyLargeOnesTheFirstIsFirst) {
  const auto found = tops_of(
      "<geom name='one' type='box' size='.5 .25 .125' pos='0 0 .5'/>"
      "<geom name='two' type='box' size='.5 .25 .125' pos='4 0 .5'/>");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "one");
}

TEST(NearestToLevelLimits, OfEquallyLargeOnesItIsTheFirst) {
  const auto nearest = nearest_of(board(".5 .5", "0 0 .7", "name='one' euler='0 9 0'") +
                                  board(".5 .5", "0 0 .7", "name='two' euler='0 9 0'"));
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->name, "one");
}

TEST(NearestToLevelLimits, APlaneMayLookDown) {
  const auto nearest = nearest_of(
      "<body name='lid' pos='0 0 .7' euler='0 172 0'>"
      "<geom size='.05' pos='0 0 9' contype='0' conaffinity='0'/>"
      "<geom type='plane' size='.5 .3 .1' contype='0' conaffinity='0'/></body>");
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->name, "lid");
  EXPECT_NEAR(nearest->area_m2, 0.6, 1e-9);
  EXPECT_NEAR(nearest->height_m, 0.7, 1e-9);
  EXPECT_NEAR(nearest->tilt_rad, 8.0 * std::numbers::pi / 180.0, 1e-9);
}

}  // namespace
}  // namespace vantage
