#include "vantage/belief/map/free_space.hpp"

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/belief/map/obstacle_distance.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/geometry/grid_part.hpp"
#include "vantage/geometry/view_cone.hpp"

namespace vantage {
namespace {

/// A view by the scan of a laser.
struct ScanView {
  const RangeScan& scan;
  Pose T_sensor_world;
  ViewCone cone;  ///< its field of view, sensor frame

  /// Conditions (i) and (ii).
  [[nodiscard]] bool swept(const Eigen::Vector3d& p_world) const {
    const Eigen::Vector3d p_sensor = T_sensor_world * p_world;
    if (!cone.contains(p_sensor)) return false;
    // A NaN range, not swept, compares false.
    return p_sensor.norm() < scan.swept_range(beam_angles(p_sensor));
  }
};

/// A view by a depth image.
struct ImageView {
  const CameraImages& image;
  Pose T_camera_world;

  [[nodiscard]] bool swept(const Eigen::Vector3d& p_world) const {
    const Eigen::Vector3d p_camera = T_camera_world * p_world;
    return p_camera.z() > 0.0 && p_camera.squaredNorm() <= image.range_max_m * image.range_max_m &&
           p_camera.z() < image.swept_depth_m(p_camera);
  }
};

/// A view with the sector, in the world, outside which it sweeps nothing.
template <class View>
struct Posed {
  View view;
  ViewCone sector;
  Eigen::AlignedBox3d box_m;  ///< round the sector

  Posed(View v, const Pose& T_world_sensor, const FieldOfView& sector_at_sensor)
      : view(std::move(v)),
        sector(T_world_sensor, sector_at_sensor),
        box_m(sector_at_sensor.box_m().transformed(T_world_sensor)) {}
};

/// The view with the sector round the image: its corners are no farther to the side, as an angle,
/// than the middle of its edges.
Posed<ImageView> posed_view(const CameraImages& image, const Pose& T_world_camera) {
  constexpr double kSlack_rad = 1e-6;
  const double across_rad = std::atan(0.5 * image.width_px / image.focal_px) + kSlack_rad;
  const double up_rad = std::atan(0.5 * image.height_px / image.focal_px) + kSlack_rad;
  Pose T_camera_sensor = Pose::Identity();  // x along the optical axis, z up
  T_camera_sensor.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const FieldOfView sector{.half_width_rad = across_rad,
                           .tilt_min_rad = -up_rad,
                           .tilt_max_rad = up_rad,
                           .range_min_m = 0.0,
                           .range_max_m = image.range_max_m};
  return {{image, T_world_camera.inverse()}, T_world_camera * T_camera_sensor, sector};
}

template <class View>
GridPart cells_about(const GridFrame& frame, const std::vector<Posed<View>>& views) {
  Eigen::AlignedBox3d box_m;
  for (const Posed<View>& posed : views) box_m.extend(posed.box_m);
  return cells_about(frame, box_m);
}

/// Frees what is seen of a row of cells; which are occupied does not change by that.
template <class View>
std::size_t carve_row(OccupancyGrid& grid, const Posed<View>& posed, const RowBounds& bounds, int y,
                      int z, const ObstacleDistance& obstacles, float evidence) {
  const GridFrame& frame = grid.frame;
  const auto seen = bounds.of_row(frame.centre({0, y, z}), frame.cells.x());
  const std::size_t row = frame.index({0, y, z});
  std::size_t freed = 0;
  for (int x = seen.begin; x < seen.end; ++x) {
    const std::size_t cell = row + static_cast<std::size_t>(x);
    if (grid.state(cell) != CellState::unobserved) continue;
    const Eigen::Vector3d p_world = frame.centre({x, y, z});
    if (!posed.view.swept(p_world)) continue;
    if (!obstacles.is_clear(posed.sector.apex_m(), p_world)) continue;  // condition (iii)
    grid.log_odds[cell] += evidence;
    ++freed;
  }
  return freed;
}

template <class View>
std::size_t carve(OccupancyGrid& grid, const std::vector<Posed<View>>& views,
                  const FreeSpaceUpdate& update, int threads) {
  expects(threads >= 1, "carve_free_space needs a thread");
  check_options(update, "free space");
  const auto evidence = static_cast<float>(log_odds_of(1.0 - update.p_free_given_pass));
  const GridPart reach = cells_about(grid.frame, views);
  const ObstacleDistance obstacles(grid, reach, threads);
  const Eigen::Vector3d step(grid.frame.cell_size_m.x(), 0.0, 0.0);
  // A worker writes and reads the cells of its own slice alone, apart from the obstacles.
  std::vector<std::size_t> freed(static_cast<std::size_t>(reach.count.z()), 0);
  parallel_for(freed.size(), threads, [&](std::size_t slice) {
    const int z = reach.begin.z() + static_cast<int>(slice);
    for (const Posed<View>& posed : views) {
      const RowBounds bounds(posed.sector, step);
      const GridPart about = cells_about(grid.frame, posed.box_m);
      for (int y = about.begin.y(); y < about.end().y(); ++y) {
        freed[slice] += carve_row(grid, posed, bounds, y, z, obstacles, evidence);
      }
    }
  });
  return std::accumulate(freed.begin(), freed.end(), std::size_t{0});
}

}  // namespace

std::size_t carve_free_space(OccupancyGrid& grid, const RangeScan& scan, const Pose& T_world_sensor,
                             const FreeSpaceUpdate& update, int threads) {
  const ViewCone cone(Pose::Identity(), scan.field_of_view);
  const std::vector<Posed<ScanView>> views{
      {{scan, T_world_sensor.inverse(), cone}, T_world_sensor, scan.field_of_view}};
  return carve(grid, views, update, threads);
}

std::size_t carve_free_space(OccupancyGrid& grid, std::span<const PosedImage> images,
                             const FreeSpaceUpdate& update, int threads) {
  std::vector<Posed<ImageView>> views;
  for (const auto& [image, T_world_camera] : images) {
    views.push_back(posed_view(image, T_world_camera));
  }
  return carve(grid, views, update, threads);
}

std::size_t carve_free_space(OccupancyGrid& grid, const CameraImages& image,
                             const Pose& T_world_camera, const FreeSpaceUpdate& update,
                             int threads) {
  const PosedImage posed{image, T_world_camera};
  return carve_free_space(grid, {&posed, 1}, update, threads);
}

}  // namespace vantage
