#include "vantage/tasks/mapping/drawing/map_panel.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>

#include "tests/report/sample_run.hpp"
#include "tests/tasks/drawn_pixels.hpp"
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
  OccupancyGrid grid(support::sample_frame());
  for (std::size_t i = 0; i < grid.size(); ++i) grid.log_odds[i] = i % 7 == 0 ? 3.0F : -3.0F;
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

using Points = std::vector<cv::Point>;

/// The channel that differs most.
double off_by(const cv::Mat& image, cv::Point at, const cv::Scalar& bgr) {
  const auto& pixel = image.at<cv::Vec3b>(at);
  double most = 0.0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(pixel[c] - bgr[c]));
  return most;
}

/// Of four scans across 322 px from x = 78 on, of 1080 cells down 116 px to y = 674.
TEST(MapPanel, PlotsTheCellsLeftAfterEachScan) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.scans_planned = 4;
  const auto plotted = [&](const std::vector<double>& cells) {
    input.observable_unobserved_cells = cells;
    return draw_map_panel(input, {640, 720});
  };
  const cv::Mat three = plotted({1000.0, 500.0, 250.0});
  const cv::Scalar under(46.0, 53.0, 55.0);  // a little of the line's colour
  for (const cv::Point& at : Points{{158, 566}, {239, 620}, {319, 647}, {200, 594}}) {
    EXPECT_TRUE(support::is_coloured(three, at, panel::kAccent)) << at;
  }
  for (const cv::Point& at : Points{{239, 660}, {200, 640}, {300, 665}}) {
    EXPECT_LT(off_by(three, at, under), 3.0) << at;
  }
  for (const cv::Point& at : Points{{150, 660}, {330, 665}, {239, 614}, {390, 590}, {390, 647}}) {
    EXPECT_LT(off_by(three, at, panel::kCard), 3.0) << at;
  }
  for (const int y : {566, 620, 674}) EXPECT_GT(off_by(three, {390, y}, panel::kCard), 8.0) << y;
  for (const int x : {154, 235, 315, 396}) {
    EXPECT_TRUE(support::is_written(three, {x, 678, 10, 12})) << x;
  }
  EXPECT_FALSE(support::is_written(three, {112, 678, 14, 12})) << "scans are whole";
  EXPECT_FALSE(support::is_written(three, {78, 692, 322, 10}));
  EXPECT_TRUE(support::is_written(three, {50, 612, 23, 13})) << "500";
  EXPECT_FALSE(support::is_written(three, {74, 612, 3, 13}));
  EXPECT_FALSE(support::is_written(three, {40, 580, 36, 25}));
  EXPECT_FALSE(support::is_written(three, {34, 560, 14, 12})) << "1k is short";
  EXPECT_LT(off_by(plotted({1000.0}), {158, 640}, panel::kCard), 3.0);
  EXPECT_LT(off_by(plotted({1000.0, 500.0}), {200, 650}, under), 3.0);
}

const cv::Rect kHeader(0, 0, 640, 60);

TEST(MapPanel, HasAHeaderAndACardOfFigures) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.observable_unobserved_cells = {111'111.0};
  input.predicted_new_cells = input.actual_new_cells = 111'111.0;
  const cv::Mat image = draw_map_panel(input, {640, 720});
  for (const cv::Point& at : Points{{20, 600}, {620, 600}, {300, 523}, {300, 700}}) {
    EXPECT_LT(off_by(image, at, panel::kCard), 3.0) << at;
  }
  for (const cv::Point& at : Points{
           {5, 1}, {3, 360}, {5, 717}, {12, 600}, {628, 600}, {300, 516}, {300, 708}, {17, 521}}) {
    const double t = at.y / 720.0;
    EXPECT_LT(off_by(image, at, panel::kTop * (1.0 - t) + panel::kBottom * t), 3.0) << at;
  }
  EXPECT_TRUE(support::is_written(image, {34, 534, 150, 14})) << "what the plot is of";
  EXPECT_FALSE(support::is_written(image, {34, 522, 150, 9}));
  for (const int row : {0, 1, 2}) {
    EXPECT_TRUE(support::is_written(image, {434, 538 + 55 * row, 120, 12})) << row;
    const cv::Rect value(434, 558 + 55 * row, 150, 20);
    EXPECT_EQ(support::count_coloured(image, value, panel::kText) > 8, row < 2) << row;
    EXPECT_EQ(support::count_coloured(image, value, panel::kAccent) > 8, row == 2) << row;
  }
  EXPECT_FALSE(support::is_written(image, {434, 581, 150, 8}));
  EXPECT_FALSE(support::is_written(image, {424, 540, 8, 150}));
  EXPECT_GT(support::count_coloured(image, {24, 16, 44, 21}, panel::kText), 3) << "Map";
  const auto changed_by = [&](const char* method, int scans) {
    input.method = method;
    input.scans_planned = scans;
    return support::box_of_changes(image, draw_map_panel(input, {640, 720}), kHeader);
  };
  const cv::Rect method = changed_by("adaptive", 0);
  EXPECT_TRUE(method.x >= 86 && method.x <= 93 && method.br().x <= 200) << method;
  EXPECT_TRUE(method.y >= 18 && method.br().y <= 43 && method.br().y >= 34) << method;
  const cv::Rect scan = changed_by("", 4);
  EXPECT_TRUE(scan.x > 440 && scan.br().x > 605 && scan.br().x <= 618) << scan;
  EXPECT_TRUE(scan.y >= 18 && scan.br().y <= 41 && scan.br().y >= 34) << scan;
}

/// "scan 1 of 4": another number of scans is another last digit, which ends at 616 px.
TEST(MapPanel, SaysOfHowManyScansItShowsWhich) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.observable_unobserved_cells = {1000.0};
  const auto drawn_of = [&](int scans) {
    input.scans_planned = scans;
    return draw_map_panel(input, {640, 720});
  };
  const cv::Rect digit = support::box_of_changes(drawn_of(4), drawn_of(7), kHeader);
  EXPECT_GT(digit.x, 590) << digit;
  EXPECT_TRUE(digit.br().x > 605 && digit.br().x <= 618) << digit;
}

/// At twice the panel's resolution, as draw_map_panel() draws it.
MapCamera camera_of_two_metres() {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, i >> 2);
  return fit_camera(corners, -0.9, 0.72, {40, 132, 1200, 872});
}

TEST(MapPanel, DrawsTheRobotItsPathAndTheBoxToScale) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.path_m = {{-0.6, -0.5}, {0.6, -0.5}};
  const cv::Mat image = draw_map_panel(input, {640, 720});
  const MapCamera camera = camera_of_two_metres();
  const auto px = [&](double x_m, double y_m, double z_m = 0.0) {
    const Eigen::Vector3d p = camera.project({x_m, y_m, z_m});
    return cv::Point(static_cast<int>(0.5 * p.x()), static_cast<int>(0.5 * p.y()));
  };
  const double size_m = 0.8 * 0.13 * 2.0;
  const auto is_robot = [&](double x, double y) {
    return support::is_coloured(image, px(size_m * x, size_m * y), panel::kRobot);
  };
  EXPECT_TRUE(is_robot(0.2, 0.0) && is_robot(0.5, 0.0) && is_robot(-0.45, 0.4));
  EXPECT_FALSE(is_robot(1.3, 0.0) || is_robot(-0.6, 0.0));
  // Of the pixels there the one that is most like it.
  const auto nearest = [&](cv::Point at, const cv::Scalar& bgr) {
    double least = 255.0;
    for (int i = 0; i < 9; ++i) {
      least = std::min(least, off_by(image, at + cv::Point(i % 3 - 1, i / 3 - 1), bgr));
    }
    return least;
  };
  EXPECT_LT(nearest(px(0.1, -0.5), {98.0, 137.0, 73.0}), 6.0) << "a path shines through";
  EXPECT_GT(nearest(px(0.75, -0.5), {98.0, 137.0, 73.0}), 25.0) << "it ends there";
  for (const auto& [x_m, y_m] :
       {std::pair{1.0, 0.1}, std::pair{-1.0, 0.1}, std::pair{0.1, 1.0}, std::pair{0.1, -1.0}}) {
    EXPECT_LT(nearest(px(x_m, y_m), {157.0, 139.0, 126.0}), 6.0) << x_m << " " << y_m;
    EXPECT_LT(nearest(px(x_m, y_m, 1.0), {86.0, 72.0, 61.0}), 12.0) << "fainter above";
  }
  EXPECT_LT(nearest(px(0.3, 0.2), {64.0, 51.0, 41.0}), 16.0) << "a line of the ground";
  EXPECT_GT(nearest(px(0.3, 0.3), {64.0, 51.0, 41.0}), 18.0) << "none between";
}

/// Two views that are 9 px apart share a label; the sensors look up, out of the labels' row.
TEST(MapPanel, NumbersViewsAndMarksTheNewest) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  const MapCamera camera = camera_of_two_metres();
  const Eigen::Vector3d once(-0.5, 0.3, 0.6);
  const Eigen::Vector3d other(0.5, -0.4, 0.6);
  const Eigen::Vector3d right(std::sin(0.9), std::cos(0.9), 0.0);
  const auto px = [&](const Eigen::Vector3d& p_m) {
    return Eigen::Vector2d(0.5 * camera.project(p_m).head<2>());
  };
  const double px_per_m = (px(once + 0.01 * right) - px(once)).norm() / 0.01;
  MapPanelInput input;
  input.grid = &grid;
  for (const Eigen::Vector3d& p_m : {once, other, Eigen::Vector3d(once + 9.0 / px_per_m * right)}) {
    input.T_world_chosen.push_back(make_pose(p_m, 0.0, -0.5 * std::numbers::pi));
  }
  const cv::Mat image = draw_map_panel(input, {640, 720});
  const auto is_filled = [&](const Eigen::Vector3d& p_m, double x_px, const cv::Scalar& bgr) {
    const Eigen::Vector2d p = px(p_m);
    const cv::Point at(static_cast<int>(p.x() + x_px), static_cast<int>(p.y()));
    return support::is_coloured(image, at, bgr);
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(is_filled(once, 14.0 * side, panel::kAccent)) << "1,3 " << side;
    EXPECT_FALSE(is_filled(once, 19.0 * side, panel::kAccent)) << "1,3 " << side;
    EXPECT_TRUE(is_filled(other, 7.0 * side, panel::kVisited)) << "2 " << side;
    EXPECT_FALSE(is_filled(other, 12.0 * side, panel::kVisited)) << "2 " << side;
  }
}

TEST(MapPanel, DrawsThePlanFromWhereTheRobotIs) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.T_world_base = {0.7, -0.6, 0.0};
  input.tour = tour_through({{-0.7, -0.6}});
  const cv::Mat image = draw_map_panel(input, {640, 720});
  const Eigen::Vector3d midway_px = 0.5 * camera_of_two_metres().project({0.0, -0.6, 0.0});
  const cv::Rect around(static_cast<int>(midway_px.x()) - 1, static_cast<int>(midway_px.y()) - 1, 3,
                        3);
  EXPECT_GT(support::count_coloured(image, around, panel::kPlan), 0);
}

/// Of 20 px; lines are 3 px wide at twice the resolution.
TEST(MapPanel, ShowsTheMapFromMarginToMargin) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.1}, {2.0, 2.0, 0.2}, {8, 8, 1}));
  MapPanelInput input;
  input.grid = &grid;
  input.elevation_rad = 0.4;
  const cv::Mat image = draw_map_panel(input, {640, 720});
  int first = image.cols;
  int last = 0;
  for (int y = 70; y < 500; ++y) {
    const cv::Scalar background(image.at<cv::Vec3b>(y, 5));
    for (int x = 0; x < image.cols; ++x) {
      if (off_by(image, {x, y}, background) < 8.0) continue;
      first = std::min(first, x);
      last = std::max(last, x);
    }
  }
  EXPECT_EQ(first, 19);
  EXPECT_EQ(last, 620);
}

/// Of 100 cells up to the upper end of the plot, at y = 558.
TEST(MapPanel, LabelsTheUpperEndOfThePlotToo) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.scans_planned = 4;
  input.observable_unobserved_cells = {100.0 / 1.08};
  const cv::Mat image = draw_map_panel(input, {640, 720});
  EXPECT_GT(off_by(image, {390, 558}, panel::kCard), 8.0);
  EXPECT_TRUE(support::is_written(image, {50, 552, 20, 9})) << "100";
}

/// Half a cell is half-way up to one, however few there are.
TEST(MapPanel, PlotsUpToAtLeastOneCell) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {2.0, 2.0, 1.0}, {8, 8, 4}));
  MapPanelInput input;
  input.grid = &grid;
  input.scans_planned = 4;
  input.observable_unobserved_cells = {0.5};
  EXPECT_TRUE(support::is_coloured(draw_map_panel(input, {640, 720}), {158, 620}, panel::kAccent));
}

}  // namespace
}  // namespace vantage
