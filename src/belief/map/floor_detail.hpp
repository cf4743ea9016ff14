/// A finer map of the floor about narrow places, beam by beam.
#pragma once

#include <span>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/floor_outline.hpp"

namespace vantage {

struct FloorDetailOptions {
  int parts = 3;
  double range_m = 3.0;
  void fields(auto&& f) {
    f("parts", parts,
      "edge of a cell of the floor map in cells of the finer one; odd; higher measures door posts "
      "more exactly and is slower",
      between(1, 15));
    f("range_m", range_m,
      "distance up to which beams of the planar scanner are taken into the finer map; higher knows "
      "a passage from farther away and is slower",
      Range{0.0, 100.0, true});
  }
  void check() const;  ///< parts is odd: the middle of a cell is that of a finer one
};

/// @throws ConfigError if the finer map of such a floor has more than kMaxFloorCells cells.
void check_floor_detail(const FloorMapOptions& floor, const FloorDetailOptions& detail);

/// Nothing known yet; each cell of `floor` is parts x parts of these.
FloorMap make_floor_detail(const FloorMap& floor, const FloorDetailOptions& options);

/// Adds one scan. Unlike add_planar_scan(), each beam counts: a cell is occupied if more than three
/// in ten of the latest beams that came to it ended there. So an edge is measured to about half a
/// cell, while a scan as a whole makes what its noise reaches an obstacle.
void add_beams(FloorMap& detail, const PlanarScan& scan, const Pose2& T_world_base,
               const FloorDetailOptions& options);

/// The robot stands there: cells with their centre inside its outline are free, except blocked
/// ones.
void clear_outline(FloorMap& detail, std::span<const Eigen::Vector2d> outline_world);

/// Free for certain, as FloorMap::state() has it, without its exponential.
inline bool is_free(const FloorMap& map, std::size_t cell) {
  return map.blocked[cell] == 0 && map.log_odds[cell] < -0.4054652F;  // ln(0.4 / 0.6)
}
inline bool is_occupied(const FloorMap& map, std::size_t cell) {
  return map.blocked[cell] != 0 || map.log_odds[cell] > 0.4054652F;
}

}  // namespace vantage
