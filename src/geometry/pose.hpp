/// Rigid transforms. `T_a_b` maps coordinates in frame b to frame a: p_a = T_a_b * p_b.
/// World: z up, metres. Base: x forward, y left, z up. Camera (OpenCV): z forward, x right, y down.
#pragma once

#include <Eigen/Geometry>

namespace vantage {

using Pose = Eigen::Isometry3d;

/// A pose of the base on the floor.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// Metres.
inline Eigen::Vector2d position(const Pose2& pose) { return {pose.x_m, pose.y_m}; }

double wrap_angle(double angle_rad);  ///< to (-pi, pi]

Pose make_pose(const Eigen::Vector3d& p_m, double yaw_rad, double pitch_rad = 0.0);
Pose to_se3(const Pose2& planar, double z_m = 0.0);
Pose2 project_to_se2(const Pose& T_world_body);  ///< x, y and the heading of the body's x axis

Pose2 compose(const Pose2& T_a_b, const Pose2& T_b_c);
Pose2 inverse(const Pose2& T_a_b);

}  // namespace vantage
