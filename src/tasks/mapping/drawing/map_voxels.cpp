#include "vantage/tasks/mapping/drawing/map_voxels.hpp"

#include <algorithm>

namespace vantage {

void MapVoxels::note(const OccupancyGrid& grid, std::size_t scans) {
  occupied_since_.resize(grid.size(), 0);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) != CellState::occupied) {
      occupied_since_[cell] = 0;
    } else if (occupied_since_[cell] == 0) {
      occupied_since_[cell] = static_cast<std::uint16_t>(scans);
    }
  }
}

std::vector<VoxelRecord> MapVoxels::of(const OccupancyGrid& grid) const {
  std::vector<VoxelRecord> voxels;
  const auto add = [&](std::size_t cell, std::size_t step, std::uint8_t kind) {
    const Eigen::Vector3f p = grid.frame.centre(grid.frame.cell(cell)).cast<float>();
    voxels.push_back({p.x(), p.y(), p.z(), static_cast<std::uint16_t>(step), kind});
  };
  for (std::size_t cell = 0; cell < occupied_since_.size(); ++cell) {
    if (occupied_since_[cell] > 0) add(cell, occupied_since_[cell] - 1U, kVoxelOccupied);
  }
  std::ranges::stable_sort(voxels, {}, &VoxelRecord::step);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) == CellState::unobserved) add(cell, 0, kVoxelUnobserved);
  }
  return voxels;
}

}  // namespace vantage
