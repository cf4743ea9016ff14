/// What a feature measures of objects that nothing was learnt of: a background density.
///
/// The objects that are known are a sample of all there are. One more object of a category differs
/// from those known of it as these differ among themselves; one of no known category differs as
/// all objects do. Both are Gaussians of the moments of the known objects, wider by what the sample
/// does not tell of its mean, and tempered by psi like every state's. Tempered densities do not
/// integrate to one, so what they are worth against those of known states is a factor, learnt from
/// objects that were left out (recognition/calibration/unknown_training.hpp).
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/observation/observation_model.hpp"

namespace vantage {

/// ln of the factors on the densities of unknown objects, within the exponent psi.
struct UnknownFactors {
  double instance = 0.0;  ///< another object of a known category
  double category = 0.0;  ///< an object of no known category
};

/// Moments of one feature over all yaw bins of each object.
struct ObjectMoments {
  Eigen::MatrixXd mean;      ///< dimensions x objects
  Eigen::MatrixXd variance;  ///< dimensions x objects, of yaw bins' means and within bins
};
ObjectMoments object_moments(const ObservationModel& model, const ObjectStates& states);

/// Gaussians of unknown objects.
struct BackgroundDensities {
  std::vector<int> category;   ///< of each column, kNoCategory in the last one
  ObservationModel gaussians;  ///< a column each, psi 1
};

/// One of each category with a known object, and one of none. Of objects k of category c with means
/// m_k and variances v_k, the mean is m_c = mean_k m_k and the variance
///   mean_k v_k + (1 + 1/n_c) (nu W + sum_k (m_k - m_c)^2) / (nu + n_c - 1),
/// W being the same of all categories together, unbiased, and worth nu = 2 objects. The last one is
/// of all objects at once. Without a category of two objects W is not known, and the last one is
/// all there is.
/// @param kept at least two objects that count as known
BackgroundDensities background_densities(const ObjectMoments& moments, const ObjectStates& states,
                                         std::span<const int> kept);

/// The hypotheses that background_densities() of all objects have.
/// @return categories, as in ObjectStates; none of a database of fewer than two objects
std::vector<int> unknown_hypotheses(const ObjectStates& states);

/// `model` of known states with columns for unknown objects behind, in the order of
/// unknown_hypotheses().
/// @param states of at least two objects
ObservationModel with_unknown(ObservationModel model, const ObjectStates& states,
                              const UnknownFactors& factors);

}  // namespace vantage
