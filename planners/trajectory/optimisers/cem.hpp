/// The cross-entropy method: noisy paths, of which the best say where to try next.
#pragma once

#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"

namespace vantage {

/// Mean and standard deviation of each point follow those of the elite; what points have to do with
/// each other stays that of R^-1, so that paths are smooth.  [Kobilarov2012]
struct Cem {
  static constexpr std::string_view name = "cem";
  static constexpr StrategyText text{
      .summary =
          "Cross-entropy method: tries noisy paths and fits mean and deviation of each waypoint to "
          "the best of them. Needs no gradient; looks farther afield at first.",
      .formula =
          "m <- m + l (mean of the elite - m), sigma <- sigma + l (deviation of the elite - sigma)",
      .source = "Kobilarov2012"};
  int rollouts = 20;
  int iterations = 50;
  int elites = 5;
  double learning = 0.5;
  double min_sigma = 0.1;
  /// Of the first iteration; its decay is not used. Twice as wide as that of the others, as what
  /// the elite does not span is lost.
  PathNoise noise{.sigma_m = {1.0, 1.0, 0.4}, .sigma_yaw_rad = 1.0};
  void fields(auto&& f) {
    f("rollouts", rollouts,
      "paths tried per iteration, the noise-free one among them; higher explores more and takes "
      "longer",
      between(2, 10'000));
    f("iterations", iterations, "number of iterations; higher settles better and takes longer",
      between(1, 100'000));
    f("elites", elites,
      "number of the best paths that mean and deviation are fitted to, at most `rollouts`; higher "
      "settles later",
      between(2, 10'000));
    f("learning", learning,
      "share of the elite in the next mean and deviation; higher settles sooner",
      Range{0.0, 1.0, true});
    f("min_sigma", min_sigma,
      "least standard deviation of a point, as a share of its first one; higher goes on searching",
      between(0.0, 1.0));
    f("sigma_m", noise.sigma_m,
      "first standard deviation of the noise along x, y and z, at the point that moves most; "
      "higher searches farther afield",
      at_least(0.0));
    f("sigma_yaw_rad", noise.sigma_yaw_rad,
      "first standard deviation of the noise in yaw, at the point that moves most; higher tries "
      "other headings",
      at_least(0.0));
  }
  void check() const;  ///< elites are rollouts
  OptimisedHorizon operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const;
};

}  // namespace vantage
