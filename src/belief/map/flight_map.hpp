/// The map of a scene that a vehicle flies through, from depth images at camera rate.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

struct FlightMapOptions {
  double cell_m = 0.1;
  int columns = 100;
  double noise_m = 0.03;
  double rise_m = 0.3;
  FreeSpaceUpdate free_space = {};
  void fields(auto&& f) {
    f("cell_m", cell_m,
      "edge of a cell; lower resolves finer, at the inverse cube of it in time and memory",
      Range{0.01, 1.0});
    f("columns", columns,
      "number of image columns whose points are marked, at least: every n-th column and row is, n "
      "the image's width over this, rounded down; freeing looks at every pixel; higher maps finer "
      "and is slower",
      between(8, 4096));
    f("noise_m", noise_m,
      "standard deviation of a point by errors of depth and estimated pose; higher weights a hit "
      "at a cell's edge more like one in its middle",
      above(0.0));
    f("rise_m", rise_m,
      "observed height from which a surface is taken to go on above what was seen of it, as walls "
      "do; higher extends fewer",
      at_least(0.0));
    f("free_space", free_space, "how cells that the camera saw through are updated towards free");
  }
};

class FlightMap {
 public:
  /// @param region_m what is mapped, world
  /// @throws ConfigError if options are out of range or the region has more than 2^26 cells.
  FlightMap(const Eigen::AlignedBox3d& region_m, const FlightMapOptions& options = {});

  /// One image: its points are occupied, what they were seen through is free. The result does not
  /// depend on what was cut away by the border of the region.
  void insert(const CameraImages& images, const Pose& T_world_camera);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// 1 for each cell to keep away from, `grid().frame.index` order: the occupied ones, and above
  /// an occupied run of at least `rise_m` all that was not seen to be free. A camera that looks
  /// down sees the foot of a column, not that it goes on.
  [[nodiscard]] std::vector<std::uint8_t> obstacles() const;
  /// 1 for each cell above a place of which nothing was ever seen, at no height; the same order.
  [[nodiscard]] std::vector<std::uint8_t> unseen_places() const;

 private:
  FlightMapOptions options_;
  OccupancyGrid grid_;
};

}  // namespace vantage
