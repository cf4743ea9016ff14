/// Where the known free space ends in the unknown: candidates for exploring offices.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

struct FrontierOptions {
  int min_cells = 20;
  double max_extent_m = 3.0;
  double height_m = 1.05;
  std::optional<std::array<double, 2>> height_band_m = {};
  void fields(auto&& f) {
    f("min_cells", min_cells,
      "least number of cells of a frontier cluster; smaller ones are dropped; higher leaves nooks "
      "unexplored",
      at_least(1));
    f("max_extent_m", max_extent_m,
      "greatest extent of a frontier cluster; longer ones are split; lower proposes more "
      "candidates",
      above(0.0));
    f("height_m", height_m, "world z of the candidate views: that of the sensor",
      between(-1e6, 1e6));
    f("height_band_m", height_band_m,
      "lowest and highest world z of frontier cells, which spares views of floor and ceiling; "
      "null: all heights count");
  }
  void check() const;  ///< the band's lowest below its highest
};

struct Frontier {
  std::vector<std::size_t> cells;  ///< ascending
  Eigen::Vector3d p_m;             ///< world; where to look at it from, at height_m
};

/// Free cells that share a face with an unobserved one, ascending. Outside the grid nothing is
/// unobserved.  [Yamauchi1997]
std::vector<std::size_t> frontier_cells(const OccupancyGrid& grid, const FrontierOptions& options);

/// Frontier cells in clusters that touch at least by a corner, the largest first, of equals the one
/// with the lowest cell. A cluster longer than max_extent_m along its principal axis is halved
/// there, again and again, as long as neither half falls below min_cells. p_m lies above or below
/// the centroid, or, if that place is not known to be free, the cluster's cell nearest to the
/// centroid, with preference for cells whose own place at height_m is free. None: all is explored.
/// @throws ConfigError if the options are out of range.
std::vector<Frontier> find_frontiers(const OccupancyGrid& grid, const FrontierOptions& options);

}  // namespace vantage
