#include "vantage/planners/navigation/passage_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "vantage/belief/map/floor_detail.hpp"

namespace vantage {
namespace {

constexpr double kStep_m = 0.03;
constexpr double kStep_rad = 0.02;
constexpr double kInPlace_m = 0.05;  ///< a turn may move the robot by so much
constexpr double kArm_m = 0.3;       ///< a heading counts by what it moves at that distance

bool is_inside(std::span<const Eigen::Vector2d> outline, const Eigen::Vector2d& p_m) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d edge = outline[i + 1 == outline.size() ? 0 : i + 1] - outline[i];
    const Eigen::Vector2d to = p_m - outline[i];
    if (edge.x() * to.y() - edge.y() * to.x() < 0.0) return false;
  }
  return true;
}

/// From one waypoint to the next: a turn in place at headings between them, else at the last one.
void add_poses(const Pose2& from, const Pose2& to, std::vector<Pose2>& poses) {
  const Eigen::Vector2d way = position(to) - position(from);
  const double turn_rad = wrap_angle(to.yaw_rad - from.yaw_rad);
  const bool in_place = way.norm() < kInPlace_m;
  const int samples =
      1 + static_cast<int>(in_place ? std::abs(turn_rad) / kStep_rad : way.norm() / kStep_m);
  for (int k = 0; k <= samples; ++k) {
    const double share = static_cast<double>(k) / samples;
    const Eigen::Vector2d p_m = position(from) + share * way;
    const double yaw_rad = in_place ? wrap_angle(from.yaw_rad + share * turn_rad) : to.yaw_rad;
    poses.push_back({p_m.x(), p_m.y(), yaw_rad});
  }
}

/// Way of the robot's corners from one pose to another, about.
double away_m(const Pose2& a, const Pose2& b) {
  return (position(a) - position(b)).norm() + kArm_m * std::abs(wrap_angle(a.yaw_rad - b.yaw_rad));
}

/// Poses of a leg; those from the last one nearest to the robot's on are ahead of it.
struct LegPoses {
  std::vector<Pose2> all;
  std::size_t nearest = 0;
  [[nodiscard]] std::span<const Pose2> ahead() const { return std::span(all).subspan(nearest); }
};

LegPoses poses_of(const PathLeg& leg, const Pose2& T_world_base) {
  LegPoses poses;
  for (std::size_t i = 1; i < leg.waypoints.size(); ++i) {
    add_poses(leg.waypoints[i - 1], leg.waypoints[i], poses.all);
  }
  for (std::size_t i = 1; i < poses.all.size(); ++i) {
    const bool nearer =
        away_m(poses.all[i], T_world_base) <= away_m(poses.all[poses.nearest], T_world_base);
    if (nearer) poses.nearest = i;
  }
  return poses;
}

}  // namespace

bool is_passage_blocked(const FloorMap& detail, const PathLeg& leg, const Pose2& T_world_base,
                        const RobotOutline& robot) {
  constexpr double kSlack_m = 0.01;
  const FloorOutline now = moved(grown(robot.outline, kSlack_m), T_world_base);
  bool blocked = false;
  const LegPoses poses = poses_of(leg, T_world_base);
  for (const Pose2& pose : poses.ahead()) {
    const FloorOutline outline = moved(robot.outline, pose);
    for_each_row_inside(outline, detail.centre({0, 0}), detail.cell_m,
                        [&](int row, int first, int last) {
                          for (int column = first; column <= last && !blocked; ++column) {
                            const Eigen::Array2i cell(column, row);
                            if (!detail.contains(cell) || !is_occupied(detail, detail.index(cell)))
                              continue;
                            blocked = !is_inside(now, detail.centre(cell));
                          }
                        });
    if (blocked) return true;
  }
  return false;
}

std::vector<Eigen::Vector2d> cells_before(const FloorMap& detail, const PathLeg& leg,
                                          const Pose2& T_world_base, const RobotOutline& robot) {
  constexpr double kAhead_m = 0.025;
  const LegPoses poses = poses_of(leg, T_world_base);
  const auto next = std::ranges::find_if(
      poses.ahead(), [&](const Pose2& pose) { return away_m(pose, T_world_base) >= kAhead_m; });
  const Pose2& to = next != poses.ahead().end() ? *next : leg.waypoints.back();
  const double share = kAhead_m / std::max(away_m(to, T_world_base), 1e-6);
  const Eigen::Vector2d p_m =
      position(T_world_base) + share * (position(to) - position(T_world_base));
  const double turn_rad = share * wrap_angle(to.yaw_rad - T_world_base.yaw_rad);
  const FloorOutline now = moved(robot.outline, T_world_base);
  std::vector<Eigen::Vector2d> cells;
  for_each_row_inside(
      moved(robot.outline, Pose2{p_m.x(), p_m.y(), T_world_base.yaw_rad + turn_rad}),
      detail.centre({0, 0}), detail.cell_m, [&](int row, int first, int last) {
        for (int column = first; column <= last; ++column) {
          const Eigen::Vector2d centre_m = detail.centre({column, row});
          if (!is_inside(now, centre_m)) cells.push_back(centre_m);
        }
      });
  return cells;
}

Pose2 pose_behind(const PathLeg& leg, const Pose2& T_world_base) {
  constexpr double kBehind_m = 0.1;
  const LegPoses poses = poses_of(leg, T_world_base);
  std::size_t behind = poses.nearest;
  while (behind > 0 && away_m(poses.all[behind], T_world_base) < kBehind_m) --behind;
  return poses.all[behind];
}

}  // namespace vantage
