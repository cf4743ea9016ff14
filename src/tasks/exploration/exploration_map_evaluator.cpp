#include "vantage/tasks/exploration/exploration_map_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "vantage/belief/map/headroom.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"
#include "vantage/tasks/mapping/mobile_ground_truth.hpp"

namespace vantage {
namespace {

/// All floor is free but where something stands or hangs at the robot's height.
FloorMap true_floor(const Exploration& task, const GridFrame& frame,
                    const std::vector<std::uint8_t>& surface) {
  OccupancyGrid solid(frame);
  for (std::size_t cell = 0; cell < solid.size(); ++cell) {
    solid.log_odds[cell] = surface[cell] != 0 ? 1.0F : -1.0F;
  }
  FloorMap floor = free_floor(task.floor_map);
  const std::vector<std::uint8_t> nowhere(floor.size(), 0);
  block_columns(floor, solid, nowhere, task.headroom);
  return floor;
}

/// In every square of a lattice, the reachable place nearest to its middle.
std::vector<Eigen::Vector2d> reachable_places(const PathField& field, const GridFrame& frame,
                                              double spacing_m) {
  std::map<std::pair<int, int>, std::pair<double, std::size_t>> nearest;
  const Eigen::AlignedBox3d box = frame.box();
  for (std::size_t cell = 0; cell < field.map.size(); ++cell) {
    if (!field.reachable(cell)) continue;
    const Eigen::Vector2d p = field.map.centre(field.map.cell(cell));
    const Eigen::Vector2d square = (p - box.min().head<2>()) / spacing_m;
    const Eigen::Vector2d corner = square.array().floor();
    const std::pair rank((square - corner - Eigen::Vector2d(0.5, 0.5)).norm(), cell);
    const std::pair key(static_cast<int>(corner.y()), static_cast<int>(corner.x()));
    const auto [entry, is_new] = nearest.try_emplace(key, rank);
    if (!is_new) entry->second = std::min(entry->second, rank);
  }
  std::vector<Eigen::Vector2d> places;
  for (const auto& [key, rank] : nearest) {
    places.push_back(field.map.centre(field.map.cell(rank.second)));
  }
  return places;
}

}  // namespace

ExplorationMapEvaluator::ExplorationMapEvaluator(const Exploration& task, int threads,
                                                 const MobileGroundTruth& truth,
                                                 const FieldOfView& view_field,
                                                 const Pose& T_base_sweep)
    : GroundTruthMapEvaluator(truth, task.map.frame(), view_field, threads) {
  const GridFrame frame = task.map.frame();
  const Pose2 start = truth.T_world_base();
  floor_ = true_floor(task, frame, surface());
  const PathField field = make_path_field(floor_, start, task.navigation);
  poses_.push_back(to_se3(start) * T_base_sweep);
  for (const auto& p : reachable_places(field, frame, task.metrics.pose_spacing_m)) {
    poses_.push_back(to_se3({p.x(), p.y(), 0.0}) * T_base_sweep);
  }
  add_observable(poses_);
}

}  // namespace vantage
