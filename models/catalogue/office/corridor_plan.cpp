#include "vantage/models/catalogue/office/corridor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kDoor_m = 1.5;
constexpr double kClearOfCorner_m = 1.6;
/// Rooms and shafts are about as long, along the corridor.
constexpr double kSegment_m = 5.0;
/// One pier for so much of the loop.
constexpr double kPierEvery_m = 26.0;

/// Centre lines of the walls: outer and inner edges of the corridor.
struct Ring {
  Vector2d outer;  ///< half sizes
  Vector2d inner;
  double width_m;
};

Ring draw_ring(const CorridorOptions& options, Rng& rng) {
  const double width_m = 0.1 * std::round(10.0 * rng.uniform(1.8, 2.4));
  const Vector2d outer =
      0.5 * Vector2d(options.width_m, options.length_m) - Vector2d::Constant(kHalfWall_m);
  return {outer, outer - Vector2d::Constant(width_m + kWallThickness_m), width_m};
}

void add_ring(FloorPlan& plan, const Ring& ring) {
  const auto& [outer, inner, width_m] = ring;
  const double corner = outer.x() + kHalfWall_m;
  plan.walls.push_back({{-corner, -outer.y()}, {corner, -outer.y()}, {}});
  plan.walls.push_back({{-corner, outer.y()}, {corner, outer.y()}, {}});
  plan.walls.push_back({{-outer.x(), -outer.y()}, {-outer.x(), outer.y()}, {}});
  plan.walls.push_back({{outer.x(), -outer.y()}, {outer.x(), outer.y()}, {}});
  plan.walls.push_back({{-inner.x(), -inner.y()}, {inner.x(), -inner.y()}, {}});
  plan.walls.push_back({{-inner.x(), inner.y()}, {inner.x(), inner.y()}, {}});
  const auto room = [&](const Vector2d& a, const Vector2d& b) {
    const Vector2d half = Vector2d::Constant(kHalfWall_m);
    plan.rooms.push_back({RoomUse::corridor, AlignedBox2d(a + half, b - half)});
  };
  room(-outer, {outer.x(), -inner.y()});
  room({-outer.x(), inner.y()}, outer);
  room({-outer.x(), -inner.y()}, {-inner.x(), inner.y()});
  room({inner.x(), -inner.y()}, {outer.x(), inner.y()});
}

/// Every other segment of the middle is a room, its door to the west or to the east in turn.
void add_rooms(FloorPlan& plan, const Ring& ring, Rng& rng) {
  const Vector2d& inner = ring.inner;
  const int count = 2 * (static_cast<int>(2.0 * inner.y() / kSegment_m) / 2) + 1;
  Wall west{{-inner.x(), -inner.y()}, {-inner.x(), inner.y()}, {}};
  Wall east{{inner.x(), -inner.y()}, {inner.x(), inner.y()}, {}};
  double from = -inner.y();
  for (int i = 0; i < count; ++i) {
    const bool last = i + 1 == count;
    const double even = -inner.y() + 2.0 * inner.y() * (i + 1) / count;
    const double to = last ? inner.y() : even + 0.1 * std::round(rng.uniform(-6.0, 6.0));
    if (!last) plan.walls.push_back({{-inner.x(), to}, {inner.x(), to}, {}});
    if (i % 2 == 0) {
      const Vector2d half = Vector2d::Constant(kHalfWall_m);
      plan.rooms.push_back({RoomUse::meeting, AlignedBox2d(Vector2d(-inner.x(), from) + half,
                                                           Vector2d(inner.x(), to) - half)});
      const double spare = to - from - kDoor_m - 0.8;
      const double at = 0.5 * (from + to) + spare * rng.uniform(-0.5, 0.5);
      ((i / 2) % 2 == 0 ? west : east).openings.push_back({0.01 * std::round(100.0 * at), kDoor_m});
    }
    from = to;
  }
  plan.walls.push_back(west);
  plan.walls.push_back(east);
}

/// Before the outer walls, away from the corners.
void add_piers(FloorPlan& plan, const Ring& ring, Rng& rng) {
  const Vector2d face = ring.outer - Vector2d::Constant(kHalfWall_m);
  const double loop_m = 4.0 * (face.x() + face.y() - ring.width_m);
  const int count = static_cast<int>(std::lround(loop_m / kPierEvery_m));
  for (int i = 0; i < count; ++i) {
    const std::size_t side = rng.uniform_index(4);
    const int axis = side < 2 ? 0 : 1;  // along the wall
    const double reach = face[axis] - ring.width_m - kClearOfCorner_m;
    const double at = 0.1 * std::round(10.0 * rng.uniform(-reach, reach));
    const double depth = std::min(0.3, ring.width_m - 1.6);
    const double sign = side % 2 == 0 ? -1.0 : 1.0;
    Vector2d low = Vector2d::Zero();
    Vector2d high = Vector2d::Zero();
    low[axis] = at - 0.2;
    high[axis] = at + 0.2;
    low[1 - axis] = sign > 0.0 ? face[1 - axis] - depth : -face[1 - axis];
    high[1 - axis] = sign > 0.0 ? face[1 - axis] : depth - face[1 - axis];
    plan.pillars.emplace_back(low, high);
  }
}

}  // namespace

FloorPlan corridor_loop(const CorridorOptions& options) {
  check_options(options, options.name);
  Rng rng = Rng::stream(options.seed, "corridor plan");
  FloorPlan plan{.size_m = {options.width_m, options.length_m},
                 .rooms = {},
                 .walls = {},
                 .pillars = {},
                 .T_world_starts = {}};
  const Ring ring = draw_ring(options, rng);
  add_ring(plan, ring);
  add_rooms(plan, ring, rng);
  add_piers(plan, ring, rng);
  const Vector2d mid = 0.5 * (ring.outer + ring.inner);
  constexpr double quarter = std::numbers::pi / 2;
  plan.T_world_starts = {{-mid.x(), -mid.y(), 0.0},
                         {mid.x(), -mid.y(), quarter},
                         {mid.x(), mid.y(), 2 * quarter},
                         {-mid.x(), mid.y(), -quarter},
                         {0.0, -mid.y(), 0.0}};
  return plan;
}

OfficeScene make_corridor_scene(const CorridorOptions& options) {
  return furnished({.name = options.name, .seed = options.seed, .clutter = 2},
                   corridor_loop(options));
}

std::vector<CorridorOptions> corridor_scenes() {
  return {{"corridor_loop_1", 51, 15.0, 28.0},   {"corridor_loop_c_1", 71, 15.0, 28.0},
          {"corridor_loop_d_1", 81, 15.0, 28.0}, {"corridor_long_1", 52, 24.0, 55.0},
          {"corridor_long_b_1", 62, 24.0, 55.0}, {"corridor_long_d_1", 82, 24.0, 55.0}};
}

}  // namespace vantage
