#include "vantage/building/solid_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "vantage/building/line_crossings.hpp"

namespace vantage {
namespace {

/// The cells along one line of a grid.
struct LineOfCells {
  const FittedGrid& grid;
  int axis;
  std::array<int, 3> at;

  [[nodiscard]] std::size_t index(int along) const {
    std::array<int, 3> cell = at;
    cell[static_cast<std::size_t>(axis)] = along;
    return grid.index(cell[0], cell[1], cell[2]);
  }
};

/// Calls `f` with the cells of each line that meets anything, and its crossings.
void for_each_line(const FittedGrid& grid, int axis, const std::vector<Crossing>& crossings,
                   auto&& f) {
  const auto u_axis = static_cast<std::size_t>((axis + 1) % 3);
  const auto v_axis = static_cast<std::size_t>((axis + 2) % 3);
  const auto nu = static_cast<std::uint32_t>(grid.cells((axis + 1) % 3));
  for (auto begin = crossings.begin(); begin != crossings.end();) {
    const auto end = std::find_if(begin, crossings.end(),
                                  [&](const Crossing& c) { return c.line != begin->line; });
    LineOfCells line{grid, axis, {}};
    line.at[u_axis] = static_cast<int>(begin->line % nu);
    line.at[v_axis] = static_cast<int>(begin->line / nu);
    f(line, std::span<const Crossing>(begin, end));
    begin = end;
  }
}

/// One vote for each cell whose centre the line has inside.
void vote(const LineOfCells& line, std::span<const Crossing> crossings,
          const std::vector<double>& centres_m, std::vector<std::uint8_t>& votes) {
  int balance = 0;
  for (const Crossing& crossing : crossings) balance += crossing.side;
  if (balance != 0) return;
  int depth = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    depth -= crossings[i].side;
    if (depth <= 0) continue;
    const auto first = std::ranges::lower_bound(centres_m, crossings[i].at_m);
    const auto last = std::ranges::lower_bound(centres_m, crossings[i + 1].at_m);
    for (auto centre = first; centre < last; ++centre) {
      ++votes[line.index(static_cast<int>(centre - centres_m.begin()))];
    }
  }
}

/// The cell under the floor, if the surface is the floor but for half a cell; else -1. A scanned
/// floor is rough, and a drawn one may face either way.
int floor_cell(const LineOfCells& line, const Crossing& crossing) {
  const FittedGrid& grid = line.grid;
  if (line.axis != 2 || std::abs(crossing.at_m) > kFloorCells * grid.cell_m) return -1;
  const int above = grid.cell_at(2, 1e-9);
  return grid.line_m(2, above) == 0.0 ? above - 1 : -1;
}

/// Which cell fills up for a surface there, or -1 if one behind it is solid.
int sheet_cell(const LineOfCells& line, const Crossing& crossing,
               const std::vector<std::uint8_t>& solid) {
  const FittedGrid& grid = line.grid;
  const int cells = grid.cells(line.axis);
  const auto is_solid_at = [&](int along) {
    return along >= 0 && along < cells && solid[line.index(along)] != 0;
  };
  if (crossing.at_m < grid.line_m(line.axis, 0) || crossing.at_m > grid.line_m(line.axis, cells)) {
    return -1;
  }
  const int cell = grid.cell_at(line.axis, crossing.at_m);
  if (const int below = floor_cell(line, crossing); below >= 0) {
    return is_solid_at(below) ? -1 : below;
  }
  const int back = crossing.side > 0 ? -1 : 1;
  for (const int side : {cell, cell + 1}) {
    const double off_m = std::abs(crossing.at_m - grid.line_m(line.axis, side));
    const double width_m = grid.line_m(line.axis, cell + 1) - grid.line_m(line.axis, cell);
    if (off_m > kNearestLines * width_m) continue;
    if (is_solid_at(side - 1) || is_solid_at(side)) return -1;
    return std::clamp(back < 0 ? side - 1 : side, 0, cells - 1);
  }
  return is_solid_at(cell) || is_solid_at(cell + back) ? -1 : cell;
}

}  // namespace

std::vector<std::uint8_t> solid_cells(const BuildingMesh& mesh,
                                      const std::vector<Triangle>& triangles,
                                      const FittedGrid& grid) {
  std::array<std::vector<Crossing>, 3> crossings;
  std::vector<std::uint8_t> solid(grid.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    auto& along = crossings[static_cast<std::size_t>(axis)];
    along = line_crossings(mesh, triangles, axis, grid.centres_m((axis + 1) % 3),
                           grid.centres_m((axis + 2) % 3));
    const std::vector<double> centres_m = grid.centres_m(axis);
    for_each_line(grid, axis, along,
                  [&](const LineOfCells& line, auto met) { vote(line, met, centres_m, solid); });
  }
  constexpr std::uint8_t kMajority = 2;
  for (std::uint8_t& votes : solid) votes = votes >= kMajority ? 1 : 0;
  std::vector<std::size_t> sheets;
  for (int axis = 0; axis < 3; ++axis) {
    for_each_line(grid, axis, crossings[static_cast<std::size_t>(axis)],
                  [&](const LineOfCells& line, auto met) {
                    for (const Crossing& crossing : met) {
                      const int cell = sheet_cell(line, crossing, solid);
                      if (cell >= 0) sheets.push_back(line.index(cell));
                    }
                  });
  }
  for (const std::size_t cell : sheets) solid[cell] = 1;
  return solid;
}

}  // namespace vantage
