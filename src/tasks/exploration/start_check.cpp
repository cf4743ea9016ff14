#include "vantage/tasks/exploration/start_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/sensors/ray_scene.hpp"

namespace vantage {
namespace {

/// Floors that a robot on wheels starts on.
constexpr double kStep_m = 0.05;
/// Above the floor, where rays look for it and for room on it.
constexpr double kAnkle_m = 0.2;

bool has_floor(const RayScene& geometry, const Eigen::Vector2d& p_m) {
  const RayHit hit =
      geometry.cast({p_m.x(), p_m.y(), kAnkle_m}, -Eigen::Vector3d::UnitZ(), kAnkle_m + kStep_m);
  return hit.hit() && std::abs(hit.distance_m - kAnkle_m) <= kStep_m;
}

/// Floor from the start on in that direction, up to what stands in the way.
double room_m(const RayScene& geometry, const Eigen::Vector2d& from_m,
              const Eigen::Vector2d& direction, double enough_m) {
  const RayHit hit = geometry.cast({from_m.x(), from_m.y(), kAnkle_m},
                                   {direction.x(), direction.y(), 0.0}, enough_m);
  const double free_m = std::min(hit.distance_m, enough_m);
  for (double way_m = kStep_m; way_m < free_m; way_m += kStep_m) {
    if (!has_floor(geometry, from_m + way_m * direction)) return way_m;
  }
  return free_m;
}

void require_floor(const RayScene& geometry, const Eigen::Vector2d& from_m,
                   const EpisodeSetup& setup, const Exploration& task) {
  const std::string place = start_text(setup.options.robot);
  if (!has_floor(geometry, from_m)) {
    throw InputError(fmt::format("scene: {}: no floor at z = 0 under {}, ({:.2f}, {:.2f})",
                                 setup.scene.string(), place, from_m.x(), from_m.y()));
  }
  constexpr int kDirections = 24;
  const double enough_m = 2.0 * task.navigation.inflation_m();
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    if (room_m(geometry, from_m, along, enough_m) >= enough_m) return;
  }
  throw InputError(fmt::format(
      "scene: {}: no free floor to explore: from {} nothing is free for {:.2f} m in any "
      "direction",
      setup.scene.string(), place, enough_m));
}

}  // namespace

std::string start_text(const RobotOptions& robot) {
  if (!robot.start_site.empty()) return fmt::format("robot.start_site '{}'", robot.start_site);
  const auto pose = robot.start_pose.value_or(std::array{0.0, 0.0, 0.0});
  return fmt::format("robot.start_pose {}", fmt::join(pose, ", "));
}

std::string floor_map_note(const Exploration& task) {
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const double needed_m = std::max(region.min().head<2>().cwiseAbs().maxCoeff(),
                                   region.max().head<2>().cwiseAbs().maxCoeff());
  if (needed_m <= task.floor_map.half_size_m) return {};
  return fmt::format(
      "floor_map.half_size_m: {} ends before the map, {:.2f} m from the world's origin at most: "
      "what "
      "is farther is not driven to; {:.1f} would do",
      task.floor_map.half_size_m, needed_m, std::ceil(2.0 * needed_m) / 2.0);
}

void check_exploration_start(const World& world, const MobileBase& robot, const RayScene& geometry,
                             const EpisodeSetup& setup, const Exploration& task) {
  const Pose2 base = robot.T_world_base(world);
  const Eigen::Vector2d from_m(base.x_m, base.y_m);
  require_floor(geometry, from_m, setup, task);
  const std::string place = start_text(setup.options.robot);
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Eigen::Vector3d& low = region.min();
  const Eigen::Vector3d& high = region.max();
  if (!Eigen::AlignedBox2d(low.head<2>(), high.head<2>()).contains(from_m)) {
    throw ConfigError(
        fmt::format("map.centre_m, map.size_m: x {:.3g} to {:.3g}, y {:.3g} to {:.3g} do not hold "
                    "{}, ({:.2f}, {:.2f}); an exploration's map covers the rooms",
                    low.x(), high.x(), low.y(), high.y(), place, from_m.x(), from_m.y()));
  }
  const double half_m = task.floor_map.half_size_m;
  if (from_m.cwiseAbs().maxCoeff() + task.navigation.footprint_radius_m <= half_m) return;
  throw ConfigError(fmt::format("floor_map.half_size_m: {} ends before {}, ({:.2f}, {:.2f})",
                                half_m, place, from_m.x(), from_m.y()));
}

}  // namespace vantage
