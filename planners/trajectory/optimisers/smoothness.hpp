/// What control costs, and noise that costs little of it: the matrices A and R of STOMP.
#pragma once

#include <Eigen/Core>

#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/horizon.hpp"

namespace vantage {

/// Second differences of n free points between two fixed ones on either side: (n + 2) x n, a row
/// for each point from the fixed one before to the fixed one after.  [Potthast2016, 5.1]
Eigen::MatrixXd second_differences(Eigen::Index free_points);

/// Adds 1/2 |a|^2 of each point to `cost_of_point`, a being the second differences of the path in
/// x, y, z and yaw. Their sum is 1/2 |A Q + b|^2 over all dimensions: a straight path of constant
/// speed costs nothing, whatever Q is. Yaw must be unwrapped.
void add_control_cost(const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point);

/// The free points that cost least control, Q = -R^-1 A' b: the clamped spline between the fixed
/// ones. A start that is smooth, where the points that are at hand are not.
Horizon smoothest(const Horizon& horizon);

class Smoothness {
 public:
  /// @param free_points > 0
  explicit Smoothness(Eigen::Index free_points);

  /// (A' A)^-1
  [[nodiscard]] const Eigen::MatrixXd& R_inverse() const { return R_inverse_; }
  /// R^-1 with each column scaled so that its greatest element is 1/n.
  [[nodiscard]] const Eigen::MatrixXd& M() const { return M_; }
  /// R^-1 / max(R^-1), the covariance of noise whose largest variance is 1.
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }

  /// Draws 4 x n noise, N(0, sigma_d^2 covariance()) a row.
  void draw(const Eigen::Vector4d& sigma, Rng& rng, Eigen::Ref<Eigen::Matrix4Xd> noise) const;

 private:
  Eigen::MatrixXd R_inverse_;
  Eigen::MatrixXd M_;
  Eigen::MatrixXd covariance_;
  Eigen::MatrixXd factor_;  // lower triangular, L L' = covariance
};

}  // namespace vantage
