#include "vantage/belief/map/free_space.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/belief/map/voxel_scene.hpp"

namespace vantage {
namespace {

using test::Drawing;
using test::parse;
using test::random_grid;
using test::scan_of;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

FieldOfView wide_view(double half_width_rad, double range_max_m) {
  return {.half_width_rad = half_width_rad,
          .tilt_min_rad = -0.2,
          .tilt_max_rad = 0.2,
          .range_min_m = 0.01,
          .range_max_m = range_max_m};
}

Pose sensor_at(double x_m, double y_m) { return make_pose({x_m, y_m, 0.0}, 0.0); }

/// What a laser at the left edge, in the middle row, makes of the scene.
Drawing carved(const Drawing& truth, const Drawing& known, const FieldOfView& view) {
  const OccupancyGrid scene = parse(truth);
  const Pose T_world_sensor = sensor_at(0.0, 0.5 * static_cast<double>(truth.size()));
  OccupancyGrid map = parse(known);
  carve_free_space(map, scan_of(scene, T_world_sensor, view, 3, 401), T_world_sensor, {});
  return test::draw(map);
}

TEST(FreeSpace, FreesTheSectorUpToTheWallAndNothingBehindIt) {
  const Drawing truth{"...........",  //
                      "...........",  //
                      "......#....",  //
                      "......#....",  //
                      "......#....",  //
                      "...........",  //
                      "..........."};
  const Drawing known{"???????????",  //
                      "???????????",  //
                      "??????#????",  //
                      "??????#????",  //
                      "??????#????",  //
                      "???????????",  //
                      "???????????"};
  EXPECT_EQ(carved(truth, known, wide_view(0.45, 9.0)), (Drawing{"??????..???",  //
                                                                 "????....???",  //
                                                                 "??....#????",  //
                                                                 "......#????",  //
                                                                 "??....#????",  //
                                                                 "????....???",  //
                                                                 "??????..???"}));
}

TEST(FreeSpace, MeasuredDepthAloneStopsItWhereTheMapKnowsNoSurface) {
  const Drawing truth{"...#....", "...#....", "...#...."};
  const Drawing known{"????????", "????????", "????????"};
  const Drawing result = carved(truth, known, wide_view(0.9, 20.0));
  for (const std::string& row : result) EXPECT_EQ(row.substr(3), "?????");
  EXPECT_EQ(result[1].substr(0, 3), "...");
}

TEST(FreeSpace, KnownOccupiedCellStopsItWhereTheBeamsWentOn) {
  const Drawing truth{"........"};
  EXPECT_EQ(carved(truth, {"???#????"}, wide_view(0.5, 20.0)), (Drawing{"...#????"}));
}

TEST(FreeSpace, StaysWithinRange) {
  const Drawing truth{"........"};
  EXPECT_EQ(carved(truth, {"????????"}, wide_view(0.5, 5.0)), (Drawing{".....???"}));
}

TEST(FreeSpace, LeavesKnownCellsAlone) {
  OccupancyGrid map = parse({"..??.#"});
  const OccupancyGrid before = map;
  const Pose T_world_sensor = sensor_at(0.0, 0.5);
  const RangeScan scan = scan_of(parse({"......"}), T_world_sensor, wide_view(0.5, 20.0), 3, 11);
  EXPECT_EQ(carve_free_space(map, scan, T_world_sensor, {}), 2U);
  for (const int x : {0, 1, 4, 5}) EXPECT_EQ(map.log_odds[x], before.log_odds[x]);
}

TEST(FreeSpace, InvalidBeamsFreeNothing) {
  OccupancyGrid map = parse({"????????"});
  const Pose T_world_sensor = sensor_at(0.0, 0.5);
  RangeScan scan = scan_of(map, T_world_sensor, wide_view(0.5, 20.0), 3, 11);
  std::ranges::fill(scan.range_m, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(carve_free_space(map, scan, T_world_sensor, {}), 0U);
}

TEST(FreeSpace, OnePassFreesEvenACellNearlyOccupied) {
  OccupancyGrid map = parse({"????????"});
  std::ranges::fill(map.log_odds, std::nextafter(kOccupiedLogOdds, 0.0F));
  const Pose T_world_sensor = sensor_at(0.0, 0.5);
  const RangeScan scan = scan_of(parse({"........"}), T_world_sensor, wide_view(0.5, 20.0), 3, 11);
  EXPECT_EQ(carve_free_space(map, scan, T_world_sensor, {}), 8U);
  EXPECT_EQ(map.count(CellState::free), 8U);
}

TEST(FreeSpace, RejectsOptionsOutOfRange) {
  OccupancyGrid map = parse({"????"});
  EXPECT_THROW(carve_free_space(map, RangeScan{}, Pose::Identity(), {.p_free_given_pass = 0.6}),
               ConfigError);
}

/// The rules of the header, cell by cell, without the grid walk: a cell blocks if the line of sight
/// passes through its box. `touching` lines, where rounding decides, are left out.
enum class Verdict { keep, free, touching };
Verdict judge(const OccupancyGrid& grid, const RangeScan& scan, const Pose& T_world_sensor,
              std::size_t cell) {
  const double p = grid.p_occupied(cell);
  const Eigen::Vector3d p_world = grid.frame.centre(grid.frame.cell(cell));
  const Eigen::Vector3d p_sensor = T_world_sensor.inverse() * p_world;
  if (p <= 0.4 || p >= 0.6 || !scan.field_of_view.contains(p_sensor)) return Verdict::keep;
  const float swept_m = scan.swept_range(beam_angles(p_sensor));
  if (std::isnan(swept_m) || p_sensor.norm() >= swept_m) return Verdict::keep;
  Verdict verdict = Verdict::free;
  for (std::size_t other = 0; other < grid.size(); ++other) {
    if (grid.p_occupied(other) < 0.6) continue;
    const SegmentClip clip =
        clip_segment(test::box_of_cell(grid.frame, other), T_world_sensor.translation(), p_world);
    const double length = clip.leave - clip.enter;
    if (length > 1e-9) return Verdict::keep;
    if (length > -1e-9) verdict = Verdict::touching;
  }
  return verdict;
}

struct RandomCase {
  OccupancyGrid map;
  RangeScan scan;
  Pose T_world_sensor;
};

RandomCase random_case(Rng& rng) {
  const GridFrame frame = make_grid_frame({0.2, -0.1, 0.3}, {1.0, 1.2, 0.5}, {9, 8, 6});
  RandomCase c;
  const OccupancyGrid truth = random_grid(frame, 0.03, 0.97, rng);
  c.map = random_grid(frame, rng.uniform(0.0, 0.05), 0.3, rng);
  c.T_world_sensor =
      make_pose({rng.uniform(-1.2, 0.5), rng.uniform(-1.0, 1.0), rng.uniform(0.1, 0.8)},
                rng.uniform(-3.0, 3.0), rng.uniform(-0.3, 0.3));
  const FieldOfView view{.half_width_rad = rng.uniform(0.1, 1.5),
                         .tilt_min_rad = rng.uniform(-1.2, -0.1),
                         .tilt_max_rad = rng.uniform(0.1, 1.2),
                         .range_min_m = rng.uniform(0.0, 0.2),
                         .range_max_m = rng.uniform(0.5, 3.0)};
  c.scan = scan_of(truth, c.T_world_sensor, view, 15, 25);
  for (float& range_m : c.scan.range_m) {
    if (rng.uniform() < 0.01) range_m = std::numeric_limits<float>::quiet_NaN();
    if (rng.uniform() < 0.01) range_m = kInfinity;
  }
  return c;
}

RC_GTEST_PROP(FreeSpaceProperty, FreesExactlyTheCellsOfTheDefinition, (std::uint64_t seed)) {
  Rng rng(seed);
  const RandomCase c = random_case(rng);
  OccupancyGrid after = c.map;
  const std::size_t freed = carve_free_space(after, c.scan, c.T_world_sensor, {});
  std::size_t changed = 0;
  for (std::size_t cell = 0; cell < after.size(); ++cell) {
    const bool lowered = after.log_odds[cell] < c.map.log_odds[cell];
    changed += lowered ? 1 : 0;
    RC_ASSERT(lowered || after.log_odds[cell] == c.map.log_odds[cell]);
    const Verdict verdict = judge(c.map, c.scan, c.T_world_sensor, cell);
    if (verdict != Verdict::touching) RC_ASSERT(lowered == (verdict == Verdict::free));
    if (lowered) RC_ASSERT(after.state(cell) == CellState::free);
  }
  RC_ASSERT(changed == freed);
}

RC_GTEST_PROP(FreeSpaceProperty, ThreadsChangeNothing, (std::uint64_t seed)) {
  Rng rng(seed);
  const RandomCase c = random_case(rng);
  OccupancyGrid alone = c.map;
  const std::size_t freed = carve_free_space(alone, c.scan, c.T_world_sensor, {}, 1);
  for (const int threads : {2, 5, 1000}) {
    OccupancyGrid shared = c.map;
    RC_ASSERT(carve_free_space(shared, c.scan, c.T_world_sensor, {}, threads) == freed);
    RC_ASSERT(shared.log_odds == alone.log_odds);
  }
}

RC_GTEST_PROP(FreeSpaceProperty, NeverFreesOutsideTheSectorOrBehindTheDepth, (std::uint64_t seed)) {
  Rng rng(seed);
  const RandomCase c = random_case(rng);
  OccupancyGrid after = c.map;
  carve_free_space(after, c.scan, c.T_world_sensor, {});
  for (std::size_t cell = 0; cell < after.size(); ++cell) {
    if (after.log_odds[cell] == c.map.log_odds[cell]) continue;
    const Eigen::Vector3d p_sensor =
        c.T_world_sensor.inverse() * c.map.frame.centre(c.map.frame.cell(cell));
    const BeamAngles angles = beam_angles(p_sensor);
    RC_ASSERT(std::abs(angles.azimuth_rad) <= c.scan.field_of_view.half_width_rad);
    RC_ASSERT(angles.tilt_rad >= c.scan.field_of_view.tilt_min_rad);
    RC_ASSERT(angles.tilt_rad <= c.scan.field_of_view.tilt_max_rad);
    RC_ASSERT(p_sensor.norm() <= c.scan.field_of_view.range_max_m);
    RC_ASSERT(p_sensor.norm() < c.scan.swept_range(angles));
  }
}

/// What a camera (OpenCV's axes) measures in a scene of voxels.
CameraImages image_of(const OccupancyGrid& truth, const Pose& T_world_camera, double focal_px,
                      double range_max_m) {
  CameraImages image;
  image.width_px = 32;
  image.height_px = 24;
  image.focal_px = focal_px;
  image.range_max_m = range_max_m;
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const Eigen::Vector3d ray = image.ray(row, column);
      const Eigen::Vector3d p_end = T_world_camera * (range_max_m * ray);
      float depth_m = kInfinity;
      walk_ray(truth.frame, T_world_camera.translation(), p_end, [&](std::size_t cell) {
        if (truth.state(cell) != CellState::occupied) return true;
        const SegmentClip clip =
            clip_segment(test::box_of_cell(truth.frame, cell), T_world_camera.translation(), p_end);
        depth_m = static_cast<float>(0.5 * (clip.enter + clip.leave) * range_max_m);
        return false;
      });
      image.depth_m.push_back(depth_m);
    }
  }
  return image;
}

struct RandomImage {
  OccupancyGrid map;
  CameraImages image;
  Pose T_world_camera;
};

RandomImage random_image(Rng& rng) {
  const GridFrame frame = make_grid_frame({0.2, -0.1, 0.3}, {1.0, 1.2, 0.5}, {9, 8, 6});
  RandomImage c;
  const OccupancyGrid truth = random_grid(frame, 0.03, 0.97, rng);
  c.map = random_grid(frame, rng.uniform(0.0, 0.05), 0.3, rng);
  Pose forward_is_x = Pose::Identity();
  forward_is_x.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  c.T_world_camera =
      make_pose({rng.uniform(-1.2, 0.5), rng.uniform(-1.0, 1.0), rng.uniform(0.1, 0.8)},
                rng.uniform(-3.0, 3.0), rng.uniform(-0.3, 0.3)) *
      forward_is_x;
  c.image = image_of(truth, c.T_world_camera, rng.uniform(10.0, 40.0), rng.uniform(0.4, 3.0));
  for (float& depth_m : c.image.depth_m) {
    if (rng.uniform() < 0.02) depth_m = 0.0F;
  }
  return c;
}

/// The rules of the header without the grid walk, and the four pixels by name.
Verdict judge(const OccupancyGrid& grid, const CameraImages& image, const Pose& T_world_camera,
              std::size_t cell) {
  if (grid.state(cell) != CellState::unobserved) return Verdict::keep;
  const Eigen::Vector3d p_world = grid.frame.centre(grid.frame.cell(cell));
  const Eigen::Vector3d p = T_world_camera.inverse() * p_world;
  if (p.z() <= 0.0 || p.norm() > image.range_max_m) return Verdict::keep;
  const double u = image.focal_px * p.x() / p.z() + 0.5 * (image.width_px - 1);
  const double v = image.focal_px * p.y() / p.z() + 0.5 * (image.height_px - 1);
  if (u < 0.0 || v < 0.0 || u > image.width_px - 1 || v > image.height_px - 1) return Verdict::keep;
  for (const double row : {std::floor(v), std::ceil(v)}) {
    for (const double column : {std::floor(u), std::ceil(u)}) {
      const float depth = image.depth_at(static_cast<int>(row), static_cast<int>(column));
      if (depth == 0.0F || depth <= p.z()) return Verdict::keep;
    }
  }
  Verdict verdict = Verdict::free;
  for (std::size_t other = 0; other < grid.size(); ++other) {
    if (grid.state(other) != CellState::occupied) continue;
    const SegmentClip clip =
        clip_segment(test::box_of_cell(grid.frame, other), T_world_camera.translation(), p_world);
    const double length = clip.leave - clip.enter;
    if (length > 1e-9) return Verdict::keep;
    if (length > -1e-9) verdict = Verdict::touching;
  }
  return verdict;
}

RC_GTEST_PROP(FreeSpaceOfImages, FreesExactlyTheCellsOfTheDefinition, (std::uint64_t seed)) {
  Rng rng(seed);
  const RandomImage c = random_image(rng);
  OccupancyGrid after = c.map;
  const std::size_t freed = carve_free_space(after, c.image, c.T_world_camera, {}, 2);
  std::size_t changed = 0;
  for (std::size_t cell = 0; cell < after.size(); ++cell) {
    const bool lowered = after.log_odds[cell] < c.map.log_odds[cell];
    changed += lowered ? 1 : 0;
    RC_ASSERT(lowered || after.log_odds[cell] == c.map.log_odds[cell]);
    const Verdict verdict = judge(c.map, c.image, c.T_world_camera, cell);
    if (verdict != Verdict::touching) RC_ASSERT(lowered == (verdict == Verdict::free));
  }
  RC_ASSERT(changed == freed);
}

TEST(FreeSpaceOfImages, FreesSomething) {
  Rng rng(3);
  std::size_t freed = 0;
  for (int i = 0; i < 50; ++i) {
    RandomImage c = random_image(rng);
    freed += carve_free_space(c.map, c.image, c.T_world_camera, {});
  }
  EXPECT_GT(freed, 500U);
}

TEST(FreeSpaceOfImages, NoReadingFreesNothing) {
  Rng rng(4);
  RandomImage c = random_image(rng);
  std::ranges::fill(c.image.depth_m, 0.0F);
  EXPECT_EQ(carve_free_space(c.map, c.image, c.T_world_camera, {}), 0U);
}

/// Of lines that meet corners of cells, where the walk from the other end takes another way.
TEST(FreeSpace, WalksFromTheSensorToTheCell) {
  Rng rng(9);
  const Pose T_world_sensor = sensor_at(0.5, 4.5);
  const FieldOfView view = wide_view(1.5, 20.0);
  int hidden = 0;
  for (int world = 0; world < 30; ++world) {
    OccupancyGrid map = parse(Drawing(9, "?????????"));
    const RangeScan scan = scan_of(map, T_world_sensor, view, 3, 401);
    for (float& log_odds : map.log_odds) log_odds = rng.uniform() < 0.15 ? 2.0F : 0.0F;
    const OccupancyGrid before = map;
    carve_free_space(map, scan, T_world_sensor, {});
    for (std::size_t cell = 0; cell < map.size(); ++cell) {
      if (before.state(cell) != CellState::unobserved) continue;
      const Eigen::Vector3d p_world = map.frame.centre(map.frame.cell(cell));
      if (!view.contains(T_world_sensor.inverse() * p_world)) continue;
      const bool clear =
          walk_ray(map.frame, T_world_sensor.translation(), p_world,
                   [&](std::size_t at) { return before.state(at) != CellState::occupied; });
      EXPECT_EQ(map.state(cell) == CellState::free, clear) << world << " " << cell;
      hidden += clear ? 0 : 1;
    }
  }
  EXPECT_GT(hidden, 100);
}

}  // namespace
}  // namespace vantage
