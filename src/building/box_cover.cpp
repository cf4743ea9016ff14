#include "vantage/building/box_cover.hpp"

#include <algorithm>

namespace vantage {
namespace {

/// Calls `f` with every cell's index until it returns false. @return whether it never did
bool all_cells(const FittedGrid& grid, const CellBox& box, auto&& f) {
  for (int z = box.first[2]; z < box.end[2]; ++z) {
    for (int y = box.first[1]; y < box.end[1]; ++y) {
      for (int x = box.first[0]; x < box.end[0]; ++x) {
        if (!f(grid.index(x, y, z))) return false;
      }
    }
  }
  return true;
}

void grow(const FittedGrid& grid, const std::vector<std::uint8_t>& solid, std::size_t axis,
          CellBox& box) {
  const auto all_solid = [&](int from, int to) {
    CellBox layer = box;
    layer.first[axis] = from;
    layer.end[axis] = to;
    return all_cells(grid, layer, [&](std::size_t cell) { return solid[cell] != 0; });
  };
  const int cells = grid.cells(static_cast<int>(axis));
  while (box.first[axis] > 0 && all_solid(box.first[axis] - 1, box.first[axis])) --box.first[axis];
  while (box.end[axis] < cells && all_solid(box.end[axis], box.end[axis] + 1)) ++box.end[axis];
}

std::size_t count_new(const FittedGrid& grid, const std::vector<std::uint8_t>& held,
                      const CellBox& box) {
  std::size_t count = 0;
  all_cells(grid, box, [&](std::size_t cell) {
    count += held[cell] == 0 ? 1 : 0;
    return true;
  });
  return count;
}

CellBox largest_from(const FittedGrid& grid, const std::vector<std::uint8_t>& solid,
                     const std::vector<std::uint8_t>& held, const CellBox& seed) {
  CellBox best = seed;
  std::size_t most = 0;
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    CellBox box = seed;
    for (const std::size_t axis : order) grow(grid, solid, axis, box);
    const std::size_t count = count_new(grid, held, box);
    if (count > most) best = box;
    most = std::max(most, count);
  } while (std::ranges::next_permutation(order).found);
  return best;
}

}  // namespace

std::vector<CellBox> cover_with_boxes(const FittedGrid& grid,
                                      const std::vector<std::uint8_t>& solid) {
  std::vector<CellBox> boxes;
  std::vector<std::uint8_t> held(solid.size(), 0);
  for (int z = 0; z < grid.cells(2); ++z) {
    for (int y = 0; y < grid.cells(1); ++y) {
      for (int x = 0; x < grid.cells(0); ++x) {
        const std::size_t cell = grid.index(x, y, z);
        if (solid[cell] == 0 || held[cell] != 0) continue;
        boxes.push_back(largest_from(grid, solid, held, {{x, y, z}, {x + 1, y + 1, z + 1}}));
        all_cells(grid, boxes.back(), [&](std::size_t inside) {
          held[inside] = 1;
          return true;
        });
      }
    }
  }
  return boxes;
}

Eigen::AlignedBox3d box_m(const FittedGrid& grid, const CellBox& box) {
  Eigen::AlignedBox3d extent_m;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    extent_m.min()[axis] = grid.line_m(axis, box.first[i]);
    extent_m.max()[axis] = grid.line_m(axis, box.end[i]);
  }
  return extent_m;
}

}  // namespace vantage
