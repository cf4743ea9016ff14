#include "vantage/models/catalogue/office/plans/floor_plan.hpp"

namespace vantage {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kPost_m = 0.07;
constexpr double kPostRelief_m = 0.01;  // thicker than the wall by that on each side

void add_outer_walls(FloorPlan& plan) {
  const double x = plan.size_m.x() / 2 - kHalfWall_m;
  const double y = plan.size_m.y() / 2 - kHalfWall_m;
  const double corner = x + kHalfWall_m;
  plan.walls.push_back({{-corner, -y}, {corner, -y}, {}});
  plan.walls.push_back({{-corner, y}, {corner, y}, {}});
  plan.walls.push_back({{-x, -y}, {-x, y}, {}});
  plan.walls.push_back({{x, -y}, {x, y}, {}});
}

bool along_x(const Wall& wall) { return wall.from_m.y() == wall.to_m.y(); }

/// A rectangle given along and across the wall.
AlignedBox2d beside(const Wall& wall, double from_m, double to_m, double half_width_m) {
  if (along_x(wall)) {
    const double y = wall.from_m.y();
    return box_between(from_m, y - half_width_m, to_m, y + half_width_m);
  }
  const double x = wall.from_m.x();
  return box_between(x - half_width_m, from_m, x + half_width_m, to_m);
}

}  // namespace

AlignedBox2d box_between(double x0_m, double y0_m, double x1_m, double y1_m) {
  return {Vector2d(x0_m, y0_m), Vector2d(x1_m, y1_m)};
}

Room room(RoomUse use, double x0_m, double y0_m, double x1_m, double y1_m) {
  return {use, box_between(x0_m + kHalfWall_m, y0_m + kHalfWall_m, x1_m - kHalfWall_m,
                           y1_m - kHalfWall_m)};
}

FloorPlan small_office() {
  using enum RoomUse;
  FloorPlan plan{
      .size_m = {15.0, 10.0}, .rooms = {}, .walls = {}, .pillars = {}, .T_world_starts = {}};
  add_outer_walls(plan);
  const double x = 7.45;
  const double y = 4.95;
  plan.rooms = {room(open_plan, -x, -y, 0.6, y), room(open_plan, 0.6, -y, x, y)};
  plan.walls.push_back({{0.6, -y}, {0.6, y}, {{-1.4, 1.6}}});
  plan.pillars = {
      box_between(-3.7, 0.5, -3.3, 0.9),
      box_between(3.9, 0.5, 4.3, 0.9),  // free standing
      box_between(-4.6, 4.6, -3.0, 4.9),
      box_between(3.2, 4.55, 3.8, 4.9),  // before the north wall
      box_between(-7.4, -0.3, -7.1, 0.3),
      box_between(7.1, -2.2, 7.4, -0.6),  // before west and east wall
      box_between(-3.5, -4.9, -3.1, -4.6),
      box_between(0.65, 2.0, 0.9, 2.5),
  };
  plan.T_world_starts = {
      {-5.6, -2.6, 0.4}, {-1.2, -1.4, 3.1}, {-5.4, 2.9, -0.8}, {2.3, -1.6, 0.0}, {5.3, 2.6, -2.3}};
  return plan;
}

FloorPlan large_office() {
  using enum RoomUse;
  FloorPlan plan{
      .size_m = {20.0, 25.0}, .rooms = {}, .walls = {}, .pillars = {}, .T_world_starts = {}};
  add_outer_walls(plan);
  const double x = 9.95;
  const double y = 12.45;
  const double west = -1.9;  // walls of the hallway from south to north
  const double east = 0.3;
  plan.rooms = {
      room(hallway, west, -y, east, y),
      room(open_plan, -x, -y, west, -2.7),
      room(hallway, -x, -2.7, west, -0.6),
      room(small_office, -x, -0.6, -6.0, 3.6),
      room(small_office, -6.0, -0.6, west, 3.6),
      room(meeting, -x, 3.6, west, 8.0),
      room(lounge, -x, 8.0, west, y),
      room(small_office, east, -y, 3.6, -8.5),
      room(small_office, 3.6, -y, 6.8, -8.5),
      room(small_office, 6.8, -y, x, -8.5),
      room(hallway, east, -8.5, x, -6.4),
      room(open_plan, east, -6.4, x, 2.6),
      room(meeting, east, 2.6, 5.2, 6.6),
      room(small_office, 5.2, 2.6, x, 6.6),
      room(hallway, east, 6.6, x, 8.7),
      room(small_office, east, 8.7, 4.6, y),
      room(lounge, 4.6, 8.7, x, y),
  };
  plan.walls.insert(
      plan.walls.end(),
      {
          {{west, -y}, {west, y}, {{-7.6, 1.6}, {-1.65, 2.0}, {5.8, 1.5}, {10.2, 1.5}}},
          {{east, -y}, {east, y}, {{-7.45, 2.0}, {-1.9, 1.6}, {4.6, 1.5}, {7.65, 2.0}}},
          {{-x, -2.7}, {west, -2.7}, {{-8.2, 1.6}}},
          {{-x, -0.6}, {west, -0.6}, {{-7.4, 1.5}, {-3.4, 1.5}}},
          {{-6.0, -0.6}, {-6.0, 3.6}, {}},
          {{-x, 3.6}, {west, 3.6}, {}},
          {{-x, 8.0}, {west, 8.0}, {}},
          {{east, -8.5}, {x, -8.5}, {{2.4, 1.5}, {5.2, 1.5}, {8.3, 1.5}}},
          {{3.6, -y}, {3.6, -8.5}, {}},
          {{6.8, -y}, {6.8, -8.5}, {}},
          {{east, -6.4}, {x, -6.4}, {{7.6, 1.6}}},
          {{east, 2.6}, {x, 2.6}, {}},
          {{5.2, 2.6}, {5.2, 6.6}, {}},
          {{east, 6.6}, {x, 6.6}, {{6.4, 1.5}}},
          {{east, 8.7}, {x, 8.7}, {{2.2, 1.5}, {7.8, 1.5}}},
          {{4.6, 8.7}, {4.6, y}, {}},
      });
  plan.pillars = {
      box_between(-6.2, -7.8, -5.8, -7.4), box_between(4.8, -2.1, 5.2, -1.7),  // free standing
      box_between(-9.9, -6.0, -9.6, -5.2), box_between(-5.0, -12.4, -4.0, -12.1),
      box_between(9.55, -3.4, 9.9, -2.6),  box_between(3.4, 2.25, 4.4, 2.55),
      box_between(-9.9, 5.6, -9.6, 6.4),   box_between(-6.4, 12.1, -5.6, 12.4),
      box_between(9.6, 10.2, 9.9, 11.0),   box_between(-1.85, -11.0, -1.6, -10.4),
      box_between(0.05, 1.0, 0.25, 1.6),   box_between(6.2, -6.7, 6.7, -6.45),
  };
  plan.T_world_starts = {{-0.8, -11.2, 1.57},
                         {-0.8, 11.2, -1.57},
                         {-7.4, -9.4, 0.7},
                         {8.0, -4.9, 2.4},
                         {-8.3, -1.65, 0.0}};
  return plan;
}

FloorPlan door_office(double door_m) {
  using enum RoomUse;
  FloorPlan plan{
      .size_m = {13.0, 9.6}, .rooms = {}, .walls = {}, .pillars = {}, .T_world_starts = {}};
  add_outer_walls(plan);
  const double x = 6.45;
  const double y = 4.75;
  const double side = 0.95;  // walls of the corridor
  plan.rooms = {
      room(hallway, -x, -side, x, side),     room(small_office, -x, side, -2.2, y),
      room(meeting, -2.2, side, 2.2, y),     room(small_office, 2.2, side, x, y),
      room(open_plan, -x, -y, -0.7, -side),  room(lounge, -0.7, -y, 3.1, -side),
      room(small_office, 3.1, -y, x, -side),
  };
  plan.walls.insert(plan.walls.end(),
                    {
                        {{-x, side}, {x, side}, {{-4.9, door_m}, {-0.8, door_m}, {4.8, door_m}}},
                        {{-x, -side}, {x, -side}, {{-4.1, door_m}, {1.4, door_m}, {5.2, door_m}}},
                        {{-2.2, side}, {-2.2, y}, {}},
                        {{2.2, side}, {2.2, y}, {}},
                        {{-0.7, -y}, {-0.7, -side}, {{-2.9, door_m}}},
                        {{3.1, -y}, {3.1, -side}, {}},
                    });
  plan.T_world_starts = {
      {-5.4, 0.0, 0.0}, {5.2, 0.0, 3.1}, {-4.6, -2.9, 0.6}, {0.0, 2.9, -1.2}, {0.1, 0.0, 0.0}};
  return plan;
}

std::vector<AlignedBox2d> wall_pieces(const Wall& wall) {
  const int axis = along_x(wall) ? 0 : 1;
  std::vector<AlignedBox2d> pieces;
  double begin = wall.from_m[axis];
  for (const Opening& opening : wall.openings) {
    pieces.push_back(beside(wall, begin, opening.at_m - opening.width_m / 2, kHalfWall_m));
    begin = opening.at_m + opening.width_m / 2;
  }
  pieces.push_back(beside(wall, begin, wall.to_m[axis], kHalfWall_m));
  return pieces;
}

std::vector<AlignedBox2d> door_posts(const Wall& wall) {
  std::vector<AlignedBox2d> posts;
  for (const Opening& opening : wall.openings) {
    const double left = opening.at_m - opening.width_m / 2;
    const double right = opening.at_m + opening.width_m / 2;
    posts.push_back(beside(wall, left - kPost_m, left + 0.005, kHalfWall_m + kPostRelief_m));
    posts.push_back(beside(wall, right - 0.005, right + kPost_m, kHalfWall_m + kPostRelief_m));
  }
  return posts;
}

std::vector<Vector2d> thresholds(const Wall& wall, double off_m) {
  std::vector<Vector2d> places;
  for (const Opening& opening : wall.openings) {
    for (const double side_m : {-off_m, off_m}) {
      places.push_back(along_x(wall) ? Vector2d(opening.at_m, wall.from_m.y() + side_m)
                                     : Vector2d(wall.from_m.x() + side_m, opening.at_m));
    }
  }
  return places;
}

std::vector<AlignedBox2d> door_ways(const Wall& wall, double depth_m) {
  std::vector<AlignedBox2d> ways;
  for (const Opening& opening : wall.openings) {
    ways.push_back(beside(wall, opening.at_m - opening.width_m / 2,
                          opening.at_m + opening.width_m / 2, kHalfWall_m + depth_m));
  }
  return ways;
}

Outline outline_of(const AlignedBox2d& box_m) {
  const Vector2d& a = box_m.min();
  const Vector2d& b = box_m.max();
  return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
}

}  // namespace vantage
