#include "vantage/view/input.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "vantage/view/orbit_camera.hpp"
#include "vantage/view/painter.hpp"
#include "vantage/view/view.hpp"

namespace vantage {
namespace {

class ViewInputTest : public testing::Test {
 protected:
  ViewInputTest() {
    controls.size = {900, 600};
    controls.overview = controls.follow = follow_of_robot();
    gate.pause();  // so that a wait returns at once or not at all
  }
  void type(const std::string& text) {
    for (const char key : text) input(KeyPressed{key});
  }
  /// Where playing goes on, if it was told to go elsewhere.
  std::optional<double> seek() { return gate.take_seek(); }

  ViewControls controls;
  PlaybackGate gate{1.0};
  ViewInput input{.controls = controls, .gate = gate, .shown_s = 8.0, .tick_s = 0.025};
};

TEST_F(ViewInputTest, IsOfATickOf25MillisecondsAndNothingPressedAtFirst) {
  const ViewInput fresh{.controls = controls, .gate = gate};
  EXPECT_EQ(fresh.tick_s, 0.025);
  EXPECT_EQ(fresh.shown_s, 0.0);
  EXPECT_FALSE(fresh.scrubbing || fresh.quit || fresh.screenshot);
  const ViewControls none;
  EXPECT_EQ(none.size, (PixelSize{1280, 720}));
  EXPECT_EQ(none.camera, ViewCamera::overview);
  EXPECT_FALSE(none.map || none.gains || none.help || none.duration_s);
  EXPECT_FALSE(ViewMoment{}.still || ViewFrame{}.still || ViewCaptions{}.help);
}

TEST_F(ViewInputTest, KeysToggle) {
  type("mgh");
  EXPECT_TRUE(controls.map && controls.gains && controls.help);
  type("MGH");
  EXPECT_FALSE(controls.map || controls.gains || controls.help);
  type("s");
  EXPECT_TRUE(input.screenshot);
  EXPECT_FALSE(input.quit);
  type("q");
  EXPECT_TRUE(input.quit);
}

TEST_F(ViewInputTest, CamerasInTurn) {
  for (const ViewCamera expected : {ViewCamera::follow, ViewCamera::robot, ViewCamera::overview}) {
    type("c");
    EXPECT_EQ(controls.camera, expected);
  }
}

TEST_F(ViewInputTest, PauseStepAndPace) {
  type(" ");
  EXPECT_FALSE(gate.paused());
  type(".");
  EXPECT_TRUE(gate.paused());
  EXPECT_TRUE(gate.wait(0.025)) << "the one step";
  type("+++");
  EXPECT_EQ(gate.speed(), 8.0);
  type("----");
  EXPECT_EQ(gate.speed(), 0.5);
  type(std::string(40, '+'));
  EXPECT_EQ(gate.speed(), 64.0);
}

TEST_F(ViewInputTest, OnlyARecordingGoesBack) {
  type("r,");
  input(MousePressed{MouseButton::left, {450.0, 599.0}});
  EXPECT_FALSE(seek());
  controls.duration_s = 20.0;
  type("r");
  EXPECT_EQ(seek(), 0.0);
  type(",");
  EXPECT_EQ(seek(), 8.0 - 0.025);
  input(KeyPressed{keys::page_up});
  EXPECT_EQ(seek(), 3.0);
  input(KeyPressed{keys::page_down});
  EXPECT_EQ(seek(), 13.0);
  input(KeyPressed{keys::end});
  EXPECT_GT(seek(), 20.0);
}

TEST_F(ViewInputTest, TheTimelineIsDragged) {
  controls.duration_s = 20.0;
  const double before_rad = controls.overview.azimuth_rad;
  input(MousePressed{MouseButton::left, {0.0, 599.0}});
  EXPECT_EQ(seek(), 0.0);
  input(MouseDragged{MouseButton::left, {449.5, 300.0}, {449.5, -299.0}});
  EXPECT_NEAR(*seek(), 10.0, 0.02);
  input(MouseDragged{MouseButton::left, {5000.0, 300.0}, {1.0, 0.0}});
  EXPECT_GT(seek(), 20.0) << "the end, with what followed the last tick";
  EXPECT_EQ(controls.overview.azimuth_rad, before_rad);
  input(MousePressed{MouseButton::left, {450.0, 300.0}});
  input(MouseDragged{MouseButton::left, {460.0, 300.0}, {10.0, 0.0}});
  EXPECT_FALSE(seek());
  EXPECT_NE(controls.overview.azimuth_rad, before_rad);
}

TEST_F(ViewInputTest, TheMouseMovesTheCameraInUse) {
  const FreeCamera before = controls.overview;
  input(MouseDragged{MouseButton::left, {0, 0}, {60.0, 0.0}});
  EXPECT_NE(controls.overview.azimuth_rad, before.azimuth_rad);
  EXPECT_EQ(controls.overview.lookat_m, before.lookat_m);
  input(MouseDragged{MouseButton::right, {0, 0}, {60.0, 0.0}});
  EXPECT_NE(controls.overview.lookat_m, before.lookat_m);
  input(WheelTurned{1.0});
  EXPECT_LT(controls.overview.distance_m, before.distance_m);
  EXPECT_EQ(controls.follow.azimuth_rad, before.azimuth_rad);
  type("c");
  input(WheelTurned{1.0});
  EXPECT_LT(controls.follow.distance_m, before.distance_m);
  type("c");
  const FreeCamera follow = controls.follow;
  input(WheelTurned{1.0});  // the robot's own camera is where it is
  input(MouseDragged{MouseButton::left, {0, 0}, {60.0, 0.0}});
  EXPECT_EQ(controls.follow.distance_m, follow.distance_m);
  EXPECT_EQ(controls.follow.azimuth_rad, follow.azimuth_rad);
}

TEST_F(ViewInputTest, ArrowsAreThePaceAndTheSteps) {
  input(KeyPressed{keys::up});
  EXPECT_EQ(gate.speed(), 2.0);
  type("=");
  EXPECT_EQ(gate.speed(), 4.0);
  input(KeyPressed{keys::down});
  EXPECT_EQ(gate.speed(), 2.0);
  type(std::string(40, '-'));
  EXPECT_EQ(gate.speed(), 0.0625);
  gate.toggle_pause();
  input(KeyPressed{keys::right});
  EXPECT_TRUE(gate.paused());
  EXPECT_TRUE(gate.wait(0.025)) << "the one step";
  input(KeyPressed{keys::escape});
  EXPECT_TRUE(input.quit);
}

TEST_F(ViewInputTest, ATickBackPauses) {
  controls.duration_s = 20.0;
  gate.toggle_pause();
  ASSERT_FALSE(gate.paused());
  input(KeyPressed{keys::left});
  EXPECT_TRUE(gate.paused());
  EXPECT_EQ(seek(), 8.0 - 0.025);
  input(KeyPressed{keys::home});
  EXPECT_EQ(seek(), 0.0);
}

/// Of 900 x 600 px the timeline is the lowest 13.3 px; its ends are the first and the last column.
TEST_F(ViewInputTest, TheTimelineIsAtTheFootOfTheImage) {
  controls.duration_s = 20.0;
  input(MousePressed{MouseButton::left, {899.0, 586.0}});
  EXPECT_FALSE(seek());
  input(MousePressed{MouseButton::right, {899.0, 599.0}});
  EXPECT_FALSE(seek());
  input(MousePressed{MouseButton::left, {899.0, 587.0}});
  EXPECT_EQ(seek(), 20.0 + 0.025);
  input(MousePressed{MouseButton::left, {0.25 * 899.0, 599.0}});
  EXPECT_NEAR(*seek(), 0.25 * 20.025, 1e-9);
  input(MouseDragged{MouseButton::left, {-50.0, 10.0}, {1.0, 0.0}});
  EXPECT_EQ(seek(), 0.0);
}

/// A height of the image is half a turn, whatever its width.
TEST_F(ViewInputTest, DragsAreInHeightsOfTheImage) {
  const FreeCamera before = controls.overview;
  input(MouseDragged{MouseButton::left, {0, 0}, {60.0, 30.0}});
  EXPECT_NEAR(controls.overview.azimuth_rad, before.azimuth_rad - 0.1 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(controls.overview.elevation_rad, before.elevation_rad - 0.05 * std::numbers::pi,
              1e-9);
  input(WheelTurned{1.0});
  EXPECT_NEAR(controls.overview.distance_m, 0.9 * before.distance_m, 1e-9);
}

TEST_F(ViewInputTest, TheRightButtonPansTheCameraInUse) {
  const FreeCamera before = controls.overview;
  input(MouseDragged{MouseButton::right, {0, 0}, {60.0, 30.0}});
  const FreeCamera expected = panned(before, {0.1, 0.05});
  EXPECT_LT((controls.overview.lookat_m - expected.lookat_m).norm(), 1e-12);
  EXPECT_EQ(controls.overview.azimuth_rad, before.azimuth_rad);
  EXPECT_EQ(controls.follow.lookat_m, before.lookat_m);
  controls.camera = ViewCamera::follow;
  input(MouseDragged{MouseButton::middle, {0, 0}, {60.0, 30.0}});
  EXPECT_LT((controls.follow.lookat_m - expected.lookat_m).norm(), 1e-12);
}

TEST_F(ViewInputTest, TheTimelineEndsWhereItIsSeenToEnd) {
  controls.duration_s = 20.0;
  input(MousePressed{MouseButton::left, {0.0, 599.0}});
  EXPECT_EQ(seek(), 0.0);
  input(MouseDragged{MouseButton::left, {5000.0, 300.0}, {1.0, 0.0}});
  EXPECT_EQ(seek(), 20.0 + 0.025) << "no farther than its right end";
  controls.size = {900, 720};
  input(MousePressed{MouseButton::left, {899.0, 703.0}});
  EXPECT_FALSE(seek());
  input(MousePressed{MouseButton::left, {899.0, 704.0}});
  EXPECT_EQ(seek(), 20.0 + 0.025) << "its upper edge";
}

TEST(ViewOptions, ShowAnEpisodeWithNothingLaidOverIt) {
  const ViewOptions options;
  EXPECT_EQ(options.size, (PixelSize{1280, 720}));
  EXPECT_EQ(options.camera, ViewCamera::overview);
  EXPECT_FALSE(options.map || options.gains || options.at_s);
  EXPECT_EQ(ViewMoment{}.events, 0U);
  EXPECT_EQ(ViewFrame{}.time_s, 0.0);
}

}  // namespace
}  // namespace vantage
