#include "vantage/tasks/table_map/table_map_log.hpp"

#include <algorithm>
#include <limits>

#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {

constexpr std::uint16_t kNever = std::numeric_limits<std::uint16_t>::max();

}  // namespace

MapChange TableMapLog::change(const OccupancyGrid& grid, int view) {
  frame_ = grid.frame;
  since_.resize(grid.size(), kNever);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const bool occupied = grid.state(cell) == CellState::occupied;
    since_[cell] = occupied ? std::min(since_[cell], static_cast<std::uint16_t>(view)) : kNever;
  }
  return map_change(known_, grid);
}

void TableMapLog::commit(const std::filesystem::path& run_dir) const {
  if (since_.empty()) return;
  VoxelMap map{frame_.cell_size_m, frame_.box(), {}};
  for (std::size_t cell = 0; cell < since_.size(); ++cell) {
    const bool occupied = since_[cell] != kNever;
    if (!occupied && known_[cell] != CellState::unobserved) continue;
    const Eigen::Vector3f p = frame_.centre(frame_.cell(cell)).cast<float>();
    map.voxels.push_back({p.x(), p.y(), p.z(), occupied ? since_[cell] : std::uint16_t{0},
                          occupied ? kVoxelOccupied : kVoxelUnobserved});
  }
  write_voxels(run_dir / "voxels.bin", map);
}

}  // namespace vantage
