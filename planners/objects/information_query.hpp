/// What a measure of information is asked, and what it answers.
#pragma once

#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/planners/objects/likely_states.hpp"
#include "vantage/planners/objects/state_divergence.hpp"

namespace vantage {

/// What measuring `features` tells of the state, or of the object if `group` says which that is.
struct InformationQuery {
  LikelyStates likely;
  FeatureModels features;
  const DivergenceTables* tables = nullptr;  ///< of these features together; null: none
  std::vector<int> group = {};               ///< object of each likely state; empty: the state
  double weight = 1.0;  ///< exponent on what is measured, beside psi: view_weight()

  [[nodiscard]] Eigen::MatrixXf divergences(Divergence divergence) const {
    const bool made = tables != nullptr && tables->of(divergence).size() > 0;
    Eigen::MatrixXf nats = made ? rows_and_columns(tables->of(divergence), likely.states)
                                : state_divergences(divergence, features, likely.states);
    if (weight != 1.0) nats *= static_cast<float>(weight);
    return nats;
  }
};

/// The objects of states, for InformationQuery::group.
inline std::vector<int> objects_of(const ObjectStates& database, std::span<const int> states) {
  std::vector<int> objects;
  for (const int state : states) objects.push_back(database.object_of(state));
  return objects;
}

struct InformationEstimate {
  double bits = 0.0;
  double standard_error_bits = 0.0;  ///< of the sampling; 0 where there is none
};

}  // namespace vantage
