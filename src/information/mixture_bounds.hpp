/// Bounds on what an observation tells of the component it comes from, from how far the components
/// are apart pair by pair.  [KolchinskyTracey2017]
///
/// b holds the probability of each component, D(i, j) >= 0 how far component j is from i, in nats,
/// 0 on the diagonal and infinite where they cannot be confused. Every function throws
/// DistributionError if b is no distribution, D is not as large as b on either side, or an entry
/// that counts is negative or NaN.
#pragma once

#include <Eigen/Core>

#include <span>

#include "vantage/information/distribution_error.hpp"

namespace vantage {

/// -sum_i b_i log2 sum_j b_j exp(-D_ij), in [0, H(b)]. Of Bhattacharyya distances a lower bound of
/// the mutual information of component and observation, of KL divergences an upper bound.
double pairwise_information_bits(std::span<const double> b,
                                 const Eigen::Ref<const Eigen::MatrixXf>& D);

/// What the observation tells of the group (an object) that its component (a pose of it) is in:
/// I(group; f) = I(component; f) - I(component; f | group), both terms as above, at least 0.
///
///   -sum_i b_i log2 [ sum_j b_j exp(-D_ij) / sum_{j in group of i} b_j/b_group exp(-D_ij) ]
///
/// A difference of two bounds is none; over views of families of near-duplicates it ranks as Monte
/// Carlo does with 0.97, where the lower bound that sums the overlaps of all pairs of components
/// has 0.76.
/// @param group of each component, >= 0
double pairwise_group_information_bits(std::span<const double> b, std::span<const int> group,
                                       const Eigen::Ref<const Eigen::MatrixXf>& D);

/// An upper bound of I(group; f) if D are KL divergences: that of two groups is at most
/// sum_q w_q [ -ln sum_r w_r exp(-D_qr) ], q in the one, r in the other, by convexity.
double group_information_upper_bound_bits(std::span<const double> b, std::span<const int> group,
                                          const Eigen::Ref<const Eigen::MatrixXf>& D);

}  // namespace vantage
