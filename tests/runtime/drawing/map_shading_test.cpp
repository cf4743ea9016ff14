// How the voxels of the map panel are lit, hide each other and are set off from what is behind
// them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "vantage/runtime/drawing/map_view.hpp"

namespace vantage {
namespace {

constexpr double kFromAbove_rad = 0.5 * std::numbers::pi;

/// Cells of that size from the origin on, of which nothing is known.
OccupancyGrid cells_of(const std::array<int, 3>& cells, const Eigen::Vector3d& size_m) {
  GridFrame frame;
  frame.cell_size_m = size_m;
  frame.cells = {cells[0], cells[1], cells[2]};
  return OccupancyGrid(frame);
}
OccupancyGrid cubes(const std::array<int, 3>& cells) {
  return cells_of(cells, Eigen::Vector3d::Ones());
}

MapCamera camera_on(const OccupancyGrid& grid, double azimuth_rad, double elevation_rad,
                    const cv::Rect& viewport = {0, 0, 200, 200}) {
  const Eigen::AlignedBox3d box = grid.frame.box();
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  return fit_camera(corners, azimuth_rad, elevation_rad, viewport);
}

/// The pixel of a place.
cv::Point pixel_of(const MapCamera& camera, const Eigen::Vector3d& p_m) {
  const Eigen::Vector3d p = camera.project(p_m);
  return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
}

MapCanvas drawn_from(const MapCamera& camera, const OccupancyGrid& grid) {
  MapCanvas canvas = make_canvas({200, 200});
  draw_voxels(canvas, camera, grid);
  return canvas;
}

/// Of the top of that cell.
cv::Vec3b colour_from_above(const OccupancyGrid& grid, std::size_t cell) {
  const MapCamera camera = camera_on(grid, 0.0, kFromAbove_rad);
  const Eigen::Vector3d top_m = grid.frame.centre(grid.frame.cell(cell)) +
                                0.5 * grid.frame.cell_size_m.z() * Eigen::Vector3d::UnitZ();
  return drawn_from(camera, grid).bgr.at<cv::Vec3b>(pixel_of(camera, top_m));
}

/// Of the face towards +x of that cell.
cv::Vec3b colour_from_ahead(const OccupancyGrid& grid, std::size_t cell) {
  const MapCamera camera = camera_on(grid, 0.0, 0.0);
  const Eigen::Vector3d face_m = grid.frame.centre(grid.frame.cell(cell)) +
                                 0.5 * grid.frame.cell_size_m.x() * Eigen::Vector3d::UnitX();
  return drawn_from(camera, grid).bgr.at<cv::Vec3b>(pixel_of(camera, face_m));
}

TEST(MapShading, IsOfFreeCellsWithinTwoCellsAndNoFarther) {
  for (const int axis : {0, 1, 2}) {
    std::array<int, 3> row{1, 1, 1};
    row[static_cast<std::size_t>(axis)] = 4;
    const auto colour = [&](std::size_t occupied, std::optional<std::size_t> free) {
      OccupancyGrid grid = cubes(row);
      grid.log_odds[occupied] = 2.0F;
      if (free) grid.log_odds[*free] = -2.0F;
      return axis == 2 ? colour_from_ahead(grid, occupied) : colour_from_above(grid, occupied);
    };
    for (const std::size_t end : {0U, 3U}) {
      const std::size_t second = end == 0 ? 2 : 1;
      EXPECT_NE(colour(end, second), colour(end, std::nullopt)) << axis << ' ' << end;
      EXPECT_EQ(colour(end, 3 - end), colour(end, std::nullopt)) << axis << ' ' << end;
    }
  }
}

/// Free on both sides, more of it towards the light: 4/5 of a normal. It is lit by 0.989, its
/// colour half way up is (120, 207.5, 130).
TEST(MapShading, IsWeakerTheLessTheCellsAgree) {
  OccupancyGrid grid = cubes({5, 1, 1});
  grid.log_odds[2] = 2.0F;
  for (const std::size_t free : {0U, 1U, 4U}) grid.log_odds[free] = -2.0F;
  EXPECT_EQ(colour_from_above(grid, 2), cv::Vec3b(119, 205, 129));
}

/// Along x they are twice as long, so that the free one there is farther away: lit by 1.051.
TEST(MapShading, GoesByMetresNotByCells) {
  OccupancyGrid grid = cells_of({2, 2, 1}, {2.0, 1.0, 1.0});
  grid.log_odds[3] = 2.0F;
  for (const std::size_t free : {1U, 2U}) grid.log_odds[free] = -2.0F;
  EXPECT_EQ(colour_from_above(grid, 3), cv::Vec3b(126, 218, 137));
}

/// (189, 173.75, 49) and (75, 196.25, 235), of which a face towards the camera is lit by 0.776.
TEST(MapShading, ColoursByTheMiddleOfTheLayer) {
  for (const std::size_t layer : {0U, 1U}) {
    OccupancyGrid grid = cubes({1, 1, 2});
    grid.log_odds[layer] = 2.0F;
    EXPECT_EQ(colour_from_ahead(grid, layer),
              layer == 0 ? cv::Vec3b(147, 135, 38) : cv::Vec3b(58, 152, 182));
  }
}

TEST(MapShading, DrawsNoCellThatIsJustNotOccupied) {
  OccupancyGrid grid = cubes({1, 1, 1});
  grid.log_odds[0] = static_cast<float>(log_odds_of(kOccupiedAbove));
  EXPECT_EQ(cv::countNonZero(drawn_from(camera_on(grid, 0.0, 0.0), grid).inverse_depth), 0);
}

/// Two cells side by side, from no side straight: each face is at the mean depth of its corners.
TEST(MapFaces, AreThoseThatLookToTheCamera) {
  OccupancyGrid grid = cubes({2, 1, 1});
  grid.log_odds[0] = grid.log_odds[1] = 2.0F;
  const MapCamera camera = camera_on(grid, 0.6, 0.5);
  const MapCanvas canvas = drawn_from(camera, grid);
  for (const auto& [cell, axis] : {std::pair(1, 0), {0, 1}, {1, 1}, {0, 2}, {1, 2}}) {
    const Eigen::Vector3d face_m =
        Eigen::Vector3d(0.5 + cell, 0.5, 0.5) + 0.5 * Eigen::Vector3d::Unit(axis);
    double inverse_depth = 0.0;
    for (const double u : {-0.5, 0.5}) {
      for (const double v : {-0.5, 0.5}) {
        const Eigen::Vector3d corner_m = face_m + u * Eigen::Vector3d::Unit((axis + 1) % 3) +
                                         v * Eigen::Vector3d::Unit((axis + 2) % 3);
        inverse_depth += 0.25 * camera.project(corner_m).z();
      }
    }
    EXPECT_NEAR(canvas.inverse_depth.at<float>(pixel_of(camera, face_m)), inverse_depth, 1e-6)
        << cell << ' ' << axis;
  }
}

/// From +x the far one begins at 128 px, behind the near one, which ends at 133 px.
TEST(MapFaces, AreHiddenWhereSomethingIsNearer) {
  OccupancyGrid grid = cubes({2, 3, 1});
  grid.log_odds[grid.frame.index({1, 1, 0})] = 2.0F;
  grid.log_odds[grid.frame.index({0, 2, 0})] = 2.0F;
  const MapCanvas canvas = drawn_from(camera_on(grid, 0.0, 0.0), grid);
  const double depth_m = 1.6 * std::sqrt(14.0) - 1.0;
  EXPECT_NEAR(canvas.inverse_depth.at<float>(100, 130), 1.0 / depth_m, 1e-5);
  EXPECT_NEAR(canvas.inverse_depth.at<float>(100, 150), 1.0 / (depth_m + 1.0), 1e-5);
}

/// Edges of 100 px: a pixel belongs to a face up to 0.005 px beside it.
TEST(MapFaces, TakeInThePixelsOnTheirEdges) {
  OccupancyGrid grid = cubes({1, 1, 1});
  grid.log_odds[0] = 2.0F;
  for (const double azimuth_rad : {0.0, std::numbers::pi}) {
    const auto pixels = [&](double x_px, double y_px) {
      MapCamera camera = camera_on(grid, azimuth_rad, 0.0, {50, 50, 100, 100});
      camera.centre_px += Eigen::Vector2d(x_px, y_px);
      return cv::countNonZero(drawn_from(camera, grid).inverse_depth);
    };
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_EQ(pixels(0.004 * sign, 0.0), 101 * 101);
      EXPECT_EQ(pixels(0.0, 0.004 * sign), 101 * 101);
      EXPECT_EQ(pixels(0.008 * sign, 0.0), 100 * 101);
      EXPECT_EQ(pixels(0.0, 0.008 * sign), 100 * 101);
    }
  }
}

TEST(MapCameraOfAPoint, StandsThreeMillimetresFromIt) {
  const std::vector<Eigen::Vector3d> points{{1.0, 2.0, 3.0}};
  const MapCamera camera = fit_camera(points, 0.4, 0.3, {10, 20, 300, 200});
  EXPECT_NEAR((camera.p_world_camera() - points[0]).norm(), 3.2e-3, 1e-9);
  EXPECT_NEAR(camera.focal_px, 2e8, 1.0);
}

/// A canvas 1 m away with a point that is nearer, on which nothing is drawn: grey levels.
cv::Mat rims_of(const std::vector<cv::Point>& near, float inverse_depth,
                std::optional<cv::Point> nothing = std::nullopt) {
  MapCanvas canvas = make_canvas({21, 21});
  canvas.bgr.setTo(cv::Scalar::all(200));
  canvas.inverse_depth.setTo(cv::Scalar(1.0));
  for (const cv::Point& p : near) canvas.inverse_depth.at<float>(p) = inverse_depth;
  if (nothing) canvas.inverse_depth.at<float>(*nothing) = 0.0F;
  draw_voxels(canvas, MapCamera{}, cubes({1, 1, 1}));
  cv::Mat grey;
  cv::extractChannel(canvas.bgr, grey, 1);
  return grey;
}

/// 3 px away in eight directions, but for the outermost 3 px of the canvas.
TEST(MapRims, AreRoundWhatIsNearer) {
  for (const cv::Point& near :
       {cv::Point(10, 10), {5, 5}, {6, 6}, {14, 14}, {15, 15}, {6, 14}, {15, 5}}) {
    cv::Mat expected(21, 21, CV_8U, cv::Scalar(200));
    for (const int dy : {-3, 0, 3}) {
      for (const int dx : {-3, 0, 3}) {
        const cv::Point at = near + cv::Point(dx, dy);
        const bool inside = at.x >= 3 && at.x < 18 && at.y >= 3 && at.y < 18;
        if (inside && at != near) expected.at<std::uint8_t>(at) = 81;  // 200 exp(-0.9)
      }
    }
    EXPECT_EQ(cv::norm(rims_of({near}, 2.0F), expected, cv::NORM_INF), 0.0) << near;
  }
}

TEST(MapRims, AreAsDarkAsTheOtherIsNear) {
  const auto level = [](float inverse_depth) {
    return static_cast<int>(rims_of({{10, 10}}, inverse_depth).at<std::uint8_t>(10, 7));
  };
  EXPECT_EQ(level(1.003F), 200) << "less than 0.4 % is the same surface";
  EXPECT_EQ(level(1.007F), 195) << "200 exp(-9 * 0.003)";
  EXPECT_EQ(level(0.5F), 200) << "farther away";
  const cv::Mat between_two = rims_of({{7, 10}, {13, 10}}, 1.024F);
  EXPECT_EQ(between_two.at<std::uint8_t>(10, 10), 140) << "200 exp(-9 * (0.02 + 0.02))";
}

TEST(MapRims, AreNoneWhereNothingWasDrawn) {
  const cv::Mat grey = rims_of({{10, 10}}, 2.0F, cv::Point(4, 10));
  EXPECT_EQ(grey.at<std::uint8_t>(10, 4), 200);
  EXPECT_EQ(grey.at<std::uint8_t>(10, 7), 81) << "behind it in the row";
}

}  // namespace
}  // namespace vantage
