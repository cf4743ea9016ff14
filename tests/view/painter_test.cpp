// From where people look at a scene and at the robot in it.
#include "vantage/view/painter.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/runtime/drawing/map_view.hpp"
#include "vantage/runtime/drawing/tour_drawing.hpp"
#include "vantage/sim/robots/robot_names.hpp"

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

/// A ball that is the robot, with an eye, over a floor; after 0.1 s and a first scan.
class PaintedView : public testing::Test {
 protected:
  PaintedView() {
    for (int tick = 0; tick < 4; ++tick) world_.advance_tick();
    scene_.method = "greedy";
    scene_.content.map = make_grid_frame({1.0, 2.0, 0.5}, {3.0, 2.0, 1.0}, {3, 2, 1});
    scene_.content.scans = 3;
    scene_.content.step_word = "look";
    scene_.content.gain_unit = "cells";
    work_.moment = {world_.state(), 1, true};
    work_.new_events = {EpisodeEvent{0, MapChange{{{2, 1, CellState::occupied}}}}};
    work_.controls.size = {160, 120};
    work_.controls.overview = overview_of(world_, scene_.content);
    work_.controls.follow = follow_of_robot();
    captions_.scene = "greedy    0.10 s    look 1 of 3";
    captions_.gain_unit = "cells";
  }
  static std::filesystem::path file_in(const support::TemporaryDirectory& folder) {
    write_file(folder / "scene.xml",
               "<mujoco><worldbody><geom type='plane' size='5 5 .1' rgba='.3 .5 .7 1'/>"
               // Ahead of the eye, for people alone.
               "<geom type='box' size='.15 .15 .1' pos='1.9 2 .1' group='5' contype='0' "
               "conaffinity='0' rgba='.1 .9 .3 1'/>"
               "<light pos='0 0 4'/><body name='robot/base' pos='1 2 .5'><freejoint/>"
               "<geom size='.1' rgba='.9 .2 .1 1'/>"
               "<camera name='robot/eye' pos='0 0 .3' xyaxes='0 -1 0 .4 0 .9'/></body>"
               "</worldbody></mujoco>");
    return folder / "scene.xml";
  }
  Eigen::Vector3d p_robot_m() const {
    return body_pose(world_, robot_base(world_.model())).translation();
  }
  ViewFrame painted() {
    ViewPainter painter(world_, scene_);
    return painter.paint(work_);
  }
  /// The same image from its parts, with map and views where something is `known`.
  cv::Mat drawn(const CameraView& camera, bool for_people, const EventReplay* known = nullptr) {
    RenderRequest request;
    request.shadows = true;
    request.for_people = for_people;
    request.depth_and_segmentation = known != nullptr;
    RenderedImages image;
    make_offscreen_renderer(world_.model(), 160, 120)
        ->render(world_.model(), world_.snapshot(), camera, request, image);
    MapCanvas canvas = make_canvas({160, 120});
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const auto i = static_cast<std::size_t>(160 * y + x);
        canvas.bgr.at<cv::Vec3b>(y, x) =
            cv::Vec3b(image.rgb[3 * i + 2], image.rgb[3 * i + 1], image.rgb[3 * i]);
        if (known == nullptr || image.depth_m[i] <= 0.0F) continue;
        canvas.inverse_depth.at<float>(y, x) = 1.0F / image.depth_m[i];
      }
    }
    if (known != nullptr) {
      const MapCamera map_camera{image.T_world_camera.inverse(), image.focal_px, {79.5, 59.5}};
      lay_map(canvas, map_camera, known->grid());
      lay_views(canvas, map_camera, *known);
    }
    lay_captions(canvas.bgr, captions_);
    return canvas.bgr;
  }
  /// Values of colour that are not the same.
  static int unlike(const ViewFrame& frame, const cv::Mat& bgr) {
    if (frame.image.rgb.size() != 3U * 160U * 120U) return -1;
    int count = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        for (int c = 0; c < 3; ++c) {
          const int value = frame.image.rgb[static_cast<std::size_t>(3 * (160 * y + x) + c)];
          count += value == bgr.at<cv::Vec3b>(y, x)[2 - c] ? 0 : 1;
        }
      }
    }
    return count;
  }

  support::TemporaryDirectory folder_;
  World world_{ModelSource{file_in(folder_), {}}};
  ViewScene scene_;
  ViewLink::Work work_;
  ViewCaptions captions_;
};

TEST_F(PaintedView, IsTheWorldUnderItsCaptions) {
  work_.controls.playback = captions_.playback = "live    1 x";
  const ViewFrame frame = painted();
  EXPECT_TRUE(frame.still);
  EXPECT_NEAR(frame.time_s, 0.1, 1e-9);
  EXPECT_TRUE(frame.image.depth_m.empty() && frame.image.segmentation.empty());
  EXPECT_EQ(unlike(frame, drawn(work_.controls.overview, true)), 0);
  work_.moment.still = false;
  work_.controls.help = captions_.help = true;
  EXPECT_FALSE(painted().still);
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true)), 0);
}

TEST_F(PaintedView, OfARecordingHasItsTimeline) {
  work_.controls.duration_s = 0.4;
  captions_.progress = world_.time_s() / 0.4;
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true)), 0);
  work_.controls.duration_s = 0.0;
  captions_.progress = 1.0;
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true)), 0) << "of a single state";
  scene_.content.scans = 0;
  captions_.scene = "greedy    0.10 s";
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true)), 0) << "it does not scan";
}

TEST_F(PaintedView, FollowsTheRobotOnTheFloorOrInTheAir) {
  work_.controls.camera = ViewCamera::follow;
  FreeCamera camera = work_.controls.follow;
  ASSERT_LT(p_robot_m().z(), 0.49) << "it falls";
  camera.lookat_m = {p_robot_m().x(), p_robot_m().y(), 0.7};
  EXPECT_EQ(unlike(painted(), drawn(camera, true)), 0);
  scene_.content.follows_height = true;
  camera.lookat_m.z() += p_robot_m().z() - 0.7;
  EXPECT_EQ(unlike(painted(), drawn(camera, true)), 0);
  work_.controls.camera = ViewCamera::robot;
  const int eye = robot_camera(world_.model()).value();
  EXPECT_EQ(unlike(painted(), drawn(FixedCamera{.camera_id = eye}, false)), 0) << "as it sees";
}

TEST_F(PaintedView, HasMapAndGainsOfWhatIsKnown) {
  Decision decision;
  decision.candidates.resize(2);
  decision.candidates[0].T_world_sensor = make_pose({1.2, 2.0, 0.6}, 0.4);
  decision.candidates[0].gain_bits = 30.0;
  decision.candidates[1].T_world_sensor = make_pose({0.4, 1.5, 0.6}, 1.4);
  decision.candidates[1].gain_bits = 20.0;
  work_.new_events.push_back({2, decision});
  PlannedTour tour;
  for (const double x_m : {1.4, 1.9}) tour.stops.push_back({.place_m = {x_m, 2.5}});
  work_.new_events.push_back({2, tour});
  work_.moment.events = 3;
  work_.controls.map = work_.controls.gains = true;
  EventReplay known(*scene_.content.map);
  known.go_to(work_.new_events, 3);
  captions_.decision = decision;
  captions_.plan = plan_text(tour);
  ASSERT_FALSE(captions_.plan.empty());
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true, &known)), 0);
  work_.moment.events = 1;  // before the decision
  captions_.decision.reset();
  captions_.plan.clear();
  known.go_to(work_.new_events, 1);
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true, &known)), 0);
}

TEST(Overview, LooksUpWhereTheScenesOwnCameraDoes) {
  const FreeCamera camera =
      overview("<camera name='overview' pos='0 -9 1' xyaxes='1 0 0 0 -.8 .6'/>");
  EXPECT_NEAR(camera.elevation_rad, std::asin(0.8), 1e-9);
}

TEST_F(PaintedView, IsTheSameForTheSameMomentWhateverWasPaintedBefore) {
  ViewPainter painter(world_, scene_);
  const ViewFrame first = painter.paint(work_);
  work_.new_events.clear();
  const auto earlier = work_.moment.state;
  for (int tick = 0; tick < 4; ++tick) world_.advance_tick();
  work_.moment.state = world_.state();
  EXPECT_NE(painter.paint(work_).image.rgb, first.image.rgb);
  work_.moment.state = earlier;
  EXPECT_EQ(painter.paint(work_).image.rgb, first.image.rgb);
  work_.controls.size = {80, 60};
  const ViewFrame small = painter.paint(work_);
  EXPECT_EQ(small.image.width_px, 80);
  EXPECT_EQ(small.image.rgb.size(), 3U * 80U * 60U);
}

TEST_F(PaintedView, HasTheMapOrTheGainsAlone) {
  EventReplay known(*scene_.content.map);
  known.go_to(work_.new_events, 1);
  const cv::Mat plain = drawn(work_.controls.overview, true);
  work_.controls.map = true;
  const ViewFrame with_map = painted();
  EXPECT_EQ(unlike(with_map, drawn(work_.controls.overview, true, &known)), 0);
  EXPECT_GT(unlike(with_map, plain), 0);
  work_.controls.map = false;
  work_.controls.gains = true;
  EXPECT_EQ(unlike(painted(), plain), 0) << "nothing is decided yet";
}

TEST_F(PaintedView, OfOneScanSaysSo) {
  scene_.content.scans = 1;
  captions_.scene = "greedy    0.10 s    look 1 of 1";
  EXPECT_EQ(unlike(painted(), drawn(work_.controls.overview, true)), 0);
}

TEST_F(PaintedView, OfARecordingThatIsItsBeginningAloneIsAtItsEnd) {
  work_.moment.state[0] = 0.0;
  work_.controls.duration_s = 0.0;
  const ViewFrame frame = painted();
  EXPECT_EQ(frame.time_s, 0.0);
  captions_.scene = "greedy    0.00 s    look 1 of 3";
  captions_.progress = 1.0;
  EXPECT_EQ(unlike(frame, drawn(work_.controls.overview, true)), 0);
}

}  // namespace
}  // namespace vantage
