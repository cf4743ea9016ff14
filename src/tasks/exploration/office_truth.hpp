/// What there is to see in an office, for metrics and for the `oracle` upper bound alone.
#pragma once

#include <vector>

#include "vantage/tasks/mapping/cell_truth.hpp"
#include "vantage/tasks/exploration/office_rig.hpp"

namespace vantage {

class OfficeTruth : public CellTruth {
 public:
  /// Observable cells: those that a noise-free sweep sees from at least one place that the robot
  /// can reach; one such place in every square of metrics.pose_spacing_m. `rig` must outlive it.
  OfficeTruth(const Episode& episode, const OfficeRig& rig, const GridFrame& frame);

  [[nodiscard]] std::size_t poses() const { return poses_.size(); }

 private:
  std::vector<Pose> poses_;  ///< T_world_sweep
};

}  // namespace vantage
