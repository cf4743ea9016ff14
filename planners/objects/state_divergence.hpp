/// How far the states of a recogniser are apart in what a feature measures of them.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/belief/observation/observation_model.hpp"

namespace vantage {

/// The features to be measured together, independent of each other given the state.
using FeatureModels = std::span<const ObservationModel* const>;

enum class Divergence {
  bhattacharyya,     ///< -ln integral sqrt(p_i p_j); symmetric
  kullback_leibler,  ///< integral p_i ln(p_i / p_j)
};

/// D_ij in nats of every two of `states`, the sum over the features of psi times the divergence of
/// their Gaussians. Rows and columns in the order of `states`, diagonal 0; infinite only of states
/// whose variances differ by more than ten orders of magnitude.
///
/// The exponent psi of a feature of d dimensions says that they repeat each other: together they
/// are worth psi d independent ones, and divergences of independent dimensions add. With psi = 0
/// nothing is told apart. N(mean, variance / psi), the other reading, gives the same where
/// variances are equal, but leaves what different variances tell at full weight however small psi.
///
/// Effort is O(|states|^2 d), shared among the threads; single precision, relative errors of 1e-5.
Eigen::MatrixXf state_divergences(Divergence divergence, FeatureModels features,
                                  std::span<const int> states, int threads = 1);

/// Of all states of one feature: a table of states^2 floats.
Eigen::MatrixXf divergence_table(Divergence divergence, const ObservationModel& model, int threads);

/// What tables there are of the features to be measured together. Those that are empty are worked
/// out for the states at hand.
struct DivergenceTables {
  Eigen::MatrixXf bhattacharyya_nats;     ///< states x states or empty
  Eigen::MatrixXf kullback_leibler_nats;  ///< states x states or empty

  [[nodiscard]] const Eigen::MatrixXf& of(Divergence divergence) const {
    return divergence == Divergence::bhattacharyya ? bhattacharyya_nats : kullback_leibler_nats;
  }
};

/// The rows and columns of `table` that belong to `states`.
Eigen::MatrixXf rows_and_columns(const Eigen::MatrixXf& table, std::span<const int> states);

/// psi (ln N(mean_i; mean_j, variance_j) + log_factor_j) of every two of `states`, summed over the
/// features, up to a constant: row i holds the log likelihoods of all states where state i measures
/// its mean.
Eigen::MatrixXf log_likelihoods_at_means(FeatureModels features, std::span<const int> states);

}  // namespace vantage
