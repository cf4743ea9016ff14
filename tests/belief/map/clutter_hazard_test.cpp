#include "vantage/belief/map/clutter_hazard.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tests/belief/map/voxel_scene.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/face_neighbours.hpp"

namespace vantage {
namespace {

using test::parse;

constexpr float kNoReturn = std::numeric_limits<float>::infinity();

/// One beam along a row of 1 m cells, from its left edge.
struct Counted {
  double crossings;
  double hits;
  bool operator==(const Counted&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Counted& c) {
  return out << c.crossings << " crossings, " << c.hits << " hits";
}
Counted beam(const std::string& row, float range_m, double range_max_m = 100.0) {
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0};
  scan.range_m = {range_m};
  scan.field_of_view.range_max_m = range_max_m;
  const OccupancyGrid before = parse({row});
  ClutterHazard hazard({.layers = 1}, before.frame.cells);
  hazard.observe(before, scan, make_pose({0.0, 0.5, 0.0}, 0.0));
  return {hazard.crossings(0), hazard.hits(0)};
}

TEST(ClutterHazard, CountsABeam) {
  EXPECT_EQ(beam("..????", 3.5F), (Counted{2, 1})) << "stopped in the second unobserved cell";
  EXPECT_EQ(beam("..????", 2.5F), (Counted{1, 1})) << "stopped in the first";
  EXPECT_EQ(beam("..????", 1.5F), (Counted{0, 0})) << "ended in a free cell";
  EXPECT_EQ(beam("..???##", 5.5F), (Counted{2, 0})) << "ended in a cell already occupied";
  EXPECT_EQ(beam("..??#??", 6.5F), (Counted{1, 0})) << "met a known surface on the way";
  EXPECT_EQ(beam("??..??", 4.5F), (Counted{3, 1})) << "free cells between do not count";
}

TEST(ClutterHazard, AKnownSurfaceMeasuredALittleOffIsNoHit) {
  EXPECT_EQ(beam("..???#?", 4.5F), (Counted{2, 0})) << "just before it";
  EXPECT_EQ(beam("..???#?", 3.5F), (Counted{2, 1})) << "farther before it";
}

TEST(ClutterHazard, BeamWithoutReturnCrossesAll) {
  EXPECT_EQ(beam("..????", kNoReturn), (Counted{4, 0})) << "to the grid's end";
  EXPECT_EQ(beam("..????", kNoReturn, 4.5), (Counted{3, 0})) << "to the range";
  EXPECT_EQ(beam("..????", 50.0F), (Counted{4, 0})) << "stopped outside the grid";
}

TEST(ClutterHazard, InvalidBeamsAreIgnored) {
  EXPECT_EQ(beam("??????", std::numeric_limits<float>::quiet_NaN()), (Counted{0, 0}));
}

TEST(ClutterHazard, StartsAtThePrior) {
  const ClutterHazard hazard({.prior_hazard = 0.02}, {20, 30, 65});
  EXPECT_DOUBLE_EQ(hazard.global_transmission(), 0.98);
  ASSERT_EQ(hazard.transmission_per_slice().size(), 65U);
  for (const double t : hazard.transmission_per_slice()) EXPECT_DOUBLE_EQ(t, 0.98);
  for (const double t : hazard.transmission().per_block) EXPECT_DOUBLE_EQ(t, 0.98);
}

TEST(ClutterHazard, LayersDivideTheSlicesEvenly) {
  const ClutterHazard hazard({.layers = 13}, {1, 1, 65});
  for (int slice = 0; slice < 65; ++slice) EXPECT_EQ(hazard.layer_of(slice), slice / 5);
  const ClutterHazard more_layers_than_slices({.layers = 13}, {1, 1, 4});
  EXPECT_EQ(more_layers_than_slices.transmission_per_slice().size(), 4U);
}

TEST(ClutterHazard, ShrinksALayerTowardsTheGlobalRate) {
  GridFrame frame;
  frame.cells = {10, 1, 2};
  const OccupancyGrid before(frame);
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0};
  const ClutterHazardOptions options{
      .layers = 2, .prior_crossings = 30.0, .prior_hazard = 0.1, .prior_weight = 10.0};
  ClutterHazard hazard(options, frame.cells);
  scan.range_m = {4.5F};  // upper layer: 5 crossings, 1 hit
  hazard.observe(before, scan, make_pose({0.0, 0.5, 1.5}, 0.0));
  scan.range_m = {kNoReturn};  // lower layer: 10 crossings, no hit
  hazard.observe(before, scan, make_pose({0.0, 0.5, 0.5}, 0.0));
  const double global = (1.0 + 10.0 * 0.1) / (15.0 + 10.0);
  EXPECT_DOUBLE_EQ(hazard.global_hazard(), global);
  EXPECT_DOUBLE_EQ(hazard.hazard(0), (0.0 + 30.0 * global) / (10.0 + 30.0));
  EXPECT_DOUBLE_EQ(hazard.hazard(1), (1.0 + 30.0 * global) / (5.0 + 30.0));
  const auto transmission = hazard.transmission_per_slice();
  EXPECT_DOUBLE_EQ(transmission[0], 1.0 - hazard.hazard(0));
  EXPECT_DOUBLE_EQ(transmission[1], 1.0 - hazard.hazard(1));
}

TEST(ClutterHazard, EachBlockHearsOfWhatWasCountedRoundIt) {
  GridFrame frame;
  frame.cells = {12, 1, 1};
  const OccupancyGrid before(frame);
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0};
  scan.range_m = {4.5F};  // 4 crossings in the first block; 1 and a hit in the second
  ClutterHazardOptions options{
      .layers = 1, .block_cells = 4, .reach_cells = 0.0, .block_crossings = 2.0};
  const auto transmission_after_scan = [&] {
    ClutterHazard hazard(options, frame.cells);
    hazard.observe(before, scan, make_pose({0.0, 0.5, 0.5}, 0.0));
    const double pull = 2.0 * hazard.hazard(0);
    return std::pair(pull, hazard.transmission().per_block);
  };
  const auto [pull, alone] = transmission_after_scan();
  ASSERT_EQ(alone.size(), 3U);
  EXPECT_DOUBLE_EQ(alone[0], 1.0 - pull / (4.0 + 2.0));
  EXPECT_DOUBLE_EQ(alone[1], 1.0 - (1.0 + pull) / (1.0 + 2.0));
  EXPECT_DOUBLE_EQ(alone[2], 1.0 - pull / 2.0) << "nothing was counted there";
  options.reach_cells = 4.0;
  const double next = std::exp(-0.5);
  const double over_next = std::exp(-2.0);
  const auto smooth = transmission_after_scan().second;
  EXPECT_DOUBLE_EQ(smooth[0], 1.0 - (next + pull) / (4.0 + next + 2.0));
  EXPECT_DOUBLE_EQ(smooth[1], 1.0 - (1.0 + pull) / (4.0 * next + 1.0 + 2.0));
  EXPECT_DOUBLE_EQ(smooth[2], 1.0 - (next + pull) / (4.0 * over_next + next + 2.0));
}

TEST(ClutterHazard, RejectsOptionsOutOfRange) {
  EXPECT_THROW(ClutterHazard({.layers = 0}, {4, 4, 4}), ConfigError);
  EXPECT_THROW(ClutterHazard({.prior_hazard = 0.0}, {4, 4, 4}), ConfigError);
}

// Voxels occupied at random, more of them low than high: the hazards come back.
TEST(ClutterHazard, RecoversAKnownHazardPerLayer) {
  constexpr int slices = 12;
  constexpr double low = 0.05;
  constexpr double high = 0.01;
  const GridFrame frame = make_grid_frame({0, 0, 0}, {60, 60, slices}, {60, 60, slices});
  const FieldOfView view{.half_width_rad = 0.6,
                         .tilt_min_rad = -0.12,
                         .tilt_max_rad = 0.12,
                         .range_min_m = 0.1,
                         .range_max_m = 200.0};
  ClutterHazard hazard({.layers = 2}, frame.cells);
  ClutterHazard shared({.layers = 2}, frame.cells);
  Rng rng(11);
  for (int scene = 0; scene < 30; ++scene) {
    OccupancyGrid truth(frame);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      truth.log_odds[i] = rng.uniform() < (frame.cell(i).z() < slices / 2 ? low : high) ? 2 : -1;
    }
    const Pose T_world_sensor = make_pose({-40.0, 0.1, 0.0}, 0.0);
    const RangeScan scan = test::scan_of(truth, T_world_sensor, view, 30, 60);
    hazard.observe(OccupancyGrid(frame), scan, T_world_sensor);
    shared.observe(OccupancyGrid(frame), scan, T_world_sensor, 3);
  }
  EXPECT_EQ(shared.transmission().per_block, hazard.transmission().per_block)
      << "it does not depend on threads";
  EXPECT_GT(hazard.crossings(0), 10'000.0);
  EXPECT_NEAR(hazard.hazard(0), low, 0.15 * low);
  EXPECT_NEAR(hazard.hazard(1), high, 0.15 * high);
}

TEST(ClutterHazard, CountsTheBeamsOfAnImage) {
  // Along x: a return in the fourth cell, one beyond range, none, and one in the second cell.
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {10.0, 4.0, 1.0}, {10, 1, 1}));
  CameraImages image;
  image.width_px = 4;
  image.height_px = 1;
  image.focal_px = 1000.0;
  image.range_max_m = 7.5;
  image.depth_m = {3.5F, std::numeric_limits<float>::infinity(), 0.0F, 1.5F};
  Pose T_world_camera = Pose::Identity();
  T_world_camera.translation() = Eigen::Vector3d(-5.0, 0.0, 0.0);
  T_world_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  const std::vector<PosedImage> images{{image, T_world_camera}};
  ClutterHazard every({.layers = 1}, grid.frame.cells);
  every.observe(grid, images, 1, -1.0);
  EXPECT_EQ(every.crossings(0), 4.0 + 8.0 + 2.0);
  EXPECT_EQ(every.hits(0), 2.0);
  ClutterHazard some({.layers = 1}, grid.frame.cells);
  some.observe(grid, images, 3, -1.0);
  EXPECT_EQ(some.crossings(0), 4.0 + 2.0);
  ClutterHazard level({.layers = 1}, grid.frame.cells);
  level.observe(grid, images, 1, 0.0);
  EXPECT_EQ(level.crossings(0), 4.0 + 8.0 + 2.0) << "the floor is what is lower than floor_m";
  EXPECT_EQ(level.hits(0), 2.0);
}

/// The range is along the ray, not along the axis: at the rim of a wide image it reaches less far
/// ahead.
TEST(ClutterHazard, ABeamOfAnImageWithoutReturnGoesAsFarAsTheRange) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {10.0, 20.0, 1.0}, {10, 1, 1}));
  CameraImages image;
  image.width_px = 3;
  image.height_px = 1;
  image.focal_px = 1.0;
  image.range_max_m = 7.5;
  image.depth_m = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F};
  Pose T_world_camera = Pose::Identity();
  T_world_camera.translation() = Eigen::Vector3d(-5.0, 0.0, 0.0);
  T_world_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  const std::vector<PosedImage> images{{image, T_world_camera}};
  ASSERT_GT(image.ray(0, 0).norm(), 1.2);
  ClutterHazard hazard({.layers = 1}, grid.frame.cells);
  hazard.observe(grid, images, 1, -1.0);
  EXPECT_EQ(hazard.crossings(0), std::ceil(7.5 / image.ray(0, 0).norm()));
  EXPECT_EQ(hazard.hits(0), 0.0);
}

/// A beam that comes down at 45 degrees from 4.5 m, so far.
CameraImages beam_down(double drop_m) {
  CameraImages image;
  image.width_px = 1;
  image.height_px = 1;
  image.focal_px = 1000.0;
  image.range_max_m = 20.0;
  image.depth_m = {static_cast<float>(drop_m * std::sqrt(2.0))};
  return image;
}

Pose camera_of_beam_down() {
  Pose T_world_camera = Pose::Identity();
  T_world_camera.translation() = Eigen::Vector3d(0.2, 0.0, 4.5);
  const double c = std::sqrt(0.5);
  T_world_camera.linear() << 0.0, -c, c, -1.0, 0.0, 0.0, 0.0, -c, -c;
  return T_world_camera;
}

/// A beam down to the floor, in cells of 1 m.
TEST(ClutterHazard, TheFloorIsNoClutter) {
  OccupancyGrid grid(make_grid_frame({5.0, 0.0, 5.0}, {10.0, 1.0, 10.0}, {10, 1, 10}));
  const CameraImages image = beam_down(4.49);
  const std::vector<PosedImage> images{{image, camera_of_beam_down()}};
  ClutterHazard taken_for_clutter({.layers = 10}, grid.frame.cells);
  taken_for_clutter.observe(grid, images, 1, 0.0);
  EXPECT_EQ(taken_for_clutter.hits(0), 1.0);
  ClutterHazard hazard({.layers = 10}, grid.frame.cells);
  hazard.observe(grid, images, 1, 1.0);
  EXPECT_EQ(hazard.hits(0), 0.0);
  EXPECT_EQ(hazard.crossings(0), 0.0) << "it counts down to floor_m and no farther";
  EXPECT_EQ(hazard.crossings(1), taken_for_clutter.crossings(1));
  for (const double floor_m : {4.5, 5.0}) {
    ClutterHazard below({.layers = 10}, grid.frame.cells);
    below.observe(grid, images, 1, floor_m);
    EXPECT_EQ(below.crossings(4), 0.0) << "a camera not above floor_m sees floor alone";
  }
}

TEST(ClutterHazard, BlocksLieAlongBothAxes) {
  GridFrame frame;
  frame.cells = {10, 8, 1};  // 3 x 2 blocks; x of 4, 3 and 3 cells
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0};
  scan.range_m = {4.5F};  // along y = 7.5: 4 crossings, then 1 and a hit
  ClutterHazard hazard({.layers = 1, .block_cells = 4, .reach_cells = 0.0, .block_crossings = 2.0},
                       frame.cells);
  hazard.observe(OccupancyGrid(frame), scan, make_pose({0.0, 7.5, 0.5}, 0.0));
  const BlockField transmission = hazard.transmission();
  const double pull = 2.0 * hazard.hazard(0);
  EXPECT_DOUBLE_EQ(transmission.at_cell({1, 5, 0}), 1.0 - pull / (4.0 + 2.0));
  EXPECT_DOUBLE_EQ(transmission.at_cell({5, 4, 0}), 1.0 - (1.0 + pull) / (1.0 + 2.0));
  EXPECT_DOUBLE_EQ(transmission.at_cell({1, 1, 0}), 1.0 - pull / 2.0);
  EXPECT_DOUBLE_EQ(transmission.at_cell({5, 1, 0}), 1.0 - pull / 2.0);
  EXPECT_DOUBLE_EQ(transmission.at_cell({9, 7, 0}), 1.0 - pull / 2.0);
}

/// Three rows at 45 degrees up, level and 45 degrees down.
TEST(ClutterHazard, RowsOfAnImageLieBelowEachOther) {
  const OccupancyGrid grid(make_grid_frame({5.0, 0.0, 0.0}, {10.0, 1.0, 10.0}, {10, 1, 10}));
  CameraImages image;
  image.width_px = 1;
  image.height_px = 3;
  image.focal_px = 1.0;
  image.range_max_m = 20.0;
  image.depth_m = {2.4F, 2.4F, 2.4F};
  Pose T_world_camera = Pose::Identity();
  T_world_camera.translation() = Eigen::Vector3d(0.1, 0.0, 0.5);
  T_world_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  const std::vector<PosedImage> images{{image, T_world_camera}};
  for (const int stride : {1, 2}) {
    ClutterHazard hazard({.layers = 10}, grid.frame.cells);
    hazard.observe(grid, images, stride, -10.0);
    EXPECT_EQ(hazard.hits(7), 1.0);
    EXPECT_EQ(hazard.hits(5), stride == 1 ? 1.0 : 0.0);
    EXPECT_EQ(hazard.hits(3), 1.0);
  }
}

TEST(ClutterHazard, ALayerWithoutPriorGoesByItsCountsAloneIfItHasAny) {
  GridFrame frame;
  frame.cells = {10, 1, 2};
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0};
  scan.range_m = {0.5F};  // upper layer: 1 crossing, a hit
  ClutterHazard hazard(
      {.layers = 2, .prior_crossings = 0.0, .prior_hazard = 0.1, .prior_weight = 10.0},
      frame.cells);
  EXPECT_DOUBLE_EQ(hazard.hazard(0), 0.1);
  hazard.observe(OccupancyGrid(frame), scan, make_pose({0.0, 0.5, 1.5}, 0.0));
  EXPECT_DOUBLE_EQ(hazard.hazard(0), 2.0 / 11.0) << "nothing was counted there";
  EXPECT_DOUBLE_EQ(hazard.hazard(1), 1.0);
}

/// From 4.5 m down at 45 degrees to 2 m; of that the floor takes what is below 3.25 m, half of it.
TEST(ClutterHazard, ABeamThatEndsFarBelowTheFloorIsCutThere) {
  const OccupancyGrid grid(make_grid_frame({5.0, 0.0, 5.0}, {10.0, 1.0, 10.0}, {10, 1, 10}));
  const CameraImages image = beam_down(2.5);
  const std::vector<PosedImage> images{{image, camera_of_beam_down()}};
  ClutterHazardOptions options;
  options.layers = 10;
  ClutterHazard hazard(options, grid.frame.cells);
  hazard.observe(grid, images, 1, 3.25);
  EXPECT_EQ(hazard.crossings(4), 1.0) << "x from 0.2 to 0.7";
  EXPECT_EQ(hazard.crossings(3), 2.0) << "x from 0.7 to 1.45";
  EXPECT_EQ(hazard.crossings(2), 0.0);
  EXPECT_EQ(hazard.hits(3), 0.0);
}

TEST(ClutterHazard, BeamsBehindAnInvalidOneCount) {
  const OccupancyGrid before = parse({"..????"});
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0, 0.0};
  scan.range_m = {std::numeric_limits<float>::quiet_NaN(), 3.5F};
  scan.field_of_view.range_max_m = 100.0;
  ClutterHazard hazard({.layers = 1}, before.frame.cells);
  hazard.observe(before, scan, make_pose({0.0, 0.5, 0.0}, 0.0));
  EXPECT_EQ(hazard.crossings(0), 2.0);
  EXPECT_EQ(hazard.hits(0), 1.0);
}

TEST(ClutterHazard, WithoutPriorASingleCrossingSaysAll) {
  const OccupancyGrid before = parse({"..????"});
  RangeScan scan;
  scan.tilt_rad = {0.0};
  scan.azimuth_rad = {0.0};
  scan.range_m = {2.5F};
  scan.field_of_view.range_max_m = 100.0;
  const ClutterHazardOptions options{
      .layers = 1, .prior_crossings = 0.0, .prior_hazard = 0.1, .prior_weight = 10.0};
  ClutterHazard hazard(options, before.frame.cells);
  EXPECT_NEAR(hazard.hazard(0), 0.1, 1e-12) << "of all layers";
  hazard.observe(before, scan, make_pose({0.0, 0.5, 0.0}, 0.0));
  EXPECT_EQ(hazard.hazard(0), 1.0);
  EXPECT_NEAR(hazard.global_hazard(), 2.0 / 11.0, 1e-12);
}

/// Ahead of it and 3 in 4 down.
TEST(ClutterHazard, ACameraOnTheFloorMeetsNothingBelowIt) {
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {10.0, 4.0, 4.0}, {10, 1, 4}));
  CameraImages image;
  image.width_px = 1;
  image.height_px = 1;
  image.focal_px = 1000.0;
  image.range_max_m = 7.5;
  image.depth_m = {2.0F};
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear() << 0.0, -0.6, 0.8, -1.0, 0.0, 0.0, 0.0, -0.8, -0.6;
  const auto crossings = [&](double height_m) {
    T_world_camera.translation() = Eigen::Vector3d(-4.5, 0.0, height_m);
    const std::vector<PosedImage> images{{image, T_world_camera}};
    ClutterHazard hazard({.layers = 1}, grid.frame.cells);
    hazard.observe(grid, images, 1, 0.0);
    return hazard.crossings(0);
  };
  EXPECT_EQ(crossings(0.0), 0.0);
  EXPECT_GT(crossings(0.5), 0.0);
}

/// What a walk along the beams counts in a layer.
Counted walked(const OccupancyGrid& grid, const RangeScan& scan, const Pose& T_world_sensor,
               const ClutterHazard& layers, int layer) {
  Counted counted{0.0, 0.0};
  const auto occupied = [&](std::size_t cell) { return grid.state(cell) == CellState::occupied; };
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const Eigen::Vector3d along = beam_direction({scan.azimuth_rad[i], scan.tilt_rad[0]});
    const Eigen::Vector3d p_end = T_world_sensor * (scan.range_m[i] * along);
    const Eigen::Array3i end = grid.frame.cell_at(p_end);
    walk_ray(grid.frame, T_world_sensor.translation(), p_end,
             [&](std::size_t index, const Eigen::Array3i& cell) {
               if (occupied(index)) return false;
               const bool clutter = grid.state(index) == CellState::unobserved &&
                                    !any_face_neighbour(grid.frame, cell, occupied);
               if (clutter && layers.layer_of(cell.z()) == layer) {
                 counted.crossings += 1.0;
                 if ((cell == end).all()) counted.hits += 1.0;
               }
               return true;
             });
  }
  return counted;
}

RC_GTEST_PROP(ClutterHazard, CountsInAPartOfALargeGridWhatTheWalkMeets, (std::uint64_t seed)) {
  Rng rng(seed);
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {6.0, 4.0, 3.0}, {60, 40, 30}));
  for (float& log_odds : grid.log_odds) {
    const double draw = rng.uniform(0.0, 1.0);
    if (draw < 0.02) log_odds = 2.0F;
    if (draw > 0.6) log_odds = -2.0F;
  }
  RangeScan scan;
  scan.tilt_rad = {rng.uniform(-1.0, 1.0)};
  for (int i = 0; i < 20; ++i) {
    scan.azimuth_rad.push_back(rng.uniform(-0.6, 0.6));
    scan.range_m.push_back(static_cast<float>(rng.uniform(0.2, 1.5)));
  }
  const Eigen::Vector3d p(rng.uniform(-4.0, 4.0), rng.uniform(-3.0, 3.0), rng.uniform(-2.0, 2.0));
  const Pose T_world_sensor = make_pose(p, rng.uniform(-3.0, 3.0));
  ClutterHazard hazard({.layers = 5}, grid.frame.cells);
  hazard.observe(grid, scan, T_world_sensor, 2);
  for (int layer = 0; layer < 5; ++layer) {
    const Counted expected = walked(grid, scan, T_world_sensor, hazard, layer);
    const Counted counted{hazard.crossings(layer), hazard.hits(layer)};
    RC_ASSERT(counted == expected);
  }
}

}  // namespace
}  // namespace vantage
