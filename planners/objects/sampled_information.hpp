/// Information by sampling what would be measured.
#pragma once

#include "vantage/core/rng.hpp"
#include "vantage/planners/objects/information_query.hpp"

namespace vantage {

/// I = H(b) - mean H(b | f_s), f_s ~ p(f | i), i ~ b, of the state or of its object.
/// [Potthast2016, (4.13)-(4.15)], without the weight of (4.16).
///
/// A feature with psi != 1 is sampled as psi d independent dimensions (see state_divergences): its
/// log likelihoods have psi times the mean and psi times the covariance of an untempered one's,
///
///   l_j(f) = psi E_i[ln p_j] + sqrt(psi) (ln p_j(f) - E_i[ln p_j]),   f ~ N(mean_i, variance_i),
///
/// which is what a filter with the exponent psi sees of data that repeat themselves. Where
/// variances are equal it is Bayes' rule for N(mean, variance / psi).
///
/// States are drawn evenly spread over b; the standard error takes them for independent draws, so
/// it is rather too large. Effort is O(samples |states| d).
/// @param samples at least 2
InformationEstimate sampled_information(const InformationQuery& query, int samples, Rng& rng);

/// H(b) - sum_i b_i H(b | f = mean_i): the features as if they came without noise, each with weight
/// 1.  [Potthast2016, (4.16)]. Can be negative.
double information_at_means_bits(const InformationQuery& query);

/// H of what is asked for (the state, or its object) in a belief over the likely states, bits.
double entropy_of_target_bits(const InformationQuery& query, std::span<const double> belief);

}  // namespace vantage
