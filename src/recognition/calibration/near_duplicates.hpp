/// Which objects of a database hardly differ.
#pragma once

#include <span>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/observation/observation_model.hpp"

namespace vantage {

/// Labels of groups, one an object. Two objects are near-duplicates
/// if a view of all features, averaged over yaw bins at the turn where they are most alike, leaves
/// more than 1 of 100 decisions between them wrong: by Bhattacharyya's bound, 1/2 exp(-D), with D
/// tempered by psi. A group is what such pairs hold together.
/// @param models one a feature, of every state, with psi
std::vector<int> near_duplicate_groups(std::span<const ObservationModel> models,
                                       const ObjectStates& states, int threads);

}  // namespace vantage
