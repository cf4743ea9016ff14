/// Carries a PathField on through passages that only the outline of the robot fits through, over
/// (x, y, heading).
#pragma once

#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

/// Dijkstra from the open cells that the field has reached, which stay as they are, or, if there
/// are none, from the robot's pose. Open places need no heading; in a passage a step keeps the
/// heading and a turn the place. Both ends and the middle of each step fit. A robot that is nearly
/// square faces where it goes, to an eighth of a turn, which takes a fraction of the time.
/// @param field with `space`
void search_passages(PathField& field);

}  // namespace vantage
