#include "vantage/study/recognition/recognition_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "vantage/belief/objects/psi_rule.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"
#include "vantage/recognition/evaluation/feature_combinations.hpp"
#include "vantage/recognition/evaluation/svm_baseline.hpp"

namespace vantage {
namespace {

constexpr auto kSingleView = "single view, all features";
constexpr auto kRandom = "random";
constexpr auto kRandomAll = "random, all features";

/// What the trials of one recogniser need.
struct Trials {
  const TestViews& test;
  const std::vector<Start>& starts;
  const RecognitionStudyOptions& options;
  const LongWork& how;
};

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
  RecognitionModel used{.states = model.states, .features = {}, .transitions = model.transitions};
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

/// A single view, all features, maximum-likelihood variances.
MethodTrials literal_trials(const RecognitionModel& model, std::string name, const Trials& trials) {
  RecogniserOptions literal = trials.options.recogniser;
  literal.variance = LiteralVariance{};
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

/// Predicts for the views that trials start from, each once.
MethodTrials svm_trials(const Svm& svm, const ObjectStates& states,
                        const std::vector<ViewFeatures>& training, const Trials& trials) {
  std::vector<int> label;
  for (const int state : states_shown(training, states)) label.push_back(states.object_of(state));
  const std::vector<int> predicted =
      svm_predictions(svm, {.views = training, .label = label}, trials.test.views);
  MethodTrials result{
      .method = std::string(strategy_name_of(svm)), .trials = {}, .label_only = true};
  for (const Start& start : trials.starts) {
    const int object = states.object_of(trials.test.shown[start.view]);
    const int estimate = predicted[start.view];
    const auto category = [&](int k) { return states.category_of[static_cast<std::size_t>(k)]; };
    result.trials.push_back({.object = object,
                             .estimate = estimate,
                             .correct = object == estimate,
                             .category_correct = category(object) == category(estimate),
                             .observations = 1});
  }
  return result;
}

void add_baselines(RecognitionStudy& study, const RecognitionModel& model,
                   const DatasetIndex& dataset, const Trials& trials) {
  std::vector<TrainedFeature> extractors;
  for (const FeatureModel& feature : model.features) {
    extractors.push_back(extractor_of(feature, "recognition model"));
  }
  std::vector<int> videos{1, 2, 4};
  std::erase(videos, trials.options.video);
  const std::vector<ViewFeatures> training = extract_features(
      views_of_videos(dataset, videos), extractors, trials.how, "features for the baselines");
  for (const Svm& svm : {Svm(LinearSvm{}), Svm(KernelSvm{})}) {
    study.methods.push_back(svm_trials(svm, model.states, training, trials));
  }
}

Estimate estimate_of(std::span<const double> values, std::uint64_t seed, const std::string& what) {
  Rng rng = Rng::stream(seed, what);
  return {.mean = mean(values),
          .interval = bootstrap_mean(values, rng, {.resamples = 2000, .confidence = 0.95})};
}

std::vector<double> values_of(const MethodTrials& method, auto&& value) {
  std::vector<double> values;
  for (const Trial& trial : method.trials) values.push_back(static_cast<double>(value(trial)));
  return values;
}

double percent_correct(const Trial& trial) { return trial.correct ? 100.0 : 0.0; }

PairedEstimate paired(const MethodTrials& method, const MethodTrials& reference,
                      std::uint64_t seed) {
  const auto differences = [&](auto&& value) {
    std::vector<double> values = values_of(method, value);
    const std::vector<double> others = values_of(reference, value);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= others[i];
    return values;
  };
  const std::string what = method.method + " - " + reference.method;
  const std::vector<double> accuracy = differences(percent_correct);
  Rng rng = Rng::stream(seed, "p " + what);
  return {.reference = reference.method,
          .accuracy_percent = estimate_of(accuracy, seed, "accuracy " + what),
          .observations = estimate_of(differences([](const Trial& t) { return t.observations; }),
                                      seed, "observations " + what),
          .p_value = sign_flip_p_value(accuracy, rng, 2000)};
}

MethodSummary summary_of(const MethodTrials& method, std::uint64_t seed) {
  const auto mean_of = [&](auto&& value) { return mean(values_of(method, value)); };
  MethodSummary summary{
      .method = method.method,
      .accuracy_percent =
          estimate_of(values_of(method, percent_correct), seed, "accuracy " + method.method),
      .category_percent = mean_of([](const Trial& t) { return t.category_correct ? 100.0 : 0.0; }),
      .observations = estimate_of(values_of(method, [](const Trial& t) { return t.observations; }),
                                  seed, "observations " + method.method)};
  if (method.label_only) return summary;
  summary.bin_error = estimate_of(values_of(method, [](const Trial& t) { return t.bin_error; }),
                                  seed, "bin error " + method.method);
  summary.features = mean_of([](const Trial& t) { return t.features; });
  summary.feature_time_s = mean_of([](const Trial& t) { return t.feature_time_s; });
  summary.selection_time_s = mean_of([](const Trial& t) { return t.selection_time_s; });
  summary.view_time_s = mean_of([](const Trial& t) { return t.view_time_s; });
  return summary;
}

}  // namespace

RecognitionStudy run_recognition_study(const RecognitionModel& model, const DatasetIndex& dataset,
                                       const RecognitionStudyOptions& options,
                                       const LongWork& how) {
  check_options(options);
  const std::vector<Method> methods = wanted_methods(options);
  const Recogniser recogniser = make_recogniser(model, options.recogniser, how.threads);
  const RecognitionModel used = with_features(model, options.recogniser.features);
  const TestViews test = read_test_views(dataset, used, options.video, how);
  const std::vector<Start> starts = draw_starts(test, options.starts, options.seed);
  const std::vector<Eigen::MatrixXf> likelihoods = log_likelihoods(recogniser, test, how);
  const Trials trials{test, starts, options, how};
  RecognitionStudy study{.options = options, .states = used.states, .methods = {}, .changes = {}};
  for (const Method& method : methods) {
    study.methods.push_back(
        {.method = method.name,
         .trials = run_trials(recogniser, test, likelihoods, starts, method, options.seed, how)});
  }
  if (options.combinations) add_combinations(study, recogniser, likelihoods, trials);
  if (options.literal) add_literal_settings(study, used, trials);
  if (options.baselines) add_baselines(study, used, dataset, trials);
  if (options.change_starts > 0) {
    const ChangeOptions change{.recognition = for_changes(options.recognition)};
    const std::vector<Start> change_starts = draw_starts(test, options.change_starts, options.seed);
    study.changes =
        evaluate_changes(recogniser, test, likelihoods, change_starts, change, options.seed, how);
  }
  return study;
}

std::vector<MethodSummary> summaries(const RecognitionStudy& study) {
  std::vector<MethodSummary> all;
  for (const MethodTrials& method : study.methods) {
    MethodSummary& summary = all.emplace_back(summary_of(method, study.options.seed));
    for (const auto& name : {kSingleView, kRandom, kRandomAll}) {
      const auto reference = std::ranges::find(study.methods, name, &MethodTrials::method);
      if (reference == study.methods.end() || method.method == name) continue;
      summary.differences.push_back(paired(method, *reference, study.options.seed));
    }
  }
  return all;
}

}  // namespace vantage
