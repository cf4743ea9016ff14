#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/runtime/interrupt.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/mapping/mobile_ground_truth.hpp"

namespace vantage {

namespace {

/// Flagged cells that the map does not know yet.
std::size_t count_unobserved(const OccupancyGrid& grid, std::span<const std::uint8_t> among) {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    count += among[cell] != 0 && grid.state(cell) == CellState::unobserved ? 1 : 0;
  }
  return count;
}

}  // namespace

GroundTruthMapEvaluator::GroundTruthMapEvaluator(const MobileGroundTruth& truth,
                                                 const GridFrame& frame,
                                                 const FieldOfView& field_of_view, int threads)
    : truth_(truth),
      frame_(frame),
      field_of_view_(field_of_view),
      threads_(threads),
      observable_(frame.size(), 0),
      surface_(
          surface_cells(truth.world().model(), truth.world().snapshot(), frame, kWithoutRobot)) {}

void GroundTruthMapEvaluator::add_observable(std::span<const Pose> T_world_sensors) {
  for (const Pose& pose : T_world_sensors) {
    throw_if_interrupted();  // minutes, of an office
    add_visible_cells(truth_.geometry(), frame_, pose, field_of_view_, observable_, -1, threads_);
  }
  observable_count_ = static_cast<std::size_t>(std::ranges::count(observable_, std::uint8_t{1}));
}

std::size_t GroundTruthMapEvaluator::true_new_cells(const OccupancyGrid& grid,
                                                    const Pose& T_world_sensor) const {
  std::vector<std::uint8_t> known(grid.size());
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    known[cell] = grid.state(cell) == CellState::unobserved ? 0 : 1;
  }
  const auto before = std::ranges::count(known, std::uint8_t{1});
  add_visible_cells(truth_.geometry(), frame_, T_world_sensor, field_of_view_, known, -1, threads_);
  return static_cast<std::size_t>(std::ranges::count(known, std::uint8_t{1}) - before);
}

std::size_t GroundTruthMapEvaluator::observable_unobserved(const OccupancyGrid& grid) const {
  return count_unobserved(grid, observable_);
}

MapScore GroundTruthMapEvaluator::score(const OccupancyGrid& grid, int tolerance_cells) const {
  std::vector<std::uint8_t> occupied(grid.size());
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    occupied[cell] = grid.state(cell) == CellState::occupied ? 1 : 0;
  }
  return score_map(grid.frame, occupied, surface_, observable_, tolerance_cells);
}

void GroundTruthMapEvaluator::measure(const OccupancyGrid& grid, int tolerance_cells,
                                      ScanRecord& record) const {
  const MapScore map = score(grid, tolerance_cells);
  record.unobserved_cells = grid.count(CellState::unobserved);
  record.observable_unobserved_cells = observable_unobserved(grid);
  record.precision = map.precision;
  record.recall = map.recall;
}

void GroundTruthMapEvaluator::measure_pose(const ScanPoses& poses, ScanRecord& record) const {
  const Pose2 T_world_true = truth_.T_world_base();
  const auto error_m = [&](const Pose2& pose) {
    return std::hypot(pose.x_m - T_world_true.x_m, pose.y_m - T_world_true.y_m);
  };
  record.pose_error_before_registration_m = error_m(poses.dead_reckoned);
  record.pose_error_tracked_m = error_m(poses.tracked);
  record.pose_error_m = error_m(poses.kept);
  record.yaw_error_rad = wrap_angle(poses.kept.yaw_rad - T_world_true.yaw_rad);
  record.collisions = truth_.collisions();
}

}  // namespace vantage
