#include "vantage/geometry/pose.hpp"

#include <cmath>
#include <numbers>

namespace vantage {

double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2.0 * std::numbers::pi : wrapped;
}

Pose make_pose(const Eigen::Vector3d& p_m, double yaw_rad, double pitch_rad) {
  return Eigen::Translation3d(p_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY());
}

Pose to_se3(const Pose2& planar, double z_m) {
  return make_pose({planar.x_m, planar.y_m, z_m}, planar.yaw_rad);
}

Pose2 project_to_se2(const Pose& T_world_body) {
  const Eigen::Vector3d forward = T_world_body.linear().col(0);
  return {T_world_body.translation().x(), T_world_body.translation().y(),
          std::atan2(forward.y(), forward.x())};
}

Pose2 compose(const Pose2& T_a_b, const Pose2& T_b_c) {
  const double c = std::cos(T_a_b.yaw_rad);
  const double s = std::sin(T_a_b.yaw_rad);
  return {T_a_b.x_m + c * T_b_c.x_m - s * T_b_c.y_m, T_a_b.y_m + s * T_b_c.x_m + c * T_b_c.y_m,
          wrap_angle(T_a_b.yaw_rad + T_b_c.yaw_rad)};
}

Pose2 inverse(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.yaw_rad);
  const double s = std::sin(T_a_b.yaw_rad);
  return {-c * T_a_b.x_m - s * T_a_b.y_m, s * T_a_b.x_m - c * T_a_b.y_m,
          wrap_angle(-T_a_b.yaw_rad)};
}

}  // namespace vantage
