#include "vantage/geometry/view_cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

Pose random_pose(Rng& rng) {
  return make_pose({rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)},
                   rng.uniform(-4.0, 4.0), rng.uniform(-1.0, 1.0));
}

FieldOfView random_sector(Rng& rng) {
  FieldOfView fov;
  fov.half_width_rad = rng.uniform(0.05, 3.1);
  fov.tilt_min_rad = rng.uniform(-1.2, 0.5);
  fov.tilt_max_rad = fov.tilt_min_rad + rng.uniform(0.1, 0.9);
  fov.range_min_m = rng.uniform(0.0, 0.5);
  fov.range_max_m = rng.uniform(0.8, 2.0);
  fov.panorama = rng.uniform() < 0.3;
  return fov;
}

TEST(ViewCone, ContainsWhatTheFieldOfViewContains) {
  Rng rng(7);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const FieldOfView fov = random_sector(rng);
    const Pose T_world_sensor = random_pose(rng);
    const Eigen::Vector3d p(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
    const bool expected = fov.contains(T_world_sensor.inverse() * p);
    EXPECT_EQ(ViewCone(T_world_sensor, fov).contains(p), expected) << "draw " << i;
    inside += expected ? 1 : 0;
  }
  EXPECT_GT(inside, 200);
}

TEST(ConeRow, ContainsWhatTheConeContainsButForRoundingAtTheRim) {
  Rng rng(13);
  int inside = 0;
  int different = 0;
  for (int i = 0; i < 20000; ++i) {
    const ViewCone cone(random_pose(rng), random_sector(rng));
    const Eigen::Vector3d p(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
    const Eigen::Vector3d step(rng.uniform(0.01, 0.1), 0.0, 0.0);
    const ConeRow row = cone.row(p, step);
    for (const int k : {0, 5, 40}) {
      const bool expected = cone.contains(p + k * step);
      inside += expected ? 1 : 0;
      different += row.contains(static_cast<float>(k)) == expected ? 0 : 1;
    }
  }
  EXPECT_GT(inside, 600);
  EXPECT_LE(different, 2);
}

TEST(ForEachCellInView, MissesNoCellAndVisitsInOrder) {
  Rng rng(11);
  const GridFrame grid = make_grid_frame({0.1, 0.0, -0.1}, {2.0, 1.5, 1.0}, {20, 13, 9});
  std::size_t found = 0;
  for (int i = 0; i < 200; ++i) {
    const FieldOfView fov = random_sector(rng);
    const ViewCone cone(random_pose(rng), fov);
    std::vector<std::size_t> expected;
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      if (cell % 3 != 0 && cone.contains(grid.centre(grid.cell(cell)))) expected.push_back(cell);
    }
    std::vector<std::size_t> visited;
    for_each_cell_in_view(
        grid, cone, [](std::size_t cell) { return cell % 3 != 0; },
        [&](const Eigen::Array3i& cell, std::size_t index) {
          EXPECT_EQ(grid.index(cell), index);
          visited.push_back(index);
        });
    EXPECT_EQ(visited, expected) << "draw " << i;
    found += visited.size();
  }
  EXPECT_GT(found, 1000U);
}

TEST(ForEachCellInView, LooksAtTheSlicesAskedFor) {
  const GridFrame grid = make_grid_frame({0.8, 0.0, 0.0}, {1.5, 1.2, 1.0}, {15, 13, 9});
  FieldOfView fov;
  fov.half_width_rad = 0.6;
  fov.tilt_min_rad = -0.5;
  fov.tilt_max_rad = 0.7;
  const ViewCone cone(make_pose({-0.1, 0.1, 0.2}, 0.2), fov);
  const auto all = [](std::size_t) { return true; };
  std::vector<std::size_t> expected;
  for_each_cell_in_view(grid, cone, all, [&](const Eigen::Array3i& cell, std::size_t index) {
    if (cell.z() >= 2 && cell.z() < 5) expected.push_back(index);
  });
  std::vector<std::size_t> visited;
  for_each_cell_in_view(grid, cone, 2, 5, all, [&](const Eigen::Array3i&, std::size_t index) {
    visited.push_back(index);
  });
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(visited, expected);
}

TEST(ViewCone, RangesBelongToIt) {
  FieldOfView fov;
  fov.range_min_m = 0.5;
  fov.range_max_m = 2.0;
  for (const bool panorama : {false, true}) {
    fov.panorama = panorama;
    const ViewCone cone(make_pose({1.0, 2.0, 3.0}, 0.0), fov);
    EXPECT_TRUE(cone.contains({1.5, 2.0, 3.0}));
    EXPECT_FALSE(cone.contains({1.4375, 2.0, 3.0}));
    EXPECT_TRUE(cone.contains({3.0, 2.0, 3.0}));
    EXPECT_FALSE(cone.contains({3.0625, 2.0, 3.0}));
    EXPECT_EQ(cone.range2_min_m2(), 0.25);
    EXPECT_EQ(cone.range2_max_m2(), 4.0);
    EXPECT_EQ(cone.apex_m(), Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(cone.normals().size(), panorama ? 0U : 5U);
  }
}

TEST(ViewCone, KnowsWhatLiesAcrossItsSector) {
  FieldOfView fov;
  fov.half_width_rad = 0.4;
  const ViewCone cone(make_pose({0.0, 0.0, 1.0}, 0.3, 0.2), fov);
  EXPECT_TRUE(cone.across().isApprox(Eigen::Vector3d(-std::sin(0.3), std::cos(0.3), 0.0)));
  EXPECT_NEAR(cone.sin2_half_width(), std::sin(0.4) * std::sin(0.4), 1e-15);
  fov.half_width_rad = std::numbers::pi;
  EXPECT_EQ(ViewCone(Pose::Identity(), fov).sin2_half_width(), 0.0);
  EXPECT_TRUE(ViewCone(Pose::Identity(), fov).normals().empty());
}

TEST(RowBounds, ExactRunsHoldWhatTheConeContainsButForRoundingAtTheRim) {
  Rng rng(17);
  int exact = 0;
  int twofold = 0;
  int inside = 0;
  int different = 0;
  for (int draw = 0; draw < 40000; ++draw) {
    const ViewCone cone(random_pose(rng), random_sector(rng));
    const Eigen::Vector3d p(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
    const Eigen::Vector3d step =
        0.05 * Eigen::Vector3d(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), 1.0);
    const auto seen = RowBounds(cone, step).runs_of_row(p, 3, 60);
    exact += seen.exact ? 1 : 0;
    twofold += seen.runs[1].begin < seen.runs[1].end ? 1 : 0;
    for (int i = 3; i < 60; ++i) {
      const bool in_run = std::ranges::any_of(
          seen.runs, [&](const auto& run) { return i >= run.begin && i < run.end; });
      const bool contained = cone.contains(p + i * step);
      EXPECT_TRUE(in_run || !contained || seen.exact) << "draw " << draw << ", cell " << i;
      if (!seen.exact) continue;
      inside += contained ? 1 : 0;
      different += in_run == contained ? 0 : 1;
    }
  }
  EXPECT_GT(exact, 1000);
  EXPECT_GT(twofold, 10);
  EXPECT_GT(inside, 3000);
  EXPECT_LE(different, 2);
}

TEST(RowBounds, HoldTheSector) {
  // A level sensor at the origin that looks along x; a row of cells across its view at x = 1.
  FieldOfView fov;
  fov.half_width_rad = 0.2;
  fov.tilt_min_rad = -0.01;
  fov.tilt_max_rad = 0.01;
  const ViewCone cone(Pose::Identity(), fov);
  const auto row = RowBounds(cone, {0.0, 0.1, 0.0}).of_row({1.0, -5.0, 0.0}, 101);
  EXPECT_GE(row.begin, 47);
  EXPECT_LE(row.end, 54);
  EXPECT_GE(row.end - row.begin, 5);
}

TEST(RowBounds, AreOfNothingAtFirst) {
  EXPECT_EQ(RowBounds::Interval{}.begin, 0);
  EXPECT_EQ(RowBounds::Interval{}.end, 0);
  EXPECT_FALSE(RowBounds::Runs{}.exact);
  const ConeRow row;
  for (const float value :
       {row.tan_tilt_min, row.tan_tilt_max, row.sin2_half_width, row.max_excess_ahead_m2,
        row.min_excess_behind_m2, row.range2_min_m2, row.range2_max_m2, row.all_round}) {
    EXPECT_EQ(value, 0.0F);
  }
}

}  // namespace
}  // namespace vantage
