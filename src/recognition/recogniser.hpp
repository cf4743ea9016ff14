/// A trained model made ready to recognise with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/belief/objects/transition.hpp"
#include "vantage/belief/observation/gaussian_statistics.hpp"
#include "vantage/perception/features/feature.hpp"
#include "vantage/planners/objects/state_divergence.hpp"

namespace vantage {

/// Under this name FeatureModel::blobs holds TrainedFeature::to_bytes().
inline constexpr auto kExtractorBlob = "extractor";

struct RecogniserFeature {
  TrainedFeature extractor;
  ObservationModel observation;
  PreparedObservationModel prepared;  ///< of `observation`
  DivergenceTables tables;            ///< of this feature alone
};

/// Immutable once made; may be used from several threads.
struct Recogniser {
  ObjectStates states;
  std::vector<RecogniserFeature> features;
  DivergenceTables tables;  ///< of all features together
  /// As the model learnt it; RecognitionOptions::transition `learned` without slips means this.
  LearnedTransition transition = {};
  std::vector<int> unseen = {};   ///< states that no view can be of, see unseen_states()
  double unknown_prior = 0.0;     ///< of the hypotheses of unknown objects, if there are any
  double view_correlation = 0.0;  ///< see view_weight()
};

struct RecogniserOptions {
  VarianceEstimate variance = ShrunkVariance{};
  std::vector<std::string> features;
  double unknown_prior = 0.1;
  bool repeated_views = true;
  void fields(auto&& f) {
    f("variance", variance,
      "how the variances of the observation model are estimated from the training views");
    f("features", features, "names of the model's features that are used; empty: all");
    f("unknown_prior", unknown_prior,
      "probability, before anything is seen, that an object is none of the model's; higher says "
      "`unknown` more readily; 0: never, every object is held to be one of the model's",
      between(0.0, 0.999));
    f("repeated_views", repeated_views,
      "true: further views of an object count for less, as far as training found that views repeat "
      "each other; false: each counts as if it were the first, which is too sure of itself after "
      "several");
  }
};

/// A feature's model with what extracts it.
struct FeaturePair {
  TrainedFeature extractor;
  ObservationModel observation;
};

/// @param features at least one, models of every state
Recogniser make_recogniser(ObjectStates states, std::vector<FeaturePair> features, int threads);

/// @throws ConfigError if `options` are out of range or name a feature that the model has not;
/// InputError if the model is damaged.
Recogniser make_recogniser(const RecognitionModel& model, const RecogniserOptions& options,
                           int threads);

/// read_recognition_model() and make_recogniser().
Recogniser load_recogniser(const std::filesystem::path& path, const RecogniserOptions& options,
                           int threads);

/// What extracts the feature, from its model.
/// @param source of the model, for messages
/// @throws InputError if it is missing, damaged, or of another size than the statistics.
TrainedFeature extractor_of(const FeatureModel& feature, const std::string& source);

}  // namespace vantage
