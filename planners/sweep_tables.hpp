#pragma once

#include <array>
#include <vector>

#include "planners/attenuated_ray.hpp"
#include "src/geometry/grid_frame.hpp"

namespace vantage {

inline constexpr float kOpaque = 64.0F;  ///< optical depth from which on a cell stops all light
/// Row loops work on so many cells at a time, and so may read and write beyond a row's end.
inline constexpr int kLanes = 8;

/// What the sweep reads of the map, three times: once for each axis along which it goes from layer
/// to layer, with each layer contiguous.
struct SweepTables {
  struct Layers {
    std::vector<float> optical_depth;  ///< -ln(transmission), per cell entered
    std::vector<float> worth;          ///< of seeing the cell, in the gain's unit
  };
  GridFrame frame;
  /// Layers of equal x, y, z. In a layer, the rows run along y, x, x; those of the third axis come
  /// one after the other. So layers[2] has the order of `frame.index`.
  std::array<Layers, 3> layers;

  SweepTables(const OccupancyGrid& grid, const Fading& fading, int threads);
};

}  // namespace vantage
