#include "vantage/planners/trajectory/flight_hazards.hpp"

#include <gtest/gtest.h>

#include "vantage/planners/trajectory/observation_ring.hpp"

namespace vantage {
namespace {

FlightMap room() {
  return FlightMap({Eigen::Vector3d(-3.0, -2.0, 0.0), Eigen::Vector3d(3.0, 2.0, 2.5)});
}

Eigen::Matrix4Xd straight_path() {
  Eigen::Matrix4Xd path(4, 2);
  path.col(0) << -2.5, 0.0, 1.8, 0.0;
  path.col(1) << 2.5, 0.0, 1.8, 0.0;
  return path;
}

/// Depth of a floor 1 m below a camera that looks straight down.
CameraImages picture_of_floor() {
  CameraImages images;
  images.width_px = 40;
  images.height_px = 30;
  images.focal_px = 50.0;
  images.range_max_m = 5.0;
  images.depth_m.assign(1200, 1.0F);
  images.rgb.assign(3600, 0);
  return images;
}

TEST(FlightHazards, WhereNobodyLookedSomethingMayStandButBesideTheGivenPath) {
  const FlightMap map = room();
  const auto hazards = flight_hazards(map, straight_path());
  const GridFrame& frame = map.grid().frame;
  const auto at = [&](double x, double y) {
    return hazards[frame.index(frame.cell_at({x, y, 1.5}))];
  };
  EXPECT_EQ(at(0.0, 0.0), 0);
  EXPECT_EQ(at(1.0, 0.6), 0);
  EXPECT_EQ(at(1.0, 1.0), 1);
  EXPECT_EQ(at(-2.0, -1.5), 1);
  EXPECT_EQ(at(-2.95, -1.95), 1) << "the first place";
}

TEST(FlightHazards, APathThatClimbsIsTrustedAllAlong) {
  const FlightMap map = room();
  Eigen::Matrix4Xd climbing = straight_path();
  climbing(2, 1) = 3.3;
  EXPECT_EQ(flight_hazards(map, climbing), flight_hazards(map, straight_path()));
}

TEST(FlightHazards, WhatWasSeenToBeEmptyIsNone) {
  FlightMap map = room();
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  T_world_camera.translation() = Eigen::Vector3d(1.0, 1.3, 1.05);
  map.insert(picture_of_floor(), T_world_camera);
  const auto unseen = map.unseen_places();
  const auto hazards = flight_hazards(map, straight_path());
  const GridFrame& frame = map.grid().frame;
  const auto above = frame.index(frame.cell_at({1.0, 1.3, 1.8}));
  EXPECT_EQ(unseen[above], 0);
  EXPECT_EQ(hazards[above], 0);
  EXPECT_EQ(hazards[frame.index(frame.cell_at({-1.0, 1.3, 1.8}))], 1);
}

}  // namespace
}  // namespace vantage
