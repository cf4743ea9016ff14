/// What the map of a table leaves in a run folder: map changes for the window, voxels.bin for the
/// report.
#pragma once

#include <filesystem>
#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/runtime/log/event_log.hpp"

namespace vantage {

class TableMapLog {
 public:
  /// What has changed on the map since the last call.
  /// @param view that it is the map after, the first is 0
  MapChange change(const OccupancyGrid& grid, int view);
  /// Writes voxels.bin: what is occupied, since which view, and what was never observed. Nothing
  /// if there was no map. @throws OutputError
  void commit(const std::filesystem::path& run_dir) const;

 private:
  std::vector<CellState> known_;
  std::vector<std::uint16_t> since_;  ///< view, by cell; while it is occupied
  GridFrame frame_;
};

}  // namespace vantage
