#include "vantage/models/catalogue/office/plans/drawn_plan.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Along the side of a room, deep 0.3 m. @param share of the side that is before it
AlignedBox2d pillar_at(const AlignedBox2d& area, double share, double length_m, bool north) {
  const double from = area.min().x() + share * (area.sizes().x() - length_m);
  return north ? box_between(from, area.max().y() - 0.3, from + length_m, area.max().y())
               : box_between(from, area.min().y(), from + length_m, area.min().y() + 0.3);
}

/// In each open room one that stands free, and one before its north and its south wall.
std::vector<AlignedBox2d> drawn_pillars(const FloorPlan& plan, Rng& rng) {
  constexpr double kFree_m = 1.8;  // between it and the walls
  constexpr double kEdge_m = 0.4;
  std::vector<AlignedBox2d> pillars;
  for (const Room& room : plan.rooms) {
    if (room.use != RoomUse::open_plan) continue;
    const AlignedBox2d& area = room.area_m;
    const double x = rng.uniform(area.min().x() + kFree_m, area.max().x() - kFree_m - kEdge_m);
    const double y = rng.uniform(area.min().y() + kFree_m, area.max().y() - kFree_m - kEdge_m);
    pillars.push_back(box_between(x, y, x + kEdge_m, y + kEdge_m));
    for (const bool north : {true, false}) {
      const double length_m = rng.uniform(0.4, 1.6);
      pillars.push_back(pillar_at(area, rng.uniform(), length_m, north));
    }
  }
  return pillars;
}

/// Clear of walls, pillars and the door, and apart.
std::vector<Pose2> drawn_starts(const FloorPlan& plan, Rng& rng) {
  constexpr double kClear_m = 0.9;
  constexpr double kApart_m = 3.2;
  constexpr int kAttempts = 10000;
  const Vector2d reach = 0.5 * plan.size_m - Vector2d::Constant(0.5);
  const auto is_clear = [&](const Vector2d& p) {
    const bool in_a_room = std::ranges::any_of(plan.rooms, [&](const Room& room) {
      return (p - room.area_m.min()).minCoeff() > kClear_m &&
             (room.area_m.max() - p).minCoeff() > kClear_m;
    });
    return in_a_room && std::ranges::none_of(plan.pillars, [&](const AlignedBox2d& pillar) {
             return pillar.exteriorDistance(p) < kClear_m;
           });
  };
  std::vector<Pose2> starts;
  for (int attempt = 0; starts.size() < 5; ++attempt) {
    expects(attempt < kAttempts, "room for five starts");
    const double x = rng.uniform(-reach.x(), reach.x());
    const double y = rng.uniform(-reach.y(), reach.y());
    const Vector2d p(x, y);
    const double yaw_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const bool apart = std::ranges::all_of(starts, [&](const Pose2& other) {
      return (p - Vector2d(other.x_m, other.y_m)).norm() > kApart_m;
    });
    if (is_clear(p) && apart) starts.push_back({p.x(), p.y(), yaw_rad});
  }
  return starts;
}

/// Those that stand neither in a door nor before one.
std::vector<AlignedBox2d> clear_of_doors(std::vector<AlignedBox2d> pillars,
                                         const std::vector<Wall>& walls) {
  constexpr double kDepth_m = 1.3;
  std::erase_if(pillars, [&](const AlignedBox2d& pillar) {
    return std::ranges::any_of(walls, [&](const Wall& wall) {
      return std::ranges::any_of(door_ways(wall, kDepth_m),
                                 [&](const AlignedBox2d& way) { return pillar.intersects(way); });
    });
  });
  return pillars;
}

/// Centre lines of the walls of a large office, before east is west.
struct Lines {
  double west, east;                       ///< of the hallway from south to north
  double side_south, side_north;           ///< of the hallway to the west
  double south, south_end;                 ///< of the one to the east, in the south
  double north, north_end;                 ///< in the north
  double office, meeting, lounge;          ///< rooms in the west
  double first, second;                    ///< small offices in the south-east
  double open, east_meeting, east_lounge;  ///< rooms in the east
};

constexpr double kHallway_m = 2.1;
constexpr double kX = 9.95;
constexpr double kY = 12.45;

Lines drawn_lines(Rng& rng) {
  Lines l{};
  l.west = rng.uniform(-2.6, -1.2);
  l.east = l.west + kHallway_m + 0.1;
  l.side_south = rng.uniform(-3.6, -2.3);
  l.side_north = l.side_south + kHallway_m;
  l.south = rng.uniform(-9.0, -8.0);
  l.south_end = l.south + kHallway_m;
  l.north = rng.uniform(6.1, 7.1);
  l.north_end = l.north + kHallway_m;
  l.office = -kX + rng.uniform(0.42, 0.58) * (l.west + kX);
  l.meeting = l.side_north + rng.uniform(3.6, 4.4);
  l.lounge = l.meeting + rng.uniform(3.9, 4.5);
  const double third = (kX - l.east) / 3.0;
  l.first = l.east + third + rng.uniform(-0.25, 0.25);
  l.second = l.east + 2.0 * third + rng.uniform(-0.25, 0.25);
  l.open = l.north - rng.uniform(3.7, 4.3);
  l.east_meeting = l.east + rng.uniform(0.45, 0.55) * (kX - l.east);
  l.east_lounge = l.east + rng.uniform(0.4, 0.5) * (kX - l.east);
  return l;
}

std::vector<Room> rooms_between(const Lines& l) {
  using enum RoomUse;
  return {
      room(hallway, l.west, -kY, l.east, kY),
      room(open_plan, -kX, -kY, l.west, l.side_south),
      room(hallway, -kX, l.side_south, l.west, l.side_north),
      room(small_office, -kX, l.side_north, l.office, l.meeting),
      room(small_office, l.office, l.side_north, l.west, l.meeting),
      room(meeting, -kX, l.meeting, l.west, l.lounge),
      room(lounge, -kX, l.lounge, l.west, kY),
      room(small_office, l.east, -kY, l.first, l.south),
      room(small_office, l.first, -kY, l.second, l.south),
      room(small_office, l.second, -kY, kX, l.south),
      room(hallway, l.east, l.south, kX, l.south_end),
      room(open_plan, l.east, l.south_end, kX, l.open),
      room(meeting, l.east, l.open, l.east_meeting, l.north),
      room(small_office, l.east_meeting, l.open, kX, l.north),
      room(hallway, l.east, l.north, kX, l.north_end),
      room(small_office, l.east, l.north_end, l.east_lounge, kY),
      room(lounge, l.east_lounge, l.north_end, kX, kY),
  };
}

/// Somewhere between two walls that meet this one.
Opening door(Rng& rng, double from, double to) {
  constexpr double kFromCorner_m = 1.15;
  const double at_m = rng.uniform(from + kFromCorner_m, to - kFromCorner_m);
  return {at_m, rng.uniform(1.5, 1.6)};
}

/// Where a hallway ends.
Opening mouth(double from, double to) { return {0.5 * (from + to), kHallway_m - 0.1}; }

/// Inner walls, each with its openings in order.
std::vector<Wall> walls_along(const Lines& l, Rng& rng) {
  std::vector<Wall> walls;
  const auto wall = [&](const Vector2d& from, const Vector2d& to, std::vector<Opening> openings) {
    walls.push_back({from, to, std::move(openings)});
  };
  const Opening to_open_plan = door(rng, -kY, l.side_south);
  const Opening to_meeting = door(rng, l.meeting, l.lounge);
  const Opening to_lounge = door(rng, l.lounge, kY);
  wall({l.west, -kY}, {l.west, kY},
       {to_open_plan, mouth(l.side_south, l.side_north), to_meeting, to_lounge});
  const Opening to_eastern_open_plan = door(rng, l.south_end, l.open);
  const Opening to_eastern_meeting = door(rng, l.open, l.north);
  wall({l.east, -kY}, {l.east, kY},
       {mouth(l.south, l.south_end), to_eastern_open_plan, to_eastern_meeting,
        mouth(l.north, l.north_end)});
  wall({-kX, l.side_south}, {l.west, l.side_south}, {door(rng, -kX, l.west)});
  const Opening first_office = door(rng, -kX, l.office);
  const Opening second_office = door(rng, l.office, l.west);
  wall({-kX, l.side_north}, {l.west, l.side_north}, {first_office, second_office});
  wall({l.office, l.side_north}, {l.office, l.meeting}, {});
  wall({-kX, l.meeting}, {l.west, l.meeting}, {});
  wall({-kX, l.lounge}, {l.west, l.lounge}, {});
  const Opening first = door(rng, l.east, l.first);
  const Opening second = door(rng, l.first, l.second);
  const Opening third = door(rng, l.second, kX);
  wall({l.east, l.south}, {kX, l.south}, {first, second, third});
  wall({l.first, -kY}, {l.first, l.south}, {});
  wall({l.second, -kY}, {l.second, l.south}, {});
  wall({l.east, l.south_end}, {kX, l.south_end}, {door(rng, l.east, kX)});
  wall({l.east, l.open}, {kX, l.open}, {});
  wall({l.east_meeting, l.open}, {l.east_meeting, l.north}, {});
  wall({l.east, l.north}, {kX, l.north}, {door(rng, l.east_meeting, kX)});
  const Opening north_office = door(rng, l.east, l.east_lounge);
  const Opening north_lounge = door(rng, l.east_lounge, kX);
  wall({l.east, l.north_end}, {kX, l.north_end}, {north_office, north_lounge});
  wall({l.east_lounge, l.north_end}, {l.east_lounge, kY}, {});
  return walls;
}

/// @param axis 0: east is west; 1: north is south
void mirror(FloorPlan& plan, int axis) {
  for (Room& room : plan.rooms) {
    std::swap(room.area_m.min()[axis], room.area_m.max()[axis]);
    room.area_m.min()[axis] *= -1.0;
    room.area_m.max()[axis] *= -1.0;
  }
  for (std::size_t i = kOuterWalls; i < plan.walls.size(); ++i) {
    Wall& wall = plan.walls[i];
    const bool along = wall.from_m[1 - axis] == wall.to_m[1 - axis];
    std::swap(wall.from_m[axis], wall.to_m[axis]);
    wall.from_m[axis] *= -1.0;
    wall.to_m[axis] *= -1.0;
    if (!along) continue;
    std::ranges::reverse(wall.openings);
    for (Opening& opening : wall.openings) opening.at_m *= -1.0;
  }
}

}  // namespace

FloorPlan drawn_small_office(std::uint64_t seed) {
  Rng rng = Rng::stream(seed, "walls");
  FloorPlan plan = small_office();
  const double x = 7.45;
  const double y = 4.95;
  const double between = rng.uniform(-1.5, 1.5);
  plan.rooms = {room(RoomUse::open_plan, -x, -y, between, y),
                room(RoomUse::open_plan, between, -y, x, y)};
  Wall& inner = plan.walls.back();
  inner = {{between, -y}, {between, y}, {{rng.uniform(-3.4, 3.4), rng.uniform(1.4, 1.7)}}};
  plan.pillars = drawn_pillars(plan, rng);
  plan.T_world_starts = drawn_starts(plan, rng);
  return plan;
}

FloorPlan drawn_large_office(std::uint64_t seed) {
  Rng rng = Rng::stream(seed, "walls");
  FloorPlan plan = large_office();
  const Lines lines = drawn_lines(rng);
  plan.rooms = rooms_between(lines);
  plan.walls.resize(kOuterWalls);
  std::ranges::move(walls_along(lines, rng), std::back_inserter(plan.walls));
  for (const int axis : {0, 1}) {
    if (rng.uniform() < 0.5) mirror(plan, axis);
  }
  plan.pillars = clear_of_doors(drawn_pillars(plan, rng), plan.walls);
  plan.T_world_starts = drawn_starts(plan, rng);
  return plan;
}

}  // namespace vantage
