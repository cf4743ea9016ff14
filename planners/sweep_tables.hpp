#pragma once

#include <array>
#include <memory>
#include <vector>

#include "planners/attenuated_ray.hpp"
#include "src/geometry/grid_frame.hpp"

namespace vantage {

inline constexpr float kOpaque = 64.0F;  ///< optical depth from which on a cell stops all light
/// Row loops work on so many cells at a time, and so may read and write beyond a row's end.
inline constexpr int kLanes = 8;

/// Axes of the sweep along w: u along the rows of a layer, v across them.
struct SweepAxes {
  int u = 0;
  int v = 1;
  int w = 2;
};
SweepAxes sweep_axes(int w);

/// What the sweep reads of the map, three times: once for each axis along which it goes from layer
/// to layer, with each layer contiguous.
struct SweepTables {
  GridFrame frame;
  /// Cells in layers of equal x, y, z. In a layer, the rows along u come one after the other in the
  /// order of v. So layers[2] has the order of `frame.index`.
  /// > 0: unobserved, and worth that much to see; 0: free; < 0: occupied.
  std::array<std::unique_ptr<float[]>, 3> layers;
  std::vector<float> depth_per_slice;  ///< -ln(transmission) of the unobserved cells of a z slice

  SweepTables(const OccupancyGrid& grid, const Fading& fading, int threads);

  /// -ln p(a beam passes the cell), of index `cell` in the order of `frame.index`.
  [[nodiscard]] float optical_depth(std::size_t cell) const {
    const float content = layers[2][cell];
    if (content <= 0.0F) return content < 0.0F ? kOpaque : 0.0F;
    return depth_per_slice[cell / cells_per_slice_];
  }

 private:
  std::size_t cells_per_slice_;
};

}  // namespace vantage
