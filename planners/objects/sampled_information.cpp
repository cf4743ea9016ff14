#include "vantage/planners/objects/sampled_information.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "vantage/core/error.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

/// A feature at the likely states, as sampling needs it: a column per state.
struct SampledFeature {
  Eigen::ArrayXXf mean;  ///< times sqrt(psi)
  Eigen::ArrayXXf variance;
  Eigen::ArrayXXf precision;
  /// Of each state, summed over dimensions, less its log_factor; times psi.
  Eigen::ArrayXd half_log_variance;
  float psi = 1.0F;
};

SampledFeature sampled_feature(const ObservationModel& model, std::span<const int> states,
                               double weight) {
  SampledFeature feature;
  const double psi = weight * model.psi;
  feature.psi = static_cast<float>(psi);
  feature.mean = model.mean(Eigen::all, states).array() * std::sqrt(feature.psi);
  feature.variance = model.variance(Eigen::all, states).array();
  feature.precision = feature.variance.inverse();
  feature.half_log_variance =
      0.5 * psi * feature.variance.log().colwise().sum().transpose().cast<double>();
  if (model.log_factor.size() > 0) {
    feature.half_log_variance -= psi * model.log_factor(states).array();
  }
  return feature;
}

/// Adds l_j(f) of one f ~ p(f | i) for every state j, up to a constant. With the noise
/// n = f - mean_i, the exponent's sum over dimensions is
///   [ (sqrt(psi) (mean_i - mean_j) + n)^2 + psi v_i - sqrt(psi) v_i + (sqrt(psi) - 1) n^2 ] / v_j.
void add_sampled_log_likelihoods(const SampledFeature& feature, Eigen::Index i, Rng& rng,
                                 Eigen::VectorXd& log_p) {
  const float root_psi = std::sqrt(feature.psi);
  Eigen::ArrayXf noise(feature.mean.rows());
  for (float& n : noise) n = static_cast<float>(rng.normal());
  noise *= feature.variance.col(i).sqrt();
  const Eigen::ArrayXf at = feature.mean.col(i) + noise;
  const Eigen::ArrayXf rest =
      (feature.psi - root_psi) * feature.variance.col(i) + (root_psi - 1.0F) * noise.square();
  for (Eigen::Index j = 0; j < log_p.size(); ++j) {
    const float squares =
        (((at - feature.mean.col(j)).square() + rest) * feature.precision.col(j)).sum();
    log_p[j] -= 0.5 * static_cast<double>(squares) + feature.half_log_variance[j];
  }
}

/// b_j exp(log_p_j), normalised; into a vector of the caller's.
void update(std::span<const double> belief, const Eigen::VectorXd& log_p,
            std::vector<double>& updated) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < belief.size(); ++j) {
    if (belief[j] > 0.0) largest = std::max(largest, log_p[static_cast<Eigen::Index>(j)]);
  }
  double sum = 0.0;
  for (std::size_t j = 0; j < belief.size(); ++j) {
    updated[j] =
        belief[j] > 0.0 ? belief[j] * std::exp(log_p[static_cast<Eigen::Index>(j)] - largest) : 0.0;
    sum += updated[j];
  }
  for (double& p : updated) p /= sum;
}

/// The state whose part of [0, 1) `at` lies in.
Eigen::Index state_at(std::span<const double> belief, double at) {
  std::size_t i = 0;
  for (double sum = belief[0]; sum <= at && i + 1 < belief.size(); sum += belief[i]) ++i;
  return static_cast<Eigen::Index>(i);
}

}  // namespace

double entropy_of_target_bits(const InformationQuery& query, std::span<const double> belief) {
  if (query.group.empty()) return entropy_bits(belief);
  std::map<int, double> mass;
  for (std::size_t i = 0; i < belief.size(); ++i) mass[query.group[i]] += belief[i];
  std::vector<double> p;
  for (const auto& [object, probability] : mass) p.push_back(probability);
  return entropy_bits(p);
}

InformationEstimate sampled_information(const InformationQuery& query, int samples, Rng& rng) {
  expects(samples >= 2, "a standard error needs two samples");
  const std::span<const double> belief = query.likely.belief;
  std::vector<SampledFeature> features;
  for (const ObservationModel* model : query.features) {
    if (model->psi > 0.0) {
      features.push_back(sampled_feature(*model, query.likely.states, query.weight));
    }
  }
  const double before_bits = entropy_of_target_bits(query, belief);
  const double offset = rng.uniform();
  std::vector<double> updated(belief.size());
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int s = 0; s < samples; ++s) {
    const Eigen::Index i = state_at(belief, (s + offset) / samples);
    Eigen::VectorXd log_p = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(belief.size()));
    for (const auto& feature : features) add_sampled_log_likelihoods(feature, i, rng, log_p);
    update(belief, log_p, updated);
    const double lost_bits = before_bits - entropy_of_target_bits(query, updated);
    sum += lost_bits;
    sum_of_squares += lost_bits * lost_bits;
  }
  const double mean_bits = sum / samples;
  const double variance = std::max(sum_of_squares / samples - mean_bits * mean_bits, 0.0);
  return {.bits = mean_bits, .standard_error_bits = std::sqrt(variance / (samples - 1))};
}

double information_at_means_bits(const InformationQuery& query) {
  const std::span<const double> belief = query.likely.belief;
  const Eigen::MatrixXd log_p =
      query.weight * log_likelihoods_at_means(query.features, query.likely.states).cast<double>();
  std::vector<double> updated(belief.size());
  double bits = entropy_of_target_bits(query, belief);
  for (std::size_t i = 0; i < belief.size(); ++i) {
    update(belief, log_p.row(static_cast<Eigen::Index>(i)), updated);
    bits -= belief[i] * entropy_of_target_bits(query, updated);
  }
  return bits;
}

}  // namespace vantage
