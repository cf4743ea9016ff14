/// Principal components.
#pragma once

#include <Eigen/Core>

namespace vantage {

/// x is mapped to axes' (x - mean).
struct Pca {
  Eigen::VectorXf mean;      ///< of the samples
  Eigen::MatrixXf axes;      ///< dimensions x components, orthonormal, greatest variance first
  Eigen::VectorXf variance;  ///< of the samples along each axis, / (n - 1)

  [[nodiscard]] Eigen::VectorXf project(const Eigen::Ref<const Eigen::VectorXf>& x) const {
    return axes.transpose() * (x - mean);
  }
};

/// Up to `components` of them: n samples have n - 1 at most, and variances below 1e-6 of the
/// greatest are rounding. Solves whichever is smaller, the covariance or the Gram matrix.
/// @param samples dimensions x n, n >= 2; an InputError says so if they are all alike
Pca learn_pca(const Eigen::MatrixXf& samples, int components);

/// The largest entry of each column becomes positive, so that solvers do not choose signs.
template <class Matrix>
void fix_signs(Matrix& columns) {
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    Eigen::Index largest = 0;
    columns.col(c).cwiseAbs().maxCoeff(&largest);
    if (columns(largest, c) < 0) columns.col(c) *= -1;
  }
}

}  // namespace vantage
