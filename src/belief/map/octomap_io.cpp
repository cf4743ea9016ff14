#include "vantage/belief/map/octomap_io.hpp"

// Else OctoMap's templates print to stderr in debug builds.
#define OCTOMAP_NODEBUGOUT

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr int kKeyOrigin = kOctomapHalfWidth;  ///< key of the cell at the world's origin
constexpr std::size_t kMaxOccupiedCells = 50'000'000;
constexpr double kMaxGridCells = 200e6;

/// Keys of the cell centres along an axis, strictly ascending: rounding next to a key's border must
/// not put two cells into one leaf.
std::vector<octomap::key_type> axis_keys(const GridFrame& frame, int axis, double resolution_m,
                                         const fs::path& path) {
  std::vector<octomap::key_type> keys;
  double previous = -1.0;
  for (int i = 0; i < frame.cells[axis]; ++i) {
    const double centre_m = frame.min_corner_m[axis] + (i + 0.5) * frame.cell_size_m[axis];
    const double key = std::max(std::floor(centre_m / resolution_m) + kKeyOrigin, previous + 1.0);
    if (!(centre_m / resolution_m >= -kKeyOrigin && key < 2.0 * kKeyOrigin)) {
      throw OutputError(fmt::format("{}: a cell at {} m does not fit an OctoMap of {} m resolution",
                                    path.string(), centre_m, resolution_m));
    }
    keys.push_back(static_cast<octomap::key_type>(key));
    previous = key;
  }
  return keys;
}

void insert_cells(const OccupancyGrid& grid, const fs::path& path, octomap::OcTree& tree) {
  // OctoMap's default limits would cut the log odds of an .ot file.
  tree.setClampingThresMin(1e-6);
  tree.setClampingThresMax(1.0 - 1e-6);
  const double resolution_m = tree.getResolution();
  const auto x = axis_keys(grid.frame, 0, resolution_m, path);
  const auto y = axis_keys(grid.frame, 1, resolution_m, path);
  const auto z = axis_keys(grid.frame, 2, resolution_m, path);
  std::size_t index = 0;
  for (const octomap::key_type kz : z) {
    for (const octomap::key_type ky : y) {
      for (const octomap::key_type kx : x) {
        const float log_odds = grid.log_odds[index++];
        if (classify(log_odds) == CellState::unobserved) continue;
        tree.setNodeValue(octomap::OcTreeKey(kx, ky, kz), log_odds, /*lazy_eval=*/true);
      }
    }
  }
  tree.updateInnerOccupancy();
}

void write_tree(octomap::OcTree& tree, bool binary, const fs::path& path) {
  if (binary) tree.toMaxLikelihood();
  tree.prune();
  // OctoMap's own writers print to stderr, so only the data are its.
  std::ostringstream content;
  content << octomap_header({binary, tree.getResolution(), tree.size()});
  binary ? tree.writeBinaryData(content) : tree.writeData(content);
  write_file(path, content.view());
}

/// Along an axis, of `count` cells from `first` on.
std::vector<float> centres_m(int first, std::size_t count, double cell_m) {
  std::vector<float> centres(count);
  for (std::size_t i = 0; i < count; ++i) {
    centres[i] = static_cast<float>((first + static_cast<double>(i) + 0.5) * cell_m);
  }
  return centres;
}

}  // namespace

void write_octomap(const OccupancyGrid& grid, const fs::path& path) {
  const bool binary = path.extension() == ".bt";
  if (!binary && path.extension() != ".ot") {
    throw OutputError(path.string() + ": an OctoMap file ends in .bt or .ot");
  }
  octomap::OcTree tree(grid.frame.cell_size_m.minCoeff());
  insert_cells(grid, path, tree);
  write_tree(tree, binary, path);
}

void write_octomaps(const OccupancyGrid& grid, const fs::path& folder) {
  octomap::OcTree tree(grid.frame.cell_size_m.minCoeff());
  insert_cells(grid, folder / "map.ot", tree);
  write_tree(tree, false, folder / "map.ot");
  write_tree(tree, true, folder / "map.bt");
}

OctomapContent read_octomap(const fs::path& path) {
  const OctomapFile file(path);
  if (file.occupied() > kMaxOccupiedCells) {
    throw InputError(
        fmt::format("{}: more than {} occupied cells", path.string(), kMaxOccupiedCells));
  }
  OctomapContent content{.resolution_m = file.resolution_m(),
                         .occupied = file.occupied(),
                         .free = file.free(),
                         .box = file.box_of(file.known()),
                         .occupied_centres = {}};
  content.occupied_centres.reserve(file.occupied());
  file.for_each_leaf([&](const OctomapLeaf& leaf) {
    if (!leaf.occupied()) return;
    const auto edge = static_cast<std::size_t>(leaf.edge_cells);
    const auto x_m = centres_m(leaf.first.x(), edge, file.resolution_m());
    const auto y_m = centres_m(leaf.first.y(), edge, file.resolution_m());
    const auto z_m = centres_m(leaf.first.z(), edge, file.resolution_m());
    for (const float z : z_m) {
      for (const float y : y_m) {
        for (const float x : x_m) content.occupied_centres.emplace_back(x, y, z);
      }
    }
  });
  return content;
}

OccupancyGrid read_octomap_grid(const fs::path& path) {
  const OctomapFile file(path);
  if (file.known().empty()) throw InputError(path.string() + ": the map has no known cell");
  if (file.known().count() > kMaxGridCells) {
    const Eigen::Array3i cells = file.known().end - file.known().begin;
    throw InputError(fmt::format("{}: the known cells span {} x {} x {} cells, at most {} fit",
                                 path.string(), cells.x(), cells.y(), cells.z(), kMaxGridCells));
  }
  return file.grid_of(file.known());
}

}  // namespace vantage
