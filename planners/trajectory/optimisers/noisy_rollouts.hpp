/// What STOMP and MPPI share: rounds of noisy paths round a mean.
#pragma once

#include <functional>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {

/// One round of them.
struct NoisyRollouts {
  std::vector<Eigen::Matrix4Xd> eps;  ///< 4 x n, what each adds to the mean; nothing the first
  Eigen::MatrixXd cost;               ///< of each of the K points (row) of each (column)
};

struct RolloutRounds {
  int rollouts = 20;  ///< a round
  int rounds = 50;
  PathNoise noise{};
};

/// Moves the 4 x n mean by what a round has shown.
using MoveMean =
    std::function<void(const NoisyRollouts&, const Smoothness&, Eigen::Matrix4Xd& mean)>;

/// The best of all paths tried, the last mean among them.
OptimisedHorizon search_by_rollouts(const Horizon& horizon, const PathCost& cost, Rng& rng,
                                    const RolloutRounds& rounds, const MoveMean& move);

}  // namespace vantage
