#include "vantage/control/base_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kSamePoint_m = 1e-6;
/// Parts of the acceleration that braking and corners are planned with; the rest makes up for the
/// lag of the drive.
constexpr double kBrakingShare = 0.7;
constexpr double kCornerShare = 0.4;

/// tan of half the angle turned at `b`; finite for a turn back, too.
double half_corner_tan(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = (b - a).normalized();
  const Eigen::Vector2d v = (c - b).normalized();
  const double angle = std::atan2(std::abs(u.x() * v.y() - u.y() * v.x()), u.dot(v));
  return std::tan(std::min(angle, 2.8) / 2.0);
}

Eigen::Vector2d step_towards(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double most) {
  const Eigen::Vector2d change = to - from;
  const double size = change.norm();
  return size <= most ? to : Eigen::Vector2d(from + change * (most / size));
}

/// Towards the carrot on the path; at the end the carrot is the goal, and its distance, which
/// counts errors across the path as well, is what is left.
Eigen::Vector2d wanted_velocity(const DrivePath& path, const Eigen::Vector2d& p_m, double arc_m,
                                const BaseControllerOptions& options) {
  const Eigen::Vector2d to_carrot = path.point(arc_m + options.lookahead_m) - p_m;
  const double carrot_m = to_carrot.norm();
  if (carrot_m < 1e-9) return Eigen::Vector2d::Zero();
  const bool at_end = arc_m + options.lookahead_m >= path.length_m();
  const double speed_m_s =
      at_end ? std::min(options.speed_m_s,
                        approach_speed(carrot_m, options.acceleration_m_s2, options.gain_per_s))
             : path.speed_limit(arc_m, options);
  return to_carrot * (speed_m_s / carrot_m);
}

Twist2 to_base_frame(const PathFollowing& following, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  const Eigen::Vector2d& v = following.v_world_m_s;
  return {c * v.x() + s * v.y(), -s * v.x() + c * v.y(), following.wz_rad_s};
}

}  // namespace

double approach_speed(double left, double acceleration, double gain_per_s) {
  const double braking = kBrakingShare * acceleration;
  const double proportional = braking / (gain_per_s * gain_per_s);
  return left < proportional ? gain_per_s * left
                             : std::sqrt(2.0 * braking * (left - proportional / 2.0));
}

DrivePath::DrivePath(const Pose2& T_world_base, std::span<const Pose2> waypoints)
    : start_yaw_rad_(T_world_base.yaw_rad),
      goal_(waypoints.empty() ? T_world_base : waypoints.back()) {
  points_m_.push_back(position(T_world_base));
  arc_m_.push_back(0.0);
  for (const Pose2& waypoint : waypoints) {
    expects(std::isfinite(waypoint.x_m) && std::isfinite(waypoint.y_m) &&
                std::isfinite(waypoint.yaw_rad),
            "waypoints are finite");
    const double step_m = (position(waypoint) - points_m_.back()).norm();
    if (step_m < kSamePoint_m) continue;
    points_m_.push_back(position(waypoint));
    arc_m_.push_back(arc_m_.back() + step_m);
  }
  half_corner_tan_.assign(points_m_.size(), 0.0);
  for (std::size_t i = 1; i + 1 < points_m_.size(); ++i) {
    half_corner_tan_[i] = half_corner_tan(points_m_[i - 1], points_m_[i], points_m_[i + 1]);
  }
  turn_rad_ = wrap_angle(goal_.yaw_rad - start_yaw_rad_);
}

Eigen::Vector2d DrivePath::point(double arc_m) const {
  if (arc_m <= 0.0) return points_m_.front();
  if (arc_m >= length_m()) return points_m_.back();
  const auto next = std::upper_bound(arc_m_.begin(), arc_m_.end(), arc_m);
  const auto i = static_cast<std::size_t>(next - arc_m_.begin());
  const double t = (arc_m - arc_m_[i - 1]) / (arc_m_[i] - arc_m_[i - 1]);
  return points_m_[i - 1] + t * (points_m_[i] - points_m_[i - 1]);
}

double DrivePath::yaw(double arc_m) const {
  if (length_m() < kSamePoint_m) return goal_.yaw_rad;
  return start_yaw_rad_ + turn_rad_ * std::clamp(arc_m / length_m(), 0.0, 1.0);
}

double DrivePath::project(const Eigen::Vector2d& p_m, double from_m, double to_m) const {
  double best_arc_m = from_m;
  double best_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points_m_.size(); ++i) {
    const double low_m = std::max(from_m, arc_m_[i - 1]);
    const double high_m = std::min(to_m, arc_m_[i]);
    if (low_m > high_m) continue;
    const Eigen::Vector2d along = (points_m_[i] - points_m_[i - 1]).normalized();
    const double arc_m =
        std::clamp(arc_m_[i - 1] + along.dot(p_m - points_m_[i - 1]), low_m, high_m);
    const double distance_m = (p_m - point(arc_m)).norm();
    if (distance_m < best_m) {
      best_m = distance_m;
      best_arc_m = arc_m;
    }
  }
  return best_arc_m;
}

double DrivePath::next_corner(double arc_m, double turn_rad) const {
  const double half_tan = std::tan(turn_rad / 2.0);
  for (std::size_t i = 1; i + 1 < points_m_.size(); ++i) {
    if (arc_m_[i] >= arc_m && half_corner_tan_[i] > half_tan) return arc_m_[i];
  }
  return length_m();
}

double DrivePath::speed_limit(double arc_m, const BaseControllerOptions& options) const {
  double limit_m_s =
      std::min(options.speed_m_s,
               approach_speed(length_m() - arc_m, options.acceleration_m_s2, options.gain_per_s));
  for (std::size_t i = 1; i + 1 < points_m_.size(); ++i) {
    if (arc_m_[i] < arc_m || half_corner_tan_[i] < 1e-3) continue;
    // A curve that cuts the corner `lookahead` before it has the radius lookahead / tan(angle / 2).
    const double radius_m = options.lookahead_m / half_corner_tan_[i];
    const double corner_squared = kCornerShare * options.acceleration_m_s2 * radius_m;
    const double ahead_m = std::max(0.0, arc_m_[i] - options.lookahead_m - arc_m);
    limit_m_s = std::min(
        limit_m_s,
        std::sqrt(corner_squared + 2.0 * kBrakingShare * options.acceleration_m_s2 * ahead_m));
  }
  return limit_m_s;
}

Twist2 follow_path(const DrivePath& path, const Pose2& T_world_base, double period_s,
                   const BaseControllerOptions& options, PathFollowing& following) {
  const Eigen::Vector2d p_m = position(T_world_base);
  following.arc_m = path.project(p_m, following.arc_m, following.arc_m + 2.0 * options.lookahead_m);
  const double carrot_arc_m = following.arc_m + options.lookahead_m;

  const Eigen::Vector2d v = wanted_velocity(path, p_m, following.arc_m, options);
  following.v_world_m_s =
      step_towards(following.v_world_m_s, v, options.acceleration_m_s2 * period_s);

  const double yaw_error_rad = wrap_angle(path.yaw(carrot_arc_m) - T_world_base.yaw_rad);
  const double wz_rad_s =
      std::copysign(std::min(options.turn_rate_rad_s,
                             approach_speed(std::abs(yaw_error_rad),
                                            options.turn_acceleration_rad_s2, options.gain_per_s)),
                    yaw_error_rad);
  const double max_rad_s = options.turn_acceleration_rad_s2 * period_s;
  following.wz_rad_s += std::clamp(wz_rad_s - following.wz_rad_s, -max_rad_s, max_rad_s);
  return to_base_frame(following, T_world_base.yaw_rad);
}

}  // namespace vantage
