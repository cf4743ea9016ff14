#include "vantage/models/catalogue/flight/flight_scene.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/models/catalogue/scene_files.hpp"
#include "vantage/models/catalogue/database/object_database.hpp"
#include "vantage/models/catalogue/flight/flight_mjcf.hpp"

namespace vantage {
namespace {

using support::kCheckedInScenes;
using support::Model;

/// Half the span of the vehicle with its rotors: 0.117 sqrt 2 + 0.105.
constexpr double kVehicleRadius_m = 0.271;

/// The least distance of the path, level.
double pass_m(const std::vector<PathPoint>& path, const Eigen::Vector2d& p_world_m) {
  double nearest_m = 1e9;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d from = path[i - 1].p_world_m;
    const Eigen::Vector2d step = path[i].p_world_m - from;
    const double at = std::clamp(step.dot(p_world_m - from) / step.squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (from + at * step - p_world_m).norm());
  }
  return nearest_m;
}

class FlightSceneFolder : public testing::TestWithParam<FlightScene> {};

TEST_P(FlightSceneFolder, IsWhatTheToolWrites) {
  const support::TemporaryDirectory directory;
  write_scene(GetParam(), directory.path());
  support::expect_same_files(directory.path(), kCheckedInScenes / GetParam().name);
}

TEST_P(FlightSceneFolder, LoadsWithStandsWhereTheLayoutSays) {
  const Model model = support::load_mjcf(kCheckedInScenes / GetParam().name / "scene.xml");
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->nv, 0);
  for (std::size_t i = 0; i < GetParam().support_surfaces.size(); ++i) {
    const FlightSupport& support_surface = GetParam().support_surfaces[i];
    const std::string name = "stand_" + std::to_string(i);
    const int body = mj_name2id(model.get(), mjOBJ_BODY, name.c_str());
    const int top = mj_name2id(model.get(), mjOBJ_GEOM, (name + "/top").c_str());
    ASSERT_GT(body, 0);
    ASSERT_GE(top, 0);
    EXPECT_NEAR(model->body_pos[3 * body], support_surface.p_world_m.x(), 1e-9);
    EXPECT_NEAR(model->body_pos[3 * body + 1], support_surface.p_world_m.y(), 1e-9);
    const double half_m = model->geom_size[3 * top + (support_surface.round ? 1 : 2)];
    EXPECT_NEAR(model->geom_pos[3 * top + 2] + half_m, support_surface.top_m, 1e-9);
    EXPECT_NE(model->geom_contype[top], 0);
  }
}

TEST_P(FlightSceneFolder, WhatIsThereForPeopleTouchesNothingAndNoSensorSeesIt) {
  const Model model = support::load_mjcf(kCheckedInScenes / GetParam().name / "scene.xml");
  ASSERT_NE(model, nullptr);
  int looks = 0;
  for (int geom = 0; geom < model->ngeom; ++geom) {
    const int body = model->geom_bodyid[geom];
    const bool is_look =
        std::string(model->names + model->name_bodyadr[body]).starts_with("looks/");
    EXPECT_EQ(model->geom_group[geom], is_look ? 5 : 0);
    EXPECT_EQ(model->geom_contype[geom] == 0, is_look);
    EXPECT_EQ(model->geom_conaffinity[geom] == 0, is_look);
    looks += is_look ? 1 : 0;
  }
  EXPECT_GT(looks, 100) << "boards, skirting, windows, a door, drawers";
}

TEST_P(FlightSceneFolder, ThePathKeepsClear) {
  EXPECT_GE(path_clearance_m(GetParam()), kVehicleRadius_m + 0.35);
  // The skids hang 0.12 m below the body's middle, objects are below 0.4 m.
  for (const FlightSupport& support_surface : GetParam().support_surfaces) {
    EXPECT_GE(kPathHeight_m - 0.12 - (support_surface.top_m + 0.4), 0.35);
    EXPECT_NEAR(kPathHeight_m - support_surface.top_m, 1.0, 0.05);
  }
}

TEST_P(FlightSceneFolder, ThePathIsEvenAndLooksAhead) {
  const auto path = flight_path_points(GetParam());
  ASSERT_EQ(path.size(), static_cast<std::size_t>(GetParam().waypoints));
  const double step_m = (path[1].p_world_m - path[0].p_world_m).norm();
  EXPECT_GT(step_m, 0.4);
  EXPECT_LT(step_m, 1.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d step = path[i].p_world_m - path[i - 1].p_world_m;
    EXPECT_LT(step.norm(), 1.01 * step_m);
    EXPECT_GT(step.norm(), 0.75 * step_m) << "chords of bends are shorter";
    const Eigen::Vector2d ahead(std::cos(path[i].yaw_rad), std::sin(path[i].yaw_rad));
    EXPECT_GT(ahead.dot(step.normalized()), 0.55) << "waypoint " << i;
  }
}

TEST_P(FlightSceneFolder, StandsAreBesideThePathAndApart) {
  const FlightScene& scene = GetParam();
  const auto path = flight_path_points(scene);
  for (std::size_t i = 0; i < scene.support_surfaces.size(); ++i) {
    const double nearest_m = pass_m(path, scene.support_surfaces[i].p_world_m);
    EXPECT_GT(nearest_m, 0.5) << "support surface " << i;
    EXPECT_LT(nearest_m, 1.1) << "support surface " << i;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((scene.support_surfaces[i].p_world_m - scene.support_surfaces[j].p_world_m).norm(),
                1.4);
    }
  }
}

TEST_P(FlightSceneFolder, SomeStandsAreTooFarAsideToBeSeenWholeFromWithinTwoMetres) {
  const auto path = flight_path_points(GetParam());
  const auto far =
      std::ranges::count_if(GetParam().support_surfaces, [&](const FlightSupport& support_surface) {
        return pass_m(path, support_surface.p_world_m) > 0.85;
      });
  EXPECT_GE(far, 1);
  EXPECT_LE(far, 3);
}

INSTANTIATE_TEST_SUITE_P(All, FlightSceneFolder, testing::ValuesIn(flight_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(FlightScene, NumbersAreThePublishedOnes) {
  std::vector<std::pair<int, std::size_t>> sizes;
  for (const FlightScene& scene : flight_scenes()) {
    sizes.emplace_back(scene.waypoints, scene.support_surfaces.size());
  }
  const std::vector<std::pair<int, std::size_t>> published{{45, 5}, {45, 7}, {56, 10}, {44, 4}};
  EXPECT_EQ(sizes, published);
}

TEST(FlightScene, InTheThirdObstaclesStandWhereOneWouldTurnAside) {
  const FlightScene scene = flight_scenes()[2];
  ASSERT_GE(scene.obstacles.size(), 3U);
  for (const FlightObstacle& obstacle : scene.obstacles) {
    double nearest_m = 1e9;
    for (const FlightSupport& support_surface : scene.support_surfaces) {
      nearest_m = std::min(nearest_m, (support_surface.p_world_m - obstacle.p_world_m).norm());
    }
    EXPECT_GT(nearest_m, 0.9);
    EXPECT_LT(nearest_m, 1.9);
  }
}

TEST(FlightScene, EveryObjectOfTheDatabaseFitsOnAStand) {
  constexpr double kPlacement_m = 0.02;
  double widest_m = 0.0;
  double highest_m = 0.0;
  for (const DatabaseObject& object : object_database()) {
    if (object.near_duplicate != NearDuplicate::original &&
        object.near_duplicate != NearDuplicate::larger)
      continue;
    for (const auto& p : generate(object).mesh.positions_m) {
      widest_m = std::max(widest_m, p.head<2>().norm());
      highest_m = std::max(highest_m, p.z());
    }
  }
  EXPECT_LT(widest_m + kPlacement_m, kPedestalHalf_m);
  EXPECT_LT(highest_m, 0.4);
}

}  // namespace
}  // namespace vantage
