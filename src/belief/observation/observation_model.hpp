/// p(feature | state): what a feature measures of each object in each yaw bin.
/// [Potthast2016, chapter 4]
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>

#include "vantage/information/censored_gaussian.hpp"

namespace vantage {

/// An independent Gaussian per dimension and state.
struct ObservationModel {
  std::string feature;       ///< name of the feature it was trained on
  Eigen::MatrixXf mean;      ///< dimensions x states
  Eigen::MatrixXf variance;  ///< dimensions x states, > 0, after shrinkage
  double psi = 1.0;          ///< exponent on the whole density, >= 0; calibrated
  /// ln of a factor on the density of each state, within the exponent; empty: none
  Eigen::VectorXd log_factor = {};
  double cost_s = 0.0;  ///< measured time to extract the feature from one view

  [[nodiscard]] int dimensions() const { return static_cast<int>(mean.rows()); }
  [[nodiscard]] int states() const { return static_cast<int>(mean.cols()); }
};

/// psi (ln N(feature; mean_j, variance_j) + log_factor_j) for every state j; zeros if psi is 0.
/// @param feature of `dimensions()` finite numbers
Eigen::VectorXd log_likelihood(const ObservationModel& model,
                               const Eigen::Ref<const Eigen::VectorXf>& feature);

/// ln N(feature; mean_j, variance_j) + log_factor_j for every state j, whatever psi is.
/// @param feature of `dimensions()` finite numbers
Eigen::VectorXd log_density(const ObservationModel& model,
                            const Eigen::Ref<const Eigen::VectorXf>& feature);

/// Log factor of a state that no view can be of; psi times it is still finite.
inline constexpr double kRulesOut = -1e9;

/// An observation model for many evaluations: no logarithm or division is left in them, which makes
/// them five times as fast, for as much memory again.
struct PreparedObservationModel {
  Eigen::MatrixXf mean;         ///< dimensions x states
  Eigen::MatrixXf precision;    ///< dimensions x states, 1 / variance
  Eigen::VectorXd log_at_mean;  ///< of each state, ln N(mean_j; mean_j, variance_j) + log_factor_j
  Eigen::VectorXd log_factor;   ///< of each state, as in ObservationModel; zeros: none
  double psi = 1.0;             ///< as in ObservationModel
};

PreparedObservationModel prepare(const ObservationModel& model);

/// As of the model it was prepared from, up to rounding.
Eigen::VectorXd log_likelihood(const PreparedObservationModel& model,
                               const Eigen::Ref<const Eigen::VectorXf>& feature);

/// The same of a feature some of whose numbers are lower bounds, or tell nothing: of these the mass
/// above them counts instead of the density, or nothing does, and of the factors, which are those
/// of a whole feature, the share that its exact numbers are. Zeros where none tells anything.
/// @param readings of each number; empty: all are exact
Eigen::VectorXd log_likelihood(const PreparedObservationModel& model,
                               const Eigen::Ref<const Eigen::VectorXf>& feature,
                               std::span<const Reading> readings);

}  // namespace vantage
