/// STOMP: noisy paths, averaged at each point by how well they do there.
#pragma once

#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"

namespace vantage {

struct Stomp {
  static constexpr std::string_view name = "stomp";
  static constexpr StrategyText text{
      .summary =
          "STOMP: tries noisy paths and averages their noise at each waypoint, weighted by the "
          "costs there. Needs no gradient; the dissertation's method.",
      .formula =
          "dQ_t = sum_u P_u,t eps_u,t, Q <- Q + M dQ, P_u,t ~ exp(-h (J - min J) / (max J - min "
          "J))",
      .source = "Kalakrishnan2011; Potthast2016, (5.1)-(5.6)"};
  int rollouts = 20;
  int iterations = 50;
  double inverse_temperature = 10.0;
  PathNoise noise{};
  void fields(auto&& f) {
    f("rollouts", rollouts,
      "paths tried per iteration, the noise-free one among them; higher explores more and takes "
      "longer",
      between(2, 10'000));
    f("iterations", iterations, "number of iterations; higher settles better and takes longer",
      between(1, 100'000));
    f("inverse_temperature", inverse_temperature,
      "inverse temperature h of the rollouts' weights at each point, relative to the span of their "
      "costs; higher follows the best ones alone",
      above(0.0));
    f("sigma_m", noise.sigma_m,
      "standard deviation of the noise along x, y and z, at the point that moves most; higher "
      "searches farther afield",
      at_least(0.0));
    f("sigma_yaw_rad", noise.sigma_yaw_rad,
      "standard deviation of the noise in yaw, at the point that moves most; higher tries other "
      "headings",
      at_least(0.0));
    f("decay", noise.decay, "factor of the noise per iteration; lower settles sooner",
      Range{0.0, 1.0, true});
  }
  OptimisedHorizon operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const;
};

/// Probability of each rollout (column) at each point (row), from their costs there: rows sum to
/// one. Where all cost the same they are as likely as each other.  [Potthast2016, (5.6)]
void rollout_probabilities(const Eigen::Ref<const Eigen::MatrixXd>& cost,
                           double inverse_temperature, Eigen::Ref<Eigen::MatrixXd> probability);

}  // namespace vantage
