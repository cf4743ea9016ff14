#include "vantage/tasks/tabletop/view_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/core/error.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"

namespace vantage {
namespace {

/// Of a lattice of so many points along each edge.
Eigen::Vector3d lattice_point(const Eigen::AlignedBox3d& region, int points, int i) {
  const Eigen::Array3i step(i % points, i / points % points, i / (points * points));
  return region.min().array() + (step.cast<double>() + 0.5) / points * region.sizes().array();
}

/// Whether the sensor sees any of a lattice of points of the region, could it see through things.
bool sees_region(const FieldOfView& field, const Pose& T_world_sensor, const Tabletop& task) {
  constexpr int kPoints = 9;
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Pose T_sensor_world = T_world_sensor.inverse();
  for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
    const Eigen::Vector3d p = lattice_point(region, kPoints, i);
    if (field.contains(T_sensor_world * p)) return true;
  }
  return false;
}

/// Whether any point of a lattice of the region is in the field of view with nothing in the way
/// outside the region.
bool sees_past_things(const RayScene& geometry, const FieldOfView& field,
                      const Pose& T_world_sensor, const Tabletop& task) {
  constexpr int kPoints = 5;
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Pose T_sensor_world = T_world_sensor.inverse();
  const Eigen::Vector3d from_m = T_world_sensor.translation();
  for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
    const Eigen::Vector3d p = lattice_point(region, kPoints, i);
    if (!field.contains(T_sensor_world * p)) continue;
    const Eigen::Vector3d way_m = p - from_m;
    const double free_m = clip_segment(region, from_m, p).enter * way_m.norm();
    if (!geometry.cast(from_m, way_m.normalized(), free_m).hit()) return true;
  }
  return false;
}

/// The true floor: free but where something stands between it and the laser's height.
FloorMap true_floor(const World& world, const Tabletop& task) {
  constexpr double kRolledOver_m = 0.05;
  constexpr double kMostCells = 400.0;
  constexpr double kLayer_m = 0.1;
  FloorMapOptions options = task.floor_map;
  options.cell_m = std::max(options.cell_m, 2.0 * options.half_size_m / kMostCells);
  FloorMap floor = make_floor_map(options);
  std::ranges::fill(floor.log_odds, -1.0F);
  const double top_m = std::max(task.candidates.height_m, kRolledOver_m + kLayer_m);
  const double high_m = top_m - kRolledOver_m;
  const Eigen::Vector2d size_m = floor.cell_m * Eigen::Vector2d(floor.nx, floor.ny);
  const Eigen::Vector2d middle_m = floor.min_corner_m + 0.5 * size_m;
  const GridFrame frame = make_grid_frame(
      {middle_m.x(), middle_m.y(), kRolledOver_m + 0.5 * high_m}, {size_m.x(), size_m.y(), high_m},
      {floor.nx, floor.ny, static_cast<int>(std::ceil(high_m / kLayer_m))});
  const auto surface = surface_cells(world.model(), world.snapshot(), frame, kWithoutRobot);
  for (std::size_t cell = 0; cell < surface.size(); ++cell) {
    if (surface[cell] == 0) continue;
    const auto at = frame.cell(cell);
    floor.blocked[floor.index({at[0], at[1]})] = 1;
  }
  return floor;
}

/// How far from the middle of the map the floor is free towards every position, the robot's size
/// taken off.
double free_radius_m(const FloorMap& floor, const Tabletop& task) {
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Eigen::AlignedBox2d covered(region.min().head<2>(), region.max().head<2>());
  const Eigen::Vector2d middle_m = task.map.centre().head<2>();
  RingOfViews ring = task.candidates;
  ring.yaw_offsets_rad = {0.0};
  double least_m = 2.0 * task.floor_map.half_size_m;
  for (const Candidate& view : ring_of_views(ring, task.map.centre())) {
    const Eigen::Vector2d along =
        (view.T_world_sensor.translation().head<2>() - middle_m).normalized();
    for (double way_m = 0.0; way_m < least_m; way_m += 0.5 * floor.cell_m) {
      const Eigen::Vector2d p = middle_m + way_m * along;
      if (covered.exteriorDistance(p) <= 2.0 * floor.cell_m) continue;
      const Eigen::Array2i cell = floor.cell_at(p);
      if (!floor.contains(cell) || floor.blocked[floor.index(cell)] != 0) least_m = way_m;
    }
  }
  return least_m - task.navigation.inflation_m();
}

/// Positions of the ring by what they are worth.
struct Positions {
  int all = 0;
  int out_of_reach = 0;
  int blind = 0;  ///< of those within reach
  [[nodiscard]] int good() const { return all - out_of_reach - blind; }
};

Positions count_positions(const PathField& paths, const RayScene& geometry, const MobileBase& robot,
                          const Tabletop& task) {
  const FieldOfView field = field_of_view(task.laser);
  const auto views = ring_of_views(task.candidates, task.map.centre());
  const std::size_t turns = task.candidates.yaw_offsets_rad.size();
  Positions positions{.all = task.candidates.positions};
  for (std::size_t first = 0; first < views.size(); first += turns) {
    const Pose2 base = robot.base_for_laser(views[first].T_world_sensor);
    bool sees = false;
    for (std::size_t i = first; i < first + turns && !sees; ++i) {
      sees = sees_past_things(geometry, field, views[i].T_world_sensor, task);
    }
    if (!paths.reachable(Eigen::Vector2d(base.x_m, base.y_m))) {
      ++positions.out_of_reach;
    } else if (!sees) {
      ++positions.blind;
    }
  }
  return positions;
}

}  // namespace

std::string region_text(const Tabletop& task) {
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const Eigen::Vector3d& from = region.min();
  const Eigen::Vector3d& to = region.max();
  return fmt::format(
      "map.centre_m, map.size_m: x {:.3g} to {:.3g}, y {:.3g} to {:.3g}, z {:.3f} to {:.3f}",
      from.x(), to.x(), from.y(), to.y(), from.z(), to.z());
}

double clear_radius_m(const Tabletop& task) {
  const double corner_m = 0.5 * task.map.size().head<2>().norm();
  return std::ceil(100.0 * (corner_m + task.navigation.footprint_radius_m)) / 100.0;
}

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

std::vector<std::string> check_positions(const World& world, const RayScene& geometry,
                                         const MobileBase& robot, const Tabletop& task) {
  FloorMap floor = true_floor(world, task);
  const Eigen::AlignedBox3d region = task.map.frame().box();
  const double free_m = free_radius_m(floor, task);
  block_box(floor, {region.min().head<2>(), region.max().head<2>()});
  const PathField paths = make_path_field(floor, robot.T_world_base(world), task.navigation);
  const Positions positions = count_positions(paths, geometry, robot, task);
  if (positions.good() == positions.all) return {};
  std::string text = fmt::format(
      "candidates.radius_m {}: of {} positions on the ring {} are out of the robot's reach, and {} "
      "more see nothing of the map past what stands between",
      task.candidates.radius_m, positions.all, positions.out_of_reach, positions.blind);
  const double clear_m = clear_radius_m(task);
  if (free_m >= clear_m)
    text += fmt::format("; {:.2f} to {:.2f} is free all round", clear_m, free_m);
  if (positions.good() == 0) throw ConfigError(text);
  return {text};
}

}  // namespace vantage
