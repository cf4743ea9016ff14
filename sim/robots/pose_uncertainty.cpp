#include "vantage/sim/robots/pose_uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// Keeps a pose that is known exactly invertible.
constexpr double kTiny_m2 = 1e-12;
/// Below it, 1 / (10 m)^2, a registration says nothing in that direction.
constexpr double kLeastInformation = 1e-2;

/// What a good registration may be off, m and rad.
constexpr double kRegistered = 0.03;

/// What a registration measures: its directions, and its variance along them.
struct Measured {
  Eigen::MatrixXd directions;  ///< (x, y, yaw), a column each
  Eigen::MatrixXd variance;
};

/// A registration against something that itself is off by `reference`.
Measured measured_by(const Eigen::Matrix3d& information, const Eigen::Matrix3d& reference) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(information);
  const Eigen::Vector3d& strength = solver.eigenvalues();  // ascending
  const auto said = static_cast<int>((strength.array() > kLeastInformation).count());
  Measured measured;
  measured.directions = solver.eigenvectors().rightCols(said);
  measured.variance = measured.directions.transpose() * reference * measured.directions;
  measured.variance.diagonal() += strength.tail(said).cwiseInverse();
  return measured;
}

Eigen::Vector3d difference(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.yaw_rad - from.yaw_rad)};
}

}  // namespace

double mapped_sigma_m(const Pose2& T_world_base, const Eigen::Matrix3d& covariance,
                      const Eigen::Vector2d& p_world_m) {
  Eigen::Matrix<double, 2, 3> lever;
  lever << 1.0, 0.0, T_world_base.y_m - p_world_m.y(),  //
      0.0, 1.0, p_world_m.x() - T_world_base.x_m;
  return std::sqrt((lever * covariance * lever.transpose()).trace());
}

void PoseUncertainty::move_to(const Pose2& T_world_base) {
  const Eigen::Vector3d moved = difference(T_world_base_, T_world_base);
  const double distance_m = moved.head<2>().norm();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned(0, 2) = -moved.y();
  turned(1, 2) = moved.x();
  covariance_ = turned * covariance_ * turned.transpose();
  // A bias adds up like the distance itself until it forgets, then like a random walk.
  const double remembered_m =
      std::min(2.0 * since_correction_m_ + distance_m, 2.0 * odometry_.bias_length_m);
  const auto grown = [&](double sigma, double bias) {
    return (sigma * sigma + bias * bias * remembered_m) * distance_m;
  };
  const double place_m2 = grown(odometry_.sigma_translation_m, odometry_.bias_translation_m_per_m);
  const double turn_rad2 =
      odometry_.sigma_turn_rad * odometry_.sigma_turn_rad * std::abs(moved.z());
  covariance_.diagonal() += Eigen::Vector3d(
      place_m2, place_m2, grown(odometry_.sigma_yaw_rad, odometry_.bias_yaw_rad_per_m) + turn_rad2);
  since_correction_m_ += distance_m;
  T_world_base_ = T_world_base;
}

void PoseUncertainty::correct(const Pose2& T_world_base, const Eigen::Matrix3d& information) {
  T_world_base_ = T_world_base;
  const Measured measured = measured_by(information, reference_);
  if (measured.directions.cols() == 0) return;
  if (measured.directions.cols() == 3) since_correction_m_ = 0.0;
  const Eigen::Matrix3d sure =
      measured.directions * measured.variance.inverse() * measured.directions.transpose();
  const Eigen::Matrix3d root =
      (covariance_ + kTiny_m2 * Eigen::Matrix3d::Identity()).llt().matrixL();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(root.transpose() * sure * root);
  const Eigen::Vector3d left = solver.eigenvalues().cwiseMax(1.0).cwiseInverse();
  const Eigen::Matrix3d axes = root * solver.eigenvectors();
  covariance_ = axes * left.asDiagonal() * axes.transpose();
}

void PoseUncertainty::assume(const Pose2& T_world_base, const Eigen::Matrix3d& covariance) {
  T_world_base_ = T_world_base;
  covariance_ = reference_ = covariance;
  since_correction_m_ = 0.0;
}

void PoseUncertainty::remember() {
  ++remembered_;
  reference_ += (covariance_ - reference_) / remembered_;
}

double PoseUncertainty::plausible_shift_m() const {
  return kRegistered + 5.0 * std::sqrt(covariance_.topLeftCorner<2, 2>().trace());
}

double PoseUncertainty::plausible_turn_rad() const {
  return kRegistered + 5.0 * std::sqrt(covariance_(2, 2));
}

}  // namespace vantage
