/// From the beams of a scan to free cells.
#pragma once

#include <cstddef>
#include <span>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

struct FreeSpaceUpdate {
  double p_free_given_pass = 0.7;
  void fields(auto&& f) {
    f("p_free_given_pass", p_free_given_pass,
      "probability that a cell is free where a beam has passed; one pass frees any unobserved "
      "cell, higher needs more hits to undo",
      between(0.7, 0.999));
  }
};

/// Updates towards free every cell c with 0.4 < p(o) < 0.6 that the scan saw empty:
///   (i)   c's centre lies inside the field of view and range,
///   (ii)  beams were swept on all sides of it and each went farther than the centre,
///   (iii) the straight walk from the sensor to c meets no cell with p(o) >= 0.6
/// [AmanatidesWoo1987], [Potthast2016, 3.2.3]. Any other cell keeps its value, so a cell outside
/// the sector or behind the measured depth is never freed. All cells are judged against the grid
/// as it was before the call. Call after add_measurements with the same scan.
/// The result does not depend on `threads` (>= 1).
/// @return the number of cells freed
/// @throws ConfigError if `update` is out of range.
std::size_t carve_free_space(OccupancyGrid& grid, const RangeScan& scan, const Pose& T_world_sensor,
                             const FreeSpaceUpdate& update, int threads = 1);

/// The same for depth images, by projecting cell centres into them. Conditions (i) and (ii) become:
///   (i)   c's centre lies in an image and no farther from the camera than image.range_max_m,
///   (ii)  each of the four pixels round its projection went farther than the centre;
/// a pixel without measurement frees nothing, one beyond range frees up to range_max_m. A cell that
/// several images saw empty is freed once, as if one image came after the other.
std::size_t carve_free_space(OccupancyGrid& grid, std::span<const PosedImage> images,
                             const FreeSpaceUpdate& update, int threads = 1);
std::size_t carve_free_space(OccupancyGrid& grid, const CameraImages& image,
                             const Pose& T_world_camera, const FreeSpaceUpdate& update,
                             int threads = 1);

}  // namespace vantage
