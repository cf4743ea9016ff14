/// A made-up database of objects in families of near-duplicates, and what a recogniser believes of
/// it.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <string>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/observation/observation_model.hpp"
#include "vantage/core/rng.hpp"

namespace vantage::test {

struct NearDuplicateFamilies {
  ObjectStates states;
  int family_size = 4;  ///< objects of a category follow each other
};

inline NearDuplicateFamilies near_duplicate_families(int objects, int bins = 8,
                                                     int family_size = 4) {
  NearDuplicateFamilies families{.states = {}, .family_size = family_size};
  families.states.bins = bins;
  for (int k = 0; k < objects; ++k) {
    const int category = k / family_size;
    families.states.objects.push_back("object_" + std::to_string(k));
    families.states.category_of.push_back(category);
    if (k % family_size == 0) {
      families.states.categories.push_back("category_" + std::to_string(category));
    }
  }
  return families;
}

/// How far apart means are, in standard deviations of a dimension.
struct NearDuplicateSpread {
  double family = 2.0;
  double yaw = 0.7;
  double near_duplicate = 0.4;
  double decal = 1.2;         ///< a mark on one side of each object
  double log_variance = 0.3;  ///< standard deviation of the states' ln variance
};

inline Eigen::VectorXd normals(int size, double sigma, Rng& rng) {
  Eigen::VectorXd drawn(size);
  for (double& x : drawn) x = rng.normal(0.0, sigma);
  return drawn;
}

/// A feature of `dimensions` worth `effective_dimensions` independent ones.
inline ObservationModel near_duplicate_model(const NearDuplicateFamilies& families, int dimensions,
                                             double effective_dimensions,
                                             const NearDuplicateSpread& spread, Rng& rng) {
  const ObjectStates& states = families.states;
  ObservationModel model{.feature = "feature_" + std::to_string(dimensions),
                         .mean = Eigen::MatrixXf(dimensions, states.size()),
                         .variance = Eigen::MatrixXf(dimensions, states.size()),
                         .psi = effective_dimensions / dimensions,
                         .cost_s = 1e-3 * dimensions};
  Eigen::VectorXd family, cosine, sine;
  for (int k = 0; k < states.object_count(); ++k) {
    if (k % families.family_size == 0) {
      family = normals(dimensions, spread.family, rng);
      cosine = normals(dimensions, spread.yaw, rng);
      sine = normals(dimensions, spread.yaw, rng);
    }
    const Eigen::VectorXd own = family + normals(dimensions, spread.near_duplicate, rng);
    const Eigen::VectorXd decal = normals(dimensions, spread.decal, rng);
    const double decal_rad = rng.uniform(0.0, 2.0 * M_PI);
    for (int q = 0; q < states.bins; ++q) {
      const double yaw_rad = q * states.bin_rad();
      const Eigen::VectorXd mean = own + std::cos(yaw_rad) * cosine + std::sin(yaw_rad) * sine +
                                   std::max(std::cos(yaw_rad - decal_rad), 0.0) * decal;
      const double scale = rng.normal(0.0, spread.log_variance);
      model.mean.col(states.state(k, q)) = mean.cast<float>();
      model.variance.col(states.state(k, q)) =
          (normals(dimensions, spread.log_variance, rng).array() + scale).exp().cast<float>();
    }
  }
  return model;
}

/// ln p(f | j) of a made-up measurement f of state i, tempered as planners/sampled_information.hpp
/// says: with psi times the mean and covariance.
inline Eigen::VectorXd measured_log_likelihoods(const ObservationModel& model, int i, Rng& rng) {
  const auto mean = [&](int j) { return model.mean.col(j).cast<double>().array(); };
  const auto variance = [&](int j) { return model.variance.col(j).cast<double>().array(); };
  const Eigen::ArrayXd f =
      mean(i) + variance(i).sqrt() * normals(model.dimensions(), 1.0, rng).array();
  Eigen::VectorXd tempered(model.states());
  for (int j = 0; j < model.states(); ++j) {
    const double log_p = -0.5 * ((f - mean(j)).square() / variance(j) + variance(j).log()).sum();
    const double expected =
        -0.5 *
        (((mean(i) - mean(j)).square() + variance(i)) / variance(j) + variance(j).log()).sum();
    tempered[j] = model.psi * expected + std::sqrt(model.psi) * (log_p - expected);
  }
  return tempered;
}

/// Bayes' rule.
inline Eigen::VectorXd updated(const Eigen::VectorXd& belief, const Eigen::VectorXd& log_p) {
  const Eigen::ArrayXd joint = belief.array() * (log_p.array() - log_p.maxCoeff()).exp();
  return joint / joint.sum();
}

/// After a turn by `turn` bins of an object that stays the same, slips of one bin included.
inline Eigen::VectorXd turned(const ObjectStates& states, const Eigen::VectorXd& belief, int turn) {
  Eigen::VectorXd predicted = Eigen::VectorXd::Zero(belief.size());
  for (int s = 0; s < states.size(); ++s) {
    for (const int slip : {-1, 0, 1}) {
      const int bin = (states.bin_of(s) + turn + slip + states.bins) % states.bins;
      predicted[states.state(states.object_of(s), bin)] += (slip == 0 ? 0.8 : 0.1) * belief[s];
    }
  }
  return predicted;
}

/// The same with the group masses of [Potthast2016, table 4.1]: 0.4 to the right state, 0.3 to the
/// object's other bins, 0.1 to the rest of its category, 0.2 to all other objects.
inline Eigen::VectorXd spread_out(const NearDuplicateFamilies& families,
                                  const Eigen::VectorXd& belief, int turn) {
  const ObjectStates& states = families.states;
  const int in_category = families.family_size * states.bins;
  Eigen::VectorXd predicted = Eigen::VectorXd::Zero(belief.size());
  for (int s = 0; s < states.size(); ++s) {
    const int k = states.object_of(s);
    const int right = states.state(k, (states.bin_of(s) + turn) % states.bins);
    for (int j = 0; j < states.size(); ++j) {
      const int other = states.object_of(j);
      const bool same_category = states.category_of[static_cast<std::size_t>(k)] ==
                                 states.category_of[static_cast<std::size_t>(other)];
      const double p = j == right      ? 0.4
                       : other == k    ? 0.3 / (states.bins - 1)
                       : same_category ? 0.1 / (in_category - states.bins)
                                       : 0.2 / (states.size() - in_category);
      predicted[j] += p * belief[s];
    }
  }
  return predicted;
}

}  // namespace vantage::test
