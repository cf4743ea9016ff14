/// Evaluates a map against ground truth: which cells are observable, and their true state.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/mapping/mobile_robot_interface.hpp"
#include "vantage/tasks/mapping/scan_record.hpp"

namespace vantage {

class GroundTruthMapEvaluator {
 public:
  /// Nothing is observable yet. `geometry`, of which the truth is, must outlive it.
  GroundTruthMapEvaluator(const World& world, const RayScene& geometry, const GridFrame& frame,
                          const FieldOfView& field_of_view, int threads);
  /// Makes observable what a noise-free sensor sees from at least one of the poses.
  void add_observable(std::span<const Pose> T_world_sensors);

  /// Unobserved cells that a view would really show.
  [[nodiscard]] std::size_t true_new_cells(const OccupancyGrid& grid,
                                           const Pose& T_world_sensor) const;
  [[nodiscard]] std::size_t observable_cells() const { return observable_count_; }
  [[nodiscard]] std::size_t observable_unobserved(const OccupancyGrid& grid) const;
  [[nodiscard]] MapScore score(const OccupancyGrid& grid, int tolerance_cells) const;
  /// Fills in what the record says of the map, held against the truth.
  void measure(const OccupancyGrid& grid, int tolerance_cells, ScanRecord& record) const;

 protected:
  [[nodiscard]] const std::vector<std::uint8_t>& surface() const { return surface_; }

 private:
  const RayScene& geometry_;
  GridFrame frame_;
  FieldOfView field_of_view_;
  int threads_;
  std::vector<std::uint8_t> observable_;
  std::vector<std::uint8_t> surface_;
  std::size_t observable_count_ = 0;
};

/// Flagged cells that the map does not know yet.
std::size_t count_unobserved(const OccupancyGrid& grid, std::span<const std::uint8_t> among);
/// Cells that `after` knows and `before` did not.
std::size_t newly_observed(const OccupancyGrid& before, const OccupancyGrid& after);

/// Fills in what the record says of the pose, held against the truth.
void measure_pose(const MobileRobotTruth& truth, const Pose2& dead_reckoned,
                  const Pose2& T_world_base, ScanRecord& record);

}  // namespace vantage
