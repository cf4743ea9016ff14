#include "src/belief/octomap_io.hpp"

// Else OctoMap's templates print to stderr in debug builds.
#define OCTOMAP_NODEBUGOUT

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "src/belief/octomap_format.hpp"
#include "src/core/atomic_file.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr int kKeyOrigin = 32768;  ///< key of the cell at the world's origin
constexpr std::size_t kMaxOccupiedCells = 50'000'000;
constexpr std::size_t kMaxGridCells = 200'000'000;

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
}

std::unique_ptr<octomap::OcTree> load_tree(const fs::path& path) {
  const std::string bytes = read_file(path);
  const OctomapHeader header = check_octomap(bytes, path.string());
  auto tree = std::make_unique<octomap::OcTree>(header.resolution_m);
  if (header.nodes == 0) return tree;
  std::istringstream data(bytes.substr(header.data_offset));
  if (header.binary) {
    tree->readBinaryData(data);
  } else {
    tree->readData(data);
  }
  return tree;
}

/// A cube of `edge_cells`^3 cells of the finest level that share one value.
struct Leaf {
  Eigen::Vector3d min_corner_m;
  int edge_cells = 1;
  float log_odds = 0.0F;
  bool occupied = false;
  [[nodiscard]] std::size_t cells() const {
    const auto edge = static_cast<std::size_t>(edge_cells);
    return edge * edge * edge;
  }
};

template <class Visit>
void for_each_leaf(const octomap::OcTree& tree, Visit&& visit) {
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    const int edge = 1 << (kOctomapDepth - static_cast<int>(it.getDepth()));
    const Eigen::Vector3d centre(it.getX(), it.getY(), it.getZ());
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * edge * tree.getResolution());
    visit(Leaf{centre - half, edge, it->getLogOdds(), tree.isNodeOccupied(*it)});
  }
}

Eigen::AlignedBox3d box_of(const octomap::OcTree& tree) {
  Eigen::AlignedBox3d box;
  for_each_leaf(tree, [&](const Leaf& leaf) {
    const double edge_m = leaf.edge_cells * tree.getResolution();
    box.extend(leaf.min_corner_m);
    box.extend(leaf.min_corner_m + Eigen::Vector3d::Constant(edge_m));
  });
  return box;
}

/// Calls `visit` with the offset of each finest cell in a leaf.
template <class Visit>
void for_each_cell_in(const Leaf& leaf, Visit&& visit) {
  for (int z = 0; z < leaf.edge_cells; ++z) {
    for (int y = 0; y < leaf.edge_cells; ++y) {
      for (int x = 0; x < leaf.edge_cells; ++x) visit(Eigen::Array3i(x, y, z));
    }
  }
}

}  // namespace

void write_octomap(const OccupancyGrid& grid, const fs::path& path) {
  const bool binary = path.extension() == ".bt";
  if (!binary && path.extension() != ".ot") {
    throw OutputError(path.string() + ": an OctoMap file ends in .bt or .ot");
  }
  octomap::OcTree tree(grid.frame.cell_size_m.minCoeff());
  // OctoMap's default limits would cut the log odds of an .ot file.
  tree.setClampingThresMin(1e-6);
  tree.setClampingThresMax(1.0 - 1e-6);
  insert_cells(grid, path, tree);
  tree.updateInnerOccupancy();
  if (binary) tree.toMaxLikelihood();
  tree.prune();
  // OctoMap's own writers print to stderr, so only the data are its.
  std::ostringstream content;
  content << octomap_header({binary, tree.getResolution(), tree.size()});
  if (binary) {
    tree.writeBinaryData(content);
  } else {
    tree.writeData(content);
  }
  write_file(path, content.view());
}

OctomapContent read_octomap(const fs::path& path) {
  const auto tree = load_tree(path);
  OctomapContent content;
  content.resolution_m = tree->getResolution();
  content.box = box_of(*tree);
  for_each_leaf(*tree, [&](const Leaf& leaf) {
    (leaf.occupied ? content.occupied : content.free) += leaf.cells();
    if (!leaf.occupied) return;
    if (content.occupied > kMaxOccupiedCells) {
      throw InputError(
          fmt::format("{}: more than {} occupied cells", path.string(), kMaxOccupiedCells));
    }
    for_each_cell_in(leaf, [&](const Eigen::Array3i& offset) {
      const Eigen::Vector3d centre =
          leaf.min_corner_m + ((offset.cast<double>() + 0.5) * content.resolution_m).matrix();
      content.occupied_centres.emplace_back(centre.cast<float>());
    });
  });
  return content;
}

OccupancyGrid read_octomap_grid(const fs::path& path) {
  const auto tree = load_tree(path);
  const double resolution_m = tree->getResolution();
  const Eigen::AlignedBox3d box = box_of(*tree);
  if (box.isEmpty()) throw InputError(path.string() + ": the map has no known cell");
  const Eigen::Array3d cells = (box.sizes().array() / resolution_m).round();
  if (cells.prod() > static_cast<double>(kMaxGridCells)) {
    throw InputError(fmt::format("{}: the known cells span {} x {} x {} cells, at most {} fit",
                                 path.string(), cells.x(), cells.y(), cells.z(), kMaxGridCells));
  }
  OccupancyGrid grid(GridFrame{.min_corner_m = box.min(),
                               .cell_size_m = Eigen::Vector3d::Constant(resolution_m),
                               .cells = cells.cast<int>()});
  for_each_leaf(*tree, [&](const Leaf& leaf) {
    const Eigen::Array3i first =
        ((leaf.min_corner_m - box.min()).array() / resolution_m).round().cast<int>();
    for_each_cell_in(leaf, [&](const Eigen::Array3i& offset) {
      grid.log_odds[grid.frame.index(first + offset)] = leaf.log_odds;
    });
  });
  return grid;
}

}  // namespace vantage
