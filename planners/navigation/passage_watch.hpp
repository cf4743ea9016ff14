/// What comes into the robot's way while it drives through a passage.
#pragma once

#include "vantage/planners/navigation/path_planning.hpp"

namespace vantage {

/// Whether something occupied is in the outline's way on a leg through a passage, from its pose
/// nearest to the robot's on.
bool is_passage_blocked(const FloorMap& detail, const PathLeg& leg, const Pose2& T_world_base,
                        const RobotOutline& robot);

}  // namespace vantage
