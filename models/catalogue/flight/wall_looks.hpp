/// Windows, a door, pictures and skirting of a room to fly through, and the parts that all looks
/// are made of.
#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>

#include "vantage/models/catalogue/flight/flight_scene.hpp"

namespace vantage {

std::string look_box(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& half_m,
                     std::string_view material);
/// A panel on a face that looks along -y, `proud_m` before it; its middle lies in the face.
std::string look_panel(const Eigen::Vector3d& middle_m, double half_width_m, double half_height_m,
                       double proud_m, std::string_view material);
/// A body looks/`name` on the floor.
std::string look_body(const std::string& name, const Eigen::Vector2d& p_world_m, double yaw_rad,
                      const std::string& geoms);

/// What is on the four walls, clear of the obstacles that stand before them.
std::string wall_looks(const FlightScene& scene);

}  // namespace vantage
