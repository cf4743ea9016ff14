// Pixels of what is laid over an image, where they can be reckoned by hand.
#include "vantage/view/overlays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "vantage/runtime/drawing/tour_drawing.hpp"

namespace vantage {
namespace {

constexpr int kLeft = 100;    // column of x = 0
constexpr int kMiddle = 360;  // row of z = 0

/// From so far off along y that there is no perspective, z upright: 500 pixels are 1 m.
MapCamera far_camera() {
  MapCamera camera;
  camera.T_camera_world.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.T_camera_world.translation() = Eigen::Vector3d(0.0, 0.0, 1000.0);
  camera.focal_px = 5e5;
  camera.centre_px = Eigen::Vector2d(kLeft, kMiddle);
  return camera;
}

/// A view at x = 0 that looks along x, turned by 45 deg about that: its upper edge rises by
/// 0.25 sqrt(2) of its length.
Candidate view_at(double z_m, double gain_bits, bool reachable = true) {
  Candidate view;
  view.T_world_sensor = Eigen::Translation3d(0.0, 0.0, z_m) *
                        Eigen::AngleAxisd(std::atan(1.0), Eigen::Vector3d::UnitX());
  view.gain_bits = gain_bits;
  view.reachable = reachable;
  return view;
}

/// What is known after one scan and these.
EventReplay known_after(std::vector<EpisodeEvent> events, double x_m = 3.0, double y_m = 2.0) {
  EventReplay known(make_grid_frame({0.0, 0.0, 0.0}, {x_m, y_m, 1.0}, {3, 2, 1}));
  events.insert(events.begin(), EpisodeEvent{0, MapChange{}});
  known.go_to(events, events.size());
  return known;
}

MapCanvas laid(const EventReplay& known, float scene_inverse_depth = 0.0F) {
  MapCanvas canvas = make_canvas({500, 720});
  canvas.inverse_depth.setTo(cv::Scalar(scene_inverse_depth));
  lay_views(canvas, far_camera(), known);
  return canvas;
}

/// On the upper edge of the view at `z_m`, so many columns from its tip, or beside that.
cv::Vec3b on_edge(const MapCanvas& canvas, double z_m, int along, int beside = 0) {
  const double row = kMiddle - 500.0 * z_m - 0.25 * std::sqrt(2.0) * along + beside;
  return canvas.bgr.at<cv::Vec3b>(static_cast<int>(std::lround(row)), kLeft + along);
}

void expect_near(const cv::Vec3b& pixel, const cv::Scalar& bgr) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], bgr[c], 1.0) << "channel " << c;
}

const cv::Vec3b kBlack(0, 0, 0);

/// The first column of the image with something in it, and the last.
std::pair<int, int> filled_columns(const cv::Mat& image) {
  std::pair<int, int> columns(-1, -1);
  for (int x = 0; x < image.cols; ++x) {
    if (cv::norm(image.col(x), cv::NORM_INF) == 0.0) continue;
    if (columns.first < 0) columns.first = x;
    columns.second = x;
  }
  return columns;
}

TEST(ViewsOnAnImage, AreAnEighthOfTheRoomWithinLimits) {
  const std::vector<std::array<double, 3>> rooms{
      {3.0, 2.0, 0.26}, {2.0, 3.0, 0.26}, {0.3, 5.0, 0.05}, {8.0, 5.0, 0.4}};
  for (const auto& [x_m, y_m, length_m] : rooms) {
    const Decision decision{.candidates = {view_at(0.0, 5.0)}, .chosen = 1};
    const MapCanvas canvas = laid(known_after({{1, decision}}, x_m, y_m));
    const int length_px = static_cast<int>(std::lround(500.0 * length_m));
    EXPECT_EQ(filled_columns(canvas.bgr), std::pair(kLeft - 1, kLeft + length_px + 1)) << x_m;
  }
}

/// Gains from 10 to 30 are ranged; the third is chosen, the fourth out of reach.
EventReplay known_with_views() {
  const Decision decision{.candidates = {view_at(0.6, 10.0), view_at(0.3, 15.0), view_at(0.0, 30.0),
                                         view_at(-0.3, 100.0, false),
                                         view_at(-0.6, std::numeric_limits<double>::quiet_NaN())},
                          .chosen = 2};
  return known_after({{1, decision}});
}

TEST(ViewsOnAnImage, AreColouredByTheirGain) {
  const MapCanvas canvas = laid(known_with_views());
  expect_near(on_edge(canvas, 0.6, 65), 0.95 * cv::Scalar(184.0, 92.0, 58.0));
  expect_near(on_edge(canvas, 0.3, 65), 0.95 * cv::Scalar(189.0, 173.75, 49.0));
  for (const double z_m : {-0.3, -0.6}) {
    expect_near(on_edge(canvas, z_m, 65), 0.95 * cv::Scalar(104.0, 86.0, 72.0));
  }
  const MapCanvas hidden = laid(known_with_views(), 1.0F);
  expect_near(on_edge(hidden, 0.6, 65), 0.3 * cv::Scalar(184.0, 92.0, 58.0));
}

TEST(ViewsOnAnImage, TheChosenOneIsLargerAndWhite) {
  const MapCanvas canvas = laid(known_with_views());
  for (const int along : {65, 164}) {
    EXPECT_EQ(on_edge(canvas, 0.0, along), cv::Vec3b(255, 255, 255)) << along;
  }
  for (const int beside : {-1, 1}) {
    EXPECT_EQ(on_edge(canvas, 0.0, 164, beside), cv::Vec3b(255, 255, 255)) << beside;
    EXPECT_EQ(on_edge(canvas, 0.0, 164, 3 * beside), kBlack) << beside;
  }
  EXPECT_EQ(on_edge(canvas, 0.6, 164), kBlack);
  EXPECT_EQ(filled_columns(canvas.bgr).second, kLeft + 208 + 2);
  expect_near(on_edge(laid(known_with_views(), 1.0F), 0.0, 164), cv::Scalar::all(127.5));
}

TEST(ViewsOnAnImage, TheWayIsDrawnThreeCentimetresAboveTheFloor) {
  const EventReplay known =
      known_after({{1, Decision{}}, {1, PlannedRoute{{{0.2, 0.0}, {0.4, 0.0}, {0.6, 0.0}}}}});
  const cv::Scalar accent(60.0, 190.0, 255.0);
  for (const bool hidden : {false, true}) {
    const MapCanvas canvas = laid(known, hidden ? 1.0F : 0.0F);
    const auto at = [&](int row, int column) { return canvas.bgr.at<cv::Vec3b>(row, column); };
    const double opacity = hidden ? 0.35 : 0.95;
    for (const int column : {250, 350}) {
      expect_near(at(kMiddle - 15, column), opacity * accent);
      expect_near(at(kMiddle - 14, column), opacity * accent);
      expect_near(at(kMiddle - 13, column), 0.5 * opacity * accent);
      EXPECT_EQ(at(kMiddle - 12, column), kBlack);
      expect_near(at(kMiddle - 17, column), 0.5 * opacity * accent);
      EXPECT_EQ(at(kMiddle - 18, column), kBlack);
    }
    EXPECT_EQ(at(kMiddle - 15, 190), kBlack);
    EXPECT_EQ(at(kMiddle - 15, 410), kBlack);
  }
}

TEST(ViewsOnAnImage, ThePlanGoesOnFromTheNextScan) {
  const Decision decision{.candidates = {view_at(0.5, 5.0)}, .chosen = 0};
  PlannedTour tour;
  for (const double x_m : {0.3, 0.5, 0.7}) tour.stops.push_back({.place_m = {x_m, 0.0}});
  MapCanvas expected = laid(known_after({{1, decision}}));
  const MapCanvas planned = laid(known_after({{1, decision}, {1, tour}}));
  EXPECT_GT(cv::norm(planned.bgr, expected.bgr, cv::NORM_INF), 0.0);
  draw_tour(expected, far_camera(), tour, {.z_m = 0.03, .number = 2, .unit = 1.3});
  EXPECT_EQ(cv::norm(planned.bgr, expected.bgr, cv::NORM_INF), 0.0);
}

TEST(ViewsOnAnImage, AreNoneBeforeADecision) {
  EXPECT_EQ(cv::norm(laid(known_after({})).bgr, cv::NORM_INF), 0.0);
}

/// A cell whose face is 9.9 m away may lie half its diagonal, 0.173 m, behind the surface it is of.
TEST(MapOnAnImage, IsHiddenByWhatIsBeforeItButNotByItsOwnSurface) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 10.0}, {0.2, 0.2, 0.2}, {1, 1, 1}));
  grid.log_odds[0] = 5.0F;
  MapCamera camera;
  camera.focal_px = 1000.0;
  camera.centre_px = {50.0, 40.0};
  for (const double scene_m : {5.0, 9.72, 9.73, 20.0}) {
    MapCanvas canvas = make_canvas({100, 80});
    canvas.inverse_depth.setTo(cv::Scalar(1.0 / scene_m));
    lay_map(canvas, camera, grid);
    const bool hidden = scene_m < 9.725;
    EXPECT_EQ(canvas.bgr.at<cv::Vec3b>(40, 50) == kBlack, hidden) << scene_m;
    EXPECT_EQ(canvas.bgr.at<cv::Vec3b>(40, 70), kBlack) << scene_m;
    EXPECT_NEAR(1.0 / canvas.inverse_depth.at<float>(40, 50), std::min(scene_m, 9.9), 1e-4);
    EXPECT_NEAR(1.0 / canvas.inverse_depth.at<float>(40, 70), scene_m, 1e-4) << "beside it";
  }
  MapCanvas canvas = make_canvas({100, 80});
  lay_map(canvas, camera, grid);
  EXPECT_NE(canvas.bgr.at<cv::Vec3b>(40, 50), kBlack) << "with nothing in the scene";
  EXPECT_NEAR(1.0 / canvas.inverse_depth.at<float>(40, 50), 9.9, 1e-4);
}

/// Of one cell that is 20 pixels wide and high.
TEST(MapOnAnImage, ReachesToAllEdges) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 10.0}, {0.2, 0.2, 0.2}, {1, 1, 1}));
  grid.log_odds[0] = 5.0F;
  MapCamera camera;
  camera.focal_px = 1000.0;
  camera.centre_px = {4.0, 3.0};
  MapCanvas canvas = make_canvas({9, 7});
  lay_map(canvas, camera, grid);
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 9; ++x) {
      EXPECT_NE(canvas.bgr.at<cv::Vec3b>(y, x), kBlack) << x << ", " << y;
      EXPECT_NEAR(1.0 / canvas.inverse_depth.at<float>(y, x), 9.9, 1e-4) << x << ", " << y;
    }
  }
}

TEST(ViewsOnAnImage, OfOneGainHasTheColourOfTheBest) {
  const Decision decision{.candidates = {view_at(0.0, 5.0)}, .chosen = 1};
  const MapCanvas canvas = laid(known_after({{1, decision}}));
  expect_near(on_edge(canvas, 0.0, 65), 0.95 * cv::Scalar(90.0, 110.0, 250.0));
}

TEST(ViewsOnAnImage, AreRangedWithoutThoseOutOfReachBeforeThem) {
  const Decision decision{
      .candidates = {view_at(0.6, 100.0, false), view_at(0.3, 10.0), view_at(0.0, 30.0)},
      .chosen = 3};
  const MapCanvas canvas = laid(known_after({{1, decision}}));
  expect_near(on_edge(canvas, 0.3, 65), 0.95 * cv::Scalar(184.0, 92.0, 58.0));
  expect_near(on_edge(canvas, 0.0, 65), 0.95 * cv::Scalar(90.0, 110.0, 250.0));
}

TEST(ViewsOnAnImage, TheWayIsWhereItIsSeenFromAbove) {
  MapCamera camera = far_camera();
  camera.T_camera_world.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  MapCanvas canvas = make_canvas({500, 720});
  lay_views(canvas, camera,
            known_after({{1, Decision{}}, {1, PlannedRoute{{{0.2, 0.1}, {0.4, 0.1}}}}}));
  expect_near(canvas.bgr.at<cv::Vec3b>(kMiddle - 50, 250), 0.95 * cv::Scalar(60.0, 190.0, 255.0));
}

TEST(ViewsOnAnImage, HaveLinesTwiceAsWideOnAnImageTwiceAsHigh) {
  const Decision decision = *known_with_views().decision();
  PlannedTour tour;
  for (const double x_m : {0.3, 0.5, 0.7}) tour.stops.push_back({.place_m = {x_m, -0.9}});
  const auto laid_high = [](const std::vector<EpisodeEvent>& events) {
    MapCanvas canvas = make_canvas({500, 1440});
    lay_views(canvas, far_camera(), known_after(events));
    return canvas;
  };
  const MapCanvas canvas = laid_high({{1, decision}, {1, PlannedRoute{{{0.5, 0.0}, {0.7, 0.0}}}}});
  for (const int beside : {-1, 1}) {
    expect_near(on_edge(canvas, 0.6, 65, beside), 0.95 * cv::Scalar(184.0, 92.0, 58.0));
    EXPECT_EQ(on_edge(canvas, 0.0, 164, 2 * beside), cv::Vec3b(255, 255, 255)) << beside;
    const cv::Vec3b on_way = canvas.bgr.at<cv::Vec3b>(kMiddle - 15 + 3 * beside, 400);
    expect_near(on_way, 0.95 * cv::Scalar(60.0, 190.0, 255.0));
  }
  MapCanvas expected = laid_high({{1, decision}});
  draw_tour(expected, far_camera(), tour, {.z_m = 0.03, .number = 2, .unit = 2.6});
  const MapCanvas planned = laid_high({{1, decision}, {1, tour}});
  EXPECT_EQ(cv::norm(planned.bgr, expected.bgr, cv::NORM_INF), 0.0);
}

TEST(MapOnAnImage, LeavesWhatIsBesideItsCells) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 10.0}, {0.2, 0.2, 0.2}, {1, 1, 1}));
  grid.log_odds[0] = 5.0F;
  MapCamera camera;
  camera.focal_px = 1000.0;
  camera.centre_px = {50.0, 40.0};
  MapCanvas canvas = make_canvas({100, 80});
  canvas.bgr.setTo(cv::Scalar(30.0, 60.0, 90.0));
  lay_map(canvas, camera, grid);
  EXPECT_NE(canvas.bgr.at<cv::Vec3b>(40, 50), cv::Vec3b(30, 60, 90));
  EXPECT_EQ(canvas.bgr.at<cv::Vec3b>(40, 70), cv::Vec3b(30, 60, 90));
}

}  // namespace
}  // namespace vantage
