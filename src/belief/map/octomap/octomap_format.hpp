/// OctoMap's two file formats: headers, and a reader that checks every byte. OctoMap's own recurses
/// without bound on damaged data and prints to stderr.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace vantage {

/// Levels below the root.
inline constexpr int kOctomapDepth = 16;
/// Cells of the finest level on each side of the world's origin, along each axis.
inline constexpr int kOctomapHalfWidth = 1 << (kOctomapDepth - 1);

struct OctomapHeader {
  bool binary = false;  ///< .bt: two bits a child; else .ot: log odds
  double resolution_m = 0.0;
  std::size_t nodes = 0;        ///< inner ones included
  std::size_t data_offset = 0;  ///< of the root's record
};

/// A block of cells of the finest level. Cell i of an axis covers [i, i + 1) resolutions of the
/// world.
struct CellBlock {
  Eigen::Array3i begin = Eigen::Array3i::Zero();
  Eigen::Array3i end = Eigen::Array3i::Zero();  ///< one past the last
  [[nodiscard]] bool empty() const { return (end <= begin).any(); }
  [[nodiscard]] double count() const { return empty() ? 0.0 : (end - begin).cast<double>().prod(); }
  [[nodiscard]] CellBlock cut(const CellBlock& other) const {
    return {begin.max(other.begin), end.min(other.end)};
  }
  /// In blocks of `cells`^3, counted from the world's origin: all that this one touches.
  [[nodiscard]] CellBlock coarsened(int cells) const {
    const auto floor_of = [&](const Eigen::Array3i& i) {
      return Eigen::Array3i((i.cast<double>() / cells).floor().cast<int>());
    };
    return {floor_of(begin), floor_of(end + (cells - 1))};
  }
  /// The least block that holds both.
  [[nodiscard]] CellBlock joined(const CellBlock& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {begin.min(other.begin), end.max(other.end)};
  }
  /// Calls `visit(cell)`, x fastest.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    Eigen::Array3i cell;
    for (cell.z() = begin.z(); cell.z() < end.z(); ++cell.z()) {
      for (cell.y() = begin.y(); cell.y() < end.y(); ++cell.y()) {
        for (cell.x() = begin.x(); cell.x() < end.x(); ++cell.x()) visit(cell);
      }
    }
  }
};

/// A cube of `edge_cells`^3 cells of the finest level that share one value.
struct OctomapLeaf {
  Eigen::Array3i first = Eigen::Array3i::Zero();  ///< its cell of lowest indices
  int edge_cells = 1;
  float log_odds = 0.0F;
  [[nodiscard]] bool occupied() const { return log_odds >= 0.0F; }  ///< as OctoMap has it
  [[nodiscard]] CellBlock block() const { return {first, first + edge_cells}; }
  [[nodiscard]] std::size_t cells() const {
    const auto edge = static_cast<std::size_t>(edge_cells);
    return edge * edge * edge;
  }
};
using OctomapLeafVisitor = std::function<void(const OctomapLeaf&)>;

/// The text in front of the data, up to and including the line "data".
std::string octomap_header(const OctomapHeader& header);

/// Calls `visit` with each leaf of an OcTree file, in the tree's order, and returns its header.
/// What was visited is good only if it returns. `name` stands for the file in messages.
/// @throws InputError if `bytes` are empty, no OctoMap file, another kind of tree, cut short, go on
/// behind the tree, or hold a number of nodes other than the header says.
OctomapHeader parse_octomap(std::string_view bytes, const std::string& name,
                            const OctomapLeafVisitor& visit);

}  // namespace vantage
