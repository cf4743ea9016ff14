// Which frontiers become views: of four round what is not seen yet, on open floor.
#include "vantage/tasks/exploration/frontier_views.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

using Places = std::vector<Eigen::Vector2d>;

/// Where the robot stands for the frontiers round 4, 2, 1 and 1 cells of 25 cm, the largest first:
/// the second is 1 m from the first, the third 2 m, the last far away.
const Eigen::Vector2d kLargest(-3.125, -3.375);
const Eigen::Vector2d kBeside(-3.125, -2.375);
const Eigen::Vector2d kNext(-1.125, -3.375);
const Eigen::Vector2d kFar(2.375, 2.125);

FloorMap open_floor() {
  FloorMap floor({-4.5, -4.5}, 0.1, 90, 90);
  floor.log_odds.assign(floor.size(), -2.0F);
  return floor;
}

Eigen::Vector2d place_of_view(const Candidate& view) {
  return view.T_world_sensor.translation().head<2>();
}

class FrontierViews : public testing::Test {
 protected:
  FrontierViews() {
    task_.frontiers.min_cells = 1;
    grid_.log_odds.assign(grid_.size(), -3.0F);
    for (const auto& [first, count, y] :
         std::vector<std::array<int, 3>>{{2, 4, 3}, {3, 2, 7}, {11, 1, 3}, {25, 1, 25}}) {
      for (int x = first; x < first + count; ++x) {
        grid_.log_odds[grid_.frame.index({x, y, 0})] = 0.0F;
      }
    }
  }
  [[nodiscard]] std::vector<Candidate> views(bool all) const {
    const PathField paths =
        make_path_field(floor_, {0.0, 0.0, 0.0}, {.footprint_radius_m = 0.2, .margin_m = 0.05});
    return frontier_views(task_,
                          {.grid = grid_,
                           .paths = paths,
                           .T_base_sweep = make_pose({0.0, 0.0, 1.47}, 0.0),
                           .visited = visited_},
                          all);
  }
  void expect_places(bool all, const Places& expected) const {
    const std::vector<Candidate> found = views(all);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].id, static_cast<int>(i));
      const Eigen::Vector3d p_m = found[i].T_world_sensor.translation();
      EXPECT_LT((p_m.head<2>() - expected[i]).norm(), 0.08) << i << ", within a cell of the floor";
      EXPECT_NEAR(p_m.z(), 1.47, 1e-12);
      EXPECT_TRUE(found[i].reachable);
      EXPECT_NEAR(found[i].path_length_m, expected[i].norm(), 0.15 * expected[i].norm());
    }
  }

  Exploration task_;
  OccupancyGrid grid_{make_grid_frame({0.0, 0.0, 1.47}, {8.0, 8.0, 0.5}, {32, 32, 1})};
  FloorMap floor_ = open_floor();
  VisitedPlaces visited_;
};

TEST_F(FrontierViews, AreOfTheLargestFrontiersFirst) {
  expect_places(false, {kLargest, kBeside, kNext, kFar});
  expect_places(true, {kLargest, kBeside, kNext, kFar});
  task_.max_candidates = 2;
  expect_places(false, {kLargest, kBeside});
  task_.frontiers.min_cells = 6;
  task_.max_candidates = 30;
  expect_places(false, {kLargest, kBeside});
}

/// Beyond the limit, of those that do not come into sight from one before.
TEST_F(FrontierViews, AreOfAllOthersThatAreNotNearForAChoiceThatPlansAhead) {
  task_.max_candidates = 1;
  expect_places(false, {kLargest});
  expect_places(true, {kLargest, kNext, kFar});
}

/// A thin wall stands between the places, with a way round.
TEST_F(FrontierViews, AreOfThoseBehindAWallThoughTheyAreNear) {
  task_.max_candidates = 1;
  const Eigen::Vector2d middle = 0.5 * (kLargest + kBeside);
  const Eigen::Vector2d half(0.3, 0.05);
  block_box(floor_, {middle - half, middle + half});
  expect_places(true, {kLargest, kBeside, kNext, kFar});
}

TEST_F(FrontierViews, AreNotWhereTheRobotWasNorTooNearEachOther) {
  visited_.add(kNext, 0.3);
  expect_places(false, {kLargest, kBeside, kFar});
  task_.taken_m = 1.2;
  expect_places(false, {kLargest, kFar});
  expect_places(true, {kLargest, kFar});
}

/// The last frontier is in a room behind a door that is not known to be wide enough yet.
TEST_F(FrontierViews, AreBeforeADoorAndWhereThatWasLookedFromTheNearestThroughAWall) {
  for (double x_m = -4.4; x_m < 4.5; x_m += 0.1) {
    const std::size_t cell = floor_.index(floor_.cell_at({x_m, 1.55}));
    const bool door = x_m > -1.0 && x_m < -0.4;
    if (!door) floor_.log_odds[cell] = 2.0F;
  }
  block_box(floor_, {Eigen::Vector2d(-1.2, 1.61), Eigen::Vector2d(-0.8, 1.79)});
  const Eigen::Vector2d before_the_door(-0.75, 1.35);
  const auto last = [&] { return place_of_view(views(false).back()); };
  EXPECT_LT((last() - before_the_door).norm(), 0.25) << last().transpose();
  visited_.add(last(), 0.5);
  EXPECT_LT((last() - Eigen::Vector2d(2.35, 1.25)).norm(), 0.15) << last().transpose();
}

/// What stands round the last frontier keeps the robot more than 1.5 m away.
TEST_F(FrontierViews, AreOutOfReachIfTheRobotCannotComeNear) {
  block_box(floor_, {Eigen::Vector2d(1.0, 0.8), Eigen::Vector2d(4.4, 4.4)});
  task_.reach_m = 1.0;
  const std::vector<Candidate> near = views(false);
  ASSERT_EQ(near.size(), 4U);
  EXPECT_TRUE(near[2].reachable);
  EXPECT_FALSE(near[3].reachable);
  EXPECT_TRUE(std::isinf(near[3].path_length_m));
  const Eigen::Vector2d frontier = find_frontiers(grid_, task_.frontiers).at(3).p_m.head<2>();
  task_.reach_m = (place_of_view(near[3]) - frontier).norm();
  EXPECT_TRUE(views(false)[3].reachable) << "just so";
  for (const bool all : {false, true}) {
    task_.reach_m = all ? 1.0 : 2.0;
    const std::vector<Candidate> any = views(all);
    ASSERT_EQ(any.size(), 4U);
    EXPECT_TRUE(any[3].reachable) << all;
    EXPECT_LT(any[3].path_length_m, 5.0);
  }
}

/// Its sensor is beside the middle of its base, and the base comes to each place straight.
TEST_F(FrontierViews, LookOnInTheDirectionThatTheRobotComesFrom) {
  const Pose2 start{0.5, -0.4, 1.0};
  const PathField paths =
      make_path_field(floor_, start, {.footprint_radius_m = 0.2, .margin_m = 0.05});
  const Pose T_base_sweep = make_pose({0.2, 0.1, 1.47}, 0.0);
  const auto found = [&] {
    return frontier_views(
        task_, {.grid = grid_, .paths = paths, .T_base_sweep = T_base_sweep, .visited = visited_},
        false);
  };
  const std::vector<Candidate> first = found();
  const Places frontiers{kLargest, kBeside, kNext, kFar};
  ASSERT_EQ(first.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const Pose2 base = project_to_se2(first[i].T_world_sensor * T_base_sweep.inverse());
    EXPECT_LT((position(base) - frontiers[i]).norm(), 0.08) << i;
    const double ahead_rad = std::atan2(base.y_m - start.y_m, base.x_m - start.x_m);
    EXPECT_NEAR(wrap_angle(base.yaw_rad - ahead_rad), 0.0, 1e-9) << i;
  }
  visited_.add(first[2].T_world_sensor.translation().head<2>(), 0.05);
  EXPECT_EQ(found().size(), 3U) << "visited is where the sensor was";
}

TEST_F(FrontierViews, AreNoneWhereTheRobotCanStandNowhere) {
  floor_.log_odds.assign(floor_.size(), 2.0F);
  EXPECT_TRUE(views(false).empty());
  EXPECT_TRUE(views(true).empty());
}

}  // namespace
}  // namespace vantage
