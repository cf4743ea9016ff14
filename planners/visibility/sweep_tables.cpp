#include "vantage/planners/visibility/sweep_tables.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/core/parallel_for.hpp"

namespace vantage {
namespace {

/// Edge of the tiles in which a slice is turned, in cells: a line of the cache each way.
constexpr std::size_t kTile = 16;

/// Copies what the region has of a z slice, x fastest, to its places in the layers of equal x and
/// of equal y.
void distribute(const GridFrame& frame, const CellRegion& region, std::size_t z, const float* slice,
                float* x_layers, float* y_layers) {
  const auto nx = static_cast<std::size_t>(frame.cells.x());
  const auto ny = static_cast<std::size_t>(frame.cells.y());
  const auto nz = static_cast<std::size_t>(frame.cells.z());
  const auto x_begin = static_cast<std::size_t>(region.begin.x());
  const auto x_end = static_cast<std::size_t>(region.end.x());
  const auto y_begin = static_cast<std::size_t>(region.begin.y());
  const auto y_end = static_cast<std::size_t>(region.end.y());
  for (std::size_t y = y_begin; y < y_end; ++y) {
    std::copy(slice + y * nx + x_begin, slice + y * nx + x_end,
              y_layers + (y * nz + z) * nx + x_begin);
  }
  for (std::size_t y_tile = y_begin; y_tile < y_end; y_tile += kTile) {
    const std::size_t y_last = std::min(y_tile + kTile, y_end);
    for (std::size_t x = x_begin; x < x_end; ++x) {
      float* row = x_layers + (x * nz + z) * ny;
      for (std::size_t y = y_tile; y < y_last; ++y) row[y] = slice[y * nx + x];
    }
  }
}

}  // namespace

CellRegion region_of_sweeps(const GridFrame& frame, const Eigen::Vector3d& p_m, double range_m,
                            const Eigen::Array3i& more) {
  // Interpolation reads beside what is seen, and row loops whole lanes.
  const Eigen::Array3i margin = more.max(2 * kLanes);
  const Eigen::Vector3d range = Eigen::Vector3d::Constant(range_m);
  const Eigen::AlignedBox3d box = frame.box();
  const Eigen::Vector3d low_m = (p_m - range).cwiseMax(box.min());
  const Eigen::Vector3d high_m = (p_m + range).cwiseMin(box.max());
  const Eigen::Array3i begin = (frame.cell_at(low_m) - margin).max(0).min(frame.cells);
  return {begin, (frame.cell_at(high_m) + margin + 1).min(frame.cells).max(begin)};
}

SweepAxes sweep_axes(int w) {
  switch (w) {
    case 0: return {.u = 1, .v = 2, .w = 0};
    case 1: return {.u = 0, .v = 2, .w = 1};
    default: return {.u = 0, .v = 1, .w = 2};
  }
}

SweepTables::SweepTables(const OccupancyGrid& grid, const Attenuation& attenuation, int threads)
    : SweepTables(grid, attenuation, threads, {Eigen::Array3i::Zero(), grid.frame.cells}) {}

SweepTables::SweepTables(const OccupancyGrid& grid, const Attenuation& attenuation, int threads,
                         const CellRegion& worked_out)
    : frame(grid.frame), region(worked_out), blocks_(attenuation.transmission.layout) {
  expects((blocks_.cells == frame.cells).all(), "transmissions for a grid of this size");
  BlockField unobserved = attenuation.transmission;
  for (double& depth : unobserved.per_block) {
    depth = std::min(-std::log(depth), static_cast<double>(kOpaque));
  }
  for (int axis = 0; axis < 3; ++axis) {
    depth_rows_[static_cast<std::size_t>(axis)] = depth_rows(axis, unobserved);
  }
  for (auto& axis : layers) {
    axis = std::make_unique_for_overwrite<float[]>(grid.size() + kLanes);
    std::fill_n(&axis[grid.size()], kLanes, 0.0F);
  }
  depth_ = std::make_unique_for_overwrite<float[]>(grid.size());
  parallel_for(static_cast<std::size_t>(region.end.z() - region.begin.z()), threads,
               [&](std::size_t i) {
                 fill_slice(grid, attenuation, region.begin.z() + static_cast<int>(i));
               });
}

void SweepTables::fill_slice(const OccupancyGrid& grid, const Attenuation& attenuation, int z) {
  auto& [x_layers, y_layers, z_layers] = layers;
  for (int y = region.begin.y(); y < region.end.y(); ++y) {
    const float* unobserved = row_of_depths(2, y, z);
    std::size_t cell = frame.index({region.begin.x(), y, z});
    for (int x = region.begin.x(); x < region.end.x(); ++x, ++cell) {
      const bool occupied = grid.state(cell) == CellState::occupied;
      const float utility = occupied ? -1.0F : attenuation.utility_of_cell(grid.log_odds[cell]);
      z_layers[cell] = utility;
      depth_[cell] = occupied ? kOpaque : utility > 0.0F ? unobserved[x] : 0.0F;
    }
  }
  distribute(frame, region, static_cast<std::size_t>(z), &z_layers[frame.index({0, 0, z})],
             x_layers.get(), y_layers.get());
}

SweepTables::DepthRows SweepTables::depth_rows(int axis, const BlockField& depth) const {
  const SweepAxes axes = sweep_axes(axis);
  const int length = frame.cells[axes.u];
  DepthRows made;
  made.stride = static_cast<std::size_t>(length) + 2 * TransmittanceLayer::kPadding;
  Eigen::Array3i block;
  for (block[axes.w] = 0; block[axes.w] < blocks_.blocks[axes.w]; ++block[axes.w]) {
    for (block[axes.v] = 0; block[axes.v] < blocks_.blocks[axes.v]; ++block[axes.v]) {
      for (int i = -TransmittanceLayer::kPadding; i < length + TransmittanceLayer::kPadding; ++i) {
        block[axes.u] = blocks_.block_of(axes.u, std::clamp(i, 0, length - 1));
        const std::size_t index = blocks_.index(block.x(), block.y(), block.z());
        made.rows.push_back(static_cast<float>(depth.per_block[index]));
      }
    }
  }
  return made;
}

const float* SweepTables::row_of_depths(int axis, int v, int w) const {
  const SweepAxes axes = sweep_axes(axis);
  const DepthRows& table = depth_rows_[static_cast<std::size_t>(axis)];
  const int row =
      blocks_.block_of(axes.w, w) * blocks_.blocks[axes.v] + blocks_.block_of(axes.v, v);
  return &table.rows[static_cast<std::size_t>(row) * table.stride + TransmittanceLayer::kPadding];
}

}  // namespace vantage
