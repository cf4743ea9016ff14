#include "vantage/perception/features/kit/pca.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kRounding = 1e-6;

}  // namespace

Pca learn_pca(const Eigen::MatrixXf& samples, int components) {
  const Eigen::Index n = samples.cols();
  if (n < 2) throw InputError("principal components need at least 2 samples");
  Pca pca;
  pca.mean = samples.rowwise().mean();
  const Eigen::MatrixXf centred = samples.colwise() - pca.mean;
  const bool dual = n < samples.rows();
  const Eigen::MatrixXf products = dual ? Eigen::MatrixXf(centred.transpose() * centred)
                                        : Eigen::MatrixXf(centred * centred.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(products.cast<double>());
  const Eigen::VectorXd values = solver.eigenvalues().reverse();
  if (!(values[0] > 0.0)) throw InputError("principal components of samples that are all alike");
  const Eigen::Index limit = std::min({Eigen::Index{components}, n - 1, values.size()});
  Eigen::Index kept = 0;
  while (kept < limit && values[kept] > kRounding * values[0]) ++kept;
  const Eigen::MatrixXf vectors =
      solver.eigenvectors().rightCols(kept).rowwise().reverse().cast<float>();
  pca.axes = dual ? Eigen::MatrixXf(centred * vectors) : vectors;
  pca.axes.colwise().normalize();
  fix_signs(pca.axes);
  pca.variance = (values.head(kept) / static_cast<double>(n - 1)).cast<float>();
  return pca;
}

}  // namespace vantage
