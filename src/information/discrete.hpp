/// Information measures of discrete distributions, in bits (base-2 logarithms).
/// [Potthast2016, chapter 2]; [CoverThomas2006, chapter 2]
///
/// Vectors hold one probability per outcome. A joint distribution p(x, y) is a matrix with a row
/// per x and a column per y. 0 log 0 = 0. Every function throws DistributionError if an argument is
/// empty, has a negative, NaN or infinite entry, or does not sum to one within kSumTolerance; and,
/// where there are two, if their sizes differ.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <span>

#include "vantage/information/distribution_error.hpp"

namespace vantage {

inline constexpr double kSumTolerance = 1e-6;

/// H(X) = -sum p log2 p, in [0, log2 n].
double entropy_bits(std::span<const double> p);

/// H(X, Y).
double joint_entropy_bits(const Eigen::Ref<const Eigen::MatrixXd>& p_xy);

/// H(Y | X) = H(X, Y) - H(X): what y still tells once the row x is known.
double conditional_entropy_bits(const Eigen::Ref<const Eigen::MatrixXd>& p_xy);

/// I(X; Y) = KL(p(x, y) || p(x) p(y)) >= 0.
double mutual_information_bits(const Eigen::Ref<const Eigen::MatrixXd>& p_xy);

/// KL(p || q) >= 0; infinite where some q = 0 and p > 0.
double kl_divergence_bits(std::span<const double> p, std::span<const double> q);

/// J(p, q) = KL(p || q) + KL(q || p).  [Jeffreys1946]
double jeffreys_divergence_bits(std::span<const double> p, std::span<const double> q);

/// H(p) = -p log2 p - (1 - p) log2 (1 - p) of one cell's occupancy.
/// @throws DistributionError unless 0 <= p <= 1.
double binary_entropy_bits(double p);

/// The same without the check, for loops over cells whose probabilities are known to be valid.
inline double binary_entropy_bits_unchecked(double p) {
  const double q = 1.0 - p;
  return (p > 0.0 ? -p * std::log2(p) : 0.0) + (q > 0.0 ? -q * std::log2(q) : 0.0);
}

}  // namespace vantage
