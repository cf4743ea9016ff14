#include "vantage/tasks/tabletop/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/sim/world/level_surfaces.hpp"
#include "vantage/sim/world/settle.hpp"
#include "vantage/tasks/tabletop/table_region.hpp"
#include "vantage/tasks/tabletop/view_check.hpp"

namespace vantage {
namespace {

std::string place_text(const RobotOptions& robot, const Tabletop& task) {
  return fmt::format(
      "robot.start_view {} on the ring of candidates.radius_m {}, robot.start_behind_m {}",
      robot.start_view, task.candidates.radius_m, robot.start_behind_m);
}

/// A map that begins higher over the table misses what stands on it.
constexpr double kMostAboveTable_m = 0.1;
/// Noise of a table top that a map begins at.
constexpr double kTouches_m = 0.005;
constexpr const char* kFollow = "map.centre_m: auto follows the table";

/// "'top' at x -0.5 to 0.5, y -0.5 to 0.5, z 0.720"
std::string table_text(const LevelSurface& table) {
  const auto from = table.extent_m.min();
  const auto to = table.extent_m.max();
  return fmt::format("'{}' at x {:.3g} to {:.3g}, y {:.3g} to {:.3g}, z {:.3f}", table.name,
                     from.x(), to.x(), from.y(), to.y(), table.height_m);
}

[[noreturn]] void refuse(const World& world, const std::string& scene, const Tabletop& task) {
  throw InputError(fmt::format("scene: {}: {}", scene,
                               no_table_text(world.model(), world.snapshot(), task.table)));
}

bool has_table(const World& world, const Tabletop& task) {
  return !level_surfaces(world.model(), world.snapshot(), table_surfaces(task.table)).empty();
}

}  // namespace

void require_table(const World& world, const EpisodeSetup& setup, const Tabletop& task) {
  if (has_table(world, task)) return;
  const std::string scene = setup.scene.string();
  World alone({.scene = setup.scene, .robot = {}}, setup.options.simulation);
  try {
    settle_free_bodies(alone);
  } catch (const InputError& error) {
    throw InputError(fmt::format("scene: {}: {}", scene, error.what()));
  }
  if (!has_table(alone, task)) refuse(alone, scene, task);
}

void check_reach(const World& world, const MobileBase& robot, const Tabletop& task) {
  const double unlifted_m = robot.T_base_laser_mount(world).translation().z() - robot.lift_m(world);
  const double lowest_m = unlifted_m + robot.lift_min_m();
  const double highest_m = unlifted_m + robot.lift_max_m();
  const double height_m = task.candidates.height_m;
  if (height_m < lowest_m - 1e-3 || height_m > highest_m) {
    const double fitting_m =
        std::floor(1e3 * std::clamp(height_m, lowest_m, highest_m) + 1e-6) / 1e3;
    throw ConfigError(fmt::format(
        "candidates.height_m: {} is out of the laser's reach, {:.3f} to {:.3f}; {:.3f} fits, in "
        "robot.yaml episode_defaults: {{tabletop: {{candidates: {{height_m: {:.3f}}}}}}}",
        height_m, lowest_m, highest_m, fitting_m, fitting_m));
  }
  const LaserOptions& laser = task.laser;
  const AngleRange reach = robot.laser_tilt_range();
  if (laser.tilt_min_rad < reach.min_rad || laser.tilt_max_rad > reach.max_rad) {
    throw ConfigError(fmt::format(
        "laser: tilt_min_rad {} to tilt_max_rad {} is beyond the joint's {} to {}; within it is, "
        "in robot.yaml, episode_defaults: {{tabletop: {{laser: {{tilt_min_rad: {:.4g}, "
        "tilt_max_rad: {:.4g}}}}}}}",
        laser.tilt_min_rad, laser.tilt_max_rad, reach.min_rad, reach.max_rad,
        std::max(laser.tilt_min_rad, reach.min_rad), std::min(laser.tilt_max_rad, reach.max_rad)));
  }
}

std::vector<std::string> check_table(const World& world, const EpisodeSetup& setup,
                                     const Tabletop& task) {
  const std::string scene = setup.scene.string();
  const auto surfaces = level_surfaces(world.model(), world.snapshot(), table_surfaces(task.table));
  if (surfaces.empty()) refuse(world, scene, task);
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Eigen::AlignedBox2d floor(region.min().head<2>(), region.max().head<2>());
  const auto below = std::ranges::find_if(surfaces, [&](const LevelSurface& surface) {
    return surface.extent_m.intersects(floor) &&
           surface.height_m < region.max().z() - task.objects.min_height_m;
  });
  if (below == surfaces.end()) {
    throw ConfigError(fmt::format("{} of the map miss the table of {}: {}; {}", region_text(task),
                                  scene, table_text(*table_among(surfaces)), kFollow));
  }
  const double gap_m = region.min().z() - below->height_m;
  if (gap_m > kMostAboveTable_m) {
    throw ConfigError(fmt::format("{}: the map begins {:.2f} m above the table of {}, {}; {}",
                                  region_text(task), gap_m, scene, table_text(*below), kFollow));
  }
  if (gap_m > -kTouches_m) return {};
  return {
      fmt::format("{}: the map reaches {:.3f} m below the table top of {}, which counts as "
                  "surface that is never found; {}",
                  region_text(task), -gap_m, scene, kFollow)};
}

std::vector<std::string> check_start(const World& world, const RayScene& geometry,
                                     const MobileBase& robot, const EpisodeSetup& setup,
                                     const Tabletop& task) {
  std::vector<std::string> notes = check_table(world, setup, task);
  check_views(robot, task);
  const Pose2 base = robot.T_world_base(world);
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Eigen::AlignedBox2d floor(region.min().head<2>(), region.max().head<2>());
  const double room_m = floor.exteriorDistance(Eigen::Vector2d(base.x_m, base.y_m));
  if (room_m < task.navigation.footprint_radius_m) {
    throw ConfigError(
        fmt::format("{}: the robot would stand {:.2f} m from the region of the map, nearer than "
                    "navigation.footprint_radius_m {}; candidates.radius_m {:.2f} clears it",
                    place_text(setup.options.robot, task), room_m,
                    task.navigation.footprint_radius_m, clear_radius_m(task)));
  }
  check_turning_room(world, robot, place_text(setup.options.robot, task));
  for (std::string& note : check_positions(world, geometry, robot, task)) {
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace vantage
