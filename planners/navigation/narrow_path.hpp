/// Paths that lead through passages.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vantage/planners/navigation/path_planning.hpp"

namespace vantage {

/// A point of the search tree on the way from the start.
struct PathStep {
  Eigen::Vector2d p_m;
  std::optional<double> yaw_rad;  ///< in a passage
};

/// In open places as plan_path(), arriving before each passage at the heading it is entered with;
/// in passages in legs at one heading, and turns in place between them.
/// @param steps the start first; at least one is in a passage
PlannedPath path_through_passages(const PathField& field, const std::vector<PathStep>& steps,
                                  double final_yaw_rad);

}  // namespace vantage
