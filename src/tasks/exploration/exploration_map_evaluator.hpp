/// Evaluates the map of an exploration against ground truth, for metrics and for the `oracle` upper
/// bound alone.
#pragma once

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

namespace vantage {

struct Exploration;

class ExplorationMapEvaluator : public GroundTruthMapEvaluator {
 public:
  /// Observable cells: those that a noise-free sweep sees from at least one place that the robot
  /// can reach; one such place in every square of metrics.pose_spacing_m. Left out is what is seen
  /// from rooms that it cannot get to. `truth` must outlive it.
  ExplorationMapEvaluator(const Exploration& task, int threads, const MobileGroundTruth& truth,
                          const FieldOfView& view_field, const Pose& T_base_sweep);

  /// `oracle_tour` may scan from any of them, and knows what it would see.
  [[nodiscard]] std::size_t poses() const { return observing_poses().size(); }

 private:
  [[nodiscard]] PathField true_ways(const Exploration& task, const MobileGroundTruth& truth,
                                    const FloorMap& floor) const;
};

}  // namespace vantage
