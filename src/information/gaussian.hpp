/// Divergences of two Gaussians with diagonal covariance, in closed form.
#pragma once

#include <Eigen/Core>

#include <numbers>

#include "vantage/information/distribution_error.hpp"

namespace vantage {

struct DiagonalGaussian {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;  ///< of each dimension, > 0
};

constexpr double bits_from_nats(double nats) { return nats * std::numbers::log2e; }

/// KL(p || q) = 1/2 sum_i [ vp/vq + (mp - mq)^2 / vq - 1 - ln(vp/vq) ].  [CoverThomas2006, 8.4]
/// @throws DistributionError if sizes differ, a dimension is missing, or a variance is not > 0.
double gaussian_kl_divergence_nats(const DiagonalGaussian& p, const DiagonalGaussian& q);
double gaussian_kl_divergence_bits(const DiagonalGaussian& p, const DiagonalGaussian& q);

/// J(p, q) = KL(p || q) + KL(q || p); the logarithms cancel.
/// @throws DistributionError as above.
double gaussian_jeffreys_divergence_nats(const DiagonalGaussian& p, const DiagonalGaussian& q);
double gaussian_jeffreys_divergence_bits(const DiagonalGaussian& p, const DiagonalGaussian& q);

/// D(p, q) = -ln integral sqrt(p q)
///         = sum_i [ (mp - mq)^2 / (4 (vp + vq)) + 1/2 ln((vp + vq) / (2 sqrt(vp vq))) ] >= 0.
/// [Kailath1967]
/// @throws DistributionError as above.
double gaussian_bhattacharyya_distance_nats(const DiagonalGaussian& p, const DiagonalGaussian& q);
double gaussian_bhattacharyya_distance_bits(const DiagonalGaussian& p, const DiagonalGaussian& q);

}  // namespace vantage
