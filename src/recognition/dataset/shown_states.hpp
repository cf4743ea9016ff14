/// Which state of a database each view of a dataset shows.
#pragma once

#include <span>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/observation/gaussian_statistics.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

/// The objects of these views in order of appearance, categories likewise.
ObjectStates states_of(std::span<const ViewEntry> views, int bins);

/// Appends the objects of `added`, and the categories that are new.
/// @throws InputError naming an object that is known already.
void add_objects(ObjectStates& states, const ObjectStates& added);

/// The state that each view shows.
/// @throws InputError naming an object that `states` has not.
std::vector<int> states_shown(std::span<const ViewFeatures> views, const ObjectStates& states);

/// The same; -1 of objects that `states` has not.
std::vector<int> states_shown_if_known(std::span<const ViewFeatures> views,
                                       const ObjectStates& states);

/// Trains on one feature of the views; those that lack it are left out.
/// @param shown the state of each view
void add_views(GaussianStatistics& statistics, std::span<const ViewFeatures> views,
               std::span<const int> shown, std::size_t feature);

}  // namespace vantage
