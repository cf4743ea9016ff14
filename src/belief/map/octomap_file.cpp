#include "vantage/belief/map/octomap_file.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 31;

std::string read_map_file(const fs::path& path) {
  std::error_code error;
  // A pipe or a device may never end; what is missing or a directory, read_file() says.
  if (fs::exists(path, error) && !fs::is_directory(path, error)) {
    if (!fs::is_regular_file(path, error)) {
      throw InputError(path.string() + ": is not a regular file");
    }
    if (fs::file_size(path, error) > kMaxFileBytes) {
      throw InputError(path.string() + ": is larger than 2 GiB");
    }
  }
  return read_file(path);
}

/// The cells of `block` that the leaf holds, of a grid of these, row by row.
void fill(OccupancyGrid& grid, const OctomapLeaf& leaf, const CellBlock& block) {
  CellBlock rows = leaf.block().cut(block);
  if (rows.empty()) return;
  const int width = rows.end.x() - rows.begin.x();
  rows.end.x() = rows.begin.x() + 1;
  rows.for_each_cell([&](const Eigen::Array3i& first) {
    const auto at = static_cast<std::ptrdiff_t>(grid.frame.index(first - block.begin));
    std::fill_n(grid.log_odds.begin() + at, width, leaf.log_odds);
  });
}

}  // namespace

OctomapFile::OctomapFile(const fs::path& path) : name_(path.string()), bytes_(read_map_file(path)) {
  header_ = parse_octomap(bytes_, name_, [this](const OctomapLeaf& leaf) {
    (leaf.occupied() ? occupied_ : free_) += leaf.cells();
    known_ = known_.joined(leaf.block());
  });
}

void OctomapFile::for_each_leaf(const OctomapLeafVisitor& visit) const {
  parse_octomap(bytes_, name_, visit);
}

Eigen::AlignedBox3d OctomapFile::box_of(const CellBlock& block) const {
  if (block.empty()) return {};
  return {block.begin.cast<double>().matrix() * resolution_m(),
          block.end.cast<double>().matrix() * resolution_m()};
}

CellBlock OctomapFile::cells_in(const Eigen::AlignedBox3d& box_m) const {
  if (box_m.isEmpty()) return {};
  // A box that ends on the border of cells, give or take rounding, ends there.
  constexpr double kRounding = 1e-6;
  const auto index = [](const Eigen::Array3d& cells) {
    constexpr double kEnd = kOctomapHalfWidth;
    return Eigen::Array3i(cells.max(-kEnd).min(kEnd).cast<int>());
  };
  return {index((box_m.min().array() / resolution_m() + kRounding).floor()),
          index((box_m.max().array() / resolution_m() - kRounding).ceil())};
}

OccupancyGrid OctomapFile::grid_of(const CellBlock& block, int coarsen) const {
  expects(!block.empty() && coarsen >= 1 && coarsen <= 1024, "a block with cells");
  const CellBlock coarse = block.coarsened(coarsen);
  const double cell_m = resolution_m() * coarsen;
  OccupancyGrid grid(GridFrame{.min_corner_m = coarse.begin.cast<double>().matrix() * cell_m,
                               .cell_size_m = Eigen::Vector3d::Constant(cell_m),
                               .cells = coarse.end - coarse.begin});
  if (coarsen == 1) {  // a cell is of one leaf
    for_each_leaf([&](const OctomapLeaf& leaf) { fill(grid, leaf, block); });
    return grid;
  }
  const auto cells_of = [coarsen](const CellBlock& part, const Eigen::Array3i& cell) {
    const CellBlock whole{cell * coarsen, (cell + 1) * coarsen};
    return static_cast<std::uint32_t>(part.cut(whole).count());
  };
  std::vector<std::uint32_t> known(grid.size(), 0);  // of the cells that make each
  for_each_leaf([&](const OctomapLeaf& leaf) {
    const CellBlock part = leaf.block().cut(block);
    if (part.empty()) return;
    part.coarsened(coarsen).for_each_cell([&](const Eigen::Array3i& cell) {
      const std::size_t i = grid.frame.index(cell - coarse.begin);
      float& log_odds = grid.log_odds[i];
      log_odds = known[i] > 0 ? std::max(log_odds, leaf.log_odds) : leaf.log_odds;
      known[i] += cells_of(part, cell);
    });
  });
  coarse.for_each_cell([&](const Eigen::Array3i& cell) {
    const std::size_t i = grid.frame.index(cell - coarse.begin);
    if (known[i] == 0 || grid.state(i) == CellState::occupied) return;
    if (2 * known[i] < cells_of(block, cell)) grid.log_odds[i] = 0.0F;
  });
  return grid;
}

}  // namespace vantage
