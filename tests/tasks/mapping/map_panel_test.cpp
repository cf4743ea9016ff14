#include "vantage/tasks/mapping/drawing/map_panel.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/report/sample_run.hpp"
#include "vantage/runtime/drawing/map_view.hpp"
#include "vantage/runtime/drawing/panel_style.hpp"
#include "vantage/runtime/drawing/tour_drawing.hpp"
#include "vantage/runtime/log/video_recorder.hpp"

namespace vantage {
namespace {

MapPanelInput sample_input(const OccupancyGrid& grid) {
  MapPanelInput input;
  input.grid = &grid;
  for (int id = 0; id < 30; ++id) input.T_world_candidates.push_back(support::sample_view(id));
  for (int scan = 0; scan < 4; ++scan) {
    input.T_world_chosen.push_back(support::sample_view(support::sample_choice(scan)));
    input.observable_unobserved_cells.push_back(90'000.0 / (scan + 1));
  }
  input.T_world_base = project_to_se2(input.T_world_chosen.back());
  input.scans_planned = 9;
  input.method = "adaptive";
  return input;
}

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

/// A camera that sees the unit cube from (azimuth, elevation) in 200 x 200 px.
MapCamera unit_camera(double azimuth_rad, double elevation_rad) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  return fit_camera(corners, azimuth_rad, elevation_rad, {0, 0, 200, 200});
}

TEST(MapCamera, StandsUprightOnItsSide) {
  const MapCamera camera = unit_camera(0.0, 0.3);  // from +x: y grows to the right
  const Eigen::Vector3d middle = camera.project({0.5, 0.5, 0.5});
  EXPECT_GT(camera.project({0.5, 1.0, 0.5}).x(), middle.x() + 10.0);
  EXPECT_LT(camera.project({0.5, 0.5, 1.0}).y(), middle.y() - 10.0);
  EXPECT_GT(camera.project({1.0, 0.5, 0.5}).z(), middle.z());
  EXPECT_GT(camera.p_world_camera().x(), 1.0);
  EXPECT_LT(camera.project({100.0, 0.5, 0.5}).z(), 0.0);
}

TEST(MapCamera, FillsItsViewport) {
  for (double azimuth = 0.0; azimuth < 6.0; azimuth += 0.7) {
    const MapCamera camera = unit_camera(azimuth, 0.6);
    Eigen::AlignedBox2d image;
    for (int i = 0; i < 8; ++i) {
      image.extend(
          Eigen::Vector2d(camera.project(Eigen::Vector3d(i & 1, i >> 1 & 1, i >> 2)).head<2>()));
    }
    EXPECT_GE(image.min().minCoeff(), -1e-6);
    EXPECT_LE(image.max().maxCoeff(), 200.0 + 1e-6);
    EXPECT_NEAR(image.sizes().maxCoeff(), 200.0, 1e-6);
  }
}

// Seen from +x, the red top cell at the far side is hidden by the blue bottom one only if it is
// lower in the image:
//
//   z ^  . . F      F: cell (0, 1, 2), far and high
//     |  . . .
//     +  N . .      N: cell (2, 1, 0), near and low         camera ->  from the left here
TEST(MapVoxels, AreColouredByHeightAndStandWhereTheyAre) {
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {3, 3, 3}));
  grid.log_odds[grid.frame.index({2, 1, 0})] = 5.0F;
  grid.log_odds[grid.frame.index({0, 1, 2})] = 5.0F;
  MapCanvas canvas = make_canvas({200, 200});
  const MapCamera camera = unit_camera(0.0, 0.0);
  draw_voxels(canvas, camera, grid);
  const Eigen::Vector3d low = camera.project({1.0, 0.5, 1.0 / 6.0});
  const Eigen::Vector3d high = camera.project({1.0 / 3.0, 0.5, 5.0 / 6.0});
  const auto at = [&](const Eigen::Vector3d& p) {
    return canvas.bgr.at<cv::Vec3b>(static_cast<int>(p.y()), static_cast<int>(p.x()));
  };
  EXPECT_GT(at(low)[0], at(low)[2]);
  EXPECT_GT(at(high)[2], at(high)[0]);
  EXPECT_NEAR(canvas.inverse_depth.at<float>(static_cast<int>(low.y()), static_cast<int>(low.x())),
              low.z(), 0.02 * low.z());
}

TEST(MapVoxels, NearOnesHideFarOnes) {
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {3, 3, 3}));
  grid.log_odds[grid.frame.index({2, 1, 1})] = 5.0F;
  const MapCamera camera = unit_camera(0.0, 0.0);
  MapCanvas one = make_canvas({200, 200});
  draw_voxels(one, camera, grid);
  grid.log_odds[grid.frame.index({0, 1, 1})] = 5.0F;
  MapCanvas two = make_canvas({200, 200});
  draw_voxels(two, camera, grid);
  EXPECT_TRUE(same(one.bgr, two.bgr));
}

TEST(MapVoxels, FreeAndUnobservedCellsAreNotDrawn) {
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {3, 3, 3}));
  grid.log_odds[4] = -5.0F;
  MapCanvas canvas = make_canvas({200, 200});
  draw_voxels(canvas, unit_camera(0.4, 0.4), grid);
  EXPECT_EQ(cv::countNonZero(canvas.inverse_depth), 0);
}

TEST(MapLines, AreFaintBehindVoxels) {
  OccupancyGrid grid(make_grid_frame({0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {1, 1, 1}));
  grid.log_odds[0] = 5.0F;
  const MapCamera camera = unit_camera(0.0, 0.0);
  const auto brightness = [&](double x) {
    MapCanvas canvas = make_canvas({200, 200});
    draw_voxels(canvas, camera, grid);
    const cv::Mat before = canvas.bgr.clone();
    draw_line(canvas, camera, {x, 0.2, 0.5}, {x, 0.8, 0.5}, {cv::Scalar::all(255), 3.0, 1.0, 0.1});
    return cv::norm(canvas.bgr, before, cv::NORM_L1);
  };
  EXPECT_GT(brightness(1.1), 4.0 * brightness(-0.1));
  EXPECT_GT(brightness(-0.1), 0.0);
}

TEST(MapPanel, IsDeterministicAndOfItsSize) {
  const OccupancyGrid grid = support::sample_grid();
  const cv::Mat first = draw_map_panel(sample_input(grid), {640, 720});
  EXPECT_EQ(first.size(), cv::Size(640, 720));
  EXPECT_EQ(first.type(), CV_8UC3);
  EXPECT_TRUE(same(first, draw_map_panel(sample_input(grid), {640, 720})));
}

TEST(MapPanel, CopesWithNothingKnown) {
  const OccupancyGrid grid(support::sample_frame());
  MapPanelInput input;
  input.grid = &grid;
  EXPECT_EQ(draw_map_panel(input, {320, 360}).size(), cv::Size(320, 360));
  input.observable_unobserved_cells = {std::numeric_limits<double>::quiet_NaN(), 5.0};
  EXPECT_EQ(draw_map_panel(input, {333, 241}).size(), cv::Size(333, 241));
}

TEST(MapPanel, ShowsTheRobotWhereItIs) {
  const OccupancyGrid grid(support::sample_frame());
  MapPanelInput input = sample_input(grid);
  const cv::Mat here = draw_map_panel(input, {640, 720});
  input.T_world_base.y_m += 0.5;
  EXPECT_FALSE(same(here, draw_map_panel(input, {640, 720})));
}

/// So many pixels of exactly that colour, and near `at_px`.
int pixels_near(const cv::Mat& image, const cv::Scalar& bgr, const Eigen::Vector2d& at_px,
                int reach_px) {
  const cv::Rect around(static_cast<int>(at_px.x()) - reach_px,
                        static_cast<int>(at_px.y()) - reach_px, 2 * reach_px, 2 * reach_px);
  cv::Mat found;
  cv::inRange(image(around & cv::Rect({}, image.size())), bgr - cv::Scalar::all(12),
              bgr + cv::Scalar::all(12), found);
  return cv::countNonZero(found);
}

PlannedTour tour_through(const std::vector<Eigen::Vector2d>& places_m) {
  PlannedTour tour;
  for (const Eigen::Vector2d& place_m : places_m) tour.stops.push_back({.place_m = place_m});
  return tour;
}

TEST(TourDrawing, IsSolidToTheNextStopAndDashedBeyond) {
  const MapCamera camera = unit_camera(0.0, 1.5);  // from above
  MapCanvas canvas = make_canvas({200, 200});
  draw_tour(canvas, camera, tour_through({{0.5, 0.1}, {0.5, 0.9}}),
            {.from_m = Eigen::Vector2d(0.95, 0.1), .unit = 2.0});
  const auto at = [&](double x, double y) {
    return Eigen::Vector2d(camera.project({x, y, 0.0}).head<2>());
  };
  // The disc of the next stop is full beside its number, the ring of the one behind it is not.
  const Eigen::Vector2d beside_px(0.0, 12.0);
  EXPECT_EQ(pixels_near(canvas.bgr, panel::kPlan, at(0.5, 0.1) + beside_px, 1), 4);
  EXPECT_EQ(pixels_near(canvas.bgr, panel::kPlan, at(0.5, 0.9) + beside_px, 1), 0);
  EXPECT_GT(pixels_near(canvas.bgr, panel::kPlan, at(0.5, 0.9), 20), 60);
  const auto drawn_share = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    int drawn = 0;
    for (int i = 0; i < 100; ++i) {
      drawn += pixels_near(canvas.bgr, panel::kPlan, from + 0.01 * i * (to - from), 1) > 0 ? 1 : 0;
    }
    return drawn;
  };
  EXPECT_EQ(drawn_share(at(0.92, 0.1), at(0.68, 0.1)), 100);
  const int dashed = drawn_share(at(0.5, 0.25), at(0.5, 0.75));
  EXPECT_GT(dashed, 30);
  EXPECT_LT(dashed, 95);
}

TEST(TourDrawing, LeavesTheFirstWayOutAndNumbersNoStopThatIsCovered) {
  const MapCamera camera = unit_camera(0.0, 1.5);
  const auto drawn = [&](const PlannedTour& tour, const TourDrawing& how) {
    MapCanvas canvas = make_canvas({200, 200});
    draw_tour(canvas, camera, tour, how);
    return canvas.bgr;
  };
  EXPECT_EQ(cv::countNonZero(drawn({}, {}).reshape(1)), 0);
  const cv::Mat one = drawn(tour_through({{0.5, 0.5}}), {.marks_next = false});
  EXPECT_EQ(cv::countNonZero(one.reshape(1)), 0);
  const cv::Mat two = drawn(tour_through({{0.5, 0.5}, {0.5, 0.52}}), {});
  const cv::Mat again = drawn(tour_through({{0.5, 0.5}, {0.5, 0.52}}), {.number = 7});
  EXPECT_FALSE(same(two, again)) << "numbers go on from the first one";
  EXPECT_TRUE(same(drawn(tour_through({{0.5, 0.5}, {0.5, 0.5}}), {}),
                   drawn(tour_through({{0.5, 0.5}}), {})))
      << "a dot covers no number";
}

TEST(MapPanel, ShowsThePlan) {
  const OccupancyGrid grid(support::sample_frame());
  MapPanelInput input = sample_input(grid);
  const cv::Mat none = draw_map_panel(input, {640, 720});
  input.tour = tour_through({{0.3, -0.3}, {-0.3, -0.3}, {-0.3, 0.3}});
  const cv::Mat planned = draw_map_panel(input, {640, 720});
  cv::Mat changed;
  cv::absdiff(none, planned, changed);
  EXPECT_GT(cv::countNonZero(changed(cv::Rect(0, 66, 640, 440)).clone().reshape(1)), 500);
  EXPECT_GT(cv::countNonZero(changed(cv::Rect(0, 44, 640, 20)).clone().reshape(1)), 100)
      << "and why";
}

TEST(MapPanel, SaysHowManyCellsAreLeftAfterTheLastScan) {
  const OccupancyGrid grid(support::sample_frame());
  MapPanelInput input = sample_input(grid);
  const auto figure_of = [&](const std::vector<double>& cells_left) {
    input.observable_unobserved_cells = cells_left;
    return draw_map_panel(input, {640, 720})(cv::Rect(430, 665, 180, 26)).clone();
  };
  EXPECT_TRUE(same(figure_of({90'000.0, 700.0}), figure_of({50'000.0, 700.0})));
  EXPECT_FALSE(same(figure_of({90'000.0, 700.0}), figure_of({90'000.0, 800.0})));
}

TEST(SideBySide, TurnsTheLeftHalfFromRgb) {
  const cv::Mat left(10, 10, CV_8UC3, cv::Scalar(200, 100, 0));
  const cv::Mat right(20, 16, CV_8UC3, cv::Scalar(1, 2, 3));
  const cv::Mat both = side_by_side(left, right);
  EXPECT_EQ(both.size(), cv::Size(32, 20));
  EXPECT_EQ(both.at<cv::Vec3b>(5, 5), cv::Vec3b(0, 100, 200));
  EXPECT_EQ(both.at<cv::Vec3b>(5, 20), cv::Vec3b(1, 2, 3));
}

}  // namespace
}  // namespace vantage
