// castRay looks at the same map, as far round as exact rays do: else their times say nothing.
#include "bench/castray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/belief/map/voxel_scene.hpp"
#include "vantage/planners/exact_gain.hpp"

namespace vantage::bench {
namespace {

constexpr float kFree = -1.0F;
constexpr float kUnobserved = 0.0F;
constexpr float kOccupied = 2.0F;

const Eigen::Vector3d kEye_m(0.313, -0.179, 0.507);
const FieldOfView kAllRound{.tilt_min_rad = -0.2,
                            .tilt_max_rad = 0.2,
                            .range_min_m = 0.0,
                            .range_max_m = 3.0,
                            .panorama = true};
const RgbdOptions kCoarse{.height_px = 60, .fovy_rad = 0.6};  // 0.01 rad a pixel

struct Ring {
  double inner_m;
  double outer_m;
  float log_odds;
};

/// Free round the eye, then a ring, then what is beyond; cells are no cubes.
OccupancyGrid round_room(const Ring& ring, float beyond) {
  OccupancyGrid grid(make_grid_frame({0.3, -0.2, 0.5}, {4.0, 4.0, 1.0}, {40, 50, 25}));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3d from_eye = grid.frame.centre(grid.frame.cell(i)) - kEye_m;
    const double distance_m = from_eye.head<2>().norm();
    grid.log_odds[i] = distance_m < ring.inner_m   ? kFree
                       : distance_m < ring.outer_m ? ring.log_odds
                                                   : beyond;
  }
  return grid;
}

double castray_gain(const OccupancyGrid& grid) {
  return CastrayGain(grid).of_view(make_pose(kEye_m, 0.4), image_beams(kCoarse, kAllRound),
                                   kAllRound.range_max_m);
}

double exact_gain(const OccupancyGrid& grid) {
  return exact_gain_bits(SimpleGain{}, {grid}, make_pose(kEye_m, 0.4), kAllRound);
}

TEST(Castray, TreeIsTheMapWithoutHoles) {
  struct Map {
    std::array<double, 3> size_m;
    std::array<int, 3> cells;
  };
  constexpr std::array kPart{21, 31, 9};
  Rng rng(3);
  for (const Map& map :
       {Map{{1.0, 1.0, 0.504}, {129, 129, 65}}, Map{{15.0, 10.0, 2.0}, {257, 257, 65}},
        Map{{20.0, 25.0, 2.0}, {257, 257, 65}}}) {
    std::array<double, 3> part_m{};
    for (std::size_t i = 0; i < 3; ++i) part_m[i] = map.size_m[i] * kPart[i] / map.cells[i];
    const GridFrame frame = make_grid_frame({0.1, -0.2, 0.982}, part_m, kPart);
    const OccupancyGrid grid = test::random_grid(frame, 0.3, 0.4, rng);
    const CastrayGain castray(grid);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      ASSERT_EQ(castray.state_at(frame.centre(frame.cell(i))), grid.state(i)) << "cell " << i;
    }
    const double edge_m = frame.cell_size_m.minCoeff();
    const GridFrame voxels{frame.min_corner_m, Eigen::Vector3d::Constant(edge_m),
                           (frame.box().sizes().array() / edge_m - 0.5).floor().cast<int>() + 1};
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      const Eigen::Vector3d p = voxels.centre(voxels.cell(i));
      ASSERT_EQ(castray.state_at(p), grid.state(frame.index(frame.cell_at(p)))) << "voxel " << i;
    }
  }
}

TEST(Castray, KnownWallsEndRays) {
  const OccupancyGrid grid = round_room({1.0, 1.25, kOccupied}, kUnobserved);
  EXPECT_EQ(castray_gain(grid), 0.0);
  EXPECT_EQ(exact_gain(grid), 0.0);
}

/// Beams that are a step apart cross a cell at a distance d (edge / (d step))^2 times, and more
/// where they cross it askew: up to sqrt(3) as many voxels are on a ray as it is edges long.
TEST(Castray, PanoramaShowsWhatExactRaysShow) {
  const OccupancyGrid grid = round_room({1.5, 1.8, kUnobserved}, kOccupied);
  const double edge_m = grid.frame.cell_size_m.minCoeff();
  const double voxels = exact_gain(grid) * grid.frame.cell_size_m.prod() / std::pow(edge_m, 3);
  const double times = std::pow(edge_m / (1.65 * 0.01), 2);
  ASSERT_GT(voxels, 1000.0);
  EXPECT_GT(castray_gain(grid), voxels * times);
  EXPECT_LT(castray_gain(grid), std::sqrt(3.0) * voxels * times);
}

TEST(Castray, LaserHasTheBeamsOfAScan) {
  const LaserOptions laser;
  const auto beams = laser_beams(laser);
  EXPECT_EQ(beams.size(), 61U * 601U);
  FieldOfView field = field_of_view(laser);
  field.half_width_rad += 1e-9;
  field.tilt_min_rad -= 1e-9;
  field.tilt_max_rad += 1e-9;
  EXPECT_TRUE(std::ranges::all_of(
      beams, [&](const Eigen::Vector3d& beam) { return field.contains(beam); }));
  EXPECT_TRUE(beams.front().isApprox(
      beam_direction({-field_of_view(laser).half_width_rad, laser.tilt_min_rad})));
  EXPECT_TRUE(beams.back().isApprox(
      beam_direction({field_of_view(laser).half_width_rad, laser.tilt_max_rad})));
}

}  // namespace
}  // namespace vantage::bench
