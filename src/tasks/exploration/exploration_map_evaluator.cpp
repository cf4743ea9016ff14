#include "vantage/tasks/exploration/exploration_map_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "vantage/belief/map/headroom.hpp"
#include "vantage/planners/navigation/distance_field.hpp"
#include "vantage/planners/navigation/narrow_places.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"
#include "vantage/tasks/mapping/mobile_ground_truth.hpp"

namespace vantage {
namespace {

/// All floor is free but where something stands or hangs at the robot's height.
FloorMap floor_of_truth(const Exploration& task, const GridFrame& frame,
                        const std::vector<std::uint8_t>& surface) {
  OccupancyGrid solid(frame);
  for (std::size_t cell = 0; cell < solid.size(); ++cell) {
    solid.log_odds[cell] = surface[cell] != 0 ? 1.0F : -1.0F;
  }
  FloorMap floor = free_floor(task.floor_map);
  const std::vector<std::uint8_t> nowhere(floor.size(), 0);
  block_columns(floor, solid, nowhere, task.headroom);
  return floor;
}

Eigen::AlignedBox2d floor_region(const GridFrame& frame) {
  const Eigen::AlignedBox3d box = frame.box();
  return {box.min().head<2>(), box.max().head<2>()};
}

/// In every square of a lattice, the place nearest to its middle.
/// @param wanted of each cell, whether it may be one of them
std::vector<Eigen::Vector2d> spread_places(const FloorMap& floor, const GridFrame& frame,
                                           double spacing_m, auto&& wanted) {
  std::map<std::pair<int, int>, std::pair<double, std::size_t>> nearest;
  const Eigen::AlignedBox3d box = frame.box();
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    if (!wanted(cell)) continue;
    const Eigen::Vector2d p = floor.centre(floor.cell(cell));
    const Eigen::Vector2d square = (p - box.min().head<2>()) / spacing_m;
    const Eigen::Vector2d corner = square.array().floor();
    const std::pair rank((square - corner - Eigen::Vector2d(0.5, 0.5)).norm(), cell);
    const std::pair key(static_cast<int>(corner.y()), static_cast<int>(corner.x()));
    const auto [entry, is_new] = nearest.try_emplace(key, rank);
    if (!is_new) entry->second = std::min(entry->second, rank);
  }
  std::vector<Eigen::Vector2d> places;
  for (const auto& [key, rank] : nearest) {
    places.push_back(floor.centre(floor.cell(rank.second)));
  }
  return places;
}

/// Where the robot's outline touches nothing, on cells of the finer map.
FloorMap true_detail(const Exploration& task, const MobileGroundTruth& truth,
                     const FloorMap& floor) {
  FloorMap detail = make_floor_detail(floor, task.floor_detail);
  std::ranges::fill(detail.log_odds, -1.0F);
  GridFrame frame = detail.frame();
  frame.min_corner_m.z() = task.headroom.low_m;
  frame.cell_size_m.z() = task.headroom.high_m - task.headroom.low_m;
  detail.blocked =
      surface_cells(truth.world().model(), truth.world().snapshot(), frame, kWithoutRobot);
  return detail;
}

/// Whether there is floor that the field has not come near to, though something might get there.
bool leaves_something_out(const PathField& field, const Eigen::AlignedBox2d& region_m,
                          double inscribed_m, double least_area_m2) {
  constexpr double kBlocks_m = 0.1;  // that cells take from a gap on either side
  constexpr double kNear_m = 0.6;
  std::vector<std::uint8_t> reached(field.map.size(), 0);
  for (std::size_t cell = 0; cell < reached.size(); ++cell) {
    reached[cell] = field.reachable(cell) ? 1 : 0;
  }
  const std::vector<double> off = squared_distances_cells(reached, field.map.nx, field.map.ny);
  const double near = std::pow(kNear_m / field.map.cell_m, 2);
  double left_m2 = 0.0;
  for (std::size_t cell = 0; cell < reached.size(); ++cell) {
    const bool might = static_cast<double>(field.clearance_m[cell]) >= inscribed_m - kBlocks_m;
    if (!might || off[cell] <= near) continue;
    if (!region_m.contains(field.map.centre(field.map.cell(cell)))) continue;
    left_m2 += field.map.cell_m * field.map.cell_m;
  }
  return left_m2 >= least_area_m2;
}

/// Open cells in parts that are not reached, wholly inside the region: what reaches beyond it is
/// outdoors.
struct UnreachedRooms {
  int count = 0;
  std::vector<std::uint8_t> cells;
};

UnreachedRooms unreached_rooms(const PathField& field, const Eigen::AlignedBox2d& region_m,
                               double least_area_m2) {
  const FloorMap& floor = field.map;
  const auto inside = [&](std::size_t cell) {
    return region_m.contains(floor.centre(floor.cell(cell)));
  };
  std::vector<std::uint8_t> unreached(floor.size(), 0);
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    unreached[cell] = field.traversable(cell) && !field.reachable(cell) ? 1 : 0;
  }
  UnreachedRooms rooms{0, std::vector<std::uint8_t>(floor.size(), 0)};
  for (const auto& part : connected_parts(floor, unreached, 4)) {
    const double area_m2 = static_cast<double>(part.size()) * floor.cell_m * floor.cell_m;
    if (area_m2 < least_area_m2 || !std::ranges::all_of(part, inside)) continue;
    ++rooms.count;
    for (const std::size_t cell : part) rooms.cells[cell] = 1;
  }
  return rooms;
}

}  // namespace

ExplorationMapEvaluator::ExplorationMapEvaluator(const Exploration& task, int threads,
                                                 const MobileGroundTruth& truth,
                                                 const FieldOfView& view_field,
                                                 const Pose& T_base_sweep)
    : GroundTruthMapEvaluator(truth, task.map.frame(), view_field, threads) {
  const GridFrame frame = task.map.frame();
  const Pose2 start = truth.T_world_base();
  const FloorMap floor = floor_of_truth(task, frame, surface());
  PathField field = true_ways(task, truth, floor);
  std::vector<Pose> T_world_sweeps{to_se3(start) * T_base_sweep};
  const double spacing_m = task.metrics.pose_spacing_m;
  for (const auto& p : spread_places(floor, frame, spacing_m,
                                     [&](std::size_t cell) { return field.reachable(cell); })) {
    const double yaw_rad = field.heading_rad(floor.index(floor.cell_at(p))).value_or(0.0);
    T_world_sweeps.push_back(to_se3({p.x(), p.y(), yaw_rad}) * T_base_sweep);
  }
  add_observable(T_world_sweeps);
  if (std::holds_alternative<OracleTour>(task.choice)) remember_visible(T_world_sweeps);
  const UnreachedRooms rooms =
      unreached_rooms(field, floor_region(frame), task.passages.least_area_m2);
  std::vector<Pose> shut;
  for (const auto& p : spread_places(floor, frame, spacing_m,
                                     [&](std::size_t cell) { return rooms.cells[cell] != 0; })) {
    shut.push_back(to_se3({p.x(), p.y(), 0.0}) * T_base_sweep);
  }
  set_left_out(rooms.count, shut);
  set_true_paths(std::move(field));
}

/// By the rule that the robot plans by. Where a disc gets everywhere, outlines are not asked.
PathField ExplorationMapEvaluator::true_ways(const Exploration& task,
                                             const MobileGroundTruth& truth,
                                             const FloorMap& floor) const {
  const Pose2 start = truth.T_world_base();
  PathField field = make_path_field(floor, start, task.navigation);
  const RobotOutline robot = truth.outline();
  if (!task.passages.use ||
      !leaves_something_out(field, floor_region(task.map.frame()),
                            inscribed_radius_m(robot.outline), task.passages.least_area_m2)) {
    return field;
  }
  const auto space = std::make_shared<const FootprintSpace>(
      true_detail(task, truth, floor), task.floor_detail.parts, robot, task.passages);
  return make_path_field(floor, start, task.navigation, space);
}

}  // namespace vantage
