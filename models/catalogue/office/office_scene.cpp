#include "vantage/models/catalogue/office/office_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/office/office_programme.hpp"
#include "vantage/models/catalogue/office/plans/drawn_plan.hpp"

namespace vantage {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using std::numbers::pi;

constexpr int kAttempts = 400;  // per group of furniture; then the office does without it
constexpr double kCell_m = 0.1;
/// Between two neighbouring cells that keep it, the way keeps kDriveRadius_m.
constexpr double kCellClearance_m = kDriveRadius_m + kCell_m / 2;
constexpr double kDoorDepth_m = 1.0;
constexpr double kStartRadius_m = kStartClearance_m + 0.1;
constexpr double kGap_m = 0.04;          // between pieces of different groups
constexpr double kReachedPart = 0.15;    // of each room's floor, at least
constexpr double kThreshold_m = 0.85;    // in front of a narrow door, where a disc gets to
constexpr double kHangingPitch_m = 2.6;  // along a wall

Outline item_outline(const PlacedItem& placed) {
  return moved(item_footprint(placed.item, placed.variant), placed.T_world_item);
}

std::vector<Outline> building(const FloorPlan& plan) {
  std::vector<Outline> outlines;
  for (const Wall& wall : plan.walls) {
    for (const AlignedBox2d& box : wall_pieces(wall)) outlines.push_back(outline_of(box));
    for (const AlignedBox2d& box : door_posts(wall)) outlines.push_back(outline_of(box));
  }
  for (const AlignedBox2d& box : plan.pillars) outlines.push_back(outline_of(box));
  return outlines;
}

/// An octagon round a circle.
Outline disc(const Vector2d& centre_m, double radius_m) {
  Outline outline;
  for (int i = 0; i < 8; ++i) {
    const double angle = pi * (2 * i + 1) / 8;
    outline.emplace_back(centre_m +
                         radius_m / std::cos(pi / 8) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

/// The office while it is furnished.
struct Layout {
  OfficeScene scene;
  std::vector<Outline> taken;  ///< also door ways and starts, where nothing may stand
  ClearanceMap clearance;
  bool has_narrow_doors = false;
};

Layout empty_layout(const OfficeOptions& options, const FloorPlan& plan) {
  const AlignedBox2d area(-0.5 * plan.size_m, 0.5 * plan.size_m);
  Layout layout{{options.name, options.seed, options.clutter, plan, {}},
                building(plan),
                ClearanceMap(area, kCell_m, kCellClearance_m + 2 * kCell_m),
                options.doors_m > 0.0};
  for (const Outline& outline : layout.taken) layout.clearance.add(outline);
  for (const Wall& wall : plan.walls) {
    for (const AlignedBox2d& way : door_ways(wall, kDoorDepth_m)) {
      layout.taken.push_back(outline_of(way));
    }
  }
  for (const Pose2& start : plan.T_world_starts) {
    layout.taken.push_back(disc(position(start), kStartRadius_m));
  }
  return layout;
}

/// With narrow doors a disc has to get about in each room alone, between its doors and the starts
/// in it.
bool rooms_within_reach(const FloorPlan& plan, const ClearanceMap& clearance) {
  std::vector<Vector2d> wanted;
  for (const Pose2& start : plan.T_world_starts) wanted.push_back(position(start));
  for (const Wall& wall : plan.walls) {
    const auto places = thresholds(wall, kThreshold_m);
    wanted.insert(wanted.end(), places.begin(), places.end());
  }
  return std::ranges::all_of(plan.rooms, [&](const Room& room) {
    std::vector<Vector2d> within;
    std::ranges::copy_if(wanted, std::back_inserter(within),
                         [&](const Vector2d& p) { return room.area_m.contains(p); });
    if (within.empty()) return true;
    const std::vector<bool> reached = clearance.reachable(within.front(), kCellClearance_m);
    double floor_m2 = 0.0;
    for (std::size_t cell = 0; cell < reached.size(); ++cell) {
      if (reached[cell] && room.area_m.contains(clearance.centre_m(cell))) {
        floor_m2 += kCell_m * kCell_m;
      }
    }
    return floor_m2 >= kReachedPart * room.area_m.volume() &&
           std::ranges::all_of(within,
                               [&](const Vector2d& p) { return reached[clearance.cell_at(p)]; });
  });
}

bool all_within_reach(const FloorPlan& plan, const ClearanceMap& clearance) {
  const std::vector<bool> reached =
      clearance.reachable(position(plan.T_world_starts.front()), kCellClearance_m);
  std::vector<double> floor_m2(plan.rooms.size(), 0.0);
  for (std::size_t cell = 0; cell < reached.size(); ++cell) {
    if (!reached[cell]) continue;
    const Vector2d p = clearance.centre_m(cell);
    const auto room = std::ranges::find_if(
        plan.rooms, [&](const Room& candidate) { return candidate.area_m.contains(p); });
    if (room == plan.rooms.end()) continue;  // in a door way
    floor_m2[static_cast<std::size_t>(room - plan.rooms.begin())] += kCell_m * kCell_m;
  }
  for (std::size_t r = 0; r < plan.rooms.size(); ++r) {
    if (floor_m2[r] < kReachedPart * plan.rooms[r].area_m.volume()) return false;
  }
  return std::ranges::all_of(plan.T_world_starts, [&](const Pose2& start) {
    return reached[clearance.cell_at(position(start))];
  });
}

/// Side 0 is west, then counter-clockwise; `share` runs along the side.
Pose2 foot_of_wall(const AlignedBox2d& area, std::size_t side, double share) {
  const Vector2d& a = area.min();
  const Vector2d& b = area.max();
  const double x = a.x() + share * (b.x() - a.x());
  const double y = a.y() + share * (b.y() - a.y());
  switch (side) {
    case 0: return {a.x(), y, 0.0};
    case 1: return {x, a.y(), pi / 2};
    case 2: return {b.x(), y, pi};
    default: return {x, b.y(), -pi / 2};
  }
}

Pose2 any_pose(const AlignedBox2d& area, Spot spot, Rng& rng) {
  const std::size_t side = rng.uniform_index(4);
  const double share = rng.uniform();
  const double depth = rng.uniform();
  if (spot == Spot::wall) return foot_of_wall(area, side, share);
  const Vector2d p = area.min() + Vector2d(share, depth).cwiseProduct(area.sizes());
  const double yaw =
      spot == Spot::middle ? pi / 2 * static_cast<double>(side) : rng.uniform(-pi, pi);
  return {p.x(), p.y(), yaw};
}

bool fits(const Layout& layout, const AlignedBox2d& area, const std::vector<Outline>& outlines) {
  return std::ranges::all_of(outlines, [&](const Outline& outline) {
    return std::ranges::all_of(outline, [&](const Vector2d& p) { return area.contains(p); }) &&
           std::ranges::none_of(layout.taken, [&](const Outline& other) {
             return too_close(outline, other, kGap_m);
           });
  });
}

/// Leaves the group out if there is no room for it.
void place(Layout& layout, const Room& room, OfficeGroup group, Rng& rng) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::vector<PlacedItem> items = make_group(group, rng);
    const Pose2 pose = any_pose(room.area_m, spot_of(group), rng);
    std::vector<Outline> outlines;
    for (PlacedItem& placed : items) {
      placed.T_world_item = compose(pose, placed.T_world_item);
      outlines.push_back(item_outline(placed));
    }
    if (!fits(layout, room.area_m, outlines)) continue;
    ClearanceMap clearance = layout.clearance;
    for (const Outline& outline : outlines) clearance.add(outline);
    const bool good = layout.has_narrow_doors ? rooms_within_reach(layout.scene.plan, clearance)
                                              : all_within_reach(layout.scene.plan, clearance);
    if (!good) continue;
    layout.clearance = std::move(clearance);
    layout.taken.insert(layout.taken.end(), outlines.begin(), outlines.end());
    layout.scene.furniture.insert(layout.scene.furniture.end(), items.begin(), items.end());
    return;
  }
}

/// Whether there is wall behind all of it: where corridors meet a side of a room is open.
bool has_wall_behind(const FloorPlan& plan, const PlacedItem& placed) {
  const Outline outline = item_footprint(placed.item, placed.variant);
  const auto [right, left] =
      std::ranges::minmax(outline, {}, [](const Vector2d& p) { return p.y(); });
  return std::ranges::all_of(std::array{right.y(), left.y()}, [&](double along_m) {
    const Pose2 behind = compose(placed.T_world_item, {-kHalfWall_m, along_m, 0.0});
    return std::ranges::any_of(plan.walls, [&](const Wall& wall) {
      return std::ranges::any_of(wall_pieces(wall), [&](const AlignedBox2d& piece) {
        return piece.contains(Vector2d(behind.x_m, behind.y_m));
      });
    });
  });
}

/// Windows in the outer walls, boards and posters on the others.
void hang(Layout& layout, const Room& room, Rng& rng) {
  const Vector2d outer = 0.5 * layout.scene.plan.size_m - Vector2d::Constant(0.2);
  for (std::size_t side = 0; side < 4; ++side) {
    const double length = room.area_m.sizes()[side % 2 == 0 ? 1 : 0];
    const int count = static_cast<int>(length / kHangingPitch_m);
    for (int i = 0; i < count; ++i) {
      const Pose2 pose = foot_of_wall(room.area_m, side, (i + 0.5) / count);
      const bool outside = std::abs(pose.x_m) > outer.x() || std::abs(pose.y_m) > outer.y();
      const OfficeItem inner = rng.uniform() < 0.3 ? OfficeItem::whiteboard : OfficeItem::poster;
      const int variant = static_cast<int>(rng.uniform_index(kVariants));
      const PlacedItem placed{outside ? OfficeItem::window : inner, variant, pose};
      const bool wanted = outside || rng.uniform() < 0.4;
      const Outline before_it =
          moved(item_footprint(placed.item, variant), compose(pose, {0.05, 0, 0}));
      const bool covered = std::ranges::any_of(
          layout.taken, [&](const Outline& other) { return too_close(before_it, other, 0.0); });
      if (wanted && !covered && has_wall_behind(layout.scene.plan, placed)) {
        layout.scene.furniture.push_back(placed);
      }
    }
  }
}

}  // namespace

FloorPlan floor_plan(const OfficeOptions& options) {
  if (options.doors_m > 0.0) return door_office(options.doors_m);
  if (options.walls > 0) {
    return options.large ? drawn_large_office(options.walls) : drawn_small_office(options.walls);
  }
  return options.large ? large_office() : small_office();
}

OfficeScene make_office_scene(const OfficeOptions& options) {
  return furnished(options, floor_plan(options));
}

OfficeScene furnished(const OfficeOptions& options, const FloorPlan& plan) {
  check_options(options, options.name);
  Layout layout = empty_layout(options, plan);
  const std::vector<Room> rooms = layout.scene.plan.rooms;
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    Rng rng = Rng::stream(options.seed, fmt::format("room {} walls", r));
    hang(layout, rooms[r], rng);
  }
  for (int level = 1; level <= options.clutter; ++level) {
    for (std::size_t r = 0; r < rooms.size(); ++r) {
      Rng rng = Rng::stream(options.seed, fmt::format("room {} level {}", r, level));
      for (const OfficeGroup group : programme(rooms[r], level))
        place(layout, rooms[r], group, rng);
    }
  }
  return std::move(layout.scene);
}

std::vector<Outline> obstacles(const OfficeScene& scene) {
  std::vector<Outline> outlines = building(scene.plan);
  for (const PlacedItem& placed : scene.furniture) outlines.push_back(item_outline(placed));
  return outlines;
}

}  // namespace vantage
