/// Carries a PathField on through passages that only the outline of the robot fits through, over
/// (x, y, heading).
#pragma once

#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

/// Dijkstra from the open cells that the field has reached, which stay as they are, or, if there
/// are none, from the robot's pose. Open places need no heading; in a passage a step keeps the
/// heading and a turn the place. Both ends and the middle of each step fit.
/// @param field with `space`
/// @param sideways a robot that can goes through passages at any heading; else one that is nearly
/// square faces where it goes, which takes a fraction of the time
void search_passages(PathField& field, bool sideways = false);

}  // namespace vantage
