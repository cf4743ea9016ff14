/// Legs of a path put where the robot keeps the most clearance.
#pragma once

#include "vantage/planners/navigation/path_planning.hpp"

namespace vantage {

/// Straight legs through passages moved to where the outline keeps the most clearance, by up to
/// 4 cm and half a heading; for the path that is driven.
PlannedPath centred(const PathField& field, PlannedPath path);

}  // namespace vantage
