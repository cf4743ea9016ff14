#include "src/belief/clutter_hazard.hpp"

#include <cmath>

namespace vantage {

ClutterHazard::ClutterHazard(const ClutterHazardOptions& options, int slices)
    : options_(options), slices_(slices) {
  check_options(options, "clutter hazard");
  expects(slices >= 1, "a grid has at least one slice");
  counts_.resize(static_cast<std::size_t>(options.layers));
}

const ClutterHazard::Counts& ClutterHazard::counts_of(int layer) const {
  expects(layer >= 0 && layer < options_.layers, "layer out of range");
  return counts_[static_cast<std::size_t>(layer)];
}

void ClutterHazard::count_beam(const OccupancyGrid& before, const Eigen::Vector3d& p_from,
                               const Eigen::Vector3d& p_to, bool returned) {
  const GridFrame& frame = before.frame;
  const Eigen::Array3i last = frame.cell_at(p_to);
  const std::size_t end = returned && frame.contains(last) ? frame.index(last) : frame.size();
  const std::size_t cells_per_slice = frame.size() / static_cast<std::size_t>(slices_);
  walk_ray(frame, p_from, p_to, [&](std::size_t cell) {
    const CellState state = before.state(cell);
    if (state == CellState::unobserved) {
      const int layer = layer_of(static_cast<int>(cell / cells_per_slice));
      Counts& counts = counts_[static_cast<std::size_t>(layer)];
      counts.crossings += 1.0;
      if (cell == end) counts.hits += 1.0;
    }
    return state != CellState::occupied;
  });
}

void ClutterHazard::observe(const OccupancyGrid& before, const RangeScan& scan,
                            const Pose& T_world_sensor) {
  expects(before.frame.cells.z() == slices_, "the hazard was made for a grid of other height");
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
                            const Pose& T_world_camera, int stride) {
  expects(before.frame.cells.z() == slices_, "the hazard was made for a grid of other height");
  expects(stride >= 1, "a stride of at least one pixel");
  for (int row = 0; row < image.height_px; row += stride) {
    for (int column = 0; column < image.width_px; column += stride) {
      const double depth_m = image.depth_at(row, column);
      if (depth_m == 0.0) continue;
      const bool returned = std::isfinite(depth_m);
      const Eigen::Vector3d ray = image.ray(row, column);
      const double scale = returned ? depth_m : image.range_max_m / ray.norm();
      count_beam(before, T_world_camera.translation(), T_world_camera * (scale * ray), returned);
    }
  }
}

double ClutterHazard::global_hazard() const {
  double crossings = options_.prior_weight;
  double hits = options_.prior_weight * options_.prior_hazard;
  for (const Counts& layer : counts_) {
    crossings += layer.crossings;
    hits += layer.hits;
  }
  return hits / crossings;
}

double ClutterHazard::hazard(int layer) const {
  const Counts& counts = counts_of(layer);
  const double global = global_hazard();
  const double crossings = counts.crossings + options_.prior_crossings;
  return crossings > 0.0 ? (counts.hits + options_.prior_crossings * global) / crossings : global;
}

std::vector<double> ClutterHazard::transmission_per_slice() const {
  std::vector<double> transmission;
  for (int slice = 0; slice < slices_; ++slice) {
    transmission.push_back(1.0 - hazard(layer_of(slice)));
  }
  return transmission;
}

}  // namespace vantage
