#include "src/belief/headroom.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {
namespace {

enum class Column { open, unseen, obstructed };

struct Slices {
  int begin = 0;
  int end = 0;
};

/// The z slices with their lower faces between two heights.
Slices slices_between(const GridFrame& frame, double low_m, double high_m) {
  Slices slices{0, frame.cells.z()};
  const auto foot_m = [&](int z) { return frame.min_corner_m.z() + z * frame.cell_size_m.z(); };
  while (slices.begin < slices.end && foot_m(slices.begin) < low_m) ++slices.begin;
  while (slices.end > slices.begin && foot_m(slices.end - 1) > high_m) --slices.end;
  return slices;
}

}  // namespace

void HeadroomOptions::check() const {
  if (low_m >= high_m || seen_low_m >= high_m) {
    throw ConfigError(fmt::format("low_m {} and seen_low_m {} must be below high_m {}", low_m,
                                  seen_low_m, high_m));
  }
}

void block_columns(FloorMap& floor, const OccupancyGrid& grid,
                   std::span<const std::uint8_t> vouched, const HeadroomOptions& options) {
  check_options(options, "headroom");
  expects(vouched.size() == floor.size(), "a flag per cell of the floor map");
  const GridFrame& frame = grid.frame;
  const Slices body = slices_between(frame, options.low_m, options.high_m);
  const Slices seen = slices_between(frame, options.seen_low_m, options.high_m);
  const double most_unseen = options.most_unseen * (seen.end - seen.begin);
  const auto judge = [&](int x, int y) {
    for (int z = body.begin; z < body.end; ++z) {
      if (grid.state(frame.index({x, y, z})) == CellState::occupied) return Column::obstructed;
    }
    int unseen = 0;
    for (int z = seen.begin; z < seen.end; ++z) {
      if (grid.state(frame.index({x, y, z})) == CellState::unobserved) ++unseen;
    }
    return unseen > most_unseen ? Column::unseen : Column::open;
  };
  std::ranges::fill(floor.blocked, std::uint8_t{0});
  const Eigen::Vector2d half = 0.5 * frame.cell_size_m.head<2>();
  constexpr double kTouching = 1e-9;
  for (int y = 0; y < frame.cells.y(); ++y) {
    for (int x = 0; x < frame.cells.x(); ++x) {
      const Column column = judge(x, y);
      if (column == Column::open) continue;
      const Eigen::Vector2d centre = frame.centre({x, y, 0}).head<2>();
      const Eigen::Array2i low = floor.cell_at((centre - half).array() + kTouching).max(0);
      const Eigen::Array2i high = floor.cell_at((centre + half).array() - kTouching)
                                      .min(Eigen::Array2i(floor.nx - 1, floor.ny - 1));
      for (int v = low.y(); v <= high.y(); ++v) {
        for (int u = low.x(); u <= high.x(); ++u) {
          const std::size_t cell = floor.index({u, v});
          if (column == Column::obstructed || vouched[cell] == 0) floor.blocked[cell] = 1;
        }
      }
    }
  }
}

}  // namespace vantage
