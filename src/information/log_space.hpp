/// The measures of discrete.hpp for callers that hold log-probabilities.
///
/// Arguments are natural logarithms, -inf for probability zero; results are in bits. Every function
/// throws DistributionError if an argument is empty, has a NaN or +inf entry, or (all but
/// log_sum_exp and normalise_log) does not sum to one within kSumTolerance; and, where there are
/// two, if their sizes differ.
#pragma once

#include <Eigen/Core>

#include <span>

#include "vantage/information/distribution_error.hpp"

namespace vantage {

/// ln sum exp(a_i) without overflow or underflow; -inf if every entry is.
double log_sum_exp(std::span<const double> log_weights);

/// Subtracts log_sum_exp in place, so that the probabilities sum to one, and returns it.
/// @throws DistributionError also if every entry is -inf: there is nothing to normalise.
double normalise_log(std::span<double> log_weights);

double entropy_bits_from_log(std::span<const double> log_p);

/// p(x, y) with a row per x, as in discrete.hpp.
double joint_entropy_bits_from_log(const Eigen::Ref<const Eigen::MatrixXd>& log_p_xy);
double conditional_entropy_bits_from_log(const Eigen::Ref<const Eigen::MatrixXd>& log_p_xy);
double mutual_information_bits_from_log(const Eigen::Ref<const Eigen::MatrixXd>& log_p_xy);

/// Infinite where some q = 0 and p > 0.
double kl_divergence_bits_from_log(std::span<const double> log_p, std::span<const double> log_q);
double jeffreys_divergence_bits_from_log(std::span<const double> log_p,
                                         std::span<const double> log_q);

}  // namespace vantage
