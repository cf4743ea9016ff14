#include "vantage/planners/objects/information_measure.hpp"

#include <cmath>

#include "vantage/information/gaussian.hpp"
#include "vantage/information/log_space.hpp"
#include "vantage/information/mixture_bounds.hpp"
#include "vantage/planners/objects/sampled_information.hpp"

namespace vantage {

InformationEstimate MutualInformation::operator()(const InformationQuery& query,
                                                  Rng& /*rng*/) const {
  const Eigen::MatrixXf D = query.divergences(Divergence::bhattacharyya);
  const auto& b = query.likely.belief;
  return {.bits = query.group.empty() ? pairwise_information_bits(b, D)
                                      : pairwise_group_information_bits(b, query.group, D)};
}

InformationEstimate InformationUpperBound::operator()(const InformationQuery& query,
                                                      Rng& /*rng*/) const {
  const Eigen::MatrixXf D = query.divergences(Divergence::kullback_leibler);
  const auto& b = query.likely.belief;
  return {.bits = query.group.empty() ? pairwise_information_bits(b, D)
                                      : group_information_upper_bound_bits(b, query.group, D)};
}

InformationEstimate MeanFeatureInformation::operator()(const InformationQuery& query,
                                                       Rng& /*rng*/) const {
  const auto& b = query.likely.belief;
  const Eigen::MatrixXd log_p =
      query.weight * log_likelihoods_at_means(query.features, query.likely.states).cast<double>();
  double nats = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    std::vector<double> own;  // ln p(mean_i, j) of the states that count as i's
    std::vector<double> all;
    double own_mass = 0.0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(i);
      all.push_back(std::log(b[j]) + log_p(row, static_cast<Eigen::Index>(j)));
      if (query.group.empty() ? i != j : query.group[i] != query.group[j]) continue;
      own.push_back(all.back());
      own_mass += b[j];
    }
    nats += b[i] * (log_sum_exp(own) - std::log(own_mass) - log_sum_exp(all));
  }
  return {.bits = bits_from_nats(nats)};
}

InformationEstimate MonteCarloInformation::operator()(const InformationQuery& query,
                                                      Rng& rng) const {
  return sampled_information(query, samples, rng);
}

InformationEstimate LossOfEntropy::operator()(const InformationQuery& query, Rng& rng) const {
  if (at_mean) return {.bits = information_at_means_bits(query)};
  return sampled_information(query, samples, rng);
}

InformationEstimate JeffreysDivergence::operator()(const InformationQuery& query,
                                                   Rng& /*rng*/) const {
  // J_ij = D_ij + D_ji of KL divergences, so that each counts twice.
  const Eigen::MatrixXf D = query.divergences(Divergence::kullback_leibler);
  const auto& b = query.likely.belief;
  double nats = 0.0;
  for (std::size_t j = 0; j < b.size(); ++j) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!query.group.empty() && query.group[i] == query.group[j]) continue;
      nats += 2.0 * b[i] * b[j] *
              static_cast<double>(D(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return {.bits = bits_from_nats(nats)};
}

}  // namespace vantage
