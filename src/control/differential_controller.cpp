#include "vantage/control/differential_controller.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage {
namespace {

/// Bearings of the point ahead at which it begins, and ends, to turn in place.
constexpr double kTurnFrom_rad = 0.7;
constexpr double kTurnUntil_rad = 0.05;
/// A goal as near as this is driven to backwards, too.
constexpr double kBackwards_m = 0.15;
/// Time to the point ahead, in time constants of the approach to a heading: higher is smoother and
/// cuts corners wider. And the turn of a corner that it does not look past.
constexpr double kLookaheadConstants = 1.2;
constexpr double kCorner_rad = 0.3;
/// Of arrival_m, before it leaves the goal's heading to come nearer to its place.
constexpr double kLeaveFactor = 1.5;

double ramp(double from, double to, double max_change) {
  return from + std::clamp(to - from, -max_change, max_change);
}

/// The way to the point that is pursued, in the base's frame.
struct Carrot {
  Eigen::Vector2d p_base_m;
  bool at_end;
  double distance_m;
  double bearing_rad;  ///< of the way there, backwards if `reverse`
  bool reverse;
};

/// Farther ahead the faster it goes, or it would weave; but not past a corner.
double carrot_arc_m(const DrivePath& path, const DifferentialFollowing& following,
                    const BaseControllerOptions& options) {
  const double near_m = following.arc_m + options.lookahead_m;
  const double far_m =
      following.arc_m + kLookaheadConstants / options.gain_per_s * std::abs(following.v_m_s);
  return std::max(near_m, std::min(far_m, path.next_corner(following.arc_m, kCorner_rad)));
}

Carrot carrot_of(const DrivePath& path, const Pose2& T_world_base, double carrot_arc_m) {
  const Eigen::Vector2d p_world_m = path.point(carrot_arc_m);
  const Pose2 to = compose(inverse(T_world_base), {p_world_m.x(), p_world_m.y(), 0.0});
  Carrot carrot{.p_base_m = {to.x_m, to.y_m},
                .at_end = carrot_arc_m >= path.length_m(),
                .distance_m = std::hypot(to.x_m, to.y_m),
                .bearing_rad = std::atan2(to.y_m, to.x_m),
                .reverse = false};
  if (carrot.at_end && carrot.distance_m < kBackwards_m &&
      std::abs(carrot.bearing_rad) > std::numbers::pi / 2.0) {
    carrot.reverse = true;
    carrot.bearing_rad = wrap_angle(carrot.bearing_rad + std::numbers::pi);
  }
  return carrot;
}

/// The turning rate that ends an error of heading.
double turn_rate(double error_rad, const BaseControllerOptions& options) {
  const double rate_rad_s =
      approach_speed(std::abs(error_rad), options.turn_acceleration_rad_s2, options.gain_per_s);
  return std::copysign(std::min(options.turn_rate_rad_s, rate_rad_s), error_rad);
}

void update_phase(const DrivePath& path, const Pose2& T_world_base, const Carrot& carrot,
                  DifferentialFollowing& following) {
  const double left_m =
      std::hypot(path.goal().x_m - T_world_base.x_m, path.goal().y_m - T_world_base.y_m);
  const double factor = following.aligning ? kLeaveFactor : 1.0;
  following.aligning = carrot.at_end && left_m < factor * following.arrival_m;
  const double max_rad = following.turning ? kTurnUntil_rad : kTurnFrom_rad;
  following.turning = !following.aligning && std::abs(carrot.bearing_rad) > max_rad;
}

double drive_speed(const DrivePath& path, const Carrot& carrot, double curvature_per_m,
                   const BaseControllerOptions& options, double arc_m) {
  double speed_m_s =
      carrot.at_end
          ? std::min(options.speed_m_s, approach_speed(carrot.distance_m, options.acceleration_m_s2,
                                                       options.gain_per_s))
          : path.speed_limit(arc_m, options);
  if (curvature_per_m != 0.0) {
    speed_m_s = std::min(speed_m_s, options.turn_rate_rad_s / std::abs(curvature_per_m));
  }
  return carrot.reverse ? -speed_m_s : speed_m_s;
}

}  // namespace

double pursuit_curvature(const Eigen::Vector2d& p_base_m) {
  const double squared_m2 = p_base_m.squaredNorm();
  return squared_m2 > 0.0 ? 2.0 * p_base_m.y() / squared_m2 : 0.0;
}

Twist2 follow_path(const DrivePath& path, const Pose2& T_world_base, double period_s,
                   const BaseControllerOptions& options, DifferentialFollowing& following) {
  following.arc_m = path.project({T_world_base.x_m, T_world_base.y_m}, following.arc_m,
                                 following.arc_m + 2.0 * options.lookahead_m);
  const Carrot carrot = carrot_of(path, T_world_base, carrot_arc_m(path, following, options));
  update_phase(path, T_world_base, carrot, following);

  double v_m_s = 0.0;
  double wz_rad_s = 0.0;
  if (following.aligning) {
    wz_rad_s = turn_rate(wrap_angle(path.goal().yaw_rad - T_world_base.yaw_rad), options);
  } else if (following.turning) {
    wz_rad_s = turn_rate(carrot.bearing_rad, options);
  } else {
    const double curvature_per_m = pursuit_curvature(carrot.p_base_m);
    v_m_s = drive_speed(path, carrot, curvature_per_m, options, following.arc_m);
    const double speeding_m_s = ramp(following.v_m_s, v_m_s, options.acceleration_m_s2 * period_s);
    const double max_rad_s = std::abs(turn_rate(carrot.bearing_rad, options));
    wz_rad_s = std::clamp(speeding_m_s * curvature_per_m, -max_rad_s, max_rad_s);
  }
  following.v_m_s = ramp(following.v_m_s, v_m_s, options.acceleration_m_s2 * period_s);
  following.wz_rad_s =
      ramp(following.wz_rad_s, wz_rad_s, options.turn_acceleration_rad_s2 * period_s);
  return {following.v_m_s, 0.0, following.wz_rad_s};
}

}  // namespace vantage
