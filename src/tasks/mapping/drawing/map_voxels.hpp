/// The map's cells as the report shows them, scan by scan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage {

class MapVoxels {
 public:
  /// Of always the same grid. What is no longer occupied is forgotten: loops may have moved it.
  /// @param scans so far, at least 1
  void note(const OccupancyGrid& grid, std::size_t scans);
  /// Of the map as it was noted: occupied ones with the scan, from 0, that showed them so, in its
  /// order; then what is unobserved in `grid`.
  [[nodiscard]] std::vector<VoxelRecord> of(const OccupancyGrid& grid) const;

 private:
  std::vector<std::uint16_t> occupied_since_;  ///< by cell, scans by then; 0: it is not occupied
};

}  // namespace vantage
