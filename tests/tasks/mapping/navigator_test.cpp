// What the navigator remembers of its way, and how sure it is of where it is.
#include "vantage/tasks/mapping/driving/navigator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tests/localisation/plan_world.hpp"
#include "tests/support/synthetic_room.hpp"
#include "tests/tasks/mapping/standing_robot.hpp"
#include "vantage/sim/robots/pose_uncertainty.hpp"

namespace vantage {
namespace {

RegistrationOptions hall_registration() {
  RegistrationOptions registration;
  registration.normals.radius_m = 0.25;
  return registration;
}

/// In a hall of 8 x 6 m, 1.2 m behind where it believes to be; or at a table's legs, where it does.
struct HallRobot : support::JumpingRobot {
  HallRobot() {
    test_plan::add_box(walls, -4.0, -3.0, 4.0, 3.0);
    table.room = {Eigen::Vector3d(-30, -30, 0), Eigen::Vector3d(30, 30, 2.5)};
    for (const double x_m : {-0.45, 0.45}) {
      for (const double y_m : {-0.45, 0.45}) {
        table.boxes.push_back(support::box_at({x_m, y_m, 0.34}, {0.05, 0.05, 0.68}));
      }
    }
  }
  [[nodiscard]] PlanarScan seen_from(const Pose2& truth) {
    PlanarScan scan{.T_base_sensor = {}, .azimuth_rad = {}, .range_m = {}, .range_max_m = 30.0};
    for (int beam = -540; beam <= 540; ++beam) {
      const double yaw_rad = truth.yaw_rad + 0.00436 * beam;
      const double range_m =
          test_plan::range_m(walls, {truth.x_m, truth.y_m}, {std::cos(yaw_rad), std::sin(yaw_rad)});
      scan.azimuth_rad.push_back(0.00436 * beam);
      scan.range_m.push_back(static_cast<float>(range_m + 0.01 * rng.normal()));
    }
    return scan;
  }
  PlanarScan read_base_scanner() override {
    if (at_table) {
      PlanarScan scan = support::floor_scan(table, T_world_base, 0.01, rng);
      scan.range_max_m = 100.0;
      return scan;
    }
    return seen_from({T_world_base.x_m - 1.2, T_world_base.y_m, T_world_base.yaw_rad});
  }

  std::vector<test_plan::Segment> walls;
  support::SyntheticScene table;
  bool at_table = false;
  Rng rng{5};
};

/// From five places, tracked 0.5 m apart and 0.6 m apart by the wheels and by what is seen.
void remember_hall(Navigator& navigator, HallRobot& robot) {
  const auto tracked = [](int i) { return Pose2{0.5 * i, 0.0, 0.0}; };
  robot.T_world_base = tracked(0);
  navigator.close_loops({.close = true, .min_way_m = 0.9}, hall_registration(), {});
  for (int i = 0; i < 5; ++i) {
    if (i > 0) {
      robot.T_world_base = compose(tracked(i - 1), {0.6, 0.0, 0.0});
      navigator.correct_pose(tracked(i), Eigen::Matrix3d::Zero());
    }
    navigator.remember(robot.seen_from({0.6 * i - 1.2, 0.0, 0.0}), tracked(i));
  }
}

TEST(Navigator, RemembersWallsAllRoundWhenItTurns) {
  HallRobot robot;
  ReferenceMap once(hall_registration());
  once.remember(robot.read_base_scanner(), robot.base_scan_height_m(), {});
  ASSERT_GT(once.cloud().size(), 500U);
  Navigator navigator({}, {}, {}, robot, ReferenceMap(hall_registration()), 1);
  EXPECT_TRUE(navigator.turn_in_place());
  EXPECT_GT(navigator.reference_map().cloud().size(), 7 * once.cloud().size() / 2);
}

/// Its inscribed circle has a radius of 0.2 m.
TEST(Navigator, PlansOnFloorThatIsFreeWhereItStands) {
  support::StandingRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  navigator.plan();
  EXPECT_EQ(navigator.floor().state_at({0.11, 0.02}), CellState::free);
  EXPECT_EQ(navigator.floor().state_at({0.29, 0.02}), CellState::unobserved);
}

TEST(Navigator, IsAsSureOfItsPoseAsOdometryAndRegistrationsMakeIt) {
  support::StandingRobot robot;
  const OdometryOptions odometry;
  Navigator navigator({}, {}, odometry, robot, ReferenceMap(RegistrationOptions{}), 1);
  PoseUncertainty expected(odometry, {});
  const auto move_to = [&](const Pose2& pose) {
    robot.T_world_base = pose;
    expected.move_to(pose);
  };
  move_to({0.5, 0.0, 0.2});
  navigator.correct_pose({0.5, 0.0, 0.2}, Eigen::Matrix3d::Zero());
  navigator.remember({}, {0.5, 0.0, 0.2});
  expected.remember();
  move_to({1.0, 0.2, 0.6});
  navigator.correct_pose({1.1, 0.3, 0.5}, 1e4 * Eigen::Matrix3d::Identity());
  expected.correct({1.1, 0.3, 0.5}, 1e4 * Eigen::Matrix3d::Identity());
  EXPECT_EQ(navigator.uncertainty().covariance(), expected.covariance());
  move_to({1.8, 0.3, 0.5});
  const Correction plausible = navigator.plausible_correction();
  EXPECT_EQ(navigator.uncertainty().covariance(), expected.covariance());
  EXPECT_EQ(plausible.shift_m, expected.plausible_shift_m());
  EXPECT_EQ(plausible.turn_rad, expected.plausible_turn_rad());
  EXPECT_GT(plausible.turn_rad, 0.0);
}

/// 0.2 m and 0.6 m from where loops have put it, 0.6 m and 1 m from where it believed to be. Behind
/// its start it knows the floor that it stood on, 0.57 m.
TEST(Navigator, GoesOnFromWhereLoopsHavePutIt) {
  HallRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(hall_registration()), 1, 0.5);
  remember_hall(navigator, robot);
  ASSERT_NEAR(robot.T_world_base.x_m, 2.0, 1e-9);
  ASSERT_TRUE(navigator.correct_over_loops());
  ASSERT_NEAR(robot.T_world_base.x_m, 2.4, 0.05);
  EXPECT_FALSE(navigator.reference_map().goes_by_posts());
  EXPECT_EQ(navigator.floor().state_at({-0.54, 0.02}), CellState::free);
  EXPECT_EQ(navigator.floor().state_at({-0.58, 0.02}), CellState::unobserved);
  navigator.correct_pose(robot.T_world_base, Eigen::Matrix3d::Zero());
  EXPECT_NEAR(navigator.loops()->turned_rad(), 0.0, 1e-9) << "that is no turn of the wheels";
  std::ranges::fill(navigator.floor().log_odds, -2.0F);
  const auto remembered_at = [&](double x_m) {
    EXPECT_TRUE(navigator.approach({x_m, 0.0, 0.0}, std::nullopt).reached);
    return navigator.loops()->remembered().size();
  };
  EXPECT_EQ(remembered_at(2.6), 5U);
  EXPECT_EQ(remembered_at(3.0), 6U);
}

TEST(Navigator, StillGoesByPostsWhenLoopsHaveMadeItsMapAnew) {
  HallRobot robot;
  Navigator navigator({}, {}, {}, robot, ReferenceMap(RegistrationOptions{}), 1);
  robot.at_table = true;
  robot.T_world_base = support::view_of_table(0.0);
  navigator.turn_in_place();
  ASSERT_TRUE(navigator.reference_map().goes_by_posts());
  robot.at_table = false;
  remember_hall(navigator, robot);
  ASSERT_TRUE(navigator.correct_over_loops());
  EXPECT_TRUE(navigator.reference_map().goes_by_posts());
}

/// Beams of a hall's scans go through the walls of the room that they are taken in; of the last of
/// them only by the loops: it is tracked far away.
TEST(LoopClosing, TakesLoopsByWhichLittleMoreGoesThroughWalls) {
  const auto wants_correction = [](int halls) {
    HallRobot robot;
    LoopClosing loops({.close = true, .min_way_m = 0.9}, hall_registration(), {}, {});
    for (int i = 0; i < 5 + halls; ++i) {
      if (i == 5) {
        robot.walls.clear();
        test_plan::add_box(robot.walls, -9.0, -8.0, 9.0, 8.0);
      }
      const double way_m = 0.6 * std::min(i, 4);
      const Pose2 tracked{i == 4 + halls ? 100.0 : way_m, 0.0, 0.0};
      if (i > 0) loops.moved_to({way_m, 0.0, 0.0}, tracked);
      loops.remember(robot.seen_from({way_m - 1.2, 0.0, 0.0}), 0.25, tracked);
    }
    EXPECT_GT(loops.graph().loops(), 0U);
    EXPECT_GT(loops.disagreement_m(), 90.0);
    EXPECT_GT(loops.contradicted_share(), 0.02);
    return loops.wants_correction();
  };
  EXPECT_TRUE(wants_correction(4)) << "those of four scans instead of three";
  EXPECT_FALSE(wants_correction(2)) << "of two instead of one";
}

}  // namespace
}  // namespace vantage
