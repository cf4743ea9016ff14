#include "vantage/recognition/training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "vantage/perception/dataset_reader.hpp"
#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"
#include "vantage/recognition/dataset/transition_training.hpp"
#include "vantage/recognition/recogniser.hpp"

namespace vantage {
namespace {

std::string name_of(const ViewFeatures& view) { return to_string(view.name); }

std::vector<ViewEntry> training_views(const DatasetIndex& dataset, const TrainingOptions& options) {
  std::vector<ViewEntry> views = views_of_videos(dataset, options.videos);
  if (views.empty()) throw InputError("videos: the dataset has no views of those to train on");
  return views;
}

std::vector<ObjectView> views_to_learn_from(std::span<const ViewEntry> views,
                                            const TrainingOptions& options, const LongWork& how) {
  Rng rng = Rng::stream(options.seed, "feature views");
  const auto chosen =
      some_indices(static_cast<Eigen::Index>(views.size()), options.feature_views, rng);
  std::vector<ObjectView> loaded(chosen.size());
  work_through(chosen.size(), how, "reading views to learn features from", [&](std::size_t i) {
    loaded[i] = load_view(views[static_cast<std::size_t>(chosen[i])]).view;
  });
  return loaded;
}

std::vector<TrainedFeature> learn_features(std::span<const ViewEntry> views,
                                           const TrainingOptions& options, const LongWork& how) {
  const std::vector<ObjectView> examples = views_to_learn_from(views, options, how);
  std::vector<std::optional<TrainedFeature>> learnt(options.features.size());
  work_through(learnt.size(), how, "learning features", [&](std::size_t f) {
    const Feature& feature = options.features[f];
    Rng rng = Rng::stream(options.seed, strategy_name_of(feature));
    learnt[f] = train_feature(feature, examples, rng);
    if (!options.costs_s.empty()) learnt[f] = learnt[f]->with_cost_s(options.costs_s[f]);
  });
  std::vector<TrainedFeature> features;
  for (auto& feature : learnt) features.push_back(std::move(*feature));
  return features;
}

std::vector<FeatureModel> empty_models(std::span<const TrainedFeature> extractors) {
  std::vector<FeatureModel> models;
  for (const TrainedFeature& extractor : extractors) {
    models.push_back({.name = std::string(extractor.name()),
                      .statistics = empty_statistics(extractor.dimension(), 0),
                      .cost_s = extractor.cost_s(),
                      .blobs = {{kExtractorBlob, extractor.to_bytes()}}});
  }
  return models;
}

/// @throws InputError if a feature could be extracted from none of the views.
void require_features(std::span<const ViewFeatures> views, std::span<const FeatureModel> models) {
  for (std::size_t f = 0; f < models.size(); ++f) {
    const auto extracted = [f](const ViewFeatures& v) { return v.features[f].extracted(); };
    if (std::ranges::any_of(views, extracted)) continue;
    throw InputError(fmt::format("feature '{}' can be extracted from none of {} views; {}: {}",
                                 models[f].name, views.size(), name_of(views.front()),
                                 views.front().features[f].skipped));
  }
}

std::vector<double> calibrated_psi(std::span<const ViewFeatures> views, std::span<const int> shown,
                                   const RecognitionModel& model, const TrainingOptions& options,
                                   const LongWork& how) {
  const Calibration calibration =
      hold_out(views, shown, model, {options.held_out, options.variance, options.seed}, how);
  return choose_psi(options.psi, {.models = calibration.models, .held_out = calibration.held_out});
}

}  // namespace

void TrainingOptions::check() const {
  std::set<std::string_view> names;
  for (const Feature& feature : features) {
    const std::string_view name = strategy_name_of(feature);
    if (!names.insert(name).second) {
      throw ConfigError(fmt::format("features: '{}' appears twice", name));
    }
  }
  if (features.empty()) throw ConfigError("features: at least one is needed");
  if (!costs_s.empty() && costs_s.size() != features.size()) {
    throw ConfigError(
        fmt::format("costs_s: {} of them for {} features", costs_s.size(), features.size()));
  }
  for (const int video : videos) {
    if (!video_elevation_rad(video)) {
      throw ConfigError(fmt::format("videos: {} is none of 1, 2, 4", video));
    }
  }
  if (videos.empty() || std::set(videos.begin(), videos.end()).size() != videos.size()) {
    throw ConfigError("videos: some are needed, each once");
  }
  if (std::holds_alternative<HeldOutVideos>(held_out) && videos.size() < 2) {
    throw ConfigError("held_out videos: needs two videos or more to train on");
  }
}

RecognitionModel train_recognition(const DatasetIndex& dataset, const TrainingOptions& options,
                                   const LongWork& how) {
  check_options(options);
  const std::vector<ViewEntry> entries = training_views(dataset, options);
  const std::vector<TrainedFeature> extractors = learn_features(entries, options, how);
  const std::vector<ViewFeatures> views =
      extract_features(entries, extractors, how, std::string(kExtractingFeatures));
  RecognitionModel model{.states = states_of(entries, options.bins),
                         .features = empty_models(extractors),
                         .transitions = {}};
  require_features(views, model.features);
  const std::vector<int> shown = states_shown(views, model.states);
  const std::vector<double> psi = calibrated_psi(views, shown, model, options, how);
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    model.features[f].psi = psi[f];
    add_states(model.features[f].statistics, model.states.size());
    add_views(model.features[f].statistics, views, shown, f);
  }
  if (options.transition_prior_moves > 0.0) {
    model.transitions = learn_transition(views, model, options.variance,
                                         options.transition_prior_moves, options.seed);
  }
  return model;
}

void extend_recognition(RecognitionModel& model, const DatasetIndex& dataset,
                        const TrainingOptions& options, const LongWork& how) {
  check_options(options);
  std::vector<TrainedFeature> extractors;
  for (const FeatureModel& feature : model.features) {
    extractors.push_back(extractor_of(feature, "recognition model"));
  }
  const std::vector<ViewEntry> entries = training_views(dataset, options);
  const ObjectStates added = states_of(entries, model.states.bins);
  add_objects(model.states, added);
  const std::vector<ViewFeatures> views =
      extract_features(entries, extractors, how, std::string(kExtractingFeatures));
  const std::vector<int> shown = states_shown(views, model.states);
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    add_states(model.features[f].statistics, added.size());
    add_views(model.features[f].statistics, views, shown, f);
  }
}

}  // namespace vantage
