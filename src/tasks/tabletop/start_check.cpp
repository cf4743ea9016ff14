#include "vantage/tasks/tabletop/start_check.hpp"

#include <fmt/format.h>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

std::string place_text(const RobotOptions& robot, const Tabletop& task) {
  return fmt::format(
      "robot.start_view {} on the ring of candidates.radius_m {}, robot.start_behind_m {}",
      robot.start_view, task.candidates.radius_m, robot.start_behind_m);
}

}  // namespace

bool has_table(const RayScene& geometry, const Tabletop& task) {
  const Eigen::AlignedBox3d region = task.map.frame().box();
  for (int i = 0; i < 25; ++i) {
    const int row = i / 5;
    const Eigen::Array3d share(0.1 + 0.2 * (i % 5), 0.1 + 0.2 * row, 1.0);
    const Eigen::Vector3d p_above = region.min().array() + share * region.sizes().array();
    const RayHit hit = geometry.cast(p_above, -Eigen::Vector3d::UnitZ(), p_above.z());
    if (p_above.z() - hit.distance_m >= task.table.min_height_m) return true;
  }
  return false;
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

void check_start(const World& world, const MobileBase& robot, const RayScene& geometry,
                 const EpisodeSetup& setup, const Tabletop& task) {
  if (!has_table(geometry, task)) {
    throw InputError(
        fmt::format("scene: {}: no table in the region round map.centre_m", setup.scene.string()));
  }
  const Pose2 base = robot.T_world_base(world);
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Eigen::AlignedBox2d floor(region.min().head<2>(), region.max().head<2>());
  const double room_m = floor.exteriorDistance(Eigen::Vector2d(base.x_m, base.y_m));
  if (room_m < task.navigation.footprint_radius_m) {
    throw ConfigError(fmt::format(
        "{}: the robot would stand {:.2f} m from the region of the map, nearer than "
        "navigation.footprint_radius_m {}",
        place_text(setup.options.robot, task), room_m, task.navigation.footprint_radius_m));
  }
  check_turning_room(world, robot, place_text(setup.options.robot, task));
}

}  // namespace vantage
