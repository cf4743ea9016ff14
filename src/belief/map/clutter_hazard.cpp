#include "vantage/belief/map/clutter_hazard.hpp"

#include <cmath>
#include <numeric>

#include "vantage/geometry/face_neighbours.hpp"

namespace vantage {
namespace {

bool is_beside_occupied(const OccupancyGrid& grid, std::size_t cell) {
  return any_face_neighbour(grid.frame, grid.frame.cell(cell), [&](std::size_t neighbour) {
    return grid.state(neighbour) == CellState::occupied;
  });
}

}  // namespace

ClutterHazard::ClutterHazard(const ClutterHazardOptions& options, const Eigen::Array3i& cells)
    : options_(options) {
  check_options(options, "clutter hazard");
  expects((cells >= 1).all(), "a grid has at least one cell along each axis");
  BlockLayout& layout = crossings_.layout;
  layout.cells = cells;
  layout.blocks = (cells + options.block_cells - 1) / options.block_cells;
  layout.blocks.z() = options.layers;
  crossings_.per_block.assign(layout.size(), 0.0);
  hits_ = crossings_;
  for (int y = 0; y < cells.y(); ++y) {
    for (int x = 0; x < cells.x(); ++x) {
      column_of_.push_back(layout.index(layout.block_of(0, x), layout.block_of(1, y), 0));
    }
  }
}

double ClutterHazard::sum_of_layer(const BlockField& counts, int layer) const {
  expects(layer >= 0 && layer < options_.layers, "layer out of range");
  const double* begin = &counts.per_block[counts.layout.index(0, 0, layer)];
  return std::accumulate(begin, begin + counts.layout.index(0, 0, 1), 0.0);
}

void ClutterHazard::count_beam(const OccupancyGrid& before, const Eigen::Vector3d& p_from,
                               const Eigen::Vector3d& p_to, bool returned) {
  const GridFrame& frame = before.frame;
  const Eigen::Array3i last = frame.cell_at(p_to);
  const std::size_t end = returned && frame.contains(last) ? frame.index(last) : frame.size();
  walk_ray(frame, p_from, p_to, [&](std::size_t cell) {
    const CellState state = before.state(cell);
    if (state == CellState::unobserved && !is_beside_occupied(before, cell)) {
      const std::size_t slice = cell / column_of_.size();
      const int layer = layer_of(static_cast<int>(slice));
      const std::size_t block =
          crossings_.layout.index(0, 0, layer) + column_of_[cell - slice * column_of_.size()];
      crossings_.per_block[block] += 1.0;
      if (cell == end) hits_.per_block[block] += 1.0;
    }
    return state != CellState::occupied;
  });
}

void ClutterHazard::observe(const OccupancyGrid& before, const RangeScan& scan,
                            const Pose& T_world_sensor) {
  expects((before.frame.cells == crossings_.layout.cells).all(),
          "the hazard was made for a grid of other size");
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      const double measured_m = scan.range(line, beam);
      if (std::isnan(measured_m)) continue;
      const bool returned = std::isfinite(measured_m);
      const double length_m = returned ? measured_m : scan.field_of_view.range_max_m;
      const BeamAngles angles{scan.azimuth_rad[beam], scan.tilt_rad[line]};
      const Eigen::Vector3d p_end = T_world_sensor * (length_m * beam_direction(angles));
      count_beam(before, T_world_sensor.translation(), p_end, returned);
    }
  }
}

void ClutterHazard::observe(const OccupancyGrid& before, const CameraImages& image,
                            const Pose& T_world_camera, int stride, double floor_m) {
  expects((before.frame.cells == crossings_.layout.cells).all(),
          "the hazard was made for a grid of other size");
  expects(stride >= 1, "a stride of at least one pixel");
  const Eigen::Vector3d& p_from = T_world_camera.translation();
  for (int row = 0; row < image.height_px; row += stride) {
    for (int column = 0; column < image.width_px; column += stride) {
      const double depth_m = image.depth_at(row, column);
      if (depth_m == 0.0) continue;
      const bool returned = std::isfinite(depth_m);
      const Eigen::Vector3d ray = image.ray(row, column);
      const double scale = returned ? depth_m : image.range_max_m / ray.norm();
      const Eigen::Vector3d p_end = T_world_camera * (scale * ray);
      if (p_end.z() >= floor_m) {
        count_beam(before, p_from, p_end, returned);
      } else if (p_from.z() > floor_m) {
        const double share = (p_from.z() - floor_m) / (p_from.z() - p_end.z());
        count_beam(before, p_from, p_from + share * (p_end - p_from), false);
      }
    }
  }
}

double ClutterHazard::global_hazard() const {
  double crossings = options_.prior_weight;
  double hits = options_.prior_weight * options_.prior_hazard;
  for (const double counted : crossings_.per_block) crossings += counted;
  for (const double counted : hits_.per_block) hits += counted;
  return hits / crossings;
}

double ClutterHazard::hazard(int layer) const {
  const double global = global_hazard();
  const double crossings = this->crossings(layer) + options_.prior_crossings;
  return crossings > 0.0 ? (hits(layer) + options_.prior_crossings * global) / crossings : global;
}

std::vector<double> ClutterHazard::transmission_per_slice() const {
  std::vector<double> transmission;
  for (int slice = 0; slice < crossings_.layout.cells.z(); ++slice) {
    transmission.push_back(1.0 - hazard(layer_of(slice)));
  }
  return transmission;
}

BlockField ClutterHazard::transmission() const {
  const BlockLayout& layout = crossings_.layout;
  const Eigen::Array2d sigma_blocks = options_.reach_cells *
                                      layout.blocks.head<2>().cast<double>() /
                                      layout.cells.head<2>().cast<double>();
  const BlockField crossings = gather_neighbours(crossings_, sigma_blocks);
  BlockField transmission = gather_neighbours(hits_, sigma_blocks);
  const double pull = options_.block_crossings;
  const std::size_t columns = layout.index(0, 0, 1);
  for (int layer = 0; layer < options_.layers; ++layer) {
    const double of_layer = hazard(layer);
    const std::size_t begin = layout.index(0, 0, layer);
    for (std::size_t block = begin; block < begin + columns; ++block) {
      double& number = transmission.per_block[block];
      number = 1.0 - (number + pull * of_layer) / (crossings.per_block[block] + pull);
    }
  }
  return transmission;
}

}  // namespace vantage
