/// How far off the robot may believe itself to be: what its odometry adds and registration takes
/// away. By what it knows itself, never by the truth.
#pragma once

#include <Eigen/Core>

#include "vantage/sim/robots/odometry.hpp"

namespace vantage {

/// RMS distance between where a point of the world lies and where a robot maps it whose pose has
/// this covariance of (x, y, yaw).
double mapped_sigma_m(const Pose2& T_world_base, const Eigen::Matrix3d& covariance,
                      const Eigen::Vector2d& p_world_m);

/// Covariance of (x, y, yaw) in the world, with the model of the odometry. The first pose is known:
/// it says where the world is.
class PoseUncertainty {
 public:
  PoseUncertainty(const OdometryOptions& odometry, const Pose2& T_world_base)
      : odometry_(odometry), T_world_base_(T_world_base) {}

  /// Dead reckoning says that the base is there now.
  void move_to(const Pose2& T_world_base);
  /// Registration says that it is there. Repeating it makes no surer: its errors are those of what
  /// is remembered, over and over. @param information of (x, y, yaw); zero where it says nothing
  void correct(const Pose2& T_world_base, const Eigen::Matrix3d& information);
  /// All that is remembered was put where it belongs, which left the base there, as sure as that.
  void assume(const Pose2& T_world_base, const Eigen::Matrix3d& covariance);
  /// What was seen from here is what later registrations go by.
  void remember();

  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Beyond these a correction is no drift of odometry: five standard deviations and what
  /// registration itself may be off.
  [[nodiscard]] double plausible_shift_m() const;
  [[nodiscard]] double plausible_turn_rad() const;

 private:
  OdometryOptions odometry_;
  Pose2 T_world_base_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d reference_ = Eigen::Matrix3d::Zero();  ///< of what is remembered, the mean
  int remembered_ = 0;
  double since_correction_m_ = 0.0;  ///< driven
};

}  // namespace vantage
