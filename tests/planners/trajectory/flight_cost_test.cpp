#include "vantage/planners/trajectory/flight_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/planners/trajectory/straight_flight.hpp"

namespace vantage {
namespace {

TEST(ObstacleCost, IsWhatIsMissingTimesSpeed) {
  const FlightCostOptions options;  // epsilon and r_b 0.5 m each
  EXPECT_EQ(obstacle_cost(options, 1.0, 2.0), 0.0);
  EXPECT_EQ(obstacle_cost(options, 1.5, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(obstacle_cost(options, 0.25, 2.0), 1.5);
  EXPECT_DOUBLE_EQ(obstacle_cost(options, -0.5, 0.4), 0.6);
}

TEST(InFrame, IsOneAtItsEdges) {
  const FlightCamera camera;  // 57 x 45 deg, ahead
  const Eigen::Vector4d waypoint(1.0, 2.0, 1.0, 0.0);
  const double across = std::tan(0.5 * camera.horizontal_fov_rad);
  const double up = std::tan(0.5 * camera.vertical_fov_rad);
  const auto middle = in_frame(camera, waypoint, {3.0, 2.0, 1.0});
  ASSERT_TRUE(middle);
  EXPECT_LT(middle->norm(), 1e-12);
  const auto right = in_frame(camera, waypoint, {3.0, 2.0 - 2.0 * across, 1.0});
  EXPECT_LT((*right - Eigen::Vector2d(1.0, 0.0)).norm(), 1e-12);
  const auto below = in_frame(camera, waypoint, {3.0, 2.0, 1.0 - 2.0 * up});
  EXPECT_LT((*below - Eigen::Vector2d(0.0, 1.0)).norm(), 1e-12);
  EXPECT_FALSE(in_frame(camera, waypoint, {0.5, 2.0, 1.0}));
}

TEST(InFrame, FollowsYawPitchAndPlaceOfTheCamera) {
  FlightCamera camera;
  camera.T_body_camera = camera_ahead(std::numbers::pi / 6.0, {0.2, 0.0, -0.1});
  const Eigen::Vector4d waypoint(0.0, 0.0, 1.0, std::numbers::pi / 2.0);  // heads for +y
  // 1 m along the axis of a camera at (0, 0.2, 0.9) that looks 30 deg down.
  const Eigen::Vector3d on_axis(0.0, 0.2 + std::cos(std::numbers::pi / 6.0),
                                0.9 - std::sin(std::numbers::pi / 6.0));
  EXPECT_LT(in_frame(camera, waypoint, on_axis)->norm(), 1e-12);
}

TEST(FlightCamera, HasSquarePixels) {
  const Pose T_body_camera = camera_ahead(0.4, {0.1, 0.2, 0.3});
  const FlightCamera camera = flight_camera(T_body_camera, 640, 480, 0.7);
  EXPECT_EQ(camera.T_body_camera.matrix(), T_body_camera.matrix());
  EXPECT_EQ(camera.vertical_fov_rad, 0.7);
  EXPECT_NEAR(std::tan(0.5 * camera.horizontal_fov_rad), 640.0 / 480.0 * std::tan(0.35), 1e-12);
}

TEST(CentreCost, GrowsWithTheSquareUpToTheEdge) {
  const FlightCamera camera;
  const FlightCostOptions options{.bearing_weight = 0.0};
  const Eigen::Vector4d waypoint(0.0, 0.0, 1.0, 0.0);
  const double across = std::tan(0.5 * camera.horizontal_fov_rad);
  EXPECT_NEAR(centre_cost(options, camera, waypoint, {2.0, 0.0, 1.0}), 0.0, 1e-15);
  EXPECT_NEAR(centre_cost(options, camera, waypoint, {2.0, across, 1.0}), 0.25, 1e-12);
  EXPECT_EQ(centre_cost(options, camera, waypoint, {2.0, 5.0, 1.0}), 1.0);
  EXPECT_EQ(centre_cost(options, camera, waypoint, {-2.0, 0.1, 1.0}), 1.0);
  const double up = std::tan(0.5 * camera.vertical_fov_rad);
  EXPECT_NEAR(centre_cost(options, camera, waypoint, {2.0, 0.0, 1.0 - up}), 0.25, 1e-12);
  EXPECT_NEAR(centre_cost(options, camera, waypoint, {2.0, 0.5 * across, 1.0 + up}), 0.3125, 1e-12);
}

TEST(CentreCost, OfAPlaceWithinFiveCentimetresIsOne) {
  const FlightCostOptions options{.bearing_weight = 0.0};
  EXPECT_EQ(centre_cost(options, {}, {0.0, 0.0, 1.0, 0.0}, {0.04, 0.0, 1.0}), 1.0);
  EXPECT_NEAR(centre_cost(options, {}, {0.0, 0.0, 1.0, 0.0}, {0.06, 0.0, 1.0}), 0.0, 1e-12);
}

TEST(CentreCost, TheBearingLeadsOutOfThePlateau) {
  const FlightCamera camera;
  const FlightCostOptions options;  // 0.5 (1 - cos) / 2
  const Eigen::Vector4d waypoint(0.0, 0.0, 1.0, 0.0);
  EXPECT_NEAR(centre_cost(options, camera, waypoint, {0.0, 2.0, 1.0}), 1.25, 1e-12);
  EXPECT_NEAR(centre_cost(options, camera, waypoint, {-2.0, 0.0, 1.0}), 1.5, 1e-12);
  double before = 2.0;
  for (double yaw = 0.05; yaw < std::numbers::pi; yaw += 0.1) {  // turning towards what was behind
    const double cost = centre_cost(options, camera, {0.0, 0.0, 1.0, yaw}, {-2.0, 0.0, 1.0});
    EXPECT_LT(cost, before);
    before = cost;
  }
}

TEST(CentreCost, AsPrintedIsAlwaysOne) {
  const FlightCostOptions options{.literal = true};
  for (const double y : {0.0, 0.3, 1.0, 5.0}) {
    EXPECT_EQ(centre_cost(options, {}, {0.0, 0.0, 1.0, 0.0}, {2.0, y, 1.0}), 1.0);
  }
}

TEST(HeadingCost, TakesNoAccountOfHeightOrPitch) {
  FlightCamera camera;
  camera.T_body_camera = camera_ahead(std::numbers::pi / 4.0, {0.12, 0.0, 0.0});
  const FlightCostOptions options{.bearing_weight = 0.0};
  const Eigen::Vector4d waypoint(0.0, 0.0, 1.0, std::numbers::pi / 2.0);
  EXPECT_NEAR(heading_cost(options, camera, waypoint, {0.0, 0.5, 3.0}), 0.0, 1e-12);
  const double across = std::tan(0.5 * camera.horizontal_fov_rad);
  EXPECT_NEAR(heading_cost(options, camera, waypoint, {0.5 * across, 1.0, 1.0}), 0.25, 1e-12);
  EXPECT_EQ(heading_cost(options, camera, waypoint, {0.0, -0.5, 1.0}), 1.0);
  EXPECT_EQ(heading_cost(options, camera, waypoint, {0.0, 0.0, 2.0}), 0.0);
  EXPECT_EQ(heading_cost(options, camera, waypoint, {0.0, -0.04, 2.0}), 0.0) << "it is there";
  EXPECT_EQ(heading_cost(options, camera, waypoint, {0.0, -0.06, 2.0}), 1.0);
}

TEST(HeadingCost, IsThatOfTheCameraWhereItLooksAside) {
  FlightCamera camera;
  camera.T_body_camera = make_pose(Eigen::Vector3d::Zero(), 0.6) * camera_ahead(0.3);
  const FlightCostOptions options{.bearing_weight = 0.0};
  const Eigen::Vector4d waypoint(1.0, 2.0, 1.0, 0.9);
  const auto cost_at = [&](double bearing_rad) {
    const Eigen::Vector3d place(1.0 + 2.0 * std::cos(bearing_rad),
                                2.0 + 2.0 * std::sin(bearing_rad), 3.0);
    return heading_cost(options, camera, waypoint, place);
  };
  const double half_way = std::atan(0.5 * std::tan(0.5 * camera.horizontal_fov_rad));
  EXPECT_NEAR(cost_at(1.5), 0.0, 1e-12);
  EXPECT_NEAR(cost_at(1.5 + half_way), 0.25, 1e-12);
  EXPECT_NEAR(cost_at(1.5 - half_way), 0.25, 1e-12);
  EXPECT_EQ(cost_at(1.5 + 0.75 * std::numbers::pi), 1.0);
}

class RecognitionCostTest : public ::testing::Test {
 protected:
  const ObservationTarget target_{{0.0, 0.0, 1.0}, {1.5, 0.0, 1.0}, 2.0};
};

TEST_F(RecognitionCostTest, IsZeroAtTheViewAlone) {
  const FlightCostOptions options;
  EXPECT_EQ(recognition_cost(options, target_, {1.5, 0.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {2.0, 0.0, 1.0}), 0.5);         // on the ray
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {1.5, 0.4, 1.0}), 0.4 + 0.4);   // beside it
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {-2.0, 0.0, 1.0}), 3.5 + 2.0);  // behind
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {0.0, 0.0, 1.0}), 1.5);
}

TEST_F(RecognitionCostTest, AsPrintedIsLeastInsideTheObject) {
  const FlightCostOptions options{.literal = true};
  EXPECT_EQ(recognition_cost(options, target_, {0.0, 0.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {1.5, 0.0, 1.0}), 1.5);
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {-2.0, 0.0, 1.0}), 2.0);
  EXPECT_DOUBLE_EQ(recognition_cost(options, target_, {0.0, 0.4, 1.0}), 0.4 + 0.4);
}

TEST(InformationCost, EndsBelowTau) {
  const FlightCostOptions options;
  EXPECT_EQ(information_cost(options, 0.0999), 0.0);
  EXPECT_EQ(information_cost(options, 0.1), 1.0);
  EXPECT_EQ(information_cost({.information = false}, 0.0), 1.0);
}

/// Costs of the ten points of a straight flight, 0.5 m and 1 s apart.
Eigen::VectorXd costs(const FlightCostOptions& options, const FlightSurroundings& scene,
                      const Horizon& horizon = test::straight_flight()) {
  Eigen::VectorXd cost(horizon.count());
  flight_cost(options, {}, scene)(horizon, cost);
  return cost;
}

TEST(FlightCost, OfAFlightInTheOpenIsZero) {
  EXPECT_LT(costs({}, {}).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(FlightCost, OfAColumnBesideThePath) {
  // The surface of the column is 0.7 m from the path where it passes, at the fourth point.
  const Esdf surface = test::columns({{1.5, 0.9}});
  const double here_m = surface.distance_m({1.5, 0.0, 1.2});
  EXPECT_NEAR(here_m, 0.7, 0.05);
  FlightSurroundings scene{.surface = &surface, .target = {}};
  const FlightCostOptions options{.obstacle_weight = 3.0, .clearance_m = 0.0};
  const auto cost = costs(options, scene);
  EXPECT_NEAR(cost[3], 3.0 * (1.0 - here_m) * 0.5, 1e-9);
  EXPECT_EQ(cost[9], 0.0);
  const FlightCostOptions slow{.obstacle_weight = 3.0, .segment_s = 2.0, .clearance_m = 0.0};
  EXPECT_NEAR(costs(slow, scene)[3], 3.0 * (1.0 - here_m) * 0.25, 1e-9);
  const FlightCostOptions hard{.obstacle_weight = 0.0, .clearance_m = 0.9, .clearance_weight = 7.0};
  EXPECT_NEAR(costs(hard, scene)[3], 7.0 * (0.9 - here_m), 1e-9);
}

TEST(FlightCost, LooksBetweenWaypointsToo) {
  const Esdf surface = test::columns({{1.75, 0.0}});  // between the 4th and the 5th
  FlightSurroundings scene{.surface = &surface, .target = {}};
  FlightCostOptions options{.clearance_weight = 0.0};
  const auto with = costs(options, scene);
  options.between_waypoints = false;
  const auto without = costs(options, scene);
  EXPECT_NEAR(without[3], 5.0 * (1.0 - surface.distance_m({1.5, 0.0, 1.2})) * 0.5, 1e-9);
  EXPECT_NEAR(with[3], 5.0 * (1.0 - surface.distance_m({1.75, 0.0, 1.2})) * 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(with[3], with[4]);
}

TEST(FlightCost, StandingInAnObstacleIsNotFree) {
  const Esdf surface = test::columns({{1.5, 0.0}});
  Horizon standing = test::straight_flight();
  standing.points.colwise() = Eigen::Vector4d(1.5, 0.0, 1.2, 0.0);
  FlightSurroundings scene{.surface = &surface, .target = {}};
  const FlightCostOptions options{.obstacle_weight = 1.0, .clearance_weight = 0.0};
  const double depth_m = surface.distance_m({1.5, 0.0, 1.2});
  const Eigen::VectorXd cost = costs(options, scene, standing);
  EXPECT_NEAR(cost[5], 0.2 * (1.0 - depth_m), 1e-9);
  // Before it 2 m were flown, and 3.5 m come after it.
  EXPECT_NEAR(cost[0], 0.5 * 2.0 * (1.0 - depth_m), 1e-9);
  EXPECT_NEAR(cost[9], 0.5 * 3.5 * (1.0 - depth_m), 1e-9);
}

TEST(FlightCost, AddsTheTermsOfTheTarget) {
  const ObservationTarget target{{2.0, 1.3, 1.2}, {2.0, 0.0, 1.2}, 1.0};
  const FlightCostOptions options{.centre_weight = 2.0, .recognition_weight = 0.5};
  const auto cost = costs(options, {.surface = nullptr, .target = target});
  const Horizon flight = test::straight_flight();
  for (Eigen::Index i = 0; i < 10; ++i) {
    const double centre = centre_cost(options, {}, flight.points.col(i), target.p_world_object_m);
    const double view = recognition_cost(options, target, flight.points.col(i).head<3>());
    EXPECT_NEAR(cost[i], 2.0 * centre + 0.5 * view, 1e-12);
  }
  // Known well enough, it is kept in view, but not flown to.
  const ObservationTarget known{target.p_world_object_m, target.p_world_view_m, 0.05};
  EXPECT_NEAR(costs(options, {.surface = nullptr, .target = known})[4],
              2.0 * centre_cost(options, {}, flight.points.col(4), known.p_world_object_m), 1e-12);
}

TEST(FlightCost, WhatIsOnlyLookedAtDoesNotDraw) {
  const FlightCostOptions options{.centre_weight = 0.0, .information = false};
  ObservationTarget target{.p_world_object_m = {2.0, 1.0, 1.2}, .p_world_view_m = {2.0, 0.3, 1.2}};
  EXPECT_GT(costs(options, {.target = target}).minCoeff(), 0.0);
  target.flown_to = false;
  EXPECT_EQ(costs(options, {.target = target}).maxCoeff(), 0.0);
}

TEST(FlightCost, AsPrintedSumsOverCentresWithinDelta) {
  const FlightCostOptions options{.obstacle_weight = 1.0, .centre_weight = 0.0, .literal = true};
  FlightSurroundings scene;
  scene.p_world_obstacles_m = {{1.5, 0.8, 1.2}, {1.5, -0.4, 1.2}, {1.5, 3.0, 1.2}};
  scene.p_world_obstacles_m.emplace_back(0.0, 0.7, 1.2);  // beside the first point
  EXPECT_NEAR(costs(options, scene)[0], 0.3 * 0.5, 1e-12);
  EXPECT_NEAR(costs(options, scene)[3], (0.2 + 0.6) * 0.5, 1e-12);
  const FlightCostOptions near{
      .obstacle_weight = 1.0, .centre_weight = 0.0, .delta_m = 0.5, .literal = true};
  EXPECT_NEAR(costs(near, scene)[3], 0.6 * 0.5, 1e-12);
}

TEST(FlightCostOptions, AreChecked) {
  EXPECT_THROW(check_options(FlightCostOptions{.segment_s = 0.0}), ConfigError);
  EXPECT_THROW(check_options(FlightCostOptions{.obstacle_weight = -1.0}), ConfigError);
}

/// Straight above the camera and beside it nothing is in front.
TEST(CentreCost, OfAPlaceAtARightAngleIsThatOfTheEdge) {
  const FlightCamera camera;
  const Eigen::Vector4d waypoint(0.0, 0.0, 1.0, 0.0);
  const Eigen::Vector3d above(0.0, 0.0, 3.0);
  const Eigen::Vector3d beside(0.0, 2.0, 1.0);
  for (const Eigen::Vector3d& place : {above, beside}) {
    EXPECT_NEAR(centre_cost({}, camera, waypoint, place), 1.25, 1e-12);
    EXPECT_FALSE(in_frame(camera, waypoint, place));
  }
  EXPECT_TRUE(in_frame(camera, waypoint, {0.5, 0.0, 1.0})) << "half a metre ahead";
}

TEST(FlightCost, AsPrintedACentreJustAtDeltaCostsNothing) {
  FlightSurroundings scene;
  scene.p_world_obstacles_m = {{1.5, 0.5, 1.2}};
  const auto cost = [&](double delta_m) {
    return costs(
        {.obstacle_weight = 1.0, .centre_weight = 0.0, .delta_m = delta_m, .literal = true}, scene);
  };
  EXPECT_EQ(cost(0.5)[3], 0.0);
  EXPECT_NEAR(cost(0.51)[3], 0.5 * 0.5, 1e-12);
}

}  // namespace
}  // namespace vantage
