/// STOMP: noisy paths, averaged at each point by how well they do there.
#pragma once

#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"

namespace vantage {

/// [Kalakrishnan2011], [Potthast2016, (5.1)-(5.6)]
struct Stomp {
  static constexpr std::string_view name = "stomp";
  int rollouts = 20;
  int iterations = 50;
  double inverse_temperature = 10.0;
  PathNoise noise{};
  void fields(auto&& f) {
    f("rollouts", rollouts, "paths tried an iteration, the noise-free one among them",
      between(2, 10'000));
    f("iterations", iterations, "higher takes longer and settles better", between(1, 100'000));
    f("inverse_temperature", inverse_temperature,
      "h, > 0: inverse temperature of the weights; higher follows the best rollouts alone",
      above(0.0));
    f("sigma_m", noise.sigma_m, "@@", at_least(0.0));
    f("sigma_yaw_rad", noise.sigma_yaw_rad, "@@", at_least(0.0));
    f("decay", noise.decay, "@@", Range{0.0, 1.0, true});
  }
  OptimisedHorizon operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const;
};

/// Probability of each rollout (column) at each point (row), from their costs there: rows sum to
/// one. Where all cost the same they are as likely as each other.  [Potthast2016, (5.6)]
void rollout_probabilities(const Eigen::Ref<const Eigen::MatrixXd>& cost,
                           double inverse_temperature, Eigen::Ref<Eigen::MatrixXd> probability);

}  // namespace vantage
