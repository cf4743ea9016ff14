/// What stands on a floor, seen from above.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace vantage {

/// Corners of a convex outline, world x and y in m, counter-clockwise.
using FloorOutline = std::vector<Eigen::Vector2d>;

}  // namespace vantage
