#include "vantage/tasks/start_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

std::string geom_text(const mjModel& model, int geom) {
  const std::string name = model_name(model, ModelObject::geom, geom);
  return name.empty() ? fmt::format("geom number {}", geom) : fmt::format("'{}'", name);
}

std::string place_text(const Episode& episode) {
  return fmt::format(
      "robot.start_view {} on the ring of candidates.radius_m {}, robot.start_behind_m {}",
      episode.robot.start_view, episode.candidates.radius_m, episode.robot.start_behind_m);
}

}  // namespace

bool has_table(const RayScene& geometry, const Episode& episode) {
  const Eigen::AlignedBox3d region = episode.grid_frame().box();
  for (int i = 0; i < 25; ++i) {
    const int row = i / 5;
    const Eigen::Array3d share(0.1 + 0.2 * (i % 5), 0.1 + 0.2 * row, 1.0);
    const Eigen::Vector3d p_above = region.min().array() + share * region.sizes().array();
    const RayHit hit = geometry.cast(p_above, -Eigen::Vector3d::UnitZ(), p_above.z());
    if (p_above.z() - hit.distance_m >= episode.table.min_height_m) return true;
  }
  return false;
}

void check_reach(const World& world, const Pr2& robot, const Episode& episode) {
  const double lowest_m = robot.T_base_laser_mount(world).translation().z() - robot.torso_m(world);
  const double highest_m = lowest_m + robot.torso_max_m();
  const double height_m = episode.candidates.height_m;
  if (height_m < lowest_m - 1e-3 || height_m > highest_m) {
    throw ConfigError(
        fmt::format("candidates.height_m: {} is out of the laser's reach, {:.3f} to {:.3f}",
                    height_m, lowest_m, highest_m));
  }
  const LaserOptions& laser = episode.laser;
  const AngleRange reach = robot.laser_tilt_range();
  if (laser.tilt_min_rad < reach.min_rad || laser.tilt_max_rad > reach.max_rad) {
    throw ConfigError(
        fmt::format("laser: tilt_min_rad {} to tilt_max_rad {} is beyond the joint's {} to {}",
                    laser.tilt_min_rad, laser.tilt_max_rad, reach.min_rad, reach.max_rad));
  }
}

void check_start(const World& world, const Pr2& robot, const RayScene& geometry,
                 const ResolvedEpisode& resolved) {
  const Episode& episode = resolved.episode;
  if (!has_table(geometry, episode)) {
    throw InputError(fmt::format("scene: {}: no table in the region round map.centre_m",
                                 resolved.scene.string()));
  }
  const Pose2 base = robot.T_world_base(world);
  const Eigen::AlignedBox3d region = episode.grid_frame().box();
  const Eigen::AlignedBox2d floor(region.min().head<2>(), region.max().head<2>());
  const double room_m = floor.exteriorDistance(Eigen::Vector2d(base.x_m, base.y_m));
  if (room_m < episode.navigation.footprint_radius_m) {
    throw ConfigError(
        fmt::format("{}: the robot would stand {:.2f} m from the region of the map, nearer than "
                    "navigation.footprint_radius_m {}",
                    place_text(episode), room_m, episode.navigation.footprint_radius_m));
  }
  check_turning_room(world, robot, place_text(episode));
}

void check_turning_room(const World& world, const Pr2& robot, const std::string& place) {
  if (const auto touched = robot.touched_by_turning(world); !touched.empty()) {
    throw ConfigError(fmt::format("{}: the robot would touch {} when it turns there", place,
                                  geom_text(world.model(), touched.front())));
  }
}

Pose2 office_start(const World& world, const ResolvedEpisode& resolved) {
  const RobotOptions& robot = resolved.episode.robot;
  if (robot.start_site.empty()) {
    return {robot.start_pose[0], robot.start_pose[1], wrap_angle(robot.start_pose[2])};
  }
  if (const auto site = find_model_id(world.model(), ModelObject::site, robot.start_site)) {
    return project_to_se2(site_pose(world, *site));
  }
  std::vector<std::string> known = model_names(world.model(), ModelObject::site);
  std::erase_if(known, [](const std::string& name) { return name.starts_with("robot/"); });
  throw ConfigError(fmt::format("robot.start_site: no site '{}' in {}; {}", robot.start_site,
                                resolved.scene.string(),
                                known.empty() ? "it has none: set robot.start_pose"
                                              : fmt::format("known: {}", fmt::join(known, ", "))));
}

std::string office_start_text(const Episode& episode) {
  const RobotOptions& robot = episode.robot;
  if (!robot.start_site.empty()) return fmt::format("robot.start_site '{}'", robot.start_site);
  return fmt::format("robot.start_pose {}", fmt::join(robot.start_pose, ", "));
}

double camera_lift_m(const Pr2& robot, double lowest_m, const Episode& episode) {
  const double height_m = episode.exploration.frontiers.height_m;
  const double lift_m = height_m - lowest_m;
  if (lift_m < -1e-2 || lift_m > robot.torso_max_m()) {
    throw ConfigError(fmt::format(
        "exploration.frontiers.height_m: {} is out of the camera's reach, {:.3f} to {:.3f}",
        height_m, lowest_m, lowest_m + robot.torso_max_m()));
  }
  return std::max(lift_m, 0.0);
}

}  // namespace vantage
