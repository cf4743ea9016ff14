#include "vantage/belief/map/headroom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace vantage {
namespace {

/// Shares of a wall's slices that are occupied, at the robot's height and in 35 cm above it. A full
/// shelf, whose boards stand out from what the scanner sees in it, is a wall by the first alone.
constexpr double kOfWall = 0.9;
constexpr double kOfWallAbove = 0.7;
constexpr double kAbove_m = 0.35;

enum class Column { open, unseen, obstructed, wall, wall_edge };

struct Slices {
  int begin, end;
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
  /// @param scanner_m height at which walls are told from other obstacles; none: never
  Columns(const OccupancyGrid& grid, const HeadroomOptions& options,
          std::optional<double> scanner_m)
      : nx_(grid.frame.cells.x()), ny_(grid.frame.cells.y()) {
    const Slices body = slices_between(grid.frame, options.low_m, options.high_m);
    const Slices seen = slices_between(grid.frame, options.seen_low_m, options.high_m);
    const Slices above = slices_between(grid.frame, options.high_m, options.high_m + kAbove_m);
    const double max_unseen = options.max_unseen * (seen.end - seen.begin);
    columns_.reserve(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        const int occupied = count(grid, x, y, body, CellState::occupied);
        const int unseen = count(grid, x, y, seen, CellState::unobserved);
        const bool wall = scanner_m && occupied >= kOfWall * (body.end - body.begin) &&
                          count(grid, x, y, above, CellState::occupied) >=
                              kOfWallAbove * (above.end - above.begin) &&
                          state_at(grid, x, y, *scanner_m) == CellState::occupied;
        columns_.push_back(wall                  ? Column::wall
                           : occupied > 0        ? Column::obstructed
                           : unseen > max_unseen ? Column::unseen
                                                 : Column::open);
      }
    }
    open_lone_groups();
    if (scanner_m) mark_wall_edges(grid, *scanner_m);
  }

  [[nodiscard]] Column at(int x, int y) const { return columns_[index(x, y)]; }

 private:
  static constexpr std::size_t kLoneGroup = 4;  ///< columns

  /// A surface near the boundary of two columns is in both, in the farther one here and there; and
  /// it hides part of the column behind, at a door's post.
  void mark_wall_edges(const OccupancyGrid& grid, double scanner_m) {
    const std::vector<Column> before = columns_;
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        const auto touches = [&](Column column) {
          bool any = false;
          for_each_beside({x, y}, [&](int u, int v) { any |= before[index(u, v)] == column; });
          return any;
        };
        const bool shaded = at(x, y) == Column::unseen && touches(Column::open) &&
                            state_at(grid, x, y, scanner_m) == CellState::free;
        if (at(x, y) != Column::obstructed && !shaded) continue;
        if (touches(Column::wall)) columns_[index(x, y)] = Column::wall_edge;
      }
    }
  }

  /// Few unseen columns amid open ones count as open.
  void open_lone_groups() {
    std::vector<std::uint8_t> asked(columns_.size(), 0);
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        if (asked[index(x, y)] != 0 || at(x, y) != Column::unseen) continue;
        const std::vector<Eigen::Array2i> group = unseen_group({x, y}, asked);
        const auto nothing_beside = [&](const auto& column) { return is_clear_of_things(column); };
        if (group.size() > kLoneGroup || !std::ranges::all_of(group, nothing_beside)) continue;
        for (const auto& column : group) columns_[index(column.x(), column.y())] = Column::open;
      }
    }
  }

  /// Those that touch the first and each other. Marks them as asked.
  [[nodiscard]] std::vector<Eigen::Array2i> unseen_group(const Eigen::Array2i& first,
                                                         std::vector<std::uint8_t>& asked) const {
    std::vector<Eigen::Array2i> group{first};
    asked[index(first.x(), first.y())] = 1;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Eigen::Array2i from = group[i];
      for_each_beside(from, [&](int x, int y) {
        if (asked[index(x, y)] != 0 || at(x, y) != Column::unseen) return;
        asked[index(x, y)] = 1;
        group.emplace_back(x, y);
      });
    }
    return group;
  }

  /// Whether all eight round it are in the grid and none obstructed.
  [[nodiscard]] bool is_clear_of_things(const Eigen::Array2i& column) const {
    int clear = 0;
    for_each_beside(column, [&](int x, int y) {
      clear += at(x, y) == Column::open || at(x, y) == Column::unseen ? 1 : 0;
    });
    return clear == 8;
  }

  template <class Visit>
  void for_each_beside(const Eigen::Array2i& column, Visit&& visit) const {
    for (int y = std::max(column.y() - 1, 0); y <= std::min(column.y() + 1, ny_ - 1); ++y) {
      for (int x = std::max(column.x() - 1, 0); x <= std::min(column.x() + 1, nx_ - 1); ++x) {
        if (x != column.x() || y != column.y()) visit(x, y);
      }
    }
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y * nx_ + x);
  }

  static int count(const OccupancyGrid& grid, int x, int y, const Slices& slices, CellState state) {
    int cells = 0;
    for (int z = slices.begin; z < slices.end; ++z) {
      if (grid.state(grid.frame.index({x, y, z})) == state) ++cells;
    }
    return cells;
  }

  static CellState state_at(const OccupancyGrid& grid, int x, int y, double height_m) {
    const Eigen::Vector3d foot = grid.frame.centre({x, y, 0});
    const Eigen::Array3i cell = grid.frame.cell_at({foot.x(), foot.y(), height_m});
    return grid.frame.contains(cell) ? grid.state(grid.frame.index(cell)) : CellState::unobserved;
  }

  int nx_;
  int ny_;
  std::vector<Column> columns_;
};

/// What is beyond the grid nothing is known of, but where the robot has been.
void block_outside(FloorMap& floor, const GridFrame& frame,
                   std::span<const std::uint8_t> traversed) {
  const Eigen::AlignedBox2d known(frame.box().min().head<2>(), frame.box().max().head<2>());
  for (int y = 0; y < floor.ny; ++y) {
    for (int x = 0; x < floor.nx; ++x) {
      const std::size_t cell = floor.index({x, y});
      floor.blocked[cell] = !known.contains(floor.centre({x, y})) && traversed[cell] == 0 ? 1 : 0;
    }
  }
}

void block(FloorMap& floor, const GridFrame& frame, std::span<const std::uint8_t> traversed,
           const Columns& columns, bool finer) {
  expects(traversed.size() == floor.size(), "a flag per cell of the floor map");
  block_outside(floor, frame, traversed);
  const Eigen::Vector2d half = 0.5 * frame.cell_size_m.head<2>();
  constexpr double kTouching = 1e-9;
  for (int y = 0; y < frame.cells.y(); ++y) {
    for (int x = 0; x < frame.cells.x(); ++x) {
      const Column column = columns.at(x, y);
      const bool of_wall = column == Column::wall || column == Column::wall_edge;
      if (column == Column::open || (of_wall && finer)) continue;
      const Eigen::Vector2d centre = frame.centre({x, y, 0}).head<2>();
      const Eigen::Array2i low = floor.cell_at((centre - half).array() + kTouching).max(0);
      const Eigen::Array2i high = floor.cell_at((centre + half).array() - kTouching)
                                      .min(Eigen::Array2i(floor.nx - 1, floor.ny - 1));
      for (int v = low.y(); v <= high.y(); ++v) {
        for (int u = low.x(); u <= high.x(); ++u) {
          const std::size_t cell = floor.index({u, v});
          const bool known_otherwise = traversed[cell] != 0 && (finer || column == Column::unseen);
          if (!known_otherwise) floor.blocked[cell] = 1;
        }
      }
    }
  }
}

}  // namespace

void HeadroomOptions::check() const {
  if (low_m >= high_m || seen_low_m >= high_m) {
    throw ConfigError(fmt::format("low_m {} and seen_low_m {} must be below high_m {}", low_m,
                                  seen_low_m, high_m));
  }
}

void block_columns(FloorMap& floor, const OccupancyGrid& grid,
                   std::span<const std::uint8_t> traversed, const HeadroomOptions& options) {
  check_options(options, "headroom");
  block(floor, grid.frame, traversed, Columns(grid, options, std::nullopt), false);
}

void block_columns(const TraversedFloor& floor, const TraversedFloor& detail,
                   const OccupancyGrid& grid, const HeadroomOptions& options, double scanner_m) {
  check_options(options, "headroom");
  const Columns columns(grid, options, scanner_m);
  block(floor.map, grid.frame, floor.traversed, columns, false);
  block(detail.map, grid.frame, detail.traversed, columns, true);
}

}  // namespace vantage
