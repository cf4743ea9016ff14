// What is worked out once an episode is over: shortest ways on the true floor, and errors of poses
// that later loops have moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"

namespace vantage {
namespace {

/// 4 m of floor, and a wall across it at x = 0 that leaves the topmost metre open.
OpenFloor walled_floor(double inscribed_radius_m) {
  OpenFloor floor{free_floor({.cell_m = 0.1, .half_size_m = 2.0}), inscribed_radius_m};
  block_box(floor.map, {Eigen::Vector2d(-0.04, -2.0), Eigen::Vector2d(0.04, 0.96)});
  return floor;
}

const std::vector<Eigen::Vector2d> kPlaces{
    {-1.05, 0.05}, {1.05, 0.05}, {-0.85, -1.05}, {5.0, 0.05}};

TEST(FreeFloor, IsFreeAllOver) {
  const FloorMap floor = free_floor({.cell_m = 0.1, .half_size_m = 2.0});
  EXPECT_EQ(floor.size(), 1600U);
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    ASSERT_EQ(floor.state(cell), CellState::free);
  }
}

/// Round the wall are 18 diagonal steps and 5 straight ones, of 0.1 m.
TEST(LeastWays, AreNoLongerThanThoseOfCells) {
  const Eigen::MatrixXd way_m = least_ways_m(walled_floor(0.3), kPlaces, 1);
  ASSERT_EQ(way_m.rows(), 4);
  ASSERT_EQ(way_m.cols(), 4);
  const double cells_m = 1.8 * std::numbers::sqrt2 + 0.5;
  const double off_m = 0.2 * std::numbers::sqrt2;
  EXPECT_NEAR(way_m(0, 1), (cells_m - off_m) * std::cos(std::numbers::pi / 8.0), 1e-5);
  EXPECT_NEAR(way_m(0, 1), 2.55244, 1e-5);
  EXPECT_EQ(way_m(1, 0), way_m(0, 1));
  EXPECT_NEAR(way_m(0, 2), std::hypot(0.2, 1.1), 1e-9) << "straight on, on the same side";
  for (int i = 0; i < 4; ++i) EXPECT_EQ(way_m(i, i), 0.0);
}

TEST(LeastWays, AreStraightWhereNoWayIsKnown) {
  EXPECT_NEAR(least_ways_m(walled_floor(0.3), kPlaces, 1)(0, 3), 6.05, 1e-9) << "off the floor";
  EXPECT_NEAR(least_ways_m(walled_floor(1.5), kPlaces, 1)(0, 1), 2.1, 1e-9)
      << "wider than what is open";
}

/// The robot was 0.1 m behind where it believed to be, along its heading of 0.3.
TEST(MovedPoses, AreHeldAgainstWhereTheRobotWas) {
  ScanRecord record;
  record.T_world_base = {1.0, 2.0, 0.3};
  record.T_true_kept = {0.1, 0.0, 0.0};
  GroundTruthMapEvaluator::measure_moved_pose({1.5, 2.4, 0.5}, record);
  EXPECT_NEAR(record.pose_error_m, std::hypot(0.5 + 0.1 * std::cos(0.3), 0.4 + 0.1 * std::sin(0.3)),
              1e-12);
  EXPECT_NEAR(record.yaw_error_rad, 0.2, 1e-12);
  EXPECT_EQ(record.T_world_base.x_m, 1.5);
  EXPECT_EQ(record.T_world_base.yaw_rad, 0.5);
  GroundTruthMapEvaluator::measure_moved_pose({1.0, 2.0, 0.25}, record);
  EXPECT_NEAR(record.pose_error_m, 0.1, 1e-12) << "and moved back";
  EXPECT_NEAR(record.yaw_error_rad, -0.05, 1e-12);
}

}  // namespace
}  // namespace vantage
