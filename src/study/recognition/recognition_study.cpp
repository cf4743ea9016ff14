#include "vantage/study/recognition/recognition_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "vantage/belief/observation/psi_rule.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"
#include "vantage/recognition/evaluation/feature_combinations.hpp"
#include "vantage/recognition/evaluation/svm_baseline.hpp"
#include "vantage/study/recognition/study_trials.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr auto kInformed = "mutual_information, all features";

RecognitionModel with_psi(RecognitionModel model, const std::vector<double>& psi) {
  for (std::size_t f = 0; f < psi.size(); ++f) model.features[f].psi = psi[f];
  return model;
}

std::vector<double> published_psi(const RecognitionModel& model) {
  std::vector<ObservationModel> models;
  for (const FeatureModel& feature : model.features) {
    models.push_back({.feature = feature.name, .mean = {}, .variance = {}});
  }
  return choose_psi(DissertationPsi{}, {.models = models, .held_out = {}});
}

/// The model with these features only, in that order; with all if there are no names.
RecognitionModel with_features(const RecognitionModel& model,
                               const std::vector<std::string>& names) {
  if (names.empty()) return model;
  RecognitionModel used{.states = model.states,
                        .features = {},
                        .transitions = model.transitions,
                        .pictures = model.pictures,
                        .view_correlation = model.view_correlation};
  for (const std::string& name : names) {
    const auto found = std::ranges::find(model.features, name, &FeatureModel::name);
    if (found != model.features.end()) used.features.push_back(*found);
  }
  return used;
}

/// Those asked for, in the order of the tables.
std::vector<Method> wanted_methods(const RecognitionStudyOptions& options) {
  std::vector<Method> methods = published_methods(options.recognition);
  for (const std::string& name : options.methods) {
    if (std::ranges::find(methods, name, &Method::name) != methods.end()) continue;
    std::vector<std::string> known;
    for (const Method& method : methods) known.push_back(method.name);
    throw ConfigError(
        fmt::format("methods: unknown '{}'; known: {}", name, fmt::join(known, "; ")));
  }
  if (!options.methods.empty()) {
    std::erase_if(methods, [&](const Method& method) {
      return std::ranges::find(options.methods, method.name) == options.methods.end();
    });
  }
  return methods;
}

/// The two methods whose probabilities are drawn.
std::vector<Method> drawn_methods(const RecognitionStudyOptions& options) {
  std::vector<Method> methods = published_methods(options.recognition);
  std::erase_if(methods, [](const Method& method) {
    return method.name != kSingleView && method.name != kInformed;
  });
  return methods;
}

/// Probabilities as they would be otherwise: by psi as published, and with views counted whole.
/// Every object is one of the model's here: of unknown ones the published psi says nothing.
void add_reliability(RecognitionStudy& study, const RecognitionModel& model, const Trials& trials) {
  RecogniserOptions whole = trials.options.recogniser;
  whole.unknown_prior = 0.0;
  whole.repeated_views = false;
  RecogniserOptions known = trials.options.recogniser;
  known.unknown_prior = 0.0;
  const auto add = [&](const char* as, const RecognitionModel& by, const RecogniserOptions& how) {
    const Recogniser recogniser = make_recogniser(by, how, trials.how.threads);
    const auto likelihoods = log_likelihoods(recogniser, trials.test, trials.how);
    for (Method method : drawn_methods(trials.options)) {
      const bool several = method.name == kInformed;
      method.name = fmt::format("{}; {}", method.name, as);
      MethodTrials& added =
          study.methods.emplace_back(trials_of(recogniser, method, likelihoods, {}, trials));
      added.drawn_as = as;
      added.several_views = several;
    }
  };
  add("psi calibrated", model, known);
  add("psi calibrated, views counted whole", model, whole);
  add("psi as published", with_psi(model, published_psi(model)), whole);
}

/// A single view, all features, maximum-likelihood variances.
MethodTrials literal_trials(const RecognitionModel& model, const std::string& name,
                            const Trials& trials) {
  RecogniserOptions literal = trials.options.recogniser;
  literal.variance = LiteralVariance{};
  literal.unknown_prior = 0.0;  // learnt for other variances
  const Recogniser recogniser = make_recogniser(model, literal, trials.how.threads);
  RecognitionOptions options = trials.options.recognition;
  options.all_features = true;
  options.max_views = 1;
  return {.method = name,
          .trials = run_trials(
              recogniser, trials.test, log_likelihoods(recogniser, trials.test, trials.how),
              trials.starts, {.name = name, .options = options}, trials.options.seed, trials.how)};
}

void add_literal_settings(RecognitionStudy& study, const RecognitionModel& model,
                          const Trials& trials) {
  const std::vector<double> one(model.features.size(), 1.0);
  study.methods.push_back(literal_trials(with_psi(model, one), "literal, psi 1", trials));
  study.methods.push_back(
      literal_trials(with_psi(model, published_psi(model)), "literal, published psi", trials));
}

void add_combinations(RecognitionStudy& study, const Recogniser& recogniser,
                      std::span<const Eigen::MatrixXf> likelihoods, const Trials& trials) {
  for (const FeatureCombination& features : feature_combinations(recogniser.features.size())) {
    std::vector<std::string> names;
    for (const std::size_t f : features) {
      names.push_back(recogniser.features[f].observation.feature);
    }
    study.methods.push_back({.method = fmt::format("only {}", fmt::join(names, " + ")),
                             .trials = combination_trials(recogniser, trials.test, likelihoods,
                                                          trials.starts, features)});
  }
}

MethodTrials label_trials(std::string name, const std::vector<int>& predicted,
                          const ObjectStates& states, const Trials& trials) {
  MethodTrials result{.method = std::move(name), .trials = {}, .label_only = true};
  for (const Start& start : trials.starts) {
    result.trials.push_back(judged(states, trials.test, start.view, predicted[start.view]));
  }
  return result;
}

/// What baselines may learn from: what was given, or what is not tested.
std::vector<ViewEntry> baseline_views(const DatasetIndex& dataset, const DatasetIndex& training,
                                      const RecognitionModel& model, const Trials& trials) {
  const RecognitionStudyOptions& options = trials.options;
  std::vector<ViewEntry> views;
  if (!training.views.empty()) {
    views = chosen_views(training, std::vector{1, 2, 4}, {});
  } else {
    const std::vector<ViewEntry> tested =
        chosen_views(dataset, {{options.video}}, options.recordings);
    std::set<fs::path> files;
    for (const ViewEntry& view : tested) files.insert(view.file("crop.png"));
    std::ranges::copy_if(dataset.views, std::back_inserter(views), [&](const ViewEntry& view) {
      return !files.contains(view.file("crop.png"));
    });
  }
  std::erase_if(views, [&](const ViewEntry& view) {
    return std::ranges::find(model.states.objects, view.name.object) == model.states.objects.end();
  });
  if (views.empty()) {
    throw ConfigError(
        "baselines: the dataset has no views of known objects beside those that are tested; "
        "--training DIR gives others");
  }
  fit_to(notes_of(model), views);
  return views;
}

void add_baselines(RecognitionStudy& study, const RecognitionModel& model,
                   const std::vector<ViewEntry>& views, const Trials& trials) {
  std::vector<TrainedFeature> extractors;
  for (const FeatureModel& feature : model.features) {
    extractors.push_back(extractor_of(feature, "recognition model"));
  }
  const std::vector<ViewFeatures> training =
      extract_features(views, extractors, trials.how, "features for the baselines");
  std::vector<int> label;
  for (const int state : states_shown(training, model.states)) {
    label.push_back(model.states.object_of(state));
  }
  const LabelledFeatures labelled{.views = training, .label = label};
  study.methods.push_back(label_trials(
      "nearest neighbour", nearest_predictions(labelled, trials.test.views), model.states, trials));
  for (const Svm& svm : {Svm(LinearSvm{}), Svm(KernelSvm{})}) {
    study.methods.push_back(label_trials(std::string(strategy_name_of(svm)),
                                         svm_predictions(svm, labelled, trials.test.views),
                                         model.states, trials));
  }
}

/// Of objects that a change can be told of.
std::vector<Start> known_starts(const TestViews& test, std::vector<Start> starts) {
  std::erase_if(starts, [&](const Start& start) { return !is_known(test, start.view); });
  return starts;
}

void require_unknown(const RecognitionStudyOptions& options, const Recogniser& recogniser) {
  if (options.unknown_starts == 0 || recogniser.states.unknown_size() > 0) return;
  throw ConfigError(
      "unknown_starts: the model was trained without unknown objects, or "
      "recogniser.unknown_prior is 0");
}

std::vector<ChangeTrials> changes_of(const Recogniser& recogniser,
                                     const std::vector<Eigen::MatrixXf>& likelihoods,
                                     const Trials& trials) {
  const RecognitionStudyOptions& options = trials.options;
  const ChangeOptions change{.recognition = for_changes(options.recognition)};
  const std::vector<Start> starts =
      known_starts(trials.test, draw_starts(trials.test, options.change_starts, options.seed));
  if (starts.empty() || recogniser.states.object_count() < 2) {
    throw ConfigError("change_starts: needs two objects or more that the model knows");
  }
  return evaluate_changes(recogniser, trials.test, likelihoods, starts, change, options.seed,
                          trials.how);
}

}  // namespace

void RecognitionStudyOptions::check() const {
  require_no_weights(recognition.views, "recognition.views");
}

RecognitionStudy run_recognition_study(const RecognitionModel& model, const DatasetIndex& dataset,
                                       const RecognitionStudyOptions& options, const LongWork& how,
                                       const DatasetIndex& training) {
  check_options(options);
  const std::vector<Method> methods = wanted_methods(options);
  const Recogniser recogniser = make_recogniser(model, options.recogniser, how.threads);
  require_unknown(options, recogniser);
  const RecognitionModel used = with_features(model, options.recogniser.features);
  const PartedViews parts =
      options.unknown_starts > 0 ? parted(dataset, model.states) : PartedViews{dataset, {}};
  const TestViews test = read_test_views(parts.known, used, options.video, how, options.recordings);
  const std::vector<Start> starts = draw_starts(test, options.starts, options.seed);
  const UnknownViews unknown = unknown_views(parts.unknown, used, options, how);
  const Trials trials{test, starts, unknown, options, how};
  const std::vector<Eigen::MatrixXf> likelihoods = log_likelihoods(recogniser, test, how);
  const std::vector<ViewEntry> of_baselines = options.baselines
                                                  ? baseline_views(dataset, training, used, trials)
                                                  : std::vector<ViewEntry>{};
  const std::vector<Eigen::MatrixXf> of_unknown = unknown_likelihoods(recogniser, trials);
  RecognitionStudy study{.options = options,
                         .states = used.states,
                         .methods = {},
                         .changes = {},
                         .threads = how.threads};
  for (const Method& method : methods) {
    study.methods.push_back(trials_of(recogniser, method, likelihoods, of_unknown, trials));
  }
  if (options.reliability) add_reliability(study, used, trials);
  if (options.combinations) add_combinations(study, recogniser, likelihoods, trials);
  if (options.literal) add_literal_settings(study, used, trials);
  if (options.baselines) add_baselines(study, used, of_baselines, trials);
  if (options.change_starts > 0) study.changes = changes_of(recogniser, likelihoods, trials);
  return study;
}

}  // namespace vantage
