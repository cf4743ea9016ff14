/// OctoMap files of any extent: read whole, looked at block by block.  [Hornung2013]
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <string>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/belief/map/octomap/octomap_format.hpp"

namespace vantage {

/// An OctoMap file, whole and checked. Leaves are decoded as they are visited: a map takes the
/// memory of its file, however far its cells lie apart.
class OctomapFile {
 public:
  /// @throws InputError if the file is missing, empty, cut short, no OctoMap OcTree, not a regular
  /// file, or larger than 2 GiB.
  explicit OctomapFile(const std::filesystem::path& path);

  [[nodiscard]] const std::string& name() const { return name_; }  ///< for messages
  [[nodiscard]] double resolution_m() const { return header_.resolution_m; }
  [[nodiscard]] std::size_t occupied() const { return occupied_; }  ///< cells of the finest level
  [[nodiscard]] std::size_t free() const { return free_; }
  [[nodiscard]] const CellBlock& known() const { return known_; }  ///< round all leaves

  /// In the tree's order.
  void for_each_leaf(const OctomapLeafVisitor& visit) const;

  [[nodiscard]] Eigen::AlignedBox3d box_of(const CellBlock& block) const;  ///< world, m
  /// The cells that `box_m` (world) reaches into; of an infinite box all.
  [[nodiscard]] CellBlock cells_in(const Eigen::AlignedBox3d& box_m) const;
  /// Those cells as a grid; where the map has none, p(o) is 0.5. Of `coarsen`^3 cells, counted
  /// from the world's origin, one is made: as the most occupied of them if that is occupied or if
  /// at least half of them are known, else unobserved. Of those at the rim the part inside the
  /// block stands for the whole. `coarsen` is at most 1024; the caller bounds the block.
  [[nodiscard]] OccupancyGrid grid_of(const CellBlock& block, int coarsen = 1) const;

 private:
  std::string name_;
  std::string bytes_;
  OctomapHeader header_;
  std::size_t occupied_ = 0;
  std::size_t free_ = 0;
  CellBlock known_;
};

}  // namespace vantage
