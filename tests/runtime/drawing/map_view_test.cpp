// Pixels of the map panel's renderer where they can be reckoned by hand.
#include "vantage/runtime/drawing/map_view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/runtime/drawing/frustum.hpp"

namespace vantage {
namespace {

/// At the origin, looking along z: at depth 1 a pixel is 1 m.
const MapCamera kPlainCamera{};
const cv::Scalar kWhite = cv::Scalar::all(255);

std::vector<Eigen::Vector3d> corners_to(const Eigen::Vector3d& size_m) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) * size_m.x(), (i >> 1 & 1) * size_m.y(), (i >> 2) * size_m.z());
  }
  return corners;
}

OccupancyGrid unit_cells(const std::array<int, 3>& cells) {
  const std::array<double, 3> size_m{1.0 * cells[0], 1.0 * cells[1], 1.0 * cells[2]};
  return OccupancyGrid(
      make_grid_frame({0.5 * size_m[0], 0.5 * size_m[1], 0.5 * size_m[2]}, size_m, cells));
}

cv::Vec3b pixel_at(const MapCanvas& canvas, const MapCamera& camera, const Eigen::Vector3d& p_m) {
  const Eigen::Vector3d p = camera.project(p_m);
  return canvas.bgr.at<cv::Vec3b>(static_cast<int>(std::lround(p.y())),
                                  static_cast<int>(std::lround(p.x())));
}

TEST(MapCamera, ProjectsByFocalLengthAndDepth) {
  MapCamera camera;
  camera.focal_px = 100.0;
  camera.centre_px = {50.0, 40.0};
  const Eigen::Vector3d p = camera.project({1.0, 2.0, 4.0});
  EXPECT_NEAR(p.x(), 75.0, 1e-9);
  EXPECT_NEAR(p.y(), 90.0, 1e-9);
  EXPECT_NEAR(p.z(), 0.25, 1e-9);
  EXPECT_GT(camera.project({0.0, 0.0, 0.0012}).z(), 0.0);
  EXPECT_LT(camera.project({0.0, 0.0, 0.0008}).z(), 0.0) << "too near";
  EXPECT_LT(camera.project({0.0, 0.0, -4.0}).z(), 0.0) << "behind";
}

TEST(MapCamera, StandsWhereItIsToldAndLooksAtTheMiddle) {
  // Of 2 x 4 x 4 m: half its diagonal is 3 m.
  const MapCamera camera = fit_camera(corners_to({2.0, 4.0, 4.0}), 0.4, 0.3, {10, 20, 300, 200});
  const Eigen::Vector3d back(std::cos(0.3) * std::cos(0.4), std::cos(0.3) * std::sin(0.4),
                             std::sin(0.3));
  EXPECT_LT((camera.p_world_camera() - Eigen::Vector3d(1.0, 2.0, 2.0) - 9.6 * back).norm(), 1e-9);
  const Eigen::Matrix3d R = camera.T_camera_world.linear();
  EXPECT_LT((R.row(0).transpose() - Eigen::Vector3d(-std::sin(0.4), std::cos(0.4), 0.0)).norm(),
            1e-12);
  EXPECT_LT((R.row(2).transpose() + back).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
}

TEST(MapCamera, FillsItsViewportFromTheMiddleOn) {
  for (const cv::Rect& viewport : {cv::Rect(10, 20, 300, 200), cv::Rect(5, 7, 90, 400)}) {
    const auto corners = corners_to({2.0, 4.0, 3.0});
    const MapCamera camera = fit_camera(corners, 0.4, 0.3, viewport);
    Eigen::AlignedBox2d image;
    for (const auto& p : corners) image.extend(Eigen::Vector2d(camera.project(p).head<2>()));
    EXPECT_NEAR(image.center().x(), viewport.x + 0.5 * viewport.width, 1e-9);
    EXPECT_NEAR(image.center().y(), viewport.y + 0.5 * viewport.height, 1e-9);
    EXPECT_NEAR(std::max(image.sizes().x() / viewport.width, image.sizes().y() / viewport.height),
                1.0, 1e-9);
  }
}

TEST(MapColours, AreMixedBetweenTheirStops) {
  const auto is = [](double share, const cv::Vec3d& bgr) {
    EXPECT_LT(cv::norm(height_colour_bgr(share) - bgr), 1e-9) << share;
  };
  is(0.0, {184.0, 92.0, 58.0});
  is(0.1, {193.0, 128.5, 50.0});
  is(0.2, {202.0, 165.0, 42.0});
  is(0.5, {120.0, 207.5, 130.0});
  is(0.9, {80.0, 150.0, 250.0});
  is(1.0, {90.0, 110.0, 250.0});
  is(-2.0, {184.0, 92.0, 58.0});
  is(3.0, {90.0, 110.0, 250.0});
}

TEST(MapLines, AreAsWideAsTheirStrokeWithSoftEdges) {
  MapCanvas canvas = make_canvas({50, 40});
  draw_line(canvas, kPlainCamera, {10.0, 20.0, 1.0}, {30.0, 20.0, 1.0}, {kWhite, 2.0, 1.0, 0.1});
  const auto level = [&](int x, int y) {
    return static_cast<int>(canvas.bgr.at<cv::Vec3b>(y, x)[1]);
  };
  for (const int x : {10, 20, 30}) {
    EXPECT_EQ(level(x, 20), 255);
    EXPECT_NEAR(level(x, 21), 127.5, 1.0) << "half of it";
    EXPECT_NEAR(level(x, 19), 127.5, 1.0);
    EXPECT_EQ(level(x, 22), 0);
    EXPECT_EQ(level(x, 18), 0);
  }
  EXPECT_NEAR(level(9, 20), 127.5, 1.0);
  EXPECT_NEAR(level(31, 20), 127.5, 1.0);
  EXPECT_EQ(level(8, 20), 0);
  EXPECT_EQ(level(32, 20), 0);
}

TEST(MapLines, AreTwoPixelsWideAndFaintBehindSomethingUnlessToldOtherwise) {
  const LineStyle style{};
  EXPECT_EQ(style.width_px, 2.0);
  EXPECT_EQ(style.opacity, 1.0);
  EXPECT_EQ(style.hidden_opacity, 0.1);
}

TEST(MapLines, ThatAreSteepAreDrawnAlongTheOtherAxis) {
  MapCanvas canvas = make_canvas({30, 50});
  draw_line(canvas, kPlainCamera, {12.0, 40.0, 1.0}, {12.0, 8.0, 1.0}, {kWhite, 3.0, 1.0, 0.1});
  int drawn = 0;
  for (int y = 8; y <= 40; ++y) {
    drawn += canvas.bgr.at<cv::Vec3b>(y, 12)[0] == 255 && canvas.bgr.at<cv::Vec3b>(y, 13)[0] == 255
                 ? 1
                 : 0;
  }
  EXPECT_EQ(drawn, 33);
  EXPECT_EQ(canvas.bgr.at<cv::Vec3b>(20, 14)[0], 0);
  MapCanvas slope = make_canvas({60, 60});
  draw_line(slope, kPlainCamera, {10.0, 10.0, 1.0}, {50.0, 40.0, 1.0}, {kWhite, 4.0, 1.0, 0.1});
  EXPECT_EQ(slope.bgr.at<cv::Vec3b>(25, 30)[0], 255);
  EXPECT_EQ(slope.bgr.at<cv::Vec3b>(25, 32)[0], 255) << "1.2 px off";
  EXPECT_NEAR(slope.bgr.at<cv::Vec3b>(25, 33)[0], 178.5, 1.0) << "1.8 px off";
  EXPECT_NEAR(slope.bgr.at<cv::Vec3b>(25, 34)[0], 25.5, 1.0) << "2.4 px off";
  EXPECT_EQ(slope.bgr.at<cv::Vec3b>(25, 35)[0], 0);
  EXPECT_NEAR(slope.bgr.at<cv::Vec3b>(25, 27)[0], 178.5, 1.0);
}

TEST(MapLines, AreMixedWithWhatIsThere) {
  MapCanvas canvas = make_canvas({50, 40});
  canvas.bgr.setTo(cv::Scalar::all(100));
  draw_line(canvas, kPlainCamera, {10.0, 20.0, 1.0}, {30.0, 20.0, 1.0},
            {cv::Scalar(200, 60, 20), 2.0, 0.25, 0.1});
  EXPECT_EQ(canvas.bgr.at<cv::Vec3b>(20, 20), cv::Vec3b(125, 90, 80));
}

TEST(MapLines, AreFaintWhereSomethingIsNearer) {
  MapCanvas canvas = make_canvas({50, 40});
  const auto level_before = [&](int x, float inverse_depth) {
    canvas.bgr.setTo(cv::Scalar());
    canvas.inverse_depth.setTo(cv::Scalar());
    canvas.inverse_depth.at<float>(20, x) = inverse_depth;
    // From 1 m to 2 m depth: in the middle of the image of it the inverse depth is 0.75.
    draw_line(canvas, kPlainCamera, {10.0, 20.0, 1.0}, {60.0, 40.0, 2.0}, {kWhite, 2.0, 1.0, 0.2});
    return static_cast<int>(canvas.bgr.at<cv::Vec3b>(20, x)[2]);
  };
  EXPECT_EQ(level_before(20, 0.0F), 255);
  EXPECT_EQ(level_before(20, 0.751F), 255);
  EXPECT_EQ(level_before(20, 0.76F), 51);
  EXPECT_EQ(level_before(15, 0.87F), 255);
  EXPECT_EQ(level_before(15, 0.88F), 51);
}

TEST(MapLines, EndAtTheCanvasAndAreNoneBehindTheCamera) {
  MapCanvas canvas = make_canvas({50, 10});
  draw_line(canvas, kPlainCamera, {-20.0, 5.0, 1.0}, {100.0, 5.0, 1.0}, {kWhite, 1.0, 1.0, 0.1});
  cv::Mat green;
  cv::extractChannel(canvas.bgr, green, 1);
  EXPECT_EQ(cv::countNonZero(green), 50);
  canvas = make_canvas({50, 10});
  draw_line(canvas, kPlainCamera, {5.0, 5.0, 1.0}, {5.0, 5.0, -1.0}, {kWhite, 1.0, 1.0, 0.1});
  draw_line(canvas, kPlainCamera, {5.0, 5.0, -1.0}, {5.0, 5.0, 1.0}, {kWhite, 1.0, 1.0, 0.1});
  draw_line(canvas, kPlainCamera, {-9.0, 5.0, 1.0}, {-5.0, 5.0, 1.0}, {kWhite, 1.0, 1.0, 0.1});
  draw_line(canvas, kPlainCamera, {9.0, 15.0, 1.0}, {15.0, 15.0, 1.0}, {kWhite, 1.0, 1.0, 0.1});
  cv::extractChannel(canvas.bgr, green, 1);
  EXPECT_EQ(cv::countNonZero(green), 0);
}

/// From +x: right is +y, down is -z, light comes along (0.6, -0.45, 0.75).
TEST(MapVoxels, OfOneCellAreItsFaceLitFromTheUpperLeft) {
  OccupancyGrid grid = unit_cells({1, 1, 1});
  const MapCamera camera = fit_camera(corners_to({1.0, 1.0, 1.0}), 0.0, 0.0, {20, 30, 100, 100});
  grid.log_odds[0] = 0.4F;
  MapCanvas canvas = make_canvas({200, 200});
  draw_voxels(canvas, camera, grid);
  EXPECT_EQ(cv::countNonZero(canvas.inverse_depth), 0) << "not above a probability of 0.6";
  grid.log_odds[0] = 0.41F;
  draw_voxels(canvas, camera, grid);
  EXPECT_EQ(cv::countNonZero(canvas.inverse_depth), 101 * 101);
  EXPECT_GT(canvas.inverse_depth.at<float>(30, 20), 0.0F);
  EXPECT_GT(canvas.inverse_depth.at<float>(130, 120), 0.0F);
  // The middle of the colours times 0.38 + 0.7 * 0.6 / sqrt(1.125).
  EXPECT_EQ(pixel_at(canvas, camera, {1.0, 0.5, 0.5}), cv::Vec3b(93, 161, 101));
  const double depth_m = 3.2 * 0.5 * std::sqrt(3.0) - 0.5;
  EXPECT_NEAR(canvas.inverse_depth.at<float>(80, 70), 1.0 / depth_m, 1e-5);
}

/// From above: right is +y, down is +x, light comes along (-0.75, -0.45, 0.6).
TEST(MapVoxels, AreLitByWhereTheFreeCellsBesideThemAre) {
  const MapCamera camera =
      fit_camera(corners_to({2.0, 1.0, 1.0}), 0.0, 0.5 * std::numbers::pi, {0, 0, 200, 200});
  const auto drawn = [&](std::size_t occupied, std::size_t free) {
    OccupancyGrid grid = unit_cells({2, 1, 1});
    grid.log_odds[occupied] = 2.0F;
    grid.log_odds[free] = -2.0F;
    MapCanvas canvas = make_canvas({200, 200});
    draw_voxels(canvas, camera, grid);
    return pixel_at(canvas, camera, {0.5 + static_cast<double>(occupied), 0.5, 1.0});
  };
  EXPECT_EQ(drawn(0, 1), cv::Vec3b(46, 79, 49)) << "away from the light";
  EXPECT_EQ(drawn(1, 0), cv::Vec3b(117, 202, 127));
}

TEST(MapVoxels, AreDarkBesideWhatStandsBeforeThem) {
  // Seen from +x the one at (1, 0, 0) is near and on the left, the one at (0, 1, 0) far.
  OccupancyGrid grid = unit_cells({2, 2, 1});
  grid.log_odds[grid.frame.index({1, 0, 0})] = 2.0F;
  grid.log_odds[grid.frame.index({0, 1, 0})] = 2.0F;
  const MapCamera camera = fit_camera(corners_to({2.0, 2.0, 1.0}), 0.0, 0.0, {0, 0, 200, 200});
  MapCanvas canvas = make_canvas({200, 200});
  draw_voxels(canvas, camera, grid);
  const auto far = canvas.bgr.at<cv::Vec3b>(100, 130);
  const auto beside = canvas.bgr.at<cv::Vec3b>(100, 102);
  EXPECT_EQ(canvas.bgr.at<cv::Vec3b>(100, 105), far);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(far[c], 20);
    EXPECT_NEAR(beside[c], std::exp(-0.9) * far[c], 0.51);
  }
}

TEST(Frustum, HasItsTipAtTheSensorAndOpensAlongX) {
  const Pose T_world_sensor = make_pose({40.0, 30.0, 100.0}, 0.5 * std::numbers::pi);
  const LineStyle style{kWhite, 1.0, 1.0, 1.0};
  MapCanvas canvas = make_canvas({80, 80});
  MapCamera camera;
  camera.focal_px = 100.0;
  draw_frustum(canvas, camera, T_world_sensor, 20.0, style);
  // x of the sensor is y of the world, y is -x.
  const Eigen::Vector3d tip(40.0, 30.0, 100.0);
  const std::array<Eigen::Vector3d, 4> rim{
      {{34.0, 50.0, 104.0}, {46.0, 50.0, 104.0}, {46.0, 50.0, 96.0}, {34.0, 50.0, 96.0}}};
  MapCanvas expected = make_canvas({80, 80});
  for (std::size_t i = 0; i < 4; ++i) {
    draw_line(expected, camera, tip, rim[i], style);
    draw_line(expected, camera, rim[i], rim[(i + 1) % 4], style);
  }
  EXPECT_LE(cv::norm(canvas.bgr, expected.bgr, cv::NORM_INF), 1.0);
  EXPECT_GT(cv::norm(expected.bgr, cv::NORM_INF), 250.0);
}

TEST(MapVoxels, EndAtTheCanvas) {
  OccupancyGrid grid = unit_cells({1, 1, 1});
  grid.log_odds[0] = 2.0F;
  const auto pixels = [&](int left_px, int top_px) {
    const MapCamera camera =
        fit_camera(corners_to({1.0, 1.0, 1.0}), 0.0, 0.0, {left_px, top_px, 100, 100});
    MapCanvas canvas = make_canvas({200, 200});
    draw_voxels(canvas, camera, grid);
    return cv::countNonZero(canvas.inverse_depth);
  };
  EXPECT_EQ(pixels(50, 50), 101 * 101);
  EXPECT_EQ(pixels(150, 50), 50 * 101);
  EXPECT_EQ(pixels(-50, 50), 51 * 101);
  EXPECT_EQ(pixels(50, 150), 101 * 50);
  EXPECT_EQ(pixels(50, -50), 101 * 51);
}

/// From above, three cells in a row of which the one in the middle is not known.
TEST(MapVoxels, AreLitByWhereFreeCellsTwoCellsAwayAre) {
  const auto drawn = [](const std::array<int, 3>& cells, std::size_t occupied) {
    const MapCamera camera = fit_camera(corners_to({1.0 * cells[0], 1.0 * cells[1], 1.0}), 0.0,
                                        0.5 * std::numbers::pi, {0, 0, 200, 200});
    OccupancyGrid grid = unit_cells(cells);
    grid.log_odds[occupied] = 2.0F;
    grid.log_odds[2 - occupied] = -2.0F;
    MapCanvas canvas = make_canvas({200, 200});
    draw_voxels(canvas, camera, grid);
    const Eigen::Vector3d middle_m = grid.frame.centre(grid.frame.cell(occupied));
    return pixel_at(canvas, camera, middle_m + 0.5 * Eigen::Vector3d::UnitZ());
  };
  EXPECT_EQ(drawn({3, 1, 1}, 0), cv::Vec3b(46, 79, 49)) << "away from the light";
  EXPECT_EQ(drawn({3, 1, 1}, 2), cv::Vec3b(117, 202, 127));
  EXPECT_EQ(drawn({1, 3, 1}, 0), cv::Vec3b(46, 79, 49)) << "away from the light";
  EXPECT_EQ(drawn({1, 3, 1}, 2), cv::Vec3b(94, 163, 102)) << "the light is more along x";
}

TEST(MapVoxels, OfOneCellAreAsLargeAndAsNearFromEverySide) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  OccupancyGrid grid = unit_cells({1, 1, 1});
  grid.log_odds[0] = 2.0F;
  const double depth_m = 3.2 * 0.5 * std::sqrt(3.0) - 0.5;
  for (const auto& [azimuth_rad, elevation_rad] : {std::pair(0.0, 0.0),
                                                   {kQuarter, 0.0},
                                                   {2.0 * kQuarter, 0.0},
                                                   {-kQuarter, 0.0},
                                                   {0.0, kQuarter},
                                                   {0.0, -kQuarter}}) {
    const MapCamera camera =
        fit_camera(corners_to({1.0, 1.0, 1.0}), azimuth_rad, elevation_rad, {50, 50, 100, 100});
    MapCanvas canvas = make_canvas({200, 200});
    draw_voxels(canvas, camera, grid);
    EXPECT_EQ(cv::countNonZero(canvas.inverse_depth), 101 * 101) << azimuth_rad << elevation_rad;
    EXPECT_NEAR(canvas.inverse_depth.at<float>(100, 100), 1.0 / depth_m, 1e-5);
  }
}

/// From the middle of one of them: the next one begins half a metre ahead.
TEST(MapVoxels, HaveNoFacesBetweenThem) {
  OccupancyGrid grid = unit_cells({1, 1, 2});
  grid.log_odds[1] = 2.0F;
  MapCamera camera;
  camera.T_camera_world.translation() = Eigen::Vector3d::Constant(-0.5);
  camera.focal_px = 20.0;
  camera.centre_px = {50.0, 50.0};
  const auto pixels = [&](float log_odds_here) {
    grid.log_odds[0] = log_odds_here;
    MapCanvas canvas = make_canvas({100, 100});
    draw_voxels(canvas, camera, grid);
    return cv::countNonZero(canvas.inverse_depth);
  };
  EXPECT_EQ(pixels(-2.0F), 41 * 41);
  EXPECT_EQ(pixels(2.0F), 0);
}

}  // namespace
}  // namespace vantage
