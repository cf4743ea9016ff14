/// Evaluates the map of an exploration against ground truth, for metrics and for the `oracle` upper
/// bound alone.
#pragma once

#include <vector>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

namespace vantage {

struct Exploration;

class ExplorationMapEvaluator : public GroundTruthMapEvaluator {
 public:
  /// Observable cells: those that a noise-free sweep sees from at least one place that the robot
  /// can reach; one such place in every square of metrics.pose_spacing_m. `truth` must outlive it.
  ExplorationMapEvaluator(const Exploration& task, int threads, const MobileGroundTruth& truth,
                          const FieldOfView& view_field, const Pose& T_base_sweep);

  [[nodiscard]] std::size_t poses() const { return poses_.size(); }
  /// Those places, as the sweep is there.
  [[nodiscard]] const std::vector<Pose>& T_world_sweeps() const { return poses_; }
  /// What stands or hangs in the robot's way, as it really is.
  [[nodiscard]] const FloorMap& floor() const { return floor_; }

 private:
  std::vector<Pose> poses_;  ///< T_world_sweep
  FloorMap floor_;
};

}  // namespace vantage
