#include "vantage/belief/map/clutter_hazard.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "vantage/core/parallel_for.hpp"
#include "vantage/geometry/face_neighbours.hpp"

namespace vantage {
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

ClutterHazard::MetCells ClutterHazard::met_cells(const OccupancyGrid& grid, const GridPart& reach,
                                                 int threads) {
  MetCells met{grid.frame, reach, std::vector<Met>(reach.size())};
  constexpr std::array by_state{Met::free, Met::unobserved, Met::occupied};
  parallel_for(static_cast<std::size_t>(reach.count.z()), threads, [&](std::size_t slice) {
    Eigen::Array3i at = reach.begin + Eigen::Array3i(0, 0, static_cast<int>(slice));
    Met* next = &met.cells[reach.index(at)];
    for (; at.y() < reach.end().y(); ++at.y()) {
      at.x() = reach.begin.x();
      std::size_t cell = grid.frame.index(at);
      for (; at.x() < reach.end().x(); ++at.x(), ++cell) {
        const CellState state = grid.state(cell);
        const bool beside = state == CellState::unobserved &&
                            any_face_neighbour(grid.frame, at, [&](std::size_t neighbour) {
                              return grid.state(neighbour) == CellState::occupied;
                            });
        *next++ =
            beside ? Met::unobserved_beside_occupied : by_state[static_cast<std::size_t>(state)];
      }
    }
  });
  return met;
}

void ClutterHazard::count_beam(const MetCells& before, const Beam& beam, Counts& counts) const {
  const GridFrame& frame = before.frame;
  const Eigen::Array3i last = frame.cell_at(beam.p_end);
  const std::size_t end = beam.returned && frame.contains(last) ? frame.index(last) : frame.size();
  walk_ray(frame, beam.p_from, beam.p_end, [&](std::size_t index, const Eigen::Array3i& cell) {
    const Met met = before.cells[before.reach.index(cell)];
    if (met == Met::unobserved) {
      const std::size_t column =
          static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(frame.cells.x()) +
          static_cast<std::size_t>(cell.x());
      const std::size_t block =
          crossings_.layout.index(0, 0, layer_of(cell.z())) + column_of_[column];
      counts.crossings[block] += 1.0;
      if (index == end) counts.hits[block] += 1.0;
    }
    return met != Met::occupied;
  });
}

/// Whole numbers, whose sum is the same in any order.
void ClutterHazard::count_beams(const OccupancyGrid& before, std::span<const Beam> beams,
                                int threads) {
  expects((before.frame.cells == crossings_.layout.cells).all(),
          "the hazard was made for a grid of other size");
  Eigen::AlignedBox3d reach_m;
  for (const Beam& beam : beams) reach_m.extend(beam.p_from).extend(beam.p_end);
  const MetCells met = met_cells(before, cells_about(before.frame, reach_m), threads);
  const std::vector<double> none(crossings_.layout.size(), 0.0);
  std::vector<Counts> parts(static_cast<std::size_t>(threads), {none, none});
  parallel_for(parts.size(), threads, [&](std::size_t part) {
    for (std::size_t i = part; i < beams.size(); i += parts.size()) {
      count_beam(met, beams[i], parts[part]);
    }
  });
  for (const Counts& part : parts) {
    for (std::size_t block = 0; block < none.size(); ++block) {
      crossings_.per_block[block] += part.crossings[block];
      hits_.per_block[block] += part.hits[block];
    }
  }
}

void ClutterHazard::observe(const OccupancyGrid& before, const RangeScan& scan,
                            const Pose& T_world_sensor, int threads) {
  const Eigen::Vector3d& p_from = T_world_sensor.translation();
  std::vector<Beam> beams;
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      const double measured_m = scan.range(line, beam);
      if (std::isnan(measured_m)) continue;
      const bool returned = std::isfinite(measured_m);
      const double length_m = returned ? measured_m : scan.field_of_view.range_max_m;
      const BeamAngles angles{scan.azimuth_rad[beam], scan.tilt_rad[line]};
      beams.push_back({p_from, T_world_sensor * (length_m * beam_direction(angles)), returned});
    }
  }
  count_beams(before, beams, threads);
}

void ClutterHazard::observe(const OccupancyGrid& before, std::span<const PosedImage> images,
                            int stride, double floor_m, int threads) {
  expects(stride >= 1, "a stride of at least one pixel");
  std::vector<Beam> beams;
  for (const auto& [image, T_world_camera] : images) {
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
          beams.push_back({p_from, p_end, returned});
        } else if (p_from.z() > floor_m) {
          const double share = (p_from.z() - floor_m) / (p_from.z() - p_end.z());
          beams.push_back({p_from, p_from + share * (p_end - p_from), false});
        }
      }
    }
  }
  count_beams(before, beams, threads);
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
