#include "vantage/recognition/calibration/near_duplicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/planners/objects/state_divergence.hpp"

namespace vantage {
namespace {

/// Mean over the bins that both are seen in, at the turn where they are most alike.
double object_distance_nats(const Eigen::MatrixXf& nats, const ObjectStates& states,
                            const std::vector<bool>& seen, int object, int other) {
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < states.bins; ++turn) {
    double sum = 0.0;
    int bins = 0;
    for (int q = 0; q < states.bins; ++q) {
      const int a = states.state(object, q);
      const int b = states.state(other, (q + turn) % states.bins);
      if (!seen[static_cast<std::size_t>(a)] || !seen[static_cast<std::size_t>(b)]) continue;
      sum += static_cast<double>(nats(a, b));
      ++bins;
    }
    if (bins > 0) least = std::min(least, sum / bins);
  }
  return least;
}

}  // namespace

std::vector<int> near_duplicate_groups(std::span<const ObservationModel> models,
                                       const ObjectStates& states, int threads,
                                       std::span<const int> unseen, double confused) {
  std::vector<bool> seen(static_cast<std::size_t>(states.known_size()), true);
  for (const int state : unseen) seen[static_cast<std::size_t>(state)] = false;
  Eigen::MatrixXf nats = Eigen::MatrixXf::Zero(states.known_size(), states.known_size());
  for (const ObservationModel& model : models) {
    if (model.psi > 0.0) nats += divergence_table(Divergence::bhattacharyya, model, threads);
  }
  const double apart_nats = -std::log(2.0 * confused);
  std::vector<int> group;
  for (int k = 0; k < states.object_count(); ++k) {
    const int own = group.empty() ? 0 : *std::ranges::max_element(group) + 1;
    group.push_back(own);
    for (int other = 0; other < k; ++other) {
      if (object_distance_nats(nats, states, seen, k, other) >= apart_nats) continue;
      std::ranges::replace(group, group[static_cast<std::size_t>(k)],
                           group[static_cast<std::size_t>(other)]);
    }
  }
  return group;
}

}  // namespace vantage
