#include "vantage/tasks/table_map/table_map.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/perception/table_extraction.hpp"
#include "vantage/planners/views/target_visibility.hpp"
#include "vantage/planners/visibility/attenuated_ray.hpp"

namespace vantage {
namespace {

Eigen::AlignedBox3d region_of(const Eigen::Vector3d& p_world_table_m,
                              const TableMapOptions& options) {
  const Eigen::Vector3d half_m(0.5 * options.size_m[0], 0.5 * options.size_m[1], 0.0);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  return {
      p_world_table_m - half_m + options.foot_m * up,
      p_world_table_m + half_m + std::max(options.height_m, options.foot_m + options.cell_m) * up};
}

FlightMapOptions map_options(const TableMapOptions& options) {
  FlightMapOptions map;
  map.cell_m = options.cell_m;
  map.columns = options.columns;
  map.noise_m = 0.5 * options.cell_m;
  return map;
}

}  // namespace

TableMap::TableMap(const Eigen::Vector3d& p_world_table_m, const TableMapOptions& options)
    : options_(options),
      p_table_m_(p_world_table_m),
      map_(region_of(p_world_table_m, options), map_options(options)),
      hazard_(options.hazard, map_.grid().frame.cells),
      distances_(distances()) {
  check_options(options, "map");
  refresh();
}

GridFrame TableMap::frame_of(const Eigen::Vector3d& p_world_table_m,
                             const TableMapOptions& options) {
  return FlightMap(region_of(p_world_table_m, options), map_options(options)).grid().frame;
}

void TableMap::insert(const CameraImages& images, const Pose& T_world_camera) {
  const PosedImage posed{images, T_world_camera};
  const int stride = std::max(1, images.width_px / options_.columns);
  hazard_.observe(map_.grid(), std::span(&posed, 1), stride, map_.grid().frame.min_corner_m.z());
  map_.insert(images, T_world_camera);
  refresh();
}

void TableMap::refresh() {
  const OccupancyGrid& grid = map_.grid();
  transmission_ =
      attenuation_tables(grid, {.transmission = hazard_.transmission(), .by_entropy = false})
          .transmission;
  distances_ = distances();
}

Esdf TableMap::distances() const {
  constexpr double kBeyond_m = 0.1;
  std::vector<std::uint8_t> closed = map_.obstacles();
  for (std::size_t cell = 0; cell < closed.size(); ++cell) {
    if (grid().state(cell) == CellState::unobserved) closed[cell] = 1;
  }
  return {grid().frame, closed, options_.clearance_m + kBeyond_m};
}

/// At least: what is outside of the map is no nearer to anything in it than this.
double TableMap::distance_m(const Eigen::Vector3d& p_world_m) const {
  const Eigen::AlignedBox3d box = grid().frame.box();
  const Eigen::Vector3d at_m = p_world_m.cwiseMax(box.min()).cwiseMin(box.max());
  return std::hypot(std::max(0.0, distances_.distance_m(at_m)), (p_world_m - at_m).norm());
}

bool TableMap::is_clear(std::span<const Eigen::Vector3d> path_m) const {
  constexpr double kStep_m = 0.03;
  for (std::size_t i = 0; i < path_m.size(); ++i) {
    const Eigen::Vector3d& from_m = path_m[i == 0 ? 0 : i - 1];
    const Eigen::Vector3d way_m = path_m[i] - from_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(way_m.norm() / kStep_m)));
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Vector3d p_m = from_m + static_cast<double>(k) / steps * way_m;
      if (distance_m(p_m) < options_.clearance_m) return false;
    }
  }
  return true;
}

std::vector<std::uint8_t> TableMap::cells_over(const std::vector<Eigen::Vector2d>& outline,
                                               double height_m) const {
  const GridFrame& frame = grid().frame;
  const double top_m = p_table_m_.z() + height_m + options_.margin_m;
  std::vector<std::uint8_t> over(frame.size(), 0);
  for (std::size_t i = 0; i < over.size(); ++i) {
    const Eigen::Vector3d p_m = frame.centre(frame.cell(i));
    if (p_m.z() > top_m) break;  // layer by layer
    over[i] = inside_hull(outline, p_m.head<2>(), options_.margin_m) ? 1 : 0;
  }
  return over;
}

double TableMap::visible_share(const UprightCylinder& target, std::span<const std::uint8_t> own,
                               const Eigen::Vector3d& p_world_eye_m) const {
  return vantage::visible_share(grid().frame, transmission_, target, own, p_world_eye_m,
                                options_.margin_m);
}

}  // namespace vantage
