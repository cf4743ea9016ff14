/// Which objects of a database hardly differ.
#pragma once

#include <span>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/observation/observation_model.hpp"

namespace vantage {

/// Labels of groups, one an object. Two objects are near-duplicates
/// if a view of all features, averaged over yaw bins at the turn where they are most alike, leaves
/// more than `confused` of the decisions between them wrong: by Bhattacharyya's bound, 1/2 exp(-D),
/// with D tempered by psi. A group is what such pairs hold together.
/// @param models one a feature, of every state, with psi
/// @param unseen states that no view is of, which say nothing of likeness
/// @param confused share of wrong decisions from which two are near-duplicates, (0, 1/2]; higher
///     finds fewer
std::vector<int> near_duplicate_groups(std::span<const ObservationModel> models,
                                       const ObjectStates& states, int threads,
                                       std::span<const int> unseen = {}, double confused = 0.01);

}  // namespace vantage
