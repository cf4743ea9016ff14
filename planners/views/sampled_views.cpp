#include "vantage/planners/views/sampled_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage {
namespace {

constexpr std::size_t kDrawsPerPlace = 10;

/// The part of a free leaf where views may stand; flat if their height is given.
std::optional<Eigen::AlignedBox3d> standing_room(const OctomapFile& map, const OctomapLeaf& leaf,
                                                 const Eigen::AlignedBox3d& within_m) {
  if (classify(leaf.log_odds) != CellState::free) return std::nullopt;
  const Eigen::AlignedBox3d box_m = map.box_of(leaf.block());
  const Eigen::AlignedBox3d room = box_m.intersection(within_m);
  // A level at which one leaf ends and another begins is that of the upper one.
  if (within_m.sizes().z() <= 0.0 && within_m.min().z() >= box_m.max().z()) return std::nullopt;
  if (room.isEmpty() || room.sizes().x() <= 0.0 || room.sizes().y() <= 0.0) return std::nullopt;
  return room;
}

double measure(const Eigen::AlignedBox3d& room, bool flat) {
  const Eigen::Vector3d size_m = room.sizes();
  return size_m.x() * size_m.y() * (flat ? 1.0 : size_m.z());
}

/// Places drawn evenly from all standing room, in the order of the draws.
std::vector<Eigen::Vector3d> draw_places(std::size_t count, const OctomapFile& map,
                                         const Eigen::AlignedBox3d& within_m, Rng& rng) {
  const bool flat = within_m.sizes().z() <= 0.0;
  double total = 0.0;
  map.for_each_leaf([&](const OctomapLeaf& leaf) {
    if (const auto room = standing_room(map, leaf, within_m)) total += measure(*room, flat);
  });
  if (total <= 0.0) return {};
  struct Draw {
    double at = 0.0;  ///< so much of the room comes before it
    Eigen::Vector3d share;
    std::size_t number = 0;
  };
  std::vector<Draw> draws(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = rng.uniform(0.0, total);
    const double x = rng.uniform();
    const double y = rng.uniform();
    draws[i] = {at, {x, y, rng.uniform()}, i};
  }
  std::ranges::sort(draws, {}, &Draw::at);
  std::vector<Eigen::Vector3d> places(count, within_m.min());
  auto next = draws.begin();
  double before = 0.0;
  map.for_each_leaf([&](const OctomapLeaf& leaf) {
    const auto room = standing_room(map, leaf, within_m);
    if (!room) return;
    before += measure(*room, flat);
    for (; next != draws.end() && next->at <= before; ++next) {
      places[next->number] = room->min() + next->share.cwiseProduct(room->sizes());
    }
  });
  return places;
}

/// Without those that have an occupied cell nearer than the clearance.
std::vector<Eigen::Vector3d> clear_places(const std::vector<Eigen::Vector3d>& places,
                                          const OctomapFile& map, double clearance_m) {
  std::vector<std::size_t> by_x(places.size());
  for (std::size_t i = 0; i < by_x.size(); ++i) by_x[i] = i;
  const auto x_of = [&](std::size_t i) { return places[i].x(); };
  std::ranges::sort(by_x, {}, x_of);
  std::vector<bool> blocked(places.size(), false);
  map.for_each_leaf([&](const OctomapLeaf& leaf) {
    if (classify(leaf.log_odds) != CellState::occupied) return;
    const Eigen::AlignedBox3d box = map.box_of(leaf.block());
    auto i = std::ranges::lower_bound(by_x, box.min().x() - clearance_m, {}, x_of);
    for (; i != by_x.end() && x_of(*i) <= box.max().x() + clearance_m; ++i) {
      if (blocked[*i]) continue;
      if (box.squaredExteriorDistance(places[*i]) < clearance_m * clearance_m) blocked[*i] = true;
    }
  });
  std::vector<Eigen::Vector3d> clear;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!blocked[i]) clear.push_back(places[i]);
  }
  return clear;
}

/// Up to `count` of them, each the farthest from those taken before.  [Gonzalez1985]
std::vector<Eigen::Vector3d> spread(const std::vector<Eigen::Vector3d>& places, std::size_t count) {
  std::vector<Eigen::Vector3d> taken;
  std::vector<double> distance2_m2(places.size(), std::numeric_limits<double>::infinity());
  while (taken.size() < std::min(count, places.size())) {
    const auto farthest = std::ranges::max_element(distance2_m2);
    taken.push_back(places[static_cast<std::size_t>(farthest - distance2_m2.begin())]);
    for (std::size_t i = 0; i < places.size(); ++i) {
      distance2_m2[i] = std::min(distance2_m2[i], (places[i] - taken.back()).squaredNorm());
    }
  }
  return taken;
}

[[noreturn]] void fail(const SampledViews& options, const OctomapFile& map, bool free) {
  const Eigen::AlignedBox3d box = map.box_of(map.known());
  const std::string where =
      options.height_m ? fmt::format("at views.height_m = {}", *options.height_m) : "in the region";
  if (!free) {
    throw InputError(fmt::format(
        "{}: no free cell {} to sample views from; the known cells span z from {:.3f} to {:.3f} m",
        map.name(), where, box.min().z(), box.max().z()));
  }
  throw InputError(fmt::format("{}: no free place {} has views.clearance_m = {} to occupied cells",
                               map.name(), where, options.clearance_m));
}

}  // namespace

std::vector<Candidate> sample_views(const SampledViews& options, const OctomapFile& map,
                                    const Eigen::AlignedBox3d& within_m, Rng& rng) {
  check_options(options, "views");
  if (map.known().empty()) throw InputError(map.name() + ": the map has no known cell");
  Eigen::AlignedBox3d box_m = within_m;
  if (options.height_m) box_m.min().z() = box_m.max().z() = *options.height_m;
  const auto wanted = static_cast<std::size_t>(options.positions);
  const auto drawn = draw_places(wanted * kDrawsPerPlace, map, box_m, rng);
  const auto places = spread(clear_places(drawn, map, options.clearance_m), wanted);
  if (places.empty()) fail(options, map, !drawn.empty());
  std::vector<Candidate> views;
  for (const Eigen::Vector3d& p_sensor : places) {
    const double start_rad = rng.uniform(0.0, 2.0 * std::numbers::pi);
    for (int heading = 0; heading < options.headings; ++heading) {
      const double yaw_rad = start_rad + 2.0 * std::numbers::pi * heading / options.headings;
      Candidate view;
      view.id = static_cast<int>(views.size());
      view.T_world_sensor = make_pose(p_sensor, wrap_angle(yaw_rad), options.pitch_rad);
      views.push_back(view);
    }
  }
  return views;
}

}  // namespace vantage
