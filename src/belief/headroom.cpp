#include "src/belief/headroom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

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

/// What there is above each place of the floor; x runs fastest.
class Columns {
 public:
  Columns(const OccupancyGrid& grid, const HeadroomOptions& options)
      : nx_(grid.frame.cells.x()), ny_(grid.frame.cells.y()) {
    const Slices body = slices_between(grid.frame, options.low_m, options.high_m);
    const Slices seen = slices_between(grid.frame, options.seen_low_m, options.high_m);
    const double most_unseen = options.most_unseen * (seen.end - seen.begin);
    columns_.reserve(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        const bool obstructed = count(grid, x, y, body, CellState::occupied) > 0;
        const int unseen = count(grid, x, y, seen, CellState::unobserved);
        columns_.push_back(obstructed             ? Column::obstructed
                           : unseen > most_unseen ? Column::unseen
                                                  : Column::open);
      }
    }
  }

  [[nodiscard]] Column at(int x, int y) const {
    return columns_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
                    static_cast<std::size_t>(x)];
  }

  /// Whether it and all eight round it are in the grid and those round it open.
  [[nodiscard]] bool amid_open(int x, int y) const {
    if (x < 1 || y < 1 || x + 1 >= nx_ || y + 1 >= ny_) return false;
    for (int v = y - 1; v <= y + 1; ++v) {
      for (int u = x - 1; u <= x + 1; ++u) {
        if ((u != x || v != y) && at(u, v) != Column::open) return false;
      }
    }
    return true;
  }

 private:
  static int count(const OccupancyGrid& grid, int x, int y, const Slices& slices, CellState state) {
    int cells = 0;
    for (int z = slices.begin; z < slices.end; ++z) {
      if (grid.state(grid.frame.index({x, y, z})) == state) ++cells;
    }
    return cells;
  }

  int nx_;
  int ny_;
  std::vector<Column> columns_;
};

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
  const Columns columns(grid, options);
  std::ranges::fill(floor.blocked, std::uint8_t{0});
  const Eigen::Vector2d half = 0.5 * frame.cell_size_m.head<2>();
  constexpr double kTouching = 1e-9;
  for (int y = 0; y < frame.cells.y(); ++y) {
    for (int x = 0; x < frame.cells.x(); ++x) {
      const Column column = columns.at(x, y);
      if (column == Column::open) continue;
      if (column == Column::unseen && columns.amid_open(x, y)) continue;
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
