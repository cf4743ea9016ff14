/// Observation models of a few states, for tests of what they tell.
#pragma once

#include <Eigen/Core>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "vantage/information/gaussian.hpp"
#include "vantage/planners/objects/information_query.hpp"

namespace vantage::test {

/// One dimension, a state per mean.
inline ObservationModel scalar_model(std::initializer_list<float> means, float variance = 1.0F) {
  const auto states = static_cast<Eigen::Index>(means.size());
  ObservationModel model{.feature = "scalar",
                         .mean = Eigen::MatrixXf(1, states),
                         .variance = Eigen::MatrixXf::Constant(1, states, variance)};
  std::ranges::copy(means, model.mean.data());
  return model;
}

/// From small to large overlaps of any two states.
inline ObservationModel random_model(int states, bool equal_variances) {
  const int dimensions = *rc::gen::inRange(1, 6);
  ObservationModel model{.feature = "random",
                         .mean = Eigen::MatrixXf(dimensions, states),
                         .variance = Eigen::MatrixXf::Ones(dimensions, states)};
  for (float& mean : model.mean.reshaped()) {
    mean = static_cast<float>(*rc::gen::inRange(-200, 200)) / 100.0F;
  }
  if (equal_variances) return model;
  for (float& variance : model.variance.reshaped()) {
    variance = static_cast<float>(*rc::gen::inRange(30, 300)) / 100.0F;
  }
  return model;
}

inline std::vector<double> random_weights(int states) {
  std::vector<double> b;
  double sum = 0.0;
  for (int i = 0; i < states; ++i) sum += b.emplace_back(*rc::gen::inRange(1, 100));
  for (double& p : b) p /= sum;
  return b;
}

/// About all states of the models.
inline InformationQuery about(FeatureModels features, const std::vector<double>& belief,
                              const std::vector<int>& group = {}) {
  InformationQuery query{
      .likely = {.states = {}, .belief = belief}, .features = features, .group = group};
  for (int i = 0; i < static_cast<int>(belief.size()); ++i) query.likely.states.push_back(i);
  return query;
}

inline DiagonalGaussian gaussian_of(const ObservationModel& model, int state) {
  return {.mean = model.mean.col(state).cast<double>(),
          .variance = model.variance.col(state).cast<double>()};
}

/// ln p(mean_i | j) by the formula, up to a constant.
inline double log_likelihood_at_mean(const ObservationModel& model, int i, int j) {
  const DiagonalGaussian at = gaussian_of(model, i);
  const DiagonalGaussian p = gaussian_of(model, j);
  return -0.5 * model.psi *
         ((at.mean - p.mean).array().square() / p.variance.array() + p.variance.array().log())
             .sum();
}

}  // namespace vantage::test
