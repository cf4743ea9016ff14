/// p(feature | state): what a feature measures of each object in each yaw bin.
/// [Potthast2016, chapter 4]
#pragma once

#include <Eigen/Core>

#include <string>

namespace vantage {

/// An independent Gaussian per dimension and state.
struct ObservationModel {
  std::string feature;       ///< name of the feature it was trained on
  Eigen::MatrixXf mean;      ///< dimensions x states
  Eigen::MatrixXf variance;  ///< dimensions x states, > 0, after shrinkage
  double psi = 1.0;          ///< exponent on the whole density, >= 0; calibrated
  double cost_s = 0.0;       ///< measured time to extract the feature from one view

  [[nodiscard]] int dimensions() const { return static_cast<int>(mean.rows()); }
  [[nodiscard]] int states() const { return static_cast<int>(mean.cols()); }
};

/// psi ln N(feature; mean_j, variance_j) for every state j.
/// @param feature of `dimensions()` finite numbers
Eigen::VectorXd log_likelihood(const ObservationModel& model,
                               const Eigen::Ref<const Eigen::VectorXf>& feature);

}  // namespace vantage
