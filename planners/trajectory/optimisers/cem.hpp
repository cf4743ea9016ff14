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
  int rollouts = 20;
  int iterations = 50;
  int elites = 5;
  double learning = 0.5;
  double min_sigma = 0.1;
  /// Of the first iteration; its decay is not used. Twice as wide as that of the others, as what
  /// the elite does not span is lost.
  PathNoise noise{.sigma_m = {1.0, 1.0, 0.4}, .sigma_yaw_rad = 1.0};
  void fields(auto&& f) {
    f("rollouts", rollouts, "paths tried an iteration, the noise-free one among them",
      between(2, 10'000));
    f("iterations", iterations, "higher takes longer and settles better", between(1, 100'000));
    f("elites", elites, "paths that are followed, at most `rollouts`; higher settles later",
      between(2, 10'000));
    f("learning", learning, "share of the elite in the next mean and deviation, (0, 1]",
      Range{0.0, 1.0, true});
    f("min_sigma", min_sigma, "of a point, as share of the first one's; higher never settles",
      between(0.0, 1.0));
    f("sigma_m", noise.sigma_m, "@@", at_least(0.0));
    f("sigma_yaw_rad", noise.sigma_yaw_rad, "@@", at_least(0.0));
  }
  void check() const;  ///< elites are rollouts
  OptimisedHorizon operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const;
};

}  // namespace vantage
