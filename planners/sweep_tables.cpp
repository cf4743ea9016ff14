#include "planners/sweep_tables.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace vantage {
namespace {

std::vector<float> with_y_fastest(const GridFrame& frame, std::span<const float> table) {
  const auto nx = static_cast<std::size_t>(frame.cells.x());
  const auto ny = static_cast<std::size_t>(frame.cells.y());
  std::vector<float> turned(table.size());
  for (std::size_t slice = 0; slice < table.size(); slice += nx * ny) {
    for (std::size_t y = 0; y < ny; ++y) {
      for (std::size_t x = 0; x < nx; ++x) turned[slice + x * ny + y] = table[slice + y * nx + x];
    }
  }
  return turned;
}

}  // namespace

SweepTables::SweepTables(const GridFrame& f, const CellTables& tables) : frame(f) {
  x_fastest.weight = tables.worth;
  x_fastest.optical_depth.resize(f.size());
  float transmission = 1.0F;
  float depth = 0.0F;
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (tables.transmission[i] != transmission) {
      transmission = tables.transmission[i];
      depth = std::min(-std::log(transmission), kOpaque);
    }
    x_fastest.optical_depth[i] = depth;
  }
  y_fastest.optical_depth = with_y_fastest(f, x_fastest.optical_depth);
  y_fastest.weight = with_y_fastest(f, x_fastest.weight);
}

}  // namespace vantage
