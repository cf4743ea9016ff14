/// MPPI: noisy paths, averaged as wholes by how well they do.
#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"

namespace vantage {

/// Path integral control of accelerations: white noise of them, given that both ends stay, is noise
/// of covariance R^-1 of the points. Unlike in STOMP a path has one weight for all its points.
struct Mppi {
  static constexpr std::string_view name = "mppi";
  static constexpr StrategyText text{
      .summary =
          "MPPI: tries noisy paths and averages them as wholes, one weight for all waypoints of a "
          "path. Needs no gradient.",
      .formula = "Q <- Q + sum_u P_u eps_u, P_u ~ exp(-h (J_u - min J) / (max J - min J))",
      .source = "Williams2017"};
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
      "inverse temperature of the paths' weights, relative to the span of their costs; higher "
      "follows the best ones alone",
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

}  // namespace vantage
