/// What comes into the robot's way while it drives through a passage.
#pragma once

#include <vector>

#include "vantage/planners/navigation/path_planning.hpp"

namespace vantage {

/// Whether something occupied is in the outline's way on a leg through a passage, from its pose
/// nearest to the robot's on.
bool is_passage_blocked(const FloorMap& detail, const PathLeg& leg, const Pose2& T_world_base,
                        const RobotOutline& robot);

/// Centres of the cells that the outline comes to in the next 2.5 cm of the leg: where the robot
/// does not get on something stands in one of them.
std::vector<Eigen::Vector2d> cells_before(const FloorMap& detail, const PathLeg& leg,
                                          const Pose2& T_world_base, const RobotOutline& robot);

/// The pose on the leg 10 cm before the robot's, or the leg's first: where it came from is room.
Pose2 pose_behind(const PathLeg& leg, const Pose2& T_world_base);

}  // namespace vantage
