#include "vantage/sim/sensors/ground_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "tests/sim/sensors/sensor_scene.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {
namespace {

/// Cells of 10 cm, one layer: x to the right from 0, y up from 0, z in [0, 0.1).
GridFrame layer(int nx, int ny) {
  return {.min_corner_m = Eigen::Vector3d::Zero(),
          .cell_size_m = Eigen::Vector3d::Constant(0.1),
          .cells = {nx, ny, 1}};
}

/// Rows from the highest y down, as one would draw it.
std::string picture(const GridFrame& grid, const std::vector<std::uint8_t>& flags) {
  std::string drawn;
  for (int y = grid.cells.y() - 1; y >= 0; --y) {
    for (int x = 0; x < grid.cells.x(); ++x) {
      drawn += flags[grid.index({x, y, 0})] != 0 ? '#' : '.';
    }
    drawn += '\n';
  }
  return drawn;
}

std::vector<std::uint8_t> flags_of(const GridFrame& grid, const std::string& drawn) {
  std::vector<std::uint8_t> flags(grid.size(), 0);
  for (int y = 0; y < grid.cells.y(); ++y) {
    for (int x = 0; x < grid.cells.x(); ++x) {
      const int row = grid.cells.y() - 1 - y;
      const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.cells.x() + 1) +
                      static_cast<std::size_t>(x);
      flags[grid.index({x, y, 0})] = drawn[at] == '#' ? 1 : 0;
    }
  }
  return flags;
}

constexpr FieldOfView kWide{.half_width_rad = 1.5,
                            .tilt_min_rad = -0.4,
                            .tilt_max_rad = 0.4,
                            .range_min_m = 0.01,
                            .range_max_m = 5.0};

/// A wall across the grid at x in [0.55, 0.95], a robot arm in front of it.
constexpr const char* kRoomWall = R"(
  <mujoco><worldbody>
    <geom type="box" size="0.2 2 2" pos="0.75 0 0"/>
    <body name="robot/base"><joint type="slide"/><geom type="sphere" size="0.02"/>
      <body><geom type="sphere" size="0.04" pos="0.2 0.25 0.05"/></body>
    </body>
  </worldbody></mujoco>)";

TEST(VisibleCells, FreeCellsAndTheSurfacesOwnNotThoseBehind) {
  const auto scene = test::compile_mjcf(kRoomWall);
  const RayScene rays(*scene.model, *scene.data, {.exclude_body_prefix = "robot/"});
  const GridFrame grid = layer(10, 5);
  const Pose T = make_pose({-1.0, 0.25, 0.05}, 0.0);
  EXPECT_EQ(picture(grid, visible_cells(rays, grid, T, kWide)),
            "######....\n"
            "######....\n"
            "######....\n"
            "######....\n"
            "######....\n");
}

TEST(VisibleCells, TheRobotHidesCellsUnlessLeftOut) {
  const auto scene = test::compile_mjcf(kRoomWall);
  const RayScene rays(*scene.model, *scene.data);
  const GridFrame grid = layer(10, 5);
  const Pose T = make_pose({-1.0, 0.25, 0.05}, 0.0);
  EXPECT_EQ(picture(grid, visible_cells(rays, grid, T, kWide)),
            "######....\n"
            "######....\n"
            "##........\n"
            "######....\n"
            "######....\n");
}

TEST(VisibleCells, ABodyThatIsLeftOutHidesNothing) {
  const auto scene = test::compile_mjcf(kRoomWall);
  const RayScene rays(*scene.model, *scene.data);
  const Pose T = make_pose({-1.0, 0.25, 0.05}, 0.0);
  constexpr int kArm = 2;
  EXPECT_EQ(picture(layer(10, 5), visible_cells(rays, layer(10, 5), T, kWide, kArm)),
            "######....\n"
            "######....\n"
            "######....\n"
            "######....\n"
            "######....\n");
}

TEST(VisibleCells, ASurfaceOnACellFaceHidesTheCellBehindIt) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody><geom type="box" size="0.2 2 2" pos="0.7 0 0"/></worldbody></mujoco>)");
  const RayScene rays(*scene.model, *scene.data);
  const GridFrame grid = layer(10, 1);
  const Pose T = make_pose({-1.0, 0.05, 0.05}, 0.0);
  EXPECT_EQ(picture(grid, visible_cells(rays, grid, T, kWide)), "#####.....\n");
}

TEST(VisibleCells, APostCastsAShadow) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody><geom type="box" size="0.04 0.04 1" pos="0.35 0.35 0"/></worldbody></mujoco>)");
  const RayScene rays(*scene.model, *scene.data);
  const GridFrame grid = layer(8, 7);
  const Pose T = make_pose({0.05, 0.35, 0.05}, 0.0);
  FieldOfView sensor = kWide;
  sensor.half_width_rad = 0.5;
  EXPECT_EQ(picture(grid, visible_cells(rays, grid, T, sensor)),
            "......##\n"
            "....####\n"
            "..#####.\n"
            ".###....\n"
            "..#####.\n"
            "....####\n"
            "......##\n");
}

TEST(VisibleCells, RangeAndThreadsAndSensorPose) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data, {.exclude_body_prefix = "robot/"});
  const GridFrame grid = make_grid_frame({0.0, 0.0, 0.5}, {3.0, 3.0, 1.0}, {60, 60, 20});
  const Pose T = make_pose({-2.5, 0.3, 1.1}, -0.1, 0.1);
  FieldOfView sensor = kWide;
  sensor.range_max_m = 3.0;
  const auto one = visible_cells(rays, grid, T, sensor);
  EXPECT_EQ(one, visible_cells(rays, grid, T, sensor, -1, 2));
  EXPECT_EQ(one, visible_cells(rays, grid, T, sensor, -1, 3));
  std::size_t seen = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i] == 0) continue;
    ++seen;
    ASSERT_TRUE(sensor.contains(T.inverse() * grid.centre(grid.cell(i))));
  }
  EXPECT_GT(seen, one.size() / 10);
  EXPECT_LT(seen, one.size());
}

TEST(VisibleCells, OfTwoPlacesAreTheUnion) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data, {.exclude_body_prefix = "robot/"});
  const GridFrame grid = make_grid_frame({0.0, 0.0, 0.5}, {3.0, 3.0, 1.0}, {40, 40, 15});
  const Pose T_a = make_pose({-2.5, 0.3, 1.1}, -0.1, 0.1);
  const Pose T_b = make_pose({0.2, -2.0, 1.4}, 1.4, 0.2);
  FieldOfView sensor = kWide;
  sensor.range_max_m = 2.6;
  const auto a = visible_cells(rays, grid, T_a, sensor);
  const auto b = visible_cells(rays, grid, T_b, sensor);
  auto both = a;
  add_visible_cells(rays, grid, T_b, sensor, both, -1, 2);
  for (std::size_t i = 0; i < both.size(); ++i) ASSERT_EQ(both[i], a[i] | b[i]) << i;
  EXPECT_NE(both, a);
}

TEST(SurfaceCells, OutlineOfABox) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody><geom type="box" size="0.2 0.15 1" pos="0.45 0.4 0"/></worldbody></mujoco>)");
  const GridFrame grid = layer(9, 7);
  EXPECT_EQ(picture(grid, surface_cells(*scene.model, *scene.data, grid)),
            ".........\n"
            "..#####..\n"
            "..#...#..\n"
            "..#...#..\n"
            "..#####..\n"
            ".........\n"
            ".........\n");
}

TEST(SurfaceCells, LeavesOutTheRobot) {
  const auto scene = test::compile_mjcf(kRoomWall);
  const GridFrame grid = layer(6, 3);
  EXPECT_EQ(picture(grid, surface_cells(*scene.model, *scene.data, grid,
                                        {.exclude_body_prefix = "robot/"})),
            ".....#\n.....#\n.....#\n");
}

TEST(SurfaceCells, APlaneFillsItsLayerOnly) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom type="plane" size="0 0 1" pos="100 0 0.05"/>
      <geom type="plane" size="0.1 0.1 1" pos="0.25 0.25 0.25"/>
    </worldbody></mujoco>)");
  GridFrame grid = layer(5, 5);
  grid.cells.z() = 4;
  const auto cells = surface_cells(*scene.model, *scene.data, grid);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Array3i cell = grid.cell(i);
    const bool on_tile =
        cell.z() == 2 && (cell.head<2>() >= 1).all() && (cell.head<2>() <= 3).all();
    EXPECT_EQ(cells[i] != 0, cell.z() == 0 || on_tile) << cell.transpose();
  }
}

/// Marks by cutting a triangle to the end, wherever it lies.
void cut(const GridFrame& grid, const std::array<Eigen::Vector3d, 3>& corners,
         std::vector<std::uint8_t>& flags) {
  const auto& [a, b, c] = corners;
  const double most = std::pow(0.45 * grid.cell_size_m.minCoeff(), 2);
  const double ab = (b - a).squaredNorm();
  const double bc = (c - b).squaredNorm();
  const double ca = (a - c).squaredNorm();
  const double longest = std::max({ab, bc, ca});
  if (longest > most) {
    const auto& [p, q, r] = ab == longest   ? corners
                            : bc == longest ? std::array{b, c, a}
                                            : std::array{c, a, b};
    const Eigen::Vector3d middle = 0.5 * (p + q);
    cut(grid, {p, middle, r}, flags);
    cut(grid, {middle, q, r}, flags);
    return;
  }
  for (const Eigen::Vector3d& p : {a, b, c, Eigen::Vector3d((a + b + c) / 3.0)}) {
    const Eigen::Array3i cell = grid.cell_at(p);
    if (grid.contains(cell)) flags[grid.index(cell)] = 1;
  }
}

/// What is left out on the way, because its cells are marked, changes none: in tall cells too, and
/// on edges of cells, which centroids are rounded across (y = 0.78).
TEST(SurfaceCells, AreThoseOfAllTrianglesCutToTheEnd) {
  const auto scene = test::compile_mjcf(R"(
    <mujoco><worldbody>
      <geom type="box" size="0.7 0.1 0.5" pos="1.1 0.3 0.5"/>
      <geom type="box" size="0.1 0.8 0.25" pos="1.7 1.3 0.25"/>
      <geom type="box" size="0.25 0.1 0.4" pos="2.1 0.68 0.4"/>
      <geom type="box" size="0.3 0.2 0.1" pos="0.9 1.6 0.4" euler="0 0 31"/>
      <geom type="box" size="0.3 0.2 0.1" pos="2.9 1.6 0.4" euler="20 10 31"/>
      <geom type="cylinder" size="0.25 0.4" pos="0.4 1.2 0.4"/>
      <geom type="sphere" size="0.3" pos="0.8 0.9 0.1"/>
    </worldbody></mujoco>)");
  for (const Eigen::Vector3d& cell_m :
       {Eigen::Vector3d(0.1, 0.1, 0.1), Eigen::Vector3d(0.07, 0.06, 0.3),
        Eigen::Vector3d(0.02, 0.02, 1.2)}) {
    GridFrame grid{.min_corner_m = {0.0, 0.0, -0.2}, .cell_size_m = cell_m, .cells = {1, 1, 1}};
    grid.cells = (Eigen::Array3d(2.4, 2.0, 1.2) / cell_m.array()).round().cast<int>();
    std::vector<std::uint8_t> expected(grid.size(), 0);
    for (int geom = 0; geom < scene.model->ngeom; ++geom) {
      const SurfaceMesh mesh =
          geom_triangles(*scene.model, geom, 0.45 * grid.cell_size_m.minCoeff());
      const Eigen::Isometry3d T = T_world_geom(*scene.data, geom);
      for (const auto& triangle : mesh.triangles) {
        std::array<Eigen::Vector3d, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
          corners[i] = T * mesh.vertices_m[static_cast<std::size_t>(triangle[i])];
        }
        cut(grid, corners, expected);
      }
    }
    EXPECT_EQ(surface_cells(*scene.model, *scene.data, grid), expected) << cell_m.transpose();
  }
}

/// Every point where a ray meets a geom must lie in or beside a marked cell, and every marked cell
/// must be near a point of some surface.
TEST(SurfaceCells, CoverWhatRaysHitOnEveryKindOfGeom) {
  const auto scene = test::sensor_scene();
  const RayScene rays(*scene.model, *scene.data);
  const GridFrame grid = make_grid_frame({0.0, 0.0, 0.7}, {4.0, 4.0, 1.6}, {100, 100, 40});
  const auto cells = surface_cells(*scene.model, *scene.data, grid);
  Rng rng(2);
  int hits = 0;
  int direct = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d p(rng.uniform(-2, 2), rng.uniform(-2, 2), 3.0);
    const Eigen::Vector3d target(rng.uniform(-2, 2), rng.uniform(-2, 2), 0.0);
    const Eigen::Vector3d d = (target - p).normalized();
    const RayHit hit = rays.cast(p, d, 10.0);
    const Eigen::Array3i cell = grid.cell_at(p + hit.distance_m * d);
    if (!hit.hit() || !grid.contains(cell)) continue;
    ++hits;
    if (cells[grid.index(cell)] != 0) ++direct;
  }
  EXPECT_GT(hits, 3000);
  EXPECT_GT(direct, 0.98 * hits);  // samples half a cell apart miss corners of cells
}

TEST(ScoreMap, KnownAnswers) {
  const GridFrame grid = layer(7, 4);
  const auto surface = flags_of(grid,
                                "..#....\n"
                                "..#....\n"
                                "..#....\n"
                                "..#...#\n");
  const auto observable = flags_of(grid,
                                   "####...\n"
                                   "####...\n"
                                   "####...\n"
                                   "......#\n");
  const auto occupied = flags_of(grid,
                                 ".......\n"
                                 ".#.....\n"
                                 "..#..#.\n"
                                 ".......\n");
  const MapScore exact = score_map(grid, occupied, surface, observable, 0);
  EXPECT_EQ(exact.occupied_cells, 3U);
  EXPECT_EQ(exact.correct_cells, 1U);
  EXPECT_EQ(exact.observable_surface_cells, 4U);
  EXPECT_EQ(exact.found_cells, 1U);
  EXPECT_DOUBLE_EQ(exact.precision, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(exact.recall, 0.25);

  const MapScore near = score_map(grid, occupied, surface, observable, 1);
  EXPECT_EQ(near.correct_cells, 3U);  // (5,1) is diagonal to the surface at (6,0)
  EXPECT_EQ(near.found_cells, 4U);
  EXPECT_DOUBLE_EQ(near.precision, 1.0);
  EXPECT_DOUBLE_EQ(near.recall, 1.0);
}

TEST(ScoreMap, ToleranceReachesAlongEveryAxisAndEndsThere) {
  const GridFrame grid{.cells = {5, 5, 5}};
  std::vector<std::uint8_t> surface(grid.size(), 0);
  surface[grid.index({2, 2, 2})] = 1;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    std::vector<std::uint8_t> occupied(grid.size(), 0);
    occupied[i] = 1;
    const int distance = (grid.cell(i) - 2).abs().maxCoeff();
    const MapScore score = score_map(grid, occupied, surface, surface, 1);
    EXPECT_EQ(score.precision, distance <= 1 ? 1.0 : 0.0);
    EXPECT_EQ(score.recall, score.precision);
  }
}

TEST(ScoreMap, NothingClaimedIsNothingWrong) {
  const GridFrame grid = layer(3, 3);
  const std::vector<std::uint8_t> none(grid.size(), 0);
  const std::vector<std::uint8_t> all(grid.size(), 1);
  EXPECT_EQ(score_map(grid, none, all, all, 1).precision, 1.0);
  EXPECT_EQ(score_map(grid, none, all, all, 1).recall, 0.0);
  EXPECT_EQ(score_map(grid, all, all, none, 1).recall, 1.0);
}

TEST(ScoreMap, ToleranceMayReachAcrossTheGrid) {
  const GridFrame grid{.cells = {2, 3, 4}};
  for (int tolerance = 0; tolerance <= 5; ++tolerance) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      for (std::size_t k = 0; k < grid.size(); ++k) {
        std::vector<std::uint8_t> occupied(grid.size(), 0);
        std::vector<std::uint8_t> surface(grid.size(), 0);
        occupied[i] = surface[k] = 1;
        const int distance = (grid.cell(i) - grid.cell(k)).abs().maxCoeff();
        const MapScore score = score_map(grid, occupied, surface, surface, tolerance);
        ASSERT_EQ(score.precision, distance <= tolerance ? 1.0 : 0.0) << i << " " << k;
        ASSERT_EQ(score.recall, score.precision) << i << " " << k;
      }
    }
  }
}

TEST(VisibleCells, ACellIsSeenAMicrometreBeforeASurface) {
  for (const auto& [wall_m, row] :
       {std::pair("0.7000007", "#####.....\n"), std::pair("0.7000015", "######....\n")}) {
    const auto scene =
        test::compile_mjcf(std::string("<mujoco><worldbody><geom type='box' size='.2 2 2' pos='") +
                           wall_m + " 0 0'/></worldbody></mujoco>");
    const RayScene rays(*scene.model, *scene.data);
    const GridFrame grid = layer(10, 1);
    const Pose T = make_pose({-1.0, 0.05, 0.05}, 0.0);
    EXPECT_EQ(picture(grid, visible_cells(rays, grid, T, kWide)), row);
  }
}

TEST(VisibleCells, TheCellThatTheSensorIsInIsSeen) {
  const auto scene = test::compile_mjcf(kRoomWall);
  const RayScene rays(*scene.model, *scene.data, {.exclude_body_prefix = "robot/"});
  const GridFrame grid = layer(10, 1);
  EXPECT_EQ(picture(grid, visible_cells(rays, grid, make_pose({0.02, 0.05, 0.05}, 0.0), kWide)),
            "######....\n");
  FieldOfView from_itself_on = kWide;
  from_itself_on.range_min_m = 0.0;
  const Pose in_its_middle{Eigen::Translation3d(grid.centre({0, 0, 0}))};
  EXPECT_EQ(picture(grid, visible_cells(rays, grid, in_its_middle, from_itself_on)),
            "######....\n");
}

TEST(VisibleCells, AreFlaggedByOnes) {
  const auto scene = test::compile_mjcf(kRoomWall);
  const RayScene rays(*scene.model, *scene.data);
  const auto flags = visible_cells(rays, layer(10, 5), make_pose({-1.0, 0.25, 0.05}, 0.0), kWide);
  EXPECT_EQ(*std::ranges::max_element(flags), 1);
}

TEST(SurfaceCells, AnEndlessPlaneHasNoEndOnEitherSide) {
  for (const char* at : {"-100 0 .05", "100 0 .05", "0 -100 .05", "0 100 .05"}) {
    const auto scene =
        test::compile_mjcf(std::string("<mujoco><worldbody><geom type='plane' size='0 0 1' pos='") +
                           at + "'/></worldbody></mujoco>");
    GridFrame grid = layer(5, 4);
    grid.cells.z() = 2;
    const auto cells = surface_cells(*scene.model, *scene.data, grid);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      EXPECT_EQ(cells[i] != 0, grid.cell(i).z() == 0) << at << " " << i;
    }
  }
}

}  // namespace
}  // namespace vantage
