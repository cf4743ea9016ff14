/// What stands in a scene, seen from above: for drawings.
#pragma once

#include <vector>

#include "vantage/geometry/floor_outline.hpp"

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

/// Between which heights something must be to be drawn.
struct FloorPlanBand {
  double low_m = 0.05;
  double high_m = 2.0;
};

/// The outline of the convex hull of each geom without the robot, planes aside, that reaches into
/// the band: walls and furniture, no floor, no ceiling.
std::vector<FloorOutline> floor_plan(const mjModel& model, const mjData& data,
                                     const FloorPlanBand& band = {});

}  // namespace vantage
