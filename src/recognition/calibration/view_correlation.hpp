/// How far views of one object repeat each other.
#pragma once

#include <cstdint>
#include <span>

#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

/// The correlation of view_weight() with which the object shown is most likely after two to six
/// views of recordings that the filter's model was not trained on: each dataset folder is held out
/// in turn, or each video if there is one folder; of one held out, the views that the others are as
/// high as, within 10 deg, or lie round in elevation. That a model which lacks a recording is too
/// sure of its single views is no repetition: likelihoods are tempered first, so that single views
/// are as likely as can be.
/// @param shown the state of each view
/// @param model with psi; its statistics do not matter
/// @return in [0, 1], in steps of 0.05; 0 if there is one recording only, or all are of
/// elevations of their own, which does not tell
double learn_view_correlation(std::span<const ViewFeatures> views, std::span<const int> shown,
                              const RecognitionModel& model, const VarianceEstimate& variance,
                              std::uint64_t seed, const LongWork& how);

}  // namespace vantage
