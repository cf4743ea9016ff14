/// A building's scene as MJCF, and an episode that explores it.
#pragma once

#include <string>

#include "vantage/building/building_scene.hpp"

namespace vantage {

/// A map that holds all of the building.
struct BuildingMap {
  Eigen::Vector2d size_m;
  Eigen::Array3i cells;
  double half_size_m = 0.0;  ///< of the floor map
};
BuildingMap map_of(const BuildingScene& scene);

/// @param made_by a line that says how it was made
std::string to_mjcf(const BuildingScene& scene, const std::string& name,
                    const std::string& made_by);

/// Keys in which the episode differs from that of the small office, as arguments of --set.
std::vector<std::string> episode_overrides(const BuildingScene& scene);

/// @param scene_file as the episode names it
std::string to_episode(const BuildingScene& scene, const std::string& scene_file);

}  // namespace vantage
