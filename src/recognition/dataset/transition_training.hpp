/// Learns what turning about an object does to its yaw bin from walks round training views.
#pragma once

#include <cstdint>
#include <span>

#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

/// One walk for each object and video: four views, turns by whole bins drawn at random between
/// them, each time to the view of the video that is nearest to where the turn leads. Their
/// likelihoods are those of `model`; which object it is and how it stands is not told.
/// @param prior_moves that the start, `rigid`, is worth, > 0
TransitionCounts learn_transition(std::span<const ViewFeatures> views,
                                  const RecognitionModel& model, const VarianceEstimate& variance,
                                  double prior_moves, std::uint64_t seed);

/// What the counts of a model say; as `rigid` if it has none.
LearnedTransition transition_of(const RecognitionModel& model);

}  // namespace vantage
