#include "planners/sweep_tables.hpp"

#include <algorithm>
#include <cmath>

#include "planners/parallel_for.hpp"
#include "src/core/error.hpp"

namespace vantage {
namespace {

/// Copies a z slice, x fastest, to its places in the layers of equal x and of equal y.
void distribute(const GridFrame& frame, std::size_t z, const float* slice, float* x_layers,
                float* y_layers) {
  const auto nx = static_cast<std::size_t>(frame.cells.x());
  const auto ny = static_cast<std::size_t>(frame.cells.y());
  const auto nz = static_cast<std::size_t>(frame.cells.z());
  for (std::size_t y = 0; y < ny; ++y) {
    std::copy_n(slice + y * nx, nx, y_layers + (y * nz + z) * nx);
  }
  for (std::size_t x = 0; x < nx; ++x) {
    float* row = x_layers + (x * nz + z) * ny;
    for (std::size_t y = 0; y < ny; ++y) row[y] = slice[y * nx + x];
  }
}

}  // namespace

SweepAxes sweep_axes(int w) {
  switch (w) {
    case 0: return {.u = 1, .v = 2, .w = 0};
    case 1: return {.u = 0, .v = 2, .w = 1};
    default: return {.u = 0, .v = 1, .w = 2};
  }
}

SweepTables::SweepTables(const OccupancyGrid& grid, const Fading& fading, int threads)
    : frame(grid.frame) {
  const auto slices = static_cast<std::size_t>(frame.cells.z());
  cells_per_slice_ = grid.size() / slices;
  expects(fading.transmission_per_slice.size() == slices, "one transmission per z slice");
  for (const double transmission : fading.transmission_per_slice) {
    depth_per_slice.push_back(std::min(static_cast<float>(-std::log(transmission)), kOpaque));
  }
  for (auto& axis : layers) {
    axis = std::make_unique_for_overwrite<float[]>(grid.size() + kLanes);
    std::fill_n(&axis[grid.size()], kLanes, 0.0F);
  }
  auto& [x_layers, y_layers, z_layers] = layers;
  parallel_for(slices, threads, [&](std::size_t z) {
    const std::size_t begin = z * cells_per_slice_;
    for (std::size_t cell = begin; cell < begin + cells_per_slice_; ++cell) {
      z_layers[cell] = grid.state(cell) == CellState::occupied
                           ? -1.0F
                           : fading.worth_of_cell(grid.log_odds[cell]);
    }
    distribute(frame, z, &z_layers[begin], x_layers.get(), y_layers.get());
  });
}

}  // namespace vantage
