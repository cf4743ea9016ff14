#include "src/belief/free_space.hpp"

#include <algorithm>
#include <future>
#include <vector>

#include "src/geometry/view_cone.hpp"

namespace vantage {
namespace {

/// A scan together with the grid and the pose it is judged from.
struct SweptView {
  const OccupancyGrid& grid;
  const RangeScan& scan;
  ViewCone cone;  ///< condition (i)
  Pose T_sensor_world;

  /// Condition (ii).
  [[nodiscard]] bool swept(const Eigen::Vector3d& p_world) const {
    const Eigen::Vector3d p_sensor = T_sensor_world * p_world;
    // A NaN range, not swept, compares false.
    return p_sensor.norm() < scan.swept_range(beam_angles(p_sensor));
  }
  /// Condition (iii).
  [[nodiscard]] bool unobstructed(const Eigen::Vector3d& p_world) const {
    return walk_ray(grid.frame, cone.apex_m(), p_world,
                    [&](std::size_t cell) { return grid.log_odds[cell] < kOccupiedLogOdds; });
  }
};

void find_free_in_slice(const SweptView& view, int z, std::vector<std::size_t>& found) {
  const GridFrame& frame = view.grid.frame;
  const auto unobserved = [&](std::size_t cell) {
    return view.grid.state(cell) == CellState::unobserved;
  };
  for_each_cell_in_view(frame, view.cone, z, z + 1, unobserved,
                        [&](const Eigen::Array3i& cell, std::size_t index) {
                          const Eigen::Vector3d p_world = frame.centre(cell);
                          if (view.swept(p_world) && view.unobstructed(p_world))
                            found.push_back(index);
                        });
}

}  // namespace

std::size_t carve_free_space(OccupancyGrid& grid, const RangeScan& scan, const Pose& T_world_sensor,
                             const FreeSpaceUpdate& update, int threads) {
  expects(threads >= 1, "carve_free_space needs a thread");
  check_options(update, "free space");
  const SweptView view{grid, scan, ViewCone(T_world_sensor, scan.field_of_view),
                       T_world_sensor.inverse()};
  // Every cell is judged against the unchanged grid: which worker does it makes no difference.
  const int slices = grid.frame.cells.z();
  const int workers = std::min(threads, slices);
  std::vector<std::future<std::vector<std::size_t>>> parts;
  for (int worker = 0; worker < workers; ++worker) {
    parts.push_back(std::async(std::launch::async, [&view, worker, workers, slices] {
      std::vector<std::size_t> found;
      for (int z = worker; z < slices; z += workers) find_free_in_slice(view, z, found);
      return found;
    }));
  }
  std::vector<std::vector<std::size_t>> found;
  for (auto& part : parts) found.push_back(part.get());

  const auto evidence = static_cast<float>(log_odds_of(1.0 - update.p_free_given_pass));
  std::size_t freed = 0;
  for (const auto& cells : found) {
    for (const std::size_t cell : cells) grid.log_odds[cell] += evidence;
    freed += cells.size();
  }
  return freed;
}

}  // namespace vantage
