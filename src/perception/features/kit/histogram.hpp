/// Histograms as features.
#pragma once

#include <Eigen/Core>

namespace vantage {

/// Shares of the sum, square-rooted (the Hellinger map [ArandjelovicZisserman2012]): unit length,
/// and spread evenly enough for Gaussians. Zero stays zero.
inline Eigen::VectorXf root_of_shares(const Eigen::Ref<const Eigen::VectorXf>& histogram) {
  const float sum = histogram.cwiseAbs().sum();
  if (!(sum > 0.0F)) return Eigen::VectorXf::Zero(histogram.size());
  return (histogram / sum).cwiseMax(0.0F).cwiseSqrt();
}

}  // namespace vantage
