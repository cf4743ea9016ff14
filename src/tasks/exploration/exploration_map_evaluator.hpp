/// Evaluates the map of an exploration against ground truth, for metrics and for the `oracle` upper
/// bound alone.
#pragma once

#include <vector>

#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

namespace vantage {

class ExplorationMapEvaluator : public GroundTruthMapEvaluator {
 public:
  /// Observable cells: those that a noise-free sweep sees from at least one place that the robot
  /// can reach; one such place in every square of metrics.pose_spacing_m. `robot` must outlive it.
  ExplorationMapEvaluator(const Episode& episode, const ExplorationRobotInterface& robot,
                          const GridFrame& frame);

  [[nodiscard]] std::size_t poses() const { return poses_.size(); }

 private:
  std::vector<Pose> poses_;  ///< T_world_sweep
};

}  // namespace vantage
