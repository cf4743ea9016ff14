/// OctoMap files put together by hand: cells anywhere in the tree, without a grid round them.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <string>
#include <vector>

namespace vantage::support {

struct MapCube {
  Eigen::Array3i first;  ///< its lowest cell; cell 0 begins at the world's origin
  int edge_cells = 1;    ///< a power of two that `first` is a multiple of
  bool occupied = false;
};

/// The record of one inner node and of all below it, two bits a child.
inline std::string binary_records(const Eigen::Array3i& first, int edge_cells,
                                  const std::vector<MapCube>& cubes, std::size_t& nodes) {
  const int half = edge_cells / 2;
  unsigned kinds = 0;
  std::string below;
  ++nodes;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Array3i child = first + half * Eigen::Array3i(i & 1, i >> 1 & 1, i >> 2 & 1);
    std::vector<MapCube> inside;
    std::ranges::copy_if(cubes, std::back_inserter(inside), [&](const MapCube& cube) {
      return (cube.first >= child).all() && (cube.first < child + half).all();
    });
    if (inside.empty()) continue;
    if (inside.front().edge_cells == half) {
      kinds |= (inside.front().occupied ? 2U : 1U) << (2 * i);
      ++nodes;
    } else {
      kinds |= 3U << (2 * i);
      below += binary_records(child, half, inside, nodes);
    }
  }
  return std::string{static_cast<char>(kinds & 255U), static_cast<char>(kinds >> 8)} + below;
}

/// A .bt file of cubes that do not overlap.
inline std::string octomap_bytes(const std::vector<MapCube>& cubes, double resolution_m) {
  std::size_t nodes = 0;
  const std::string data = binary_records(Eigen::Array3i::Constant(-32768), 65536, cubes, nodes);
  return "# Octomap OcTree binary file\nid OcTree\nsize " + std::to_string(nodes) + "\nres " +
         std::to_string(resolution_m) + "\ndata\n" + data;
}

}  // namespace vantage::support
