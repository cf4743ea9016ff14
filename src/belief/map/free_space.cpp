#include "vantage/belief/map/free_space.hpp"

#include <algorithm>
#include <future>
#include <vector>

#include "vantage/geometry/view_cone.hpp"

namespace vantage {
namespace {

using Found = std::vector<std::size_t>;

/// Cells that may have been seen, and where from.
struct Window {
  Eigen::Array3i low;   ///< first cell
  Eigen::Array3i high;  ///< last cell
  Eigen::Vector3d p_world_sensor;
};

Window whole(const GridFrame& frame, const Eigen::Vector3d& p_world_sensor) {
  return {Eigen::Array3i::Zero(), frame.cells - 1, p_world_sensor};
}

/// The cells that the image can show within its range.
Window window_of(const GridFrame& frame, const CameraImages& image, const Pose& T_world_camera) {
  const Eigen::Vector3d apex = T_world_camera.translation();
  const double x = 0.5 * image.width_px / image.focal_px;
  const double y = 0.5 * image.height_px / image.focal_px;
  Eigen::AlignedBox3d box(apex);
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(x, y, 1.0), {x, -y, 1.0}, {-x, y, 1.0}, {-x, -y, 1.0}}) {
    box.extend(T_world_camera * Eigen::Vector3d(image.range_max_m * corner));
  }
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(image.range_max_m);
  box = box.intersection({apex - reach, apex + reach});
  return {frame.cell_at(box.min()).max(0), frame.cell_at(box.max()).min(frame.cells - 1), apex};
}

struct SweptScan {
  const RangeScan& scan;
  ViewCone cone;  ///< its field of view, sensor frame
};

/// Conditions (i) and (ii) for a scan.
bool swept(const SweptScan& view, const Eigen::Vector3d& p_sensor) {
  if (!view.cone.contains(p_sensor)) return false;
  // A NaN range, not swept, compares false.
  return p_sensor.norm() < view.scan.swept_range(beam_angles(p_sensor));
}

/// Conditions (i) and (ii) for an image.
bool swept(const CameraImages& image, const Eigen::Vector3d& p_camera) {
  return p_camera.z() > 0.0 && p_camera.squaredNorm() <= image.range_max_m * image.range_max_m &&
         p_camera.z() < image.swept_depth_m(p_camera);
}

/// Condition (iii).
bool unobstructed(const OccupancyGrid& grid, const Eigen::Vector3d& p_world_sensor,
                  const Eigen::Vector3d& p_world) {
  return walk_ray(grid.frame, p_world_sensor, p_world,
                  [&](std::size_t cell) { return grid.log_odds[cell] < kOccupiedLogOdds; });
}

template <class Measurement>
void find_free_in_slice(const OccupancyGrid& grid, const Measurement& measurement,
                        const Pose& T_sensor_world, const Window& window, int z, Found& found) {
  for (int y = window.low.y(); y <= window.high.y(); ++y) {
    std::size_t index = grid.frame.index({window.low.x(), y, z});
    for (int x = window.low.x(); x <= window.high.x(); ++x, ++index) {
      if (grid.state(index) != CellState::unobserved) continue;
      const Eigen::Vector3d p_world = grid.frame.centre({x, y, z});
      if (swept(measurement, T_sensor_world * p_world) &&
          unobstructed(grid, window.p_world_sensor, p_world)) {
        found.push_back(index);
      }
    }
  }
}

template <class Measurement>
std::size_t carve(OccupancyGrid& grid, const Measurement& measurement, const Pose& T_world_sensor,
                  const Window& window, const FreeSpaceUpdate& update, int threads) {
  expects(threads >= 1, "carve_free_space needs a thread");
  check_options(update, "free space");
  const Pose T_sensor_world = T_world_sensor.inverse();
  // Every cell is judged against the unchanged grid: which worker does it makes no difference.
  std::vector<std::future<Found>> parts;
  for (int worker = 0; worker < threads; ++worker) {
    const int first = window.low.z() + worker;
    if (first > window.high.z()) break;
    parts.push_back(std::async(std::launch::async, [&, first] {
      Found found;
      for (int z = first; z <= window.high.z(); z += threads) {
        find_free_in_slice(grid, measurement, T_sensor_world, window, z, found);
      }
      return found;
    }));
  }
  std::vector<Found> found;
  for (auto& part : parts) found.push_back(part.get());

  const auto evidence = static_cast<float>(log_odds_of(1.0 - update.p_free_given_pass));
  std::size_t freed = 0;
  for (const Found& cells : found) {
    for (const std::size_t cell : cells) grid.log_odds[cell] += evidence;
    freed += cells.size();
  }
  return freed;
}

}  // namespace

std::size_t carve_free_space(OccupancyGrid& grid, const RangeScan& scan, const Pose& T_world_sensor,
                             const FreeSpaceUpdate& update, int threads) {
  const SweptScan swept{scan, ViewCone(Pose::Identity(), scan.field_of_view)};
  return carve(grid, swept, T_world_sensor, whole(grid.frame, T_world_sensor.translation()), update,
               threads);
}

std::size_t carve_free_space(OccupancyGrid& grid, const CameraImages& image,
                             const Pose& T_world_camera, const FreeSpaceUpdate& update,
                             int threads) {
  return carve(grid, image, T_world_camera, window_of(grid.frame, image, T_world_camera), update,
               threads);
}

}  // namespace vantage
