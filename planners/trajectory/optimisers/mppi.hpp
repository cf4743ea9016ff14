/// MPPI: noisy paths, averaged as wholes by how well they do.
#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"

namespace vantage {

/// Path integral control of accelerations: white noise of them, given that both ends stay, is noise
/// of covariance R^-1 of the points. Unlike in STOMP a path has one weight for all its points.
/// [Williams2017]
struct Mppi {
  static constexpr std::string_view name = "mppi";
  int rollouts = 20;
  int iterations = 50;
  double inverse_temperature = 10.0;
  PathNoise noise{};
  void fields(auto&& f) {
    f("rollouts", rollouts, "paths tried an iteration, the noise-free one among them",
      between(2, 10'000));
    f("iterations", iterations, "higher takes longer and settles better", between(1, 100'000));
    f("inverse_temperature", inverse_temperature,
      "of the weights, times the span of costs, > 0; higher follows the best rollouts alone",
      above(0.0));
    f("sigma_m", noise.sigma_m, "@@", at_least(0.0));
    f("sigma_yaw_rad", noise.sigma_yaw_rad, "@@", at_least(0.0));
    f("decay", noise.decay, "@@", Range{0.0, 1.0, true});
  }
  OptimisedHorizon operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const;
};

}  // namespace vantage
