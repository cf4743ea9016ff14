#include "vantage/planners/trajectory/search_heading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {
namespace {

constexpr double kBetweenRays_rad = std::numbers::pi / 36.0;
constexpr double kNearest_m = 0.5;  // nearer is below the frame

/// Area that a ray stands for, between its neighbours.
double unseen_along_m2(const SearchOptions& options, const OccupancyGrid& grid,
                       const Eigen::Vector3d& from_m, double bearing_rad) {
  const Eigen::Vector3d direction(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
  const double step_m = grid.frame.cell_size_m.head<2>().minCoeff();
  double area_m2 = 0.0;
  for (double away_m = kNearest_m; away_m < options.range_m; away_m += step_m) {
    const Eigen::Array3i cell = grid.frame.cell_at(from_m + away_m * direction);
    if (!grid.frame.contains(cell)) break;
    const CellState state = grid.state(grid.frame.index(cell));
    if (state == CellState::occupied) break;
    if (state == CellState::unobserved) area_m2 += away_m * kBetweenRays_rad * step_m;
  }
  return area_m2;
}

}  // namespace

std::optional<double> search_heading(const SearchOptions& options, const OccupancyGrid& grid,
                                     const Eigen::Vector3d& p_world_vehicle_m, double ahead_rad,
                                     double fov_rad) {
  const Eigen::Vector3d from_m = p_world_vehicle_m - Eigen::Vector3d(0.0, 0.0, options.below_m);
  const auto turns = static_cast<int>(options.turn_rad / kBetweenRays_rad);  // to either side
  const auto beside = static_cast<int>(0.5 * fov_rad / kBetweenRays_rad);
  std::vector<double> unseen_m2;
  for (int ray = -turns - beside; ray <= turns + beside; ++ray) {
    unseen_m2.push_back(unseen_along_m2(options, grid, from_m, ahead_rad + ray * kBetweenRays_rad));
  }
  int best = 0;
  double best_utility = options.min_area_m2;
  for (int turn = -turns; turn <= turns; ++turn) {
    const auto first_ray = unseen_m2.begin() + turns + turn;
    const double seen_m2 = std::accumulate(first_ray, first_ray + 2 * beside + 1, 0.0);
    const double utility = seen_m2 * std::cos(0.5 * turn * kBetweenRays_rad);
    if (utility > best_utility) {
      best = turn;
      best_utility = utility;
    }
  }
  if (best == 0) return std::nullopt;
  return wrap_angle(ahead_rad + best * kBetweenRays_rad);
}

std::optional<ObservationTarget> search_target(const SearchOptions& options,
                                               const OccupancyGrid& grid,
                                               const FlightCamera& camera,
                                               const Eigen::Matrix4Xd& path, Eigen::Index waypoint,
                                               double away_m) {
  const Eigen::Vector3d at_m = path.col(waypoint).head<3>();
  const Eigen::Index from = std::min(waypoint, path.cols() - 2);
  const Eigen::Vector2d ahead = (path.col(from + 1) - path.col(from)).head<2>();
  const auto yaw_rad = search_heading(options, grid, at_m, std::atan2(ahead.y(), ahead.x()),
                                      camera.horizontal_fov_rad);
  if (!yaw_rad) return std::nullopt;
  const Pose T_world_body = make_pose(at_m, *yaw_rad);
  const Eigen::Vector3d p_body_m = camera.T_body_camera * Eigen::Vector3d(0.0, 0.0, away_m);
  return ObservationTarget{
      .p_world_object_m = T_world_body * p_body_m, .p_world_view_m = at_m, .flown_to = false};
}

}  // namespace vantage
