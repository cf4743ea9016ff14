#include "vantage/belief/map/flight_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

GridFrame frame_of(const Eigen::AlignedBox3d& region_m, double cell_m) {
  expects(!region_m.isEmpty(), "a map has a region");
  constexpr double kMaxCells = 67108864.0;  // 2^26
  const Eigen::Array3d cells = (region_m.sizes().array() / cell_m).ceil().max(1.0);
  if (!(cells.prod() <= kMaxCells)) {
    throw ConfigError(
        fmt::format("flight map: {} cells of cell_m = {}, at most 2^26", cells.prod(), cell_m));
  }
  return {region_m.min(), Eigen::Vector3d::Constant(cell_m), cells.cast<int>()};
}

std::vector<Eigen::Vector3f> points_of(const CameraImages& images, const Pose& T_world_camera,
                                       int stride) {
  std::vector<Eigen::Vector3f> points;
  for (int row = stride / 2; row < images.height_px; row += stride) {
    for (int column = stride / 2; column < images.width_px; column += stride) {
      const float z_m = images.depth_at(row, column);
      if (!(z_m > 0.0F) || !std::isfinite(z_m)) continue;
      const Eigen::Vector3d p_m = T_world_camera * (z_m * images.ray(row, column));
      points.emplace_back(p_m.cast<float>());
    }
  }
  return points;
}

/// Something below `above` is occupied. Whether beside it, at its height, something is occupied
/// that was seen to end there: a stand's top is level, so where part of it ends all of it does.
bool ends_beside(const OccupancyGrid& grid, std::size_t above) {
  const Eigen::Array3i cell = grid.frame.cell(above);
  for (int k = 0; k < 9; ++k) {
    const Eigen::Array3i over = cell + Eigen::Array3i(k % 3 - 1, k / 3 - 1, 0);
    const Eigen::Array3i beside = over - Eigen::Array3i(0, 0, 1);
    if (!grid.frame.contains(over) || !grid.frame.contains(beside)) continue;
    if (grid.state(grid.frame.index(beside)) == CellState::occupied &&
        grid.state(grid.frame.index(over)) == CellState::free) {
      return true;
    }
  }
  return false;
}

}  // namespace

FlightMap::FlightMap(const Eigen::AlignedBox3d& region_m, const FlightMapOptions& options)
    : options_(options) {
  check_options(options_, "flight map");
  grid_ = OccupancyGrid(frame_of(region_m, options_.cell_m));
}

void FlightMap::insert(const CameraImages& images, const Pose& T_world_camera) {
  InverseSensorModel model;
  model.sigma_m = options_.noise_m;
  model.spread_sigmas = 0.0;
  add_measurements(
      grid_, points_of(images, T_world_camera, std::max(1, images.width_px / options_.columns)),
      model);
  carve_free_space(grid_, images, T_world_camera, options_.free_space);
}

std::vector<std::uint8_t> FlightMap::obstacles() const {
  const GridFrame& frame = grid_.frame;
  const auto layer =
      static_cast<std::size_t>(frame.cells.x()) * static_cast<std::size_t>(frame.cells.y());
  const auto tall = static_cast<int>(std::ceil(options_.rise_m / options_.cell_m - 1e-9));
  std::vector<std::uint8_t> blocked(grid_.size(), 0);
  std::vector<int> run(layer, 0);  // of blocked cells below, a column
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    int& below = run[cell % layer];
    const CellState state = grid_.state(cell);
    const bool occupied = state == CellState::occupied;
    bool goes_on = state == CellState::unobserved && below >= tall && below > 0;
    if (goes_on && grid_.state(cell - layer) == CellState::occupied) {
      goes_on = !ends_beside(grid_, cell);
    }
    blocked[cell] = occupied || goes_on ? 1 : 0;
    below = occupied || goes_on ? below + 1 : 0;
  }
  return blocked;
}

std::vector<std::uint8_t> FlightMap::unseen_places() const {
  const GridFrame& frame = grid_.frame;
  const auto layer =
      static_cast<std::size_t>(frame.cells.x()) * static_cast<std::size_t>(frame.cells.y());
  std::vector<std::uint8_t> seen(layer, 0);
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    if (grid_.state(cell) != CellState::unobserved) seen[cell % layer] = 1;
  }
  std::vector<std::uint8_t> unseen(grid_.size());
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) unseen[cell] = 1 - seen[cell % layer];
  return unseen;
}

}  // namespace vantage
