#include "vantage/recognition/training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "vantage/perception/dataset_reader.hpp"
#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/recognition/calibration/unknown_training.hpp"
#include "vantage/recognition/calibration/view_correlation.hpp"
#include "vantage/recognition/dataset/few_views.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"
#include "vantage/recognition/dataset/transition_training.hpp"
#include "vantage/recognition/recogniser.hpp"

namespace vantage {
namespace {

std::string name_of(const ViewFeatures& view) { return to_string(view.name); }

constexpr int kUsualBins = 8;
constexpr std::size_t kManyViewsOfState = 6;

std::vector<ViewEntry> training_views(const DatasetIndex& dataset, const TrainingOptions& options,
                                      const std::optional<PictureNotes>& notes) {
  std::vector<ViewEntry> views = chosen_views(dataset, options.videos, options.recordings);
  for (const std::string& name : options.leave_out) {
    if (std::erase_if(views, [&](const ViewEntry& v) { return v.name.object == name; }) == 0) {
      throw InputError(fmt::format("leave_out: the dataset has no object '{}' to train on", name));
    }
  }
  if (views.empty()) throw InputError("leave_out: leaves no object to train on");
  fit_to(notes, views);
  drop_copies(views);
  return views;
}

/// What `auto` stands for.
HeldOut held_out_of(const TrainingOptions& options, std::span<const ViewFeatures> views,
                    bool imported) {
  const auto* by_itself = std::get_if<HeldOutAuto>(&options.held_out);
  if (by_itself == nullptr) return options.held_out;
  std::set<std::pair<std::filesystem::path, int>> recordings;
  for (const ViewFeatures& view : views) {
    recordings.emplace(view.folder.parent_path().parent_path(), view.name.video);
  }
  if (imported && recordings.size() > 1) return HeldOutRecordings{};
  return HeldOutShare{.share = by_itself->share};
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

struct Calibrated {
  std::vector<double> psi;
  double variance_floor = 0.0;  ///< 0: that of the options
  Calibration by = {};          ///< what it was chosen on
};

/// The highest of some floors whose held-out views are as likely as those of the best, within a
/// standard error: of few pictures, single dimensions look more reliable than they are.
/// [HastieTibshiraniFriedman2009, 7.10]
Calibrated calibrated_on_few(std::span<const ViewFeatures> views, std::span<const int> shown,
                             const RecognitionModel& model, const TrainingOptions& options,
                             HoldOutOptions hold, const LongWork& how) {
  const auto shrunk = std::get<ShrunkVariance>(options.variance);
  double least = -std::numeric_limits<double>::infinity();
  std::vector<std::pair<Calibrated, LogObject>> tried;
  for (const double floor : {0.0, 0.1, 0.3, 1.0, 3.0}) {
    hold.variance = ShrunkVariance{.nu0 = shrunk.nu0, .floor = std::max(shrunk.floor, floor)};
    Calibration calibration = hold_out(views, shown, model, hold, how);
    HeldOutViews with_a_mistake = calibration.held_out;
    add_a_mistake(with_a_mistake);
    const std::vector<double> psi = choose_psi(
        options.psi, {.models = calibration.folds.front().models, .held_out = with_a_mistake});
    const LogObject log = log_object(with_a_mistake, psi, calibration.held_out.state.size());
    tried.emplace_back(Calibrated{psi, floor, std::move(calibration)}, log);
    least = std::max(least, log.mean - log.standard_error);
  }
  Calibrated chosen;
  for (auto& [calibrated, log] : tried) {
    if (log.mean >= least) chosen = std::move(calibrated);
  }
  return chosen;
}

Calibrated calibrated(std::span<const ViewFeatures> views, std::span<const int> shown,
                      const RecognitionModel& model, const TrainingOptions& options, bool imported,
                      const LongWork& how) {
  const HoldOutOptions hold{held_out_of(options, views, imported), options.variance, options.seed,
                            imported};
  const bool few = imported && std::holds_alternative<ShrunkVariance>(options.variance) &&
                   std::holds_alternative<CalibratedPsi>(options.psi) &&
                   views.size() < kManyViewsOfState * static_cast<std::size_t>(model.states.size());
  if (few) return calibrated_on_few(views, shown, model, options, hold, how);
  Calibrated calibrated;
  calibrated.by = hold_out(views, shown, model, hold, how);
  calibrated.psi = choose_psi(options.psi, {.models = calibrated.by.folds.front().models,
                                            .held_out = calibrated.by.held_out});
  return calibrated;
}

/// Of objects that are none of the model's, and of views of one object that are alike.
/// @param model with psi
void learn_unknown(std::span<const ViewFeatures> views, std::span<const int> shown,
                   const Calibrated& calibrated, RecognitionModel& model,
                   const TrainingOptions& options, const LongWork& how) {
  const auto unknown = calibrate_unknown(calibrated.by, views, model.states, calibrated.psi, how);
  for (std::size_t f = 0; f < unknown.size(); ++f) model.features[f].unknown = unknown[f];
  model.view_correlation = learn_view_correlation(
      views, shown, model, floored(model, options.variance), options.seed, how);
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
  if (bins == 1) throw ConfigError("bins: 1 tells no poses apart; 0 takes what the pictures have");
  if (std::holds_alternative<HeldOutVideos>(held_out) && videos.size() < 2) {
    throw ConfigError("held_out videos: needs two videos or more to train on");
  }
}

RecognitionModel train_recognition(const DatasetIndex& dataset, const TrainingOptions& options,
                                   const LongWork& how) {
  check_options(options);
  const std::optional<PictureNotes> notes =
      common_notes(chosen_views(dataset, options.videos, options.recordings), options.bins);
  if (notes) check_options(*notes, kPictureNotes);
  const std::vector<ViewEntry> entries = training_views(dataset, options, notes);
  const int bins = options.bins > 0 ? options.bins : notes ? notes->bins : kUsualBins;
  const std::vector<TrainedFeature> extractors = learn_features(entries, options, how);
  const std::vector<ViewFeatures> views =
      extract_features(entries, extractors, how, std::string(kExtractingFeatures));
  RecognitionModel model{
      .states = states_of(entries, bins), .features = empty_models(extractors), .transitions = {}};
  require_features(views, model.features);
  const std::vector<int> shown = states_shown(views, model.states);
  const Calibrated by = calibrated(views, shown, model, options, notes.has_value(), how);
  if (notes) keep_notes(*notes, by.variance_floor, model);
  for (std::size_t f = 0; f < model.features.size(); ++f) model.features[f].psi = by.psi[f];
  if (options.unknown) learn_unknown(views, shown, by, model, options, how);
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    add_states(model.features[f].statistics, model.states.size());
    add_views(model.features[f].statistics, views, shown, f);
  }
  if (options.transition_prior_moves > 0.0) {
    model.transitions = learn_transition(views, model, floored(model, options.variance),
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
  const std::vector<ViewEntry> entries = training_views(dataset, options, notes_of(model));
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
