#include "vantage/tasks/tabletop/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/sim/world/level_surfaces.hpp"
#include "vantage/sim/world/settle.hpp"
#include "vantage/tasks/tabletop/table_region.hpp"

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

std::string region_text(const Tabletop& task) {
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const auto from = region.min();
  const auto to = region.max();
  return fmt::format(
      "map.centre_m, map.size_m: x {:.3g} to {:.3g}, y {:.3g} to {:.3g}, z {:.3f} to {:.3f}",
      from.x(), to.x(), from.y(), to.y(), from.z(), to.z());
}

/// "'top' at x -0.5 to 0.5, y -0.5 to 0.5, z 0.720"
std::string table_text(const LevelSurface& table) {
  const auto from = table.extent_m.min();
  const auto to = table.extent_m.max();
  return fmt::format("'{}' at x {:.3g} to {:.3g}, y {:.3g} to {:.3g}, z {:.3f}", table.name,
                     from.x(), to.x(), from.y(), to.y(), table.height_m);
}

/// Of a circle of views from which the robot clears the region on all sides.
double clear_radius_m(const Tabletop& task) {
  const double corner_m = 0.5 * task.map.size().head<2>().norm();
  return std::ceil(100.0 * (corner_m + task.navigation.footprint_radius_m)) / 100.0;
}

/// Whether the sensor sees any of a lattice of points of the region, could it see through things.
bool sees_region(const FieldOfView& field, const Pose& T_world_sensor, const Tabletop& task) {
  constexpr int kPoints = 9;
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Pose T_sensor_world = T_world_sensor.inverse();
  for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
    const Eigen::Array3d step(i % kPoints, i / kPoints % kPoints, i / (kPoints * kPoints));
    const Eigen::Vector3d p =
        region.min().array() + (step + 0.5) / kPoints * region.sizes().array();
    if (field.contains(T_sensor_world * p)) return true;
  }
  return false;
}

/// @throws ConfigError if the floor map ends before a view, or no view reaches the region.
void check_views(const MobileBase& robot, const Tabletop& task) {
  const FieldOfView field = field_of_view(task.laser);
  bool seen = false;
  double farthest_m = 0.0;
  for (const Candidate& view : ring_of_views(task.candidates, task.map.centre())) {
    seen = seen || sees_region(field, view.T_world_sensor, task);
    const Pose2 base = robot.base_for_laser(view.T_world_sensor);
    farthest_m = std::max({farthest_m, std::abs(base.x_m), std::abs(base.y_m)});
  }
  if (!seen) {
    throw ConfigError(fmt::format(
        "laser: range_max_m {}, tilt_min_rad {} to tilt_max_rad {} reach no part of the map from "
        "candidates.radius_m {}, candidates.height_m {}; {}",
        task.laser.range_max_m, task.laser.tilt_min_rad, task.laser.tilt_max_rad,
        task.candidates.radius_m, task.candidates.height_m, region_text(task)));
  }
  const double needed_m = farthest_m + task.navigation.footprint_radius_m;
  if (needed_m <= task.floor_map.half_size_m) return;
  throw ConfigError(fmt::format(
      "floor_map.half_size_m: {} ends before the views round map.centre_m, {:.2f} m from the "
      "world's origin at most; {:.1f} would do",
      task.floor_map.half_size_m, farthest_m, std::ceil(needed_m)));
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
  const double lowest_m = robot.T_base_laser_mount(world).translation().z() - robot.lift_m(world);
  const double highest_m = lowest_m + robot.lift_max_m();
  const double height_m = task.candidates.height_m;
  if (height_m < lowest_m - 1e-3 || height_m > highest_m) {
    throw ConfigError(
        fmt::format("candidates.height_m: {} is out of the laser's reach, {:.3f} to {:.3f}",
                    height_m, lowest_m, highest_m));
  }
  const LaserOptions& laser = task.laser;
  const AngleRange reach = robot.laser_tilt_range();
  if (laser.tilt_min_rad < reach.min_rad || laser.tilt_max_rad > reach.max_rad) {
    throw ConfigError(
        fmt::format("laser: tilt_min_rad {} to tilt_max_rad {} is beyond the joint's {} to {}",
                    laser.tilt_min_rad, laser.tilt_max_rad, reach.min_rad, reach.max_rad));
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

std::vector<std::string> check_start(const World& world, const MobileBase& robot,
                                     const EpisodeSetup& setup, const Tabletop& task) {
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
  return notes;
}

}  // namespace vantage
