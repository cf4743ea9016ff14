/// What several views show together: E = sum_c [1 - prod_i (1 - p_i(c))], monotone and submodular.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// Grows view by view. Views show a block's cells independently of each other, as far as is known.
class JointGain {
 public:
  /// @param problem outlives this
  explicit JointGain(const PlanningProblem& problem);

  /// Cells that the view would add.
  [[nodiscard]] double of_adding(std::size_t view) const;
  /// Adds it. @return the cells that it added
  double add(std::size_t view);
  [[nodiscard]] double total() const { return total_; }
  /// Back to no view at all, at the cost of what was shown.
  void clear();

 private:
  const PlanningProblem& problem_;
  std::vector<float> left_;  ///< per block: cells that no view has shown
  std::vector<std::size_t> added_;
  double total_ = 0.0;
};

/// Of those views, in whatever order.
double joint_gain(const PlanningProblem& problem, std::span<const std::size_t> views);

}  // namespace vantage
