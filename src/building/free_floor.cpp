#include "vantage/building/free_floor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"
#include "vantage/planners/navigation/distance_field.hpp"

namespace vantage {
namespace {

constexpr double kSquare_m = 0.05;
constexpr double kMostSquares = 67108864.0;  // 410 x 410 m
/// More room than that makes no start better.
constexpr double kPlenty_m = 1.2;

/// The floor in squares, seen from above.
struct Squares {
  Eigen::Vector2d corner_m;
  int nx = 0;
  int ny = 0;
  std::vector<std::uint8_t> blocked;
  std::vector<double> clearance_m;
  bool has_floor = false;

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < nx && y < ny; }
  [[nodiscard]] Eigen::Vector2d centre_m(std::size_t square) const {
    const auto n = static_cast<std::size_t>(nx);
    const std::size_t y = square / n;
    const std::size_t x = square % n;
    return corner_m +
           kSquare_m * Eigen::Vector2d(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
  }
};

/// Of cells from the floor up to the headroom, of which none may be solid, and what is below them.
struct Standing {
  const FittedGrid& grid;
  const std::vector<std::uint8_t>& solid;
  int floor;  ///< first layer above it
  int end;

  [[nodiscard]] bool blocked(int x, int y) const {
    for (int z = floor; z < end; ++z) {
      if (solid[grid.index(x, y, z)] != 0) return true;
    }
    return false;
  }
  [[nodiscard]] bool has_floor(int x, int y) const {
    return floor > 0 && solid[grid.index(x, y, floor - 1)] != 0;
  }
};

Squares squares_of(const FittedGrid& grid, const std::vector<std::uint8_t>& solid,
                   const FreeFloorOptions& options) {
  const Standing standing{grid, solid, grid.cell_at(2, 1e-9),
                          grid.cell_at(2, options.headroom_m) + 1};
  Squares squares;
  squares.corner_m = {grid.line_m(0, 0), grid.line_m(1, 0)};
  const Eigen::Vector2d edges_m(grid.line_m(0, grid.cells(0)), grid.line_m(1, grid.cells(1)));
  const Eigen::Array2d count = ((edges_m - squares.corner_m) / kSquare_m).array();
  if (count.prod() > kMostSquares) {
    throw ConfigError(
        fmt::format("the building is {:.0f} x {:.0f} m, more than a start is looked "
                    "for in: is --scale right?",
                    count.x() * kSquare_m, count.y() * kSquare_m));
  }
  squares.nx = static_cast<int>(count.x());
  squares.ny = static_cast<int>(count.y());
  for (int y = 0; y < squares.ny; ++y) {
    const int row = grid.cell_at(1, squares.corner_m.y() + (y + 0.5) * kSquare_m);
    for (int x = 0; x < squares.nx; ++x) {
      const int column = grid.cell_at(0, squares.corner_m.x() + (x + 0.5) * kSquare_m);
      const bool floor = options.floor_everywhere || standing.has_floor(column, row);
      const bool free = floor && !standing.blocked(column, row);
      squares.has_floor = squares.has_floor || free;
      squares.blocked.push_back(free ? 0 : 1);
    }
  }
  squares.clearance_m = squared_distances_cells(squares.blocked, squares.nx, squares.ny);
  for (double& d : squares.clearance_m) d = (std::sqrt(d) - 1.0) * kSquare_m;
  return squares;
}

/// By what stands, an area beside it or among its wings.
bool is_outdoors(const Squares& squares, const std::vector<std::size_t>& area,
                 const Eigen::AlignedBox2d& standing_m) {
  constexpr double kWidestGate_m = 3.0;
  if (standing_m.isEmpty()) return false;
  const Eigen::Array2d low = standing_m.min().array() + kSquare_m;
  const Eigen::Array2d high = standing_m.max().array() - kSquare_m;
  const auto at_edge = std::ranges::count_if(area, [&](std::size_t square) {
    const Eigen::Array2d p_m = squares.centre_m(square).array();
    return (p_m < low).any() || (p_m > high).any();
  });
  return static_cast<double>(at_edge) * kSquare_m > kWidestGate_m;
}

/// Of each square, whether it is beyond what stands.
std::vector<std::uint8_t> beyond(const Squares& squares, const Eigen::AlignedBox2d& standing_m) {
  std::vector<std::uint8_t> is_beyond(squares.blocked.size(), 0);
  for (std::size_t square = 0; square < is_beyond.size() && !standing_m.isEmpty(); ++square) {
    is_beyond[square] = standing_m.contains(squares.centre_m(square)) ? 0 : 1;
  }
  return is_beyond;
}

/// The largest set of neighbouring squares with enough clearance, within what stands, of those not
/// outdoors if any.
std::vector<std::size_t> largest_area(const Squares& squares, double clearance_m,
                                      const Eigen::AlignedBox2d& standing_m) {
  constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<std::uint8_t> taken = beyond(squares, standing_m);
  std::vector<std::size_t> largest;
  bool is_in = false;
  for (std::size_t seed = 0; seed < taken.size(); ++seed) {
    if (taken[seed] != 0 || squares.clearance_m[seed] < clearance_m) continue;
    std::vector<std::size_t> area{seed};
    taken[seed] = 1;
    for (std::size_t i = 0; i < area.size(); ++i) {
      const int x = static_cast<int>(area[i] % static_cast<std::size_t>(squares.nx));
      const int y = static_cast<int>(area[i] / static_cast<std::size_t>(squares.nx));
      for (const auto& [dx, dy] : kSteps) {
        if (!squares.holds(x + dx, y + dy)) continue;
        const std::size_t next = squares.index(x + dx, y + dy);
        if (taken[next] != 0 || squares.clearance_m[next] < clearance_m) continue;
        taken[next] = 1;
        area.push_back(next);
      }
    }
    const bool in = !is_outdoors(squares, area, standing_m);
    if (std::pair(in, area.size()) <= std::pair(is_in, largest.size())) continue;
    is_in = in;
    largest = std::move(area);
  }
  return largest;
}

/// Along an axis, towards where the way is free for longest.
double open_heading_rad(const Squares& squares, std::size_t from) {
  constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  int farthest = -1;
  double heading_rad = 0.0;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    int x = static_cast<int>(from % static_cast<std::size_t>(squares.nx));
    int y = static_cast<int>(from / static_cast<std::size_t>(squares.nx));
    int steps = 0;
    while (squares.holds(x, y) && squares.blocked[squares.index(x, y)] == 0) {
      x += kSteps[i][0];
      y += kSteps[i][1];
      ++steps;
    }
    if (steps <= farthest) continue;
    farthest = steps;
    heading_rad = wrap_angle(0.5 * std::numbers::pi * static_cast<double>(i));
  }
  return heading_rad;
}

}  // namespace

std::optional<FreeFloor> find_free_floor(const FittedGrid& grid,
                                         const std::vector<std::uint8_t>& solid,
                                         const FreeFloorOptions& options) {
  const Squares squares = squares_of(grid, solid, options);
  if (!squares.has_floor) return std::nullopt;
  FreeFloor found;
  std::vector<std::size_t> area = largest_area(squares, options.clearance_m, options.standing_m);
  if (area.empty()) area = largest_area(squares, options.clearance_m, {});
  if (area.empty()) return found;
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
  for (const std::size_t square : area) middle_m += squares.centre_m(square);
  middle_m /= static_cast<double>(area.size());
  const auto rank = [&](std::size_t square) {
    return std::pair(-std::min(squares.clearance_m[square], kPlenty_m),
                     (squares.centre_m(square) - middle_m).norm());
  };
  const std::size_t best = *std::ranges::min_element(area, {}, rank);
  const Eigen::Vector2d at_m = squares.centre_m(best);
  found.start = {at_m.x(), at_m.y(), open_heading_rad(squares, best)};
  found.area_m2 = static_cast<double>(area.size()) * kSquare_m * kSquare_m;
  found.clearance_m = squares.clearance_m[best];
  return found;
}

}  // namespace vantage
