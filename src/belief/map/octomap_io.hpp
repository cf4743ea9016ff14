/// Maps in and out as OctoMap files.  [Hornung2013]
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage {

/// Writes the free and occupied cells, as free/occupied (`.bt`) or with their log odds (`.ot`);
/// unobserved cells are not stored. The resolution is the smallest cell edge; every cell keeps a
/// leaf of its own, within half a cell of its centre.
/// @throws OutputError if the extension is another, the grid reaches farther than 32 768 cells from
/// the world's origin, or the file cannot be written; nothing is left under `path` then.
void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& path);

/// `map.bt` and `map.ot` of a folder, from one tree.
void write_octomaps(const OccupancyGrid& grid, const std::filesystem::path& folder);

struct OctomapContent {
  double resolution_m = 0.0;
  std::size_t occupied = 0;  ///< cells of the finest level
  std::size_t free = 0;
  Eigen::AlignedBox3d box;                        ///< of all known cells, world; empty if none
  std::vector<Eigen::Vector3f> occupied_centres;  ///< world, in the tree's order
};

/// @throws InputError as OctomapFile, and if the map has more than 50 million occupied cells.
OctomapContent read_octomap(const std::filesystem::path& path);

/// The map as a grid over the box of its known cells; the others stay at p(o) = 0.5.
/// @throws InputError as OctomapFile, and if the map has no known cell or its box more than 200
/// million cells.
OccupancyGrid read_octomap_grid(const std::filesystem::path& path);

}  // namespace vantage
