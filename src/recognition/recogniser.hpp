/// A trained model made ready to recognise with.
#pragma once

#include <filesystem>
#include <vector>

#include "planners/state_divergence.hpp"
#include "src/belief/gaussian_statistics.hpp"
#include "src/belief/object_states.hpp"
#include "src/belief/recognition_model.hpp"
#include "src/belief/transition.hpp"
#include "src/perception/features/feature.hpp"

namespace vantage {

struct RecogniserFeature {
  TrainedFeature extractor;
  ObservationModel observation;
  DivergenceTables tables;  ///< of this feature alone
};

/// Immutable once made; may be used from several threads.
struct Recogniser {
  ObjectStates states;
  std::vector<RecogniserFeature> features;
  DivergenceTables tables;  ///< of all features together
};

struct RecogniserOptions {
  VarianceEstimate variance = ShrunkVariance{};
  std::vector<std::string> features;  ///< names to use of those in the model; empty: all
  void fields(auto&& f) {
    f("variance", variance);
    f("features", features);
  }
};

/// @throws ConfigError if `options` are out of range or name a feature that the model has not;
/// InputError if the model is damaged.
Recogniser make_recogniser(const RecognitionModel& model, const RecogniserOptions& options,
                           int threads);

/// read_recognition_model() and make_recogniser().
Recogniser load_recogniser(const std::filesystem::path& path, const RecogniserOptions& options,
                           int threads);

}  // namespace vantage
