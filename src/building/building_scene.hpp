/// A scene made of a building's mesh: shapes that sensors see and robots touch alike.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "vantage/building/free_floor.hpp"
#include "vantage/building/mesh_parts.hpp"

namespace vantage {

struct BuildingOptions {
  double cell_m = 0.05;
  std::optional<double> floor_m = {};  ///< height of the floor in the mesh; none: found
  double height_m = 3.0;
  double clearance_m = 0.6;
  int max_geoms = 3000;
};

/// How far below the floor a building goes on.
inline constexpr double kBelowFloor_m = 0.3;

struct BoxShape {
  OrientedBox box;
  Eigen::Vector3f colour;
};
struct HullShape {
  std::vector<Eigen::Vector3d> corners_m;
  Eigen::Vector3f colour;
};

struct BuildingScene {
  Eigen::Isometry3d T_scene_mesh = Eigen::Isometry3d::Identity();
  double cell_m = 0.0;
  std::vector<BoxShape> boxes;       ///< of parts that are boxes: exact
  std::vector<HullShape> hulls;      ///< of other convex parts: exact
  std::vector<BoxShape> cell_boxes;  ///< of all else: within a cell
  bool laid_floor = false;           ///< the mesh has none there: a plane at z = 0
  FreeFloor floor;
  Eigen::AlignedBox2d extent_m;  ///< of all that stands on the floor

  [[nodiscard]] std::size_t geoms() const {
    return boxes.size() + hulls.size() + cell_boxes.size() + (laid_floor ? 1 : 0);
  }
};

/// The mesh turned so that its walls run along x and y, its floor at z = 0, what stands on it in
/// the middle. Parts that are convex stay what they are. All others become boxes of cells of a grid
/// that is fitted to their faces: faces along the axes stay where they are, other surfaces are off
/// by a cell at most.
/// @param name of the mesh, in messages @param step tells what begins
/// @throws InputError if there is no floor, or no room on it for a robot; ConfigError if the
/// options lead to too many cells or geoms.
BuildingScene make_building_scene(BuildingMesh mesh, const BuildingOptions& options,
                                  const std::string& name,
                                  const std::function<void(std::string_view)>& step);

}  // namespace vantage
