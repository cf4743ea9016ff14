/// What hides objects on a table and is none itself. For the scene and for evaluators alone.
#pragma once

#include <Eigen/Core>

#include <string>

#include "vantage/tasks/recognition/standing_room.hpp"

namespace vantage {

/// A thin upright cylinder.
struct Post {
  Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();  ///< from the table's middle
  double radius_m = 0.0;
  double height_m = 0.0;
};

/// Three upright walls round a square, as an open box has them on its side. Open along +x of its
/// own frame.
struct Screen {
  Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();  ///< of the square, from the table's middle
  double yaw_rad = 0.0;                                ///< of the open side
  double half_m = 0.0;                                 ///< of the square's edge, to the walls
  double height_m = 0.0;

  static constexpr double kWall_m = 0.01;  ///< thickness
};

/// Round an object with room for it whichever way it stands.
/// @param spacing_m from the object to the walls
Screen screen_round(const Outline& object, double spacing_m, double height_m);
/// Of all that it encloses.
Outline outline_of(const Screen& screen);

/// @param p_world_table_m middle of the table top
std::string mjcf_of(const Post& post, const std::string& name,
                    const Eigen::Vector3d& p_world_table_m);
std::string mjcf_of(const Screen& screen, const std::string& name,
                    const Eigen::Vector3d& p_world_table_m);

}  // namespace vantage
