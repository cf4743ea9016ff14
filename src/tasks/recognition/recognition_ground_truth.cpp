#include "vantage/tasks/recognition/recognition_ground_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "vantage/tasks/flight/full_turn.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"
#include "vantage/tasks/recognition/standing_room.hpp"

namespace vantage {
namespace {

/// The objects that are not on the table yet.
class Stock {
 public:
  explicit Stock(const RecognitionTask& task)
      : database_(dataset_of(task.database)), names_(known_objects(task)) {}

  [[nodiscard]] const std::vector<ObjectName>& names() const { return names_; }
  [[nodiscard]] TurntableObject make(const ObjectName& name) const {
    return make_turntable_object(database_, name);
  }
  void take(const std::string& object) { taken_.insert(object); }

  /// One that is left and passes, any of them as likely; nothing if none is left.
  template <class Passes>
  std::optional<ObjectName> draw(Rng& rng, const Passes& passes) {
    std::vector<ObjectName> left;
    for (const ObjectName& name : names_) {
      if (!taken_.contains(name.object)) left.push_back(name);
    }
    for (std::size_t tried = 0; tried < left.size(); ++tried) {  // what passes may be slow to tell
      std::swap(left[tried], left[tried + rng.uniform_index(left.size() - tried)]);
      if (!passes(left[tried])) continue;
      take(left[tried].object);
      return left[tried];
    }
    return std::nullopt;
  }

 private:
  DatasetOptions database_;
  std::vector<ObjectName> names_;
  std::set<std::string> taken_;
};

Eigen::Vector2d table_size_m(const RecognitionTask& task) {
  return {task.map.size_m[0], task.map.size_m[1]};
}

/// Of the first targets, each turned at random; where it stands is where its target does.
std::vector<Screen> draw_screens(const RecognitionTask& task, std::uint64_t seed,
                                 const Stock& stock, std::span<const ObjectOnTable> targets) {
  if (task.clutter.screens > std::ssize(targets)) {
    throw ConfigError(fmt::format("clutter.screens: {} of them, but targets is {}",
                                  task.clutter.screens, task.targets));
  }
  Rng rng = Rng::stream(seed, "screens");
  std::vector<Screen> screens;
  for (const ObjectOnTable& target :
       targets.first(static_cast<std::size_t>(task.clutter.screens))) {
    const Outline object = outline_of(stock.make({target.category, target.object}));
    screens.push_back(screen_round(object, task.clutter.spacing_m, task.clutter.screen_m));
    screens.back().yaw_rad = rng.uniform(0.0, kTurn_rad);
  }
  return screens;
}

/// What a target takes of the table round its middle, with its screen if it has one.
std::vector<Outline> footprints(const Stock& stock, std::span<const ObjectOnTable> targets,
                                std::span<const Screen> screens) {
  std::vector<Outline> taken;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const ObjectName name{targets[i].category, targets[i].object};
    taken.push_back(i < screens.size()
                        ? outline_of(screens[i])
                        : placed(outline_of(stock.make(name)), targets[i].yaw_rad, {0.0, 0.0}));
  }
  return taken;
}

/// Draws where the targets stand, away from the table's edge, one after the other.
/// @return false if one finds no room beside the former ones
bool find_places(const RecognitionTask& task, Rng& rng, std::span<const Outline> footprints,
                 std::span<ObjectOnTable> targets) {
  constexpr double kApart_m = 0.25;  // room for something in between
  constexpr double kFromEdge_m = 0.2;
  constexpr int kAttempts = 2000;
  const Eigen::Vector2d half_m = (0.5 * table_size_m(task).array() - kFromEdge_m).max(0.0).matrix();
  std::vector<Outline> standing;
  for (ObjectOnTable& target : targets) {
    const Eigen::Vector2d off_m = target.offset_m;
    const std::span<const ObjectOnTable> put = targets.first(standing.size());
    bool found = false;
    for (int i = 0; i < kAttempts && !found; ++i) {
      target.told_m = {rng.uniform(-half_m.x(), half_m.x()), rng.uniform(-half_m.y(), half_m.y())};
      target.offset_m = off_m + target.told_m;
      const Outline there = placed(footprints[put.size()], 0.0, target.offset_m);
      found = std::ranges::all_of(put, [&](const ObjectOnTable& other) {
        return (other.told_m - target.told_m).norm() >= kApart_m;
      });
      found = found && std::ranges::all_of(standing, [&](const Outline& other) {
                return gap_m(there, other) >= task.clutter.spacing_m;
              });
      if (found) standing.push_back(there);
    }
    if (!found) return false;
  }
  return true;
}

/// Each at a place of its own.
void put_apart(const RecognitionTask& task, Rng rng, std::span<const Outline> footprints,
               std::vector<ObjectOnTable>& targets) {
  constexpr int kTries = 20;
  for (int i = 0; i < kTries; ++i) {
    std::vector<ObjectOnTable> put = targets;
    if (!find_places(task, rng, footprints, put)) continue;
    targets = std::move(put);
    return;
  }
  throw ConfigError(fmt::format("targets: no room for {} of them on a table of {} x {} m",
                                task.targets, task.map.size_m[0], task.map.size_m[1]));
}

std::vector<ObjectOnTable> draw_targets(const RecognitionTask& task, std::uint64_t seed,
                                        Stock& stock) {
  std::vector<ObjectOnTable> targets{draw_object(task, seed)};
  stock.take(targets.front().object);
  Rng rng = Rng::stream(seed, "targets");
  for (int i = 1; i < task.targets; ++i) {
    const auto name = stock.draw(rng, [](const ObjectName&) { return true; });
    if (!name) {
      throw ConfigError(fmt::format("targets: {} of them, but database.objects has {}",
                                    task.targets, stock.names().size()));
    }
    targets.push_back({name->object, name->category, rng.uniform(0.0, kTurn_rad),
                       drawn_offset_m(rng.next(), task.placement_m)});
  }
  return targets;
}

const ObjectName& name_of(const Stock& stock, const std::string& object) {
  return *std::ranges::find(stock.names(), object, &ObjectName::object);
}

/// The `i`th thing round the targets: near-duplicates come first, then tall ones, then any.
std::optional<ObjectName> draw_other(const RecognitionTask& task,
                                     const std::vector<ObjectOnTable>& targets, int i, Stock& stock,
                                     Rng& rng) {
  const ClutterOptions& clutter = task.clutter;
  std::optional<ObjectName> name;
  if (i < clutter.near_duplicates) {
    const ObjectName& like =
        name_of(stock, targets[static_cast<std::size_t>(i) % targets.size()].object);
    name = stock.draw(rng, [&](const ObjectName& n) { return n.family == like.family; });
    if (!name) {
      name = stock.draw(rng, [&](const ObjectName& n) { return n.category == like.category; });
    }
  } else if (i < clutter.near_duplicates + clutter.tall) {
    name = stock.draw(rng, [&](const ObjectName& n) {
      return stock.make(n).box_m.sizes().z() >= clutter.tall_m;
    });
  }
  return name ? name : stock.draw(rng, [](const ObjectName&) { return true; });
}

ConfigError no_room(const char* key, int count) {
  return ConfigError(fmt::format(
      "{}: no room for {} of them on the table; fewer, a smaller clutter.spacing_m or a larger "
      "clutter.reach_m leave more",
      key, count));
}

void put_posts(const RecognitionTask& task, std::uint64_t seed, StandingRoom& room,
               TableGroundTruth& table) {
  Rng rng = Rng::stream(seed, "posts");
  StandingRoom::Place place;
  for (int i = 0; i < task.clutter.posts; ++i) {
    Post post{.radius_m = rng.uniform(0.02, 0.035),
              .height_m = rng.uniform(0.8, 1.0) * task.map.height_m};
    if (!room.place(round_outline(post.radius_m), rng, place)) {
      throw no_room("clutter.posts", task.clutter.posts);
    }
    post.offset_m = place.p_m;
    table.posts.push_back(post);
  }
}

/// What finds no room is laid aside, and another one drawn.
void put_others(const RecognitionTask& task, std::uint64_t seed, Stock& stock, StandingRoom& room,
                TableGroundTruth& table) {
  constexpr int kLaidAside = 30;
  Rng which = Rng::stream(seed, "clutter");
  Rng places = Rng::stream(seed, "clutter places");
  StandingRoom::Place place;
  for (int i = 0; i < task.clutter.objects; ++i) {
    bool stands = false;
    for (int laid_aside = 0; laid_aside <= kLaidAside && !stands; ++laid_aside) {
      const auto name = draw_other(task, table.targets, i, stock, which);
      if (!name && laid_aside > 0) throw no_room("clutter.objects", task.clutter.objects);
      if (!name) {
        throw ConfigError(
            fmt::format("clutter.objects: {} objects and {} targets, but database.objects has {}",
                        task.clutter.objects, task.targets, stock.names().size()));
      }
      stands = room.place(outline_of(stock.make(*name)), places, place);
      if (stands) table.others.push_back({name->object, name->category, place.yaw_rad, place.p_m});
    }
    if (!stands) throw no_room("clutter.objects", task.clutter.objects);
  }
}

}  // namespace

ObjectOnTable draw_object(const RecognitionTask& task, std::uint64_t seed) {
  const std::vector<ObjectName> names = known_objects(task);
  const ObjectName& name =
      named_or_drawn(names, task.object, "object", Rng::stream(seed, "object"));
  return {name.object, name.category, drawn_yaw_rad(seed, "object yaw"),
          drawn_offset_m(seed, task.placement_m)};
}

TableGroundTruth draw_table(const RecognitionTask& task, std::uint64_t seed) {
  if (!task.among_others()) return {{draw_object(task, seed)}, {}, {}, {}};
  Stock stock(task);
  TableGroundTruth table{draw_targets(task, seed, stock), {}, {}, {}};
  table.screens = draw_screens(task, seed, stock, table.targets);
  const std::vector<Outline> taken = footprints(stock, table.targets, table.screens);
  if (task.targets > 1) put_apart(task, Rng::stream(seed, "target places"), taken, table.targets);
  std::vector<Eigen::Vector2d> round_m;
  for (const ObjectOnTable& target : table.targets) round_m.push_back(target.offset_m);
  StandingRoom room({round_m, task.clutter.reach_m, task.clutter.spacing_m, table_size_m(task)});
  for (std::size_t i = 0; i < taken.size(); ++i) room.take(placed(taken[i], 0.0, round_m[i]));
  for (std::size_t i = 0; i < table.screens.size(); ++i) table.screens[i].offset_m = round_m[i];
  put_posts(task, seed, room, table);
  put_others(task, seed, stock, room, table);
  return table;
}

std::vector<MemoryFile> table_files(const RecognitionTask& task, const TableGroundTruth& table) {
  std::vector<NamedObject> objects;
  for (std::size_t i = 0; i < table.targets.size(); ++i) {
    objects.push_back({body_of_target(i), table.targets[i]});
  }
  for (std::size_t i = 0; i < table.others.size(); ++i) {
    objects.push_back({fmt::format("other_{}", i), table.others[i]});
  }
  const Eigen::Vector3d p_m = task.p_world_table_m();
  std::string obstacles;
  for (std::size_t i = 0; i < table.posts.size(); ++i) {
    obstacles += mjcf_of(table.posts[i], fmt::format("post_{}", i), p_m);
  }
  for (std::size_t i = 0; i < table.screens.size(); ++i) {
    obstacles += mjcf_of(table.screens[i], fmt::format("screen_{}", i), p_m);
  }
  return object_files(task, objects, obstacles);
}

}  // namespace vantage
