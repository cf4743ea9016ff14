#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

#include "vantage/geometry/grid_frame.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"
#include "vantage/planners/visibility/transmittance_layer.hpp"

namespace vantage {

inline constexpr float kOpaque =
    64.0F;  ///< optical depth from which on a cell is opaque; a sweep lets 0.4 % through
/// Row loops work on so many cells at a time, and so may read and write beyond a row's end.
inline constexpr int kLanes = 8;

/// The cells from `begin` to before `end` along each axis.
struct CellRegion {
  Eigen::Array3i begin;
  Eigen::Array3i end;
};
/// All that is read of the tables by sweeps from `p_m` with that range, and at least `more` cells
/// round what they see.
CellRegion region_of_sweeps(const GridFrame& frame, const Eigen::Vector3d& p_m, double range_m,
                            const Eigen::Array3i& more);

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
  CellRegion region;  ///< what was worked out; other cells are not to be read
  /// Cells in layers of equal x, y, z. In a layer, the rows along u come one after the other in the
  /// order of v. So layers[2] has the order of `frame.index`.
  /// > 0: unobserved, its utility; 0: free; < 0: occupied.
  std::array<std::unique_ptr<float[]>, 3> layers;

  SweepTables(const OccupancyGrid& grid, const Attenuation& attenuation, int threads);
  SweepTables(const OccupancyGrid& grid, const Attenuation& attenuation, int threads,
              const CellRegion& worked_out);

  /// -ln p(a beam passes the cell), of index `cell` in the order of `frame.index`.
  [[nodiscard]] float optical_depth(std::size_t cell) const { return depth_[cell]; }

  /// -ln(transmission) along the row of the cells (., v) in layer w of an axis, were they all
  /// unobserved. Readable up to TransmittanceLayer::kPadding places beyond either end.
  [[nodiscard]] const float* row_of_depths(int axis, int v, int w) const;

 private:
  /// Rows differ from block to block only.
  struct DepthRows {
    std::size_t stride = 0;
    std::vector<float> rows;
  };
  void fill_slice(const OccupancyGrid& grid, const Attenuation& attenuation, int z);
  [[nodiscard]] DepthRows depth_rows(int axis, const BlockField& depth) const;

  BlockLayout blocks_;
  std::array<DepthRows, 3> depth_rows_;
  std::unique_ptr<float[]> depth_;  ///< of each cell as it is
};

}  // namespace vantage
