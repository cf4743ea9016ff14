#include "src/recognition/recogniser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "src/recognition/plain_recogniser.hpp"
#include "src/recognition/transition_training.hpp"

namespace vantage {
namespace {

constexpr auto kModel = "recognition model";

RecogniserFeature plain(FeaturePair pair) {
  RecogniserFeature feature{.extractor = std::move(pair.extractor),
                            .observation = std::move(pair.observation),
                            .prepared = {},
                            .tables = {}};
  feature.prepared = prepare(feature.observation);
  return feature;
}

/// Bhattacharyya distances only: the default measure asks for no other.
RecogniserFeature ready(FeaturePair pair, int threads) {
  RecogniserFeature feature = plain(std::move(pair));
  feature.tables.bhattacharyya_nats =
      divergence_table(Divergence::bhattacharyya, feature.observation, threads);
  return feature;
}

std::vector<const FeatureModel*> wanted_features(const RecognitionModel& model,
                                                 const std::vector<std::string>& names) {
  std::vector<const FeatureModel*> wanted;
  std::vector<std::string> known;
  for (const FeatureModel& feature : model.features) {
    known.push_back(feature.name);
    if (names.empty()) wanted.push_back(&feature);
  }
  for (const std::string& name : names) {
    const auto found = std::ranges::find(model.features, name, &FeatureModel::name);
    if (found == model.features.end()) {
      throw ConfigError(
          fmt::format("features: the model has no '{}'; known: {}", name, fmt::join(known, ", ")));
    }
    if (std::ranges::find(wanted, &*found) != wanted.end()) {
      throw ConfigError(fmt::format("features: '{}' appears twice", name));
    }
    wanted.push_back(&*found);
  }
  return wanted;
}

/// Of the features that the options want, in their order.
std::vector<FeaturePair> pairs_of(const RecognitionModel& model, const RecogniserOptions& options,
                                  const std::string& source) {
  check_options(options);
  std::vector<FeaturePair> pairs;
  for (const FeatureModel* feature : wanted_features(model, options.features)) {
    pairs.push_back({extractor_of(*feature, source),
                     make_observation_model(*feature, model.states.bins, options.variance)});
  }
  if (pairs.empty() || model.states.size() == 0) {
    throw InputError(source + ": holds no features or no objects");
  }
  return pairs;
}

Recogniser make_named_recogniser(const RecognitionModel& model, const RecogniserOptions& options,
                                 int threads, const std::string& source) {
  Recogniser recogniser = make_recogniser(model.states, pairs_of(model, options, source), threads);
  recogniser.transition = transition_of(model);
  return recogniser;
}

}  // namespace

Recogniser make_recogniser(ObjectStates states, std::vector<FeaturePair> features, int threads) {
  expects(!features.empty(), "a recogniser has features");
  Recogniser recogniser{
      .states = std::move(states), .features = {}, .tables = {}, .transition = {}};
  const int count = recogniser.states.size();
  recogniser.tables.bhattacharyya_nats.setZero(count, count);
  for (FeaturePair& pair : features) {
    expects(pair.observation.states() == count, "a feature models every state");
    recogniser.features.push_back(ready(std::move(pair), threads));
    recogniser.tables.bhattacharyya_nats += recogniser.features.back().tables.bhattacharyya_nats;
  }
  return recogniser;
}

Recogniser make_recogniser(const RecognitionModel& model, const RecogniserOptions& options,
                           int threads) {
  return make_named_recogniser(model, options, threads, kModel);
}

Recogniser load_recogniser(const std::filesystem::path& path, const RecogniserOptions& options,
                           int threads) {
  return make_named_recogniser(read_recognition_model(path), options, threads, path.string());
}

Recogniser load_plain_recogniser(const std::filesystem::path& path,
                                 const RecogniserOptions& options) {
  const RecognitionModel model = read_recognition_model(path);
  Recogniser recogniser{
      .states = model.states, .features = {}, .tables = {}, .transition = transition_of(model)};
  for (FeaturePair& pair : pairs_of(model, options, path.string())) {
    recogniser.features.push_back(plain(std::move(pair)));
  }
  return recogniser;
}

TrainedFeature extractor_of(const FeatureModel& feature, const std::string& source) {
  const auto blob = feature.blobs.find(kExtractorBlob);
  if (blob == feature.blobs.end()) {
    throw InputError(
        fmt::format("{}: feature '{}' has nothing to extract it", source, feature.name));
  }
  TrainedFeature extractor = TrainedFeature::from_bytes(blob->second, source);
  if (extractor.name() != feature.name ||
      extractor.dimension() != feature.statistics.dimensions()) {
    throw InputError(fmt::format("{}: feature '{}' of {} numbers is extracted as '{}' of {}",
                                 source, feature.name, feature.statistics.dimensions(),
                                 extractor.name(), extractor.dimension()));
  }
  return extractor;
}

}  // namespace vantage
