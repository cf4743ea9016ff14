/// Rooms, walls and doors of the offices.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

#include "vantage/geometry/pose.hpp"
#include "vantage/models/catalogue/shapes/footprint.hpp"

namespace vantage {

inline constexpr double kWallThickness_m = 0.1;
inline constexpr double kHalfWall_m = kWallThickness_m / 2;
inline constexpr double kWallHeight_m = 2.0;

enum class RoomUse { open_plan, small_office, meeting, lounge, hallway, corridor };

struct Room {
  RoomUse use = RoomUse::open_plan;
  Eigen::AlignedBox2d area_m;  ///< between the faces of its walls
};

/// A door opening: nothing above it, no door leaf.
struct Opening {
  double at_m = 0.0;  ///< its middle: coordinate along the wall
  double width_m = 1.5;
};

/// Along x or along y.
struct Wall {
  Eigen::Vector2d from_m;  ///< centre line
  Eigen::Vector2d to_m;
  std::vector<Opening> openings;
};

/// The first walls of a plan are the outer ones.
inline constexpr std::size_t kOuterWalls = 4;

/// World frame: origin on the floor in the middle of the office. The outer faces of the outer walls
/// are the edges of `size_m`.
struct FloorPlan {
  Eigen::Vector2d size_m;
  std::vector<Room> rooms;
  std::vector<Wall> walls;
  std::vector<Eigen::AlignedBox2d> pillars;
  std::vector<Pose2> T_world_starts;  ///< five places for the robot, apart from each other
};

Eigen::AlignedBox2d box_between(double x0_m, double y0_m, double x1_m, double y1_m);
/// Between centre lines of walls.
Room room(RoomUse use, double x0_m, double y0_m, double x1_m, double y1_m);

/// 15 x 10 m: two large rooms side by side, joined by a door.
FloorPlan small_office();
/// 20 x 25 m: four hallways, large and small rooms.
FloorPlan large_office();

/// 13 x 9.6 m: six rooms off a corridor, with doors of that width, two of them joined by one more.
FloorPlan door_office(double door_m);

/// The solid parts of a wall between its openings.
std::vector<Eigen::AlignedBox2d> wall_pieces(const Wall& wall);
/// Posts on both sides of each opening, a little thicker than the wall.
std::vector<Eigen::AlignedBox2d> door_posts(const Wall& wall);
/// Middles of the floor `off_m` in front of each opening, on both sides.
std::vector<Eigen::Vector2d> thresholds(const Wall& wall, double off_m);
/// Where nothing may stand: each opening and `depth_m` in front of it on both sides.
std::vector<Eigen::AlignedBox2d> door_ways(const Wall& wall, double depth_m);

Outline outline_of(const Eigen::AlignedBox2d& box_m);

}  // namespace vantage
