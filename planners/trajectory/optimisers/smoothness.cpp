#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

#include <Eigen/Cholesky>

#include "vantage/core/error.hpp"

namespace vantage {

Eigen::MatrixXd second_differences(Eigen::Index free_points) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(free_points + 2, free_points);
  for (Eigen::Index i = 0; i < free_points; ++i) A.col(i).segment<3>(i) << 1.0, -2.0, 1.0;
  return A;
}

void add_control_cost(const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) {
  const Eigen::Index count = horizon.count();
  Eigen::Vector4d previous = horizon.before;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector4d here = horizon.points.col(i);
    const Eigen::Vector4d a = previous - 2.0 * here + horizon.point(i + 1);
    cost_of_point[i] += 0.5 * a.squaredNorm();
    previous = here;
  }
}

Horizon smoothest(const Horizon& horizon) {
  Horizon smooth = unwrapped(horizon);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return smooth;
  smooth.points.middleCols(1, n).setZero();
  Eigen::MatrixXd b(4, n + 2);
  for (Eigen::Index i = 0; i < n + 2; ++i) {
    b.col(i) = smooth.point(i - 1) - 2.0 * smooth.point(i) + smooth.point(i + 1);
  }
  const Eigen::MatrixXd A = second_differences(n);
  smooth.points.middleCols(1, n) = -b * A * Smoothness(n).R_inverse();
  return smooth;
}

Smoothness::Smoothness(Eigen::Index free_points) {
  expects(free_points > 0, "a path has free points");
  const Eigen::MatrixXd A = second_differences(free_points);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(free_points, free_points);
  R_inverse_ = (A.transpose() * A).llt().solve(identity);
  M_ = R_inverse_;
  for (auto column : M_.colwise()) {
    column /= column.maxCoeff() * static_cast<double>(free_points);
  }
  covariance_ = R_inverse_ / R_inverse_.maxCoeff();
  factor_ = covariance_.llt().matrixL();
}

void Smoothness::draw(const Eigen::Vector4d& sigma, Rng& rng,
                      Eigen::Ref<Eigen::Matrix4Xd> noise) const {
  for (Eigen::Index t = 0; t < noise.cols(); ++t) {
    for (Eigen::Index d = 0; d < 4; ++d) noise(d, t) = sigma[d] * rng.normal();
  }
  // noise L', in place: a column needs itself and those before it.
  for (Eigen::Index t = noise.cols(); t-- > 0;) {
    Eigen::Vector4d sum = factor_(t, t) * noise.col(t);
    for (Eigen::Index s = 0; s < t; ++s) sum += factor_(t, s) * noise.col(s);
    noise.col(t) = sum;
  }
}

}  // namespace vantage
