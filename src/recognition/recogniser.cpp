#include "vantage/recognition/recogniser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/dataset/transition_training.hpp"
#include "vantage/recognition/lean_recogniser.hpp"

namespace vantage {
namespace {

constexpr auto kModel = "recognition model";

/// Of a feature that no view had when its time was taken: gains per cost need some.
constexpr double kLeastCost_s = 1e-6;
/// Tables of divergences, or none.
enum class Tables { made, none };

/// Bhattacharyya distances only: the default measure asks for no other.
/// @param impossible states that no view can be of
RecogniserFeature ready(FeaturePair pair, int threads, Tables tables,
                        const std::vector<int>& impossible) {
  RecogniserFeature feature{.extractor = std::move(pair.extractor),
                            .observation = std::move(pair.observation),
                            .prepared = {},
                            .tables = {}};
  feature.prepared = prepare(feature.observation);
  for (const int state : impossible) {
    feature.prepared.log_at_mean[state] = feature.prepared.log_factor[state] = kRulesOut;
  }
  if (tables == Tables::none) return feature;
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

/// Whether all of them have learnt what they are of unknown objects.
bool knows_unknown(const ObjectStates& states, std::span<const FeatureModel* const> features,
                   const std::string& source) {
  const bool learnt =
      states.object_count() >= 2 && std::ranges::all_of(features, [](const FeatureModel* feature) {
        return feature->unknown.has_value();
      });
  if (!learnt && source != kModel) {
    log_info(source +
             ": was trained without unknown objects: each is held to be one of the model's; "
             "train it anew to recognise what is unknown");
  }
  return learnt;
}

Recogniser assembled(ObjectStates states, std::vector<FeaturePair> features, int threads,
                     Tables tables, const std::vector<int>& impossible = {}) {
  expects(!features.empty(), "a recogniser has features");
  Recogniser recogniser{
      .states = std::move(states), .features = {}, .tables = {}, .transition = {}};
  recogniser.unseen = impossible;
  const int count = recogniser.states.size();
  Eigen::MatrixXf& sum = recogniser.tables.bhattacharyya_nats;
  if (tables == Tables::made) sum.setZero(count, count);
  for (FeaturePair& pair : features) {
    expects(pair.observation.states() == count, "a feature models every state");
    recogniser.features.push_back(ready(std::move(pair), threads, tables, impossible));
    if (tables == Tables::made) sum += recogniser.features.back().tables.bhattacharyya_nats;
  }
  return recogniser;
}

Recogniser make_named_recogniser(const RecognitionModel& model, const RecogniserOptions& options,
                                 int threads, const std::string& source,
                                 Tables tables = Tables::made) {
  check_options(options);
  const std::vector<const FeatureModel*> wanted = wanted_features(model, options.features);
  const bool unknown = options.unknown_prior > 0.0 && knows_unknown(model.states, wanted, source);
  std::vector<FeaturePair> pairs;
  for (const FeatureModel* feature : wanted) {
    ObservationModel observation =
        make_observation_model(*feature, model.states.bins, floored(model, options.variance));
    observation.cost_s = std::max(observation.cost_s, kLeastCost_s);
    if (unknown) {
      observation = with_unknown(std::move(observation), model.states, *feature->unknown);
    }
    pairs.push_back({extractor_of(*feature, source), std::move(observation)});
  }
  if (pairs.empty() || model.states.size() == 0) {
    throw InputError(source + ": holds no features or no objects");
  }
  ObjectStates states = model.states;
  if (unknown) states.unknown_category = unknown_hypotheses(states);
  Recogniser recogniser =
      assembled(std::move(states), std::move(pairs), threads, tables, unseen_states(model));
  recogniser.transition = transition_of(model);
  recogniser.unknown_prior = unknown ? options.unknown_prior : 0.0;
  recogniser.view_correlation = options.repeated_views ? model.view_correlation : 0.0;
  return recogniser;
}

}  // namespace

Recogniser make_recogniser(ObjectStates states, std::vector<FeaturePair> features, int threads) {
  return assembled(std::move(states), std::move(features), threads, Tables::made);
}

Recogniser make_recogniser(const RecognitionModel& model, const RecogniserOptions& options,
                           int threads) {
  return make_named_recogniser(model, options, threads, kModel);
}

Recogniser load_recogniser(const std::filesystem::path& path, const RecogniserOptions& options,
                           int threads) {
  return make_named_recogniser(read_recognition_model(path), options, threads, path.string());
}

Recogniser load_lean_recogniser(const std::filesystem::path& path,
                                const RecogniserOptions& options) {
  return make_named_recogniser(read_recognition_model(path), options, 1, path.string(),
                               Tables::none);
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
