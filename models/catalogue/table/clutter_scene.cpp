#include "vantage/models/catalogue/table/clutter_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using Eigen::Vector2d;

constexpr double kTall_m = 0.15;     // of this two are to be had from each category, else one
constexpr double kHalf_m = 0.46;     // things stay within |x|, |y| of this
constexpr double kBoxHalf_m = 0.42;  // boxes do: a robot must see something of the table it is at
constexpr double kBeforeABox_m = 0.07;  // free of other boxes
constexpr double kInBox_m = 0.004;      // least gap in and on boxes
constexpr double kMaxOverhang = 1.1;    // rider's footprint radius over its support's top radius
constexpr int kMostInACompartment = 4;
constexpr int kSceneAttempts = 400;
constexpr int kBoxAttempts = 400;
constexpr int kObjectAttempts = 800;

void shuffle(auto& items, Rng& rng) {
  for (std::size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[rng.uniform_index(i)]);
  }
}

/// Left out: as long as a box is wide, and nothing anyone puts into one.
bool belongs_here(std::string_view category) { return category != "keyboard"; }

std::vector<PlacedObject> choose_objects(const ClutterSceneOptions& options) {
  Rng rng = Rng::stream(options.seed, options.name + "/objects");
  std::vector<PlacedObject> objects;
  for (const std::string_view category : object_categories()) {
    if (!belongs_here(category)) continue;
    for (int i = 0; i < 2; ++i) {
      const ObjectSpec spec{fmt::format("{}_{:02}", category, i), std::string(category),
                            options.seed};
      PlacedObject placed{.spec = spec,
                          .object = generate(spec),
                          .T_world_object = {},
                          .z_m = kWorktop_m,
                          .support = {}};
      if (i == 0 || placed.object.height_m > kTall_m) objects.push_back(std::move(placed));
    }
  }
  if (std::ssize(objects) < options.objects) {
    throw ConfigError(fmt::format("objects: {} is more than the {} that seed {} makes",
                                  options.objects, objects.size(), options.seed));
  }
  shuffle(objects, rng);
  objects.resize(static_cast<std::size_t>(options.objects));
  return objects;
}

struct Rectangle {
  Vector2d min_m;
  Vector2d max_m;
};

bool inside(const Rectangle& where, const Outline& outline) {
  return std::ranges::all_of(outline, [&](const Vector2d& p) {
    return (p.array() >= where.min_m.array()).all() && (p.array() <= where.max_m.array()).all();
  });
}

bool is_free(const Outline& outline, const std::vector<Outline>& taken, double clearance_m) {
  return std::ranges::none_of(
      taken, [&](const Outline& other) { return too_close(outline, other, clearance_m); });
}

Pose2 any_pose(const Rectangle& where, Rng& rng) {
  const double x = rng.uniform(where.min_m.x(), where.max_m.x());
  const double y = rng.uniform(where.min_m.y(), where.max_m.y());
  return {x, y, rng.uniform(-std::numbers::pi, std::numbers::pi)};
}

class Arrangement {
 public:
  Arrangement(const ClutterSceneOptions& options, const std::vector<PlacedObject>& objects,
              int attempt)
      : options_(options),
        rng_(Rng::stream(options.seed, fmt::format("{}/{}", options.name, attempt))),
        scene_{options.name, options.seed, objects, options.furniture},
        placed_(scene_.objects.size(), false) {
    scene_.top_m = kWorktop_m;
  }

  /// @return whether everything found a place
  bool arrange() {
    if (!place_boxes()) return false;
    fill_boxes();
    make_stacks();
    return place_rest();
  }
  [[nodiscard]] TableScene take() { return std::move(scene_); }

 private:
  bool place_boxes() {
    std::array kinds{OpenBox::Kind::shelf, OpenBox::Kind::crate, OpenBox::Kind::pigeonholes,
                     OpenBox::Kind::carton};
    shuffle(kinds, rng_);
    std::vector<Outline> with_fronts;
    for (int i = 0; i < options_.boxes; ++i) {
      OpenBox box = make_open_box(kinds[static_cast<std::size_t>(i) % kinds.size()], rng_);
      bool found = false;
      for (int attempt = 0; attempt < kBoxAttempts && !found; ++attempt) {
        box.T_world_box = any_pose(kForBoxes, rng_);
        box.T_world_box.yaw_rad = squared(box.T_world_box.yaw_rad);
        const Outline solid = moved(outline(box), box.T_world_box);
        const Outline with_front = moved(outline(box, kBeforeABox_m), box.T_world_box);
        found = inside(kForBoxes, solid) && is_free(with_front, with_fronts, 0.01);
        if (!found) continue;
        taken_.push_back(solid);
        with_fronts.push_back(with_front);
      }
      if (!found) return false;
      scene_.boxes.push_back(box);
    }
    return true;
  }

  /// Things with corners stand more or less along the edges of a table.
  double squared(double yaw_rad) {
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    return kQuarter * std::round(yaw_rad / kQuarter) + rng_.uniform(-0.25, 0.25);
  }

  /// Each object into the first compartment, in an order drawn anew, that has room for it.
  void fill_boxes() {
    struct Place {
      const OpenBox* box;
      Compartment room;
      std::vector<Outline> taken;
    };
    std::vector<Place> places;
    for (const OpenBox& box : scene_.boxes) {
      for (const Compartment& room : compartments(box, kClutterHeight_m)) {
        places.push_back({&box, room, {}});
      }
    }
    auto wanted = static_cast<int>(std::lround(options_.share_in_boxes * options_.objects));
    for (std::size_t i = 0; i < scene_.objects.size() && wanted > 0; ++i) {
      shuffle(places, rng_);
      for (Place& place : places) {
        if (place.taken.size() >= kMostInACompartment ||
            !put_into(i, *place.box, place.room, place.taken)) {
          continue;
        }
        --wanted;
        break;
      }
    }
  }

  bool put_into(std::size_t i, const OpenBox& box, const Compartment& room,
                std::vector<Outline>& taken) {
    PlacedObject& placed = scene_.objects[i];
    if (placed.object.height_m > room.height_m) return false;
    if (!room.inside && !placed.object.stands) return false;
    const Rectangle where{room.min_m + Vector2d::Constant(kInBox_m),
                          room.max_m - Vector2d::Constant(kInBox_m)};
    constexpr int kAttempts = 60;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Pose2 T_box_object = any_pose(where, rng_);
      const Outline outline = moved(placed.object.footprint_m, T_box_object);
      if (!inside(where, outline) || !is_free(outline, taken, kInBox_m)) continue;
      taken.push_back(outline);
      placed.T_world_object = compose(box.T_world_box, T_box_object);
      placed.z_m = kWorktop_m + room.floor_m;
      placed_[i] = true;
      return true;
    }
    return false;
  }

  /// Of what is left, things that stand on others; one on each.
  void make_stacks() {
    int wanted = options_.stacks;
    const auto& objects = scene_.objects;
    for (std::size_t s = 0; s < objects.size() && wanted > 0; ++s) {
      if (placed_[s] || objects[s].support) continue;
      for (std::size_t r = 0; r < objects.size(); ++r) {
        if (r == s || placed_[r] || objects[r].support || carries(s) || carries(r)) continue;
        if (!can_carry(objects[s].object, objects[r].object)) continue;
        scene_.objects[r].support = s;
        scene_.objects[r].z_m = kWorktop_m + objects[s].object.height_m;
        --wanted;
        break;
      }
    }
  }

  [[nodiscard]] bool carries(std::size_t i) const {
    return std::ranges::any_of(scene_.objects, [&](const auto& o) { return o.support == i; });
  }

  static bool can_carry(const GeneratedObject& support, const GeneratedObject& rider) {
    return rider.stands && rider.footprint_radius_m <= kMaxOverhang * support.top_radius_m &&
           support.height_m + rider.height_m < kClutterHeight_m;
  }

  /// Larger things first, each at the first random pose that is free.
  bool place_rest() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      if (!placed_[i] && !scene_.objects[i].support) order.push_back(i);
    }
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return scene_.objects[a].object.footprint_radius_m >
             scene_.objects[b].object.footprint_radius_m;
    });
    return std::ranges::all_of(order, [&](std::size_t i) { return put_on_table(i); });
  }

  bool put_on_table(std::size_t i) {
    for (int attempt = 0; attempt < kObjectAttempts; ++attempt) {
      const Pose2 pose = any_pose(kTable, rng_);
      const Outline outline = moved(scene_.objects[i].object.footprint_m, pose);
      if (!inside(kTable, outline) || !is_free(outline, taken_, options_.clearance_m)) continue;
      taken_.push_back(outline);
      scene_.objects[i].T_world_object = pose;
      for (PlacedObject& rider : scene_.objects) {
        if (rider.support == i) rider.T_world_object = pose;
      }
      return true;
    }
    return false;
  }

  inline static const Rectangle kForBoxes{Vector2d::Constant(-kBoxHalf_m),
                                          Vector2d::Constant(kBoxHalf_m)};
  inline static const Rectangle kTable{Vector2d::Constant(-kHalf_m), Vector2d::Constant(kHalf_m)};

  const ClutterSceneOptions& options_;
  Rng rng_;
  TableScene scene_;
  std::vector<bool> placed_;
  std::vector<Outline> taken_;  ///< of the table, world
};

}  // namespace

TableScene make_clutter_scene(const ClutterSceneOptions& options) {
  check_options(options, options.name);
  const std::vector<PlacedObject> objects = choose_objects(options);
  for (int attempt = 0; attempt < kSceneAttempts; ++attempt) {
    Arrangement arrangement(options, objects, attempt);
    if (arrangement.arrange()) return arrangement.take();
  }
  throw ConfigError(fmt::format("{}: {} objects and {} boxes do not fit on the table", options.name,
                                options.objects, options.boxes));
}

std::vector<ClutterSceneOptions> clutter_scenes() {
  struct Level {
    int objects;
    int boxes;
    int stacks;
  };
  constexpr std::array<Level, 5> kLevels{
      {{4, 1, 0}, {8, 2, 0}, {15, 3, 1}, {25, 4, 3}, {40, 4, 6}}};
  std::vector<ClutterSceneOptions> scenes;
  for (const auto& [set, seed] : {std::pair{"dev", 1000U},
                                  {"report", 2000U},
                                  {"report_b", 3000U},
                                  {"report_c", 4000U},
                                  {"report_d", 5000U},
                                  {"report_e", 7000U}}) {
    for (const Level& level : kLevels) {
      scenes.push_back({.name = fmt::format("clutter_{}_{}", set, level.objects),
                        .seed = seed + static_cast<unsigned>(level.objects),
                        .objects = level.objects,
                        .boxes = level.boxes,
                        .stacks = level.stacks,
                        .furniture = {}});
    }
  }
  return scenes;
}

}  // namespace vantage
