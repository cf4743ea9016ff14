#include "vantage/models/catalogue/table/table_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/shapes/footprint.hpp"

namespace vantage {
namespace {

constexpr int kInstances = 6;  // per category to choose from
constexpr int kChoices = 40;   // each with another choice of objects
constexpr int kPlaceAttempts = 600;
constexpr double kWidestRider = 1.25;  // rider's footprint radius over its support's top radius

template <class T>
void shuffle(std::vector<T>& items, Rng& rng) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[rng.uniform_index(i)]);
}

std::vector<PlacedObject> choose_objects(const TableSceneOptions& options, Rng& rng) {
  const std::vector<ObjectSpec> specs = catalogue(options.seed, kInstances);
  std::vector<std::size_t> category(specs.size() / kInstances);
  std::iota(category.begin(), category.end(), std::size_t{0});
  shuffle(category, rng);
  std::vector<PlacedObject> objects;
  for (std::size_t i = 0; i < static_cast<std::size_t>(options.objects); ++i) {
    const ObjectSpec& spec = specs[category[i] * kInstances + rng.uniform_index(kInstances)];
    objects.push_back(
        {.spec = spec, .object = generate(spec), .T_world_object = {}, .support = {}});
  }
  return objects;
}

bool can_carry(const GeneratedObject& support, const GeneratedObject& rider) {
  return rider.stands && rider.footprint_radius_m <= kWidestRider * support.top_radius_m &&
         support.height_m + rider.height_m < kMaxHeight_m - 0.005;
}

/// Puts up to `wanted` objects onto others, one on each. @return how many found a support.
int assign_supports(std::vector<PlacedObject>& objects, int wanted) {
  std::vector<bool> used(objects.size(), false);
  int assigned = 0;
  for (std::size_t s = 0; s < objects.size() && assigned < wanted; ++s) {
    for (std::size_t r = 0; r < objects.size() && !used[s]; ++r) {
      if (r == s || used[r] || !can_carry(objects[s].object, objects[r].object)) continue;
      objects[r].support = s;
      objects[r].z_m = kTableTop_m + objects[s].object.height_m;
      used[s] = used[r] = true;
      ++assigned;
    }
  }
  return assigned;
}

bool inside_region(const Outline& outline) {
  return std::ranges::all_of(outline, [](const Eigen::Vector2d& p) {
    return p.cwiseAbs().maxCoeff() <= kPlacementHalf_m;
  });
}

/// A rider stands in the middle of its support, so one outline about a common origin holds both.
Outline unit_outline(const std::vector<PlacedObject>& objects, std::size_t base,
                     double rider_yaw_rad) {
  Outline points = objects[base].object.footprint_m;
  for (const PlacedObject& rider : objects) {
    if (rider.support != base) continue;
    const Outline turned = moved(rider.object.footprint_m, {0.0, 0.0, rider_yaw_rad});
    points.insert(points.end(), turned.begin(), turned.end());
  }
  return convex_outline(std::move(points));
}

Pose2 any_pose(Rng& rng) {
  const double x = rng.uniform(-kPlacementHalf_m, kPlacementHalf_m);
  const double y = rng.uniform(-kPlacementHalf_m, kPlacementHalf_m);
  return {x, y, rng.uniform(-std::numbers::pi, std::numbers::pi)};
}

/// Larger things first, each at the first random pose that is free. @return false if one found
/// none.
bool place_all(std::vector<PlacedObject>& objects, double clearance_m, Rng& rng) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects[i].support) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return objects[a].object.footprint_radius_m > objects[b].object.footprint_radius_m;
  });
  std::vector<Outline> taken;
  for (const std::size_t base : order) {
    const double rider_yaw = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const Outline unit = unit_outline(objects, base, rider_yaw);
    const auto is_free = [&](const Outline& outline) {
      return inside_region(outline) && std::ranges::none_of(taken, [&](const Outline& other) {
               return too_close(outline, other, clearance_m);
             });
    };
    bool placed = false;
    for (int attempt = 0; attempt < kPlaceAttempts && !placed; ++attempt) {
      const Pose2 pose = any_pose(rng);
      Outline outline = moved(unit, pose);
      if (!is_free(outline)) continue;
      objects[base].T_world_object = pose;
      for (PlacedObject& rider : objects) {
        if (rider.support == base) rider.T_world_object = compose(pose, {0.0, 0.0, rider_yaw});
      }
      taken.push_back(std::move(outline));
      placed = true;
    }
    if (!placed) return false;
  }
  return true;
}

}  // namespace

TableScene make_table_scene(const TableSceneOptions& options) {
  check_options(options, options.name);
  for (int attempt = 0; attempt < kChoices; ++attempt) {
    Rng rng = Rng::stream(options.seed, fmt::format("{}/{}", options.name, attempt));
    TableScene scene{options.name, options.seed, choose_objects(options, rng), options.furniture};
    if (assign_supports(scene.objects, options.stacks) < options.stacks) continue;
    if (place_all(scene.objects, options.clearance_m, rng)) return scene;
  }
  throw ConfigError(
      fmt::format("{}: {} objects ({} stacked) with {} m between them do not fit on the table",
                  options.name, options.objects, options.stacks, options.clearance_m));
}

std::vector<TableSceneOptions> standard_scenes() {
  using enum Furniture::Kind;
  const double pi = std::numbers::pi;
  const Furniture cabinet{shelf, {2.80, 0.6, pi}};
  const Furniture far_chair{chair, {-1.9, 1.8, -0.8}};
  const Furniture far_crate{crate, {-2.2, -2.1, 0.3}};
  const Furniture near_chair{chair, {-1.1875, -0.8318, 0.6109}};  // 1.45 m from the table centre
  return {
      {.name = "tabletop_4",
       .seed = 4,
       .objects = 4,
       .stacks = 0,
       .clearance_m = 0.06,
       .furniture = {}},
      {.name = "tabletop_8",
       .seed = 8,
       .objects = 8,
       .stacks = 0,
       .clearance_m = 0.03,
       .furniture = {}},
      {.name = "tabletop_15",
       .seed = 15,
       .objects = 15,
       .stacks = 2,
       .clearance_m = 0.015,
       .furniture = {cabinet, far_chair}},
      {.name = "tabletop_25",
       .seed = 25,
       .objects = 25,
       .stacks = 4,
       .clearance_m = 0.01,
       .furniture = {cabinet, near_chair, far_crate}},
  };
}

}  // namespace vantage
