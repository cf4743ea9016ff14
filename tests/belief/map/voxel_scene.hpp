/// Small scenes of voxels, drawn in ASCII or random, and what a noise-free laser measures in them.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage::test {

using Drawing = std::vector<std::string>;

inline float log_odds_of_symbol(char symbol) {
  expects(symbol == '#' || symbol == '.' || symbol == '?', "unknown symbol in a drawing");
  return symbol == '#' ? 2.0F : (symbol == '.' ? -1.0F : 0.0F);
}

/// One slice seen from above, cells of 1 m; '#' occupied, '.' free, '?' unobserved. The first
/// column begins at x = 0, the last row at y = 0, the slice is centred on z = 0.
inline OccupancyGrid parse(const Drawing& rows) {
  GridFrame frame;
  frame.min_corner_m = {0.0, 0.0, -0.5};
  frame.cells = {static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), 1};
  OccupancyGrid grid(frame);
  for (int y = 0; y < frame.cells.y(); ++y) {
    const std::string& row = rows[rows.size() - 1 - static_cast<std::size_t>(y)];
    for (int x = 0; x < frame.cells.x(); ++x) {
      grid.log_odds[frame.index({x, y, 0})] = log_odds_of_symbol(row[static_cast<std::size_t>(x)]);
    }
  }
  return grid;
}

inline Drawing draw(const OccupancyGrid& grid) {
  Drawing rows;
  for (int y = grid.frame.cells.y() - 1; y >= 0; --y) {
    std::string row;
    for (int x = 0; x < grid.frame.cells.x(); ++x) {
      const CellState state = grid.state(grid.frame.index({x, y, 0}));
      row += state == CellState::occupied ? '#' : (state == CellState::free ? '.' : '?');
    }
    rows.push_back(row);
  }
  return rows;
}

/// Cells that are occupied, free or unobserved with the given probabilities (rest unobserved).
inline OccupancyGrid random_grid(const GridFrame& frame, double p_occupied, double p_free,
                                 Rng& rng) {
  OccupancyGrid grid(frame);
  for (float& cell : grid.log_odds) {
    const double u = rng.uniform();
    cell = u < p_occupied ? 2.0F : (u < p_occupied + p_free ? -1.0F : 0.0F);
  }
  return grid;
}

inline Eigen::AlignedBox3d box_of_cell(const GridFrame& frame, std::size_t cell) {
  const Eigen::Vector3d centre = frame.centre(frame.cell(cell));
  return {centre - 0.5 * frame.cell_size_m, centre + 0.5 * frame.cell_size_m};
}

/// A beam ends halfway through the first occupied cell of `truth` it enters.
inline float measure(const OccupancyGrid& truth, const Pose& T_world_sensor,
                     const BeamAngles& angles, double range_max_m) {
  const Eigen::Vector3d p_from = T_world_sensor.translation();
  const Eigen::Vector3d p_to = T_world_sensor * (range_max_m * beam_direction(angles));
  float range_m = std::numeric_limits<float>::infinity();
  walk_ray(truth.frame, p_from, p_to, [&](std::size_t cell) {
    if (truth.state(cell) != CellState::occupied) return true;
    const SegmentClip clip = clip_segment(box_of_cell(truth.frame, cell), p_from, p_to);
    range_m = static_cast<float>(0.5 * (clip.enter + clip.leave) * range_max_m);
    return false;
  });
  return range_m;
}

inline std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(count == 1 ? 0.5 * (low + high) : low + (high - low) * i / (count - 1));
  }
  return values;
}

/// `lines` x `beams` spread evenly over the field of view, its limits included.
inline RangeScan scan_of(const OccupancyGrid& truth, const Pose& T_world_sensor,
                         const FieldOfView& field_of_view, int lines, int beams) {
  RangeScan scan;
  scan.field_of_view = field_of_view;
  scan.tilt_rad = evenly(field_of_view.tilt_min_rad, field_of_view.tilt_max_rad, lines);
  scan.azimuth_rad = evenly(-field_of_view.half_width_rad, field_of_view.half_width_rad, beams);
  for (const double tilt_rad : scan.tilt_rad) {
    for (const double azimuth_rad : scan.azimuth_rad) {
      scan.range_m.push_back(
          measure(truth, T_world_sensor, {azimuth_rad, tilt_rad}, field_of_view.range_max_m));
    }
  }
  return scan;
}

}  // namespace vantage::test
