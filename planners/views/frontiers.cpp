#include "vantage/planners/views/frontiers.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>

#include "vantage/geometry/face_neighbours.hpp"

namespace vantage {
namespace {

using Cells = std::vector<std::size_t>;

struct Slices {
  int begin = 0;
  int end = 0;
};

/// The z slices with their centres in the band.
Slices slices_in_band(const GridFrame& frame, const FrontierOptions& options) {
  Slices slices{0, frame.cells.z()};
  if (!options.height_band_m) return slices;
  const auto height_m = [&](int z) { return frame.centre({0, 0, z}).z(); };
  const auto [low_m, high_m] = *options.height_band_m;
  while (slices.begin < slices.end && height_m(slices.begin) < low_m) ++slices.begin;
  while (slices.end > slices.begin && height_m(slices.end - 1) > high_m) --slices.end;
  return slices;
}

/// Parts of `cells` (ascending) that are connected through faces, edges and corners, each
/// ascending.
std::vector<Cells> connected_clusters(const GridFrame& frame, const Cells& cells) {
  std::vector<std::uint8_t> waiting(frame.size(), 0);
  for (const std::size_t cell : cells) waiting[cell] = 1;
  std::vector<Cells> clusters;
  for (const std::size_t seed : cells) {
    if (waiting[seed] == 0) continue;
    waiting[seed] = 0;
    Cells cluster{seed};
    for (std::size_t next = 0; next < cluster.size(); ++next) {
      const Eigen::Array3i at = frame.cell(cluster[next]);
      const Eigen::Array3i low = (at - 1).max(0);
      const Eigen::Array3i high = (at + 1).min(frame.cells - 1);
      for (int z = low.z(); z <= high.z(); ++z) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int x = low.x(); x <= high.x(); ++x) {
            const std::size_t cell = frame.index({x, y, z});
            if (std::exchange(waiting[cell], std::uint8_t{0}) != 0) cluster.push_back(cell);
          }
        }
      }
    }
    std::ranges::sort(cluster);
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

Eigen::Vector3d centroid_m(const GridFrame& frame, const Cells& cells) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t cell : cells) sum += frame.centre(frame.cell(cell));
  return sum / static_cast<double>(cells.size());
}

/// Direction in which the cells spread most.
Eigen::Vector3d principal_axis(const GridFrame& frame, const Cells& cells) {
  const Eigen::Vector3d mean_m = centroid_m(frame, cells);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::size_t cell : cells) {
    const Eigen::Vector3d d = frame.centre(frame.cell(cell)) - mean_m;
    scatter += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2);
}

/// Appends the cluster to `pieces`, halved as often as the options ask for.
void split(const GridFrame& frame, Cells cluster, const FrontierOptions& options,
           std::vector<Cells>& pieces) {
  const Eigen::Vector3d axis = principal_axis(frame, cluster);
  const auto along_m = [&](std::size_t cell) { return axis.dot(frame.centre(frame.cell(cell))); };
  const auto [first, last] = std::ranges::minmax(cluster, {}, along_m);
  const double low_m = along_m(first);
  const double high_m = along_m(last);
  const auto in_low_half = [&](std::size_t c) { return along_m(c) < 0.5 * (low_m + high_m); };
  Cells low;
  Cells high;
  if (high_m - low_m > options.max_extent_m) {
    std::ranges::partition_copy(cluster, std::back_inserter(low), std::back_inserter(high),
                                in_low_half);
  }
  const auto min_cells = static_cast<std::size_t>(options.min_cells);
  if (std::min(low.size(), high.size()) < min_cells) {
    pieces.push_back(std::move(cluster));
    return;
  }
  split(frame, std::move(low), options, pieces);
  split(frame, std::move(high), options, pieces);
}

Eigen::Vector3d place(const OccupancyGrid& grid, const Cells& cells, double height_m) {
  const auto at_height = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), height_m);
  };
  const auto is_free = [&](const Eigen::Vector3d& p) {
    const Eigen::Array3i cell = grid.frame.cell_at(p);
    return grid.frame.contains(cell) && grid.state(grid.frame.index(cell)) == CellState::free;
  };
  const Eigen::Vector3d mean_m = centroid_m(grid.frame, cells);
  if (is_free(at_height(mean_m))) return at_height(mean_m);
  const auto rank = [&](std::size_t cell) {
    const Eigen::Vector3d p = grid.frame.centre(grid.frame.cell(cell));
    return std::tuple(!is_free(at_height(p)), (p - mean_m).squaredNorm());
  };
  return at_height(grid.frame.centre(grid.frame.cell(*std::ranges::min_element(cells, {}, rank))));
}

}  // namespace

void FrontierOptions::check() const {
  if (height_band_m && (*height_band_m)[0] >= (*height_band_m)[1]) {
    throw ConfigError(fmt::format("height_band_m: lowest {} must be below highest {}",
                                  (*height_band_m)[0], (*height_band_m)[1]));
  }
}

std::vector<std::size_t> frontier_cells(const OccupancyGrid& grid, const FrontierOptions& options) {
  const GridFrame& frame = grid.frame;
  const Slices slices = slices_in_band(frame, options);
  const auto unknown = [&](std::size_t cell) { return grid.state(cell) == CellState::unobserved; };
  Cells found;
  for (int z = slices.begin; z < slices.end; ++z) {
    for (int y = 0; y < frame.cells.y(); ++y) {
      for (int x = 0; x < frame.cells.x(); ++x) {
        const std::size_t cell = frame.index({x, y, z});
        if (grid.state(cell) != CellState::free) continue;
        if (any_face_neighbour(frame, {x, y, z}, unknown)) found.push_back(cell);
      }
    }
  }
  return found;
}

std::vector<Frontier> find_frontiers(const OccupancyGrid& grid, const FrontierOptions& options) {
  check_options(options, "frontiers");
  std::vector<Cells> pieces;
  for (Cells& cluster : connected_clusters(grid.frame, frontier_cells(grid, options))) {
    if (cluster.size() < static_cast<std::size_t>(options.min_cells)) continue;
    split(grid.frame, std::move(cluster), options, pieces);
  }
  std::ranges::sort(pieces, {}, [](const Cells& cells) {
    return std::tuple(-static_cast<std::ptrdiff_t>(cells.size()), cells.front());
  });
  std::vector<Frontier> frontiers;
  for (Cells& cells : pieces) {
    const Eigen::Vector3d p_m = place(grid, cells, options.height_m);
    frontiers.push_back({std::move(cells), p_m});
  }
  return frontiers;
}

}  // namespace vantage
