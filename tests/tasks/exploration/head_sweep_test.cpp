// Which sweeps of the head leave no gaps, and what is said of where an exploration starts.
#include "vantage/tasks/exploration/head_sweep.hpp"

#include <gtest/gtest.h>

#include "vantage/tasks/exploration/start_check.hpp"
#include "vantage/tasks/exploration/visited_places.hpp"

namespace vantage {
namespace {

RgbdOptions wide_camera() {
  RgbdOptions camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fovy_rad = 0.9;
  camera.range_max_m = 4.0;
  return camera;
}

FieldOfView swept(int pans, const std::vector<double>& tilts_rad) {
  return swept_field({.pans = pans, .tilts_rad = tilts_rad}, wide_camera(), 0.25);
}

/// Up to the middle of the upper edge of the upper row and the lower edge of the lower one, as far
/// as it is seen at the sides too: atan(tan(-0.35) cos 20 deg) and atan(tan 1.05 cos 20 deg).
TEST(SweptField, EndsWhereEveryPanSees) {
  const FieldOfView field = swept(9, {0.1, 0.6});
  EXPECT_NEAR(field.tilt_min_rad, -0.3304382275978708, 1e-9);
  EXPECT_NEAR(field.tilt_max_rad, 1.022740557673841, 1e-9);
  EXPECT_EQ(field.range_min_m, 0.0);
  EXPECT_EQ(field.range_max_m, 4.25);
  EXPECT_TRUE(field.panorama);
}

/// The upper row ends at atan(tan 0.55 cos 20 deg) = 0.5227 at its sides.
TEST(SweptField, HasNoGapBetweenRows) {
  EXPECT_NO_THROW(swept(9, {0.1, 0.97}));
  EXPECT_THROW(swept(9, {0.1, 0.975}), ConfigError);
}

/// An image that looks down is narrowest at its upper edge: 0.53 rad to either side.
TEST(SweptField, HasNoGapBetweenPans) {
  EXPECT_NO_THROW(swept(6, {0.1, 0.6}));
  EXPECT_THROW(swept(5, {0.1, 0.6}), ConfigError);
}

TEST(SweptField, ReachesNotPastTheVertical) {
  EXPECT_NO_THROW(swept(9, {1.04}));
  EXPECT_THROW(swept(9, {1.06}), ConfigError);
}

TEST(HeadSweepRows, Ascend) {
  EXPECT_NO_THROW((HeadSweep{.tilts_rad = {0.1, 0.2}}.check()));
  EXPECT_THROW((HeadSweep{.tilts_rad = {0.1, 0.1}}.check()), ConfigError);
  EXPECT_THROW((HeadSweep{.tilts_rad = {0.2, 0.1}}.check()), ConfigError);
  EXPECT_THROW((HeadSweep{.tilts_rad = {}}.check()), ConfigError);
}

TEST(VisitedPlaces, CoverTheirDiscsWhereverTheyAreMoved) {
  VisitedPlaces visited;
  EXPECT_FALSE(visited.covers({1.0, 2.0}));
  visited.add({1.0, 2.0}, 0.5);
  visited.add({7.0, 2.0}, 0.25);
  EXPECT_EQ(visited.size(), 2U);
  EXPECT_TRUE(visited.covers({1.0, 2.49}));
  EXPECT_FALSE(visited.covers({1.5, 2.0})) << "at its edge";
  EXPECT_TRUE(visited.covers({7.2, 2.0}));
  EXPECT_FALSE(visited.covers({7.3, 2.0}));
  visited.move(0, {3.0, 2.0});
  EXPECT_EQ(visited.place(0), Eigen::Vector2d(3.0, 2.0));
  EXPECT_FALSE(visited.covers({1.0, 2.0}));
  EXPECT_TRUE(visited.covers({3.25, 2.25}));
}

TEST(VisitedPlaces, WhereSomethingWasMissedMayBeGoneToOnceMore) {
  VisitedPlaces visited;
  visited.add({1.1, 2.0}, 0.5);  // chosen, and scanned from nearby
  visited.add({1.0, 2.0}, 0.5, true);
  visited.add({3.0, 2.0}, 0.5);
  EXPECT_TRUE(visited.covers({1.0, 2.0}));
  EXPECT_TRUE(visited.reopen());
  EXPECT_FALSE(visited.covers({1.0, 2.0}));
  EXPECT_TRUE(visited.covers({3.0, 2.0})) << "nothing was missed there";
  EXPECT_FALSE(visited.reopen()) << "it is open";
  visited.add({1.2, 2.0}, 0.5, true);
  EXPECT_TRUE(visited.covers({1.0, 2.0}));
  EXPECT_FALSE(visited.reopen()) << "once";
}

TEST(VisitedPlaces, TheVeryFirstMayBeGoneToOnceMoreToo) {
  VisitedPlaces visited;
  EXPECT_FALSE(visited.reopen());
  visited.add({1.0, 2.0}, 0.5, true);
  EXPECT_TRUE(visited.reopen());
  EXPECT_FALSE(visited.covers({1.0, 2.0}));
}

TEST(StartText, NamesTheSiteOrThePose) {
  RobotOptions robot;
  robot.start_pose = {1.5, 2.25, -0.5};
  EXPECT_EQ(start_text(robot), "robot.start_pose 1.5, 2.25, -0.5");
  robot.start_site = "door";
  EXPECT_EQ(start_text(robot), "robot.start_site 'door'");
}

TEST(FloorMapNote, NamesTheFarthestSideOfTheMap) {
  Exploration task;
  task.floor_map.half_size_m = 6.0;
  task.map.cells = {64, 64, 8};
  const auto note = [&](double x_m, double y_m, double x_size_m, double y_size_m) {
    task.map.centre_m = {x_m, y_m, 1.0};
    task.map.size_m = {x_size_m, y_size_m, 2.0};
    return floor_map_note(task);
  };
  EXPECT_EQ(note(0.0, 0.0, 12.0, 12.0), "") << "as far as the floor map";
  for (const double side : {-1.0, 1.0}) {
    for (const std::string& told : {note(side, -2.0, 10.4, 6.0), note(-2.0, side, 6.0, 10.4)}) {
      EXPECT_NE(told.find("6.20 m"), std::string::npos) << told;
      EXPECT_NE(told.find("6.5 would do"), std::string::npos) << told;
    }
  }
}

/// The rows of EndsWhereEveryPanSees, looking up as much as those look down.
TEST(SweptField, IsUpsideDownIfItsImagesAre) {
  const FieldOfView field = swept(9, {-0.6, -0.1});
  EXPECT_NEAR(field.tilt_min_rad, -1.022740557673841, 1e-9);
  EXPECT_NEAR(field.tilt_max_rad, 0.3304382275978708, 1e-9);
  EXPECT_NO_THROW(swept(6, {-0.6, -0.1}));
  EXPECT_THROW(swept(5, {-0.6, -0.1}), ConfigError) << "narrowest at its lower edge";
  EXPECT_NO_THROW(swept(9, {-1.04}));
  EXPECT_THROW(swept(9, {-1.06}), ConfigError) << "past the vertical";
}

}  // namespace
}  // namespace vantage
