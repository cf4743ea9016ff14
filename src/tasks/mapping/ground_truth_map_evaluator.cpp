#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

#include <algorithm>
#include <bit>
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

/// Of the flags that are 0 or 1.
CellSet set_of(std::span<const std::uint8_t> flags) {
  CellSet set((flags.size() + 63) / 64);
  for (std::size_t cell = 0; cell < flags.size(); ++cell) {
    set[cell / 64] |= std::uint64_t{flags[cell]} << (cell % 64);
  }
  return set;
}

CellSet without(CellSet set, const CellSet& others) {
  for (std::size_t i = 0; i < set.size(); ++i) set[i] &= ~others[i];
  return set;
}

}  // namespace

KnownCells known_cells(const OccupancyGrid& grid) {
  KnownCells known{.flags = std::vector<std::uint8_t>(grid.size()), .set = {}};
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    known.flags[cell] = grid.state(cell) == CellState::unobserved ? 0 : 1;
  }
  known.set = set_of(known.flags);
  return known;
}

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
    observing_poses_.push_back(pose);
  }
  observable_count_ = static_cast<std::size_t>(std::ranges::count(observable_, std::uint8_t{1}));
}

void GroundTruthMapEvaluator::set_left_out(int rooms, std::span<const Pose> T_world_sensors) {
  std::vector<std::uint8_t> seen = observable_;
  for (const Pose& pose : T_world_sensors) {
    throw_if_interrupted();
    add_visible_cells(truth_.geometry(), frame_, pose, field_of_view_, seen, -1, threads_);
  }
  const auto all = static_cast<std::size_t>(std::ranges::count(seen, std::uint8_t{1}));
  left_out_ = LeftOut{rooms, all - observable_count_};
}

void GroundTruthMapEvaluator::remember_visible(std::span<const Pose> T_world_sensors) {
  for (const Pose& pose : T_world_sensors) {
    throw_if_interrupted();
    remembered_.push_back({pose, visible_set(pose)});
  }
}

CellSet GroundTruthMapEvaluator::visible_set(const Pose& T_world_sensor) const {
  const std::size_t cells = frame_.size();
  return visible_unless({std::vector<std::uint8_t>(cells, 0), CellSet((cells + 63) / 64)},
                        T_world_sensor);
}

CellSet GroundTruthMapEvaluator::observable_set() const { return set_of(observable_); }

CellSet GroundTruthMapEvaluator::visible_unless(const KnownCells& known,
                                                const Pose& T_world_sensor) const {
  std::vector<std::uint8_t> shown = known.flags;
  add_visible_cells(truth_.geometry(), frame_, T_world_sensor, field_of_view_, shown, -1, threads_);
  return without(set_of(shown), known.set);
}

CellSet GroundTruthMapEvaluator::true_new_cell_set(const KnownCells& known,
                                                   const Pose& T_world_sensor) const {
  const auto found = std::ranges::find_if(remembered_, [&](const Remembered& remembered) {
    return remembered.T_world_sensor.matrix() == T_world_sensor.matrix();
  });
  if (found == remembered_.end()) return visible_unless(known, T_world_sensor);
  return without(found->visible, known.set);
}

std::size_t GroundTruthMapEvaluator::true_new_cells(const KnownCells& known,
                                                    const Pose& T_world_sensor) const {
  std::size_t count = 0;
  for (const std::uint64_t word : true_new_cell_set(known, T_world_sensor)) {
    count += static_cast<std::size_t>(std::popcount(word));
  }
  return count;
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
  record.pose_error_at_scan_m = record.pose_error_m = error_m(poses.kept);
  record.yaw_error_rad = wrap_angle(poses.kept.yaw_rad - T_world_true.yaw_rad);
  record.T_true_kept = compose(inverse(T_world_true), poses.kept);
  record.collisions = truth_.collisions();
}

void GroundTruthMapEvaluator::measure_moved_pose(const Pose2& T_world_base, ScanRecord& record) {
  const Pose2 T_world_true = compose(record.T_world_base, inverse(record.T_true_kept));
  record.T_true_kept = compose(inverse(T_world_true), T_world_base);
  record.pose_error_m = std::hypot(record.T_true_kept.x_m, record.T_true_kept.y_m);
  record.yaw_error_rad = wrap_angle(record.T_true_kept.yaw_rad);
  record.T_world_base = T_world_base;
}

}  // namespace vantage
