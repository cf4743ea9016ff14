#include "vantage/recognition/recognition.hpp"

#include <algorithm>
#include <utility>

#include "vantage/belief/objects/view_weight.hpp"
#include "vantage/core/log.hpp"

namespace vantage {
namespace {

std::vector<FeatureOption> feature_options(const Recogniser& recogniser) {
  std::vector<FeatureOption> features;
  for (const RecogniserFeature& feature : recogniser.features) {
    features.push_back(
        {.model = &feature.observation, .tables = &feature.tables, .extracted = false});
  }
  return features;
}

/// The first that is left.
FeatureDecision take_next(std::span<const FeatureOption> features) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (!features[i].extracted) return {.feature = i, .scores = {}, .score = {}};
  }
  return {};
}

FeatureDecision next_feature(const Recogniser& recogniser, const RecognitionOptions& options,
                             const Recognition& recognition,
                             std::span<const FeatureOption> features,
                             std::optional<double> last_score, Rng& rng) {
  if (options.all_features) return take_next(features);
  const Eigen::VectorXd belief = p_state(recognition.belief);
  return choose_feature(options.features,
                        {.database = recogniser.states,
                         .belief = belief,
                         .features = features,
                         .last_score = last_score,
                         .weight = next_view_weight(recogniser, recognition)},
                        rng);
}

/// Bayes' rule with what was extracted.
/// @param weight of the view, see view_weight()
void apply(const RecogniserFeature& feature, const ExtractedFeature& extracted, double weight,
           ObjectBelief& belief, ViewReport& report) {
  const std::string& name = feature.observation.feature;
  report.feature_time_s += extracted.time_s;
  if (!extracted.result.extracted()) {
    report.skipped.push_back({name, extracted.result.skipped});
    return;
  }
  const bool known = extracted.log_likelihood.size() > 0;
  const FeatureResult& result = extracted.result;
  const EvidenceResult evidence = update(
      belief, weighted(known ? extracted.log_likelihood
                             : log_likelihood(feature.prepared, result.vector, result.readings),
                       weight * (known ? 1.0 : result.weight)));
  if (evidence.used()) {
    report.features.push_back(name);
  } else {
    report.skipped.push_back({name, evidence.reason});
  }
}

std::vector<const ObservationModel*> models_of(const Recogniser& recogniser) {
  std::vector<const ObservationModel*> models;
  for (const RecogniserFeature& feature : recogniser.features) {
    models.push_back(&feature.observation);
  }
  return models;
}

}  // namespace

void require_fits(const RecognitionOptions& options, const Recogniser& recogniser) {
  std::vector<std::string_view> known;
  for (const RecogniserFeature& feature : recogniser.features) {
    known.emplace_back(feature.observation.feature);
  }
  const std::string& first = options.features.first;
  if (!options.all_features && !first.empty() && std::ranges::find(known, first) == known.end()) {
    throw ConfigError("features.first: " + unknown_strategy("feature", first, known));
  }
  kernel_of(options.transition, 0.0, recogniser.states.bins);
}

ExtractFeature extract_from(const Recogniser& recogniser, const ObjectView& view) {
  return [&recogniser, &view](std::size_t feature) {
    const double start_s = wall_s();
    FeatureResult result = recogniser.features[feature].extractor.extract(view);
    return ExtractedFeature{.result = std::move(result), .time_s = wall_s() - start_s};
  };
}

Recognition begin_recognition(const Recogniser& recogniser) {
  ObjectBelief belief = prior_belief(recogniser.states, recogniser.unknown_prior);
  spread_over_seen(recogniser.states, recogniser.unseen, belief);
  return {.belief = std::move(belief), .views = {}};
}

double next_view_weight(const Recogniser& recogniser, const Recognition& recognition) {
  const auto told = std::ranges::count_if(
      recognition.views, [](const ViewReport& view) { return !view.features.empty(); });
  return view_weight(static_cast<int>(told), recogniser.view_correlation);
}

Eigen::VectorXd weighted(Eigen::VectorXd log_likelihood, double weight) {
  if (weight != 1.0) log_likelihood *= weight;
  return log_likelihood;
}

void update_with_view(const Recogniser& recogniser, const RecognitionOptions& options,
                      const ExtractFeature& extract, double view_rad, Recognition& recognition,
                      Rng& rng) {
  ViewReport report{.view_rad = view_rad, .features = {}, .skipped = {}};
  std::vector<FeatureOption> features = feature_options(recogniser);
  std::optional<double> last_score;
  const double weight = next_view_weight(recogniser, recognition);
  for (;;) {
    const double start_s = wall_s();
    const FeatureDecision decision =
        next_feature(recogniser, options, recognition, features, last_score, rng);
    report.selection_time_s += wall_s() - start_s;
    if (!decision.feature) break;
    const std::size_t chosen = *decision.feature;
    apply(recogniser.features[chosen], extract(chosen), weight, recognition.belief, report);
    features[chosen].extracted = true;
    last_score = decision.score;
  }
  report.entropy_bits = state_entropy_bits(recognition.belief);
  recognition.views.push_back(std::move(report));
}

std::optional<RecognitionEnd> recognition_end(const Recogniser& recogniser,
                                              const RecognitionOptions& options,
                                              const Recognition& recognition) {
  const Eigen::VectorXd belief = p_state(recognition.belief);
  if (seen_enough(options.enough, recogniser.states, belief)) return RecognitionEnd::sure;
  if (recognition.views.size() >= static_cast<std::size_t>(options.max_views)) {
    return RecognitionEnd::max_views;
  }
  return std::nullopt;
}

double p_unseen_side(const Recogniser& recogniser, const RecognitionOptions& options,
                     const Recognition& recognition, double motion_rad) {
  Recognition there{.belief = recognition.belief, .views = {}};
  predict_motion(recogniser, options, motion_rad, there);
  const Eigen::VectorXd p = p_state(there.belief);
  const double p_known = p.head(recogniser.states.known_size()).sum();
  return p_known > 0.0 ? p(recogniser.unseen).sum() / p_known : 0.0;
}

NextView next_view(const Recogniser& recogniser, const RecognitionOptions& options,
                   const Recognition& recognition, std::span<const ObjectViewAction> actions,
                   Rng& rng) {
  const double start_s = wall_s();
  std::vector<Eigen::VectorXd> predicted;
  for (const ObjectViewAction& action : actions) {
    Recognition there{.belief = recognition.belief, .views = {}};
    predict_motion(recogniser, options, action.yaw_rad, there);
    predicted.push_back(p_state(there.belief));
  }
  const std::vector<const ObservationModel*> models = models_of(recogniser);
  ObjectViewDecision decision =
      choose_object_view(options.views,
                         {.database = recogniser.states,
                          .features = models,
                          .tables = &recogniser.tables,
                          .actions = actions,
                          .predicted_belief = predicted,
                          .weight = next_view_weight(recogniser, recognition)},
                         rng);
  return {.decision = std::move(decision), .time_s = wall_s() - start_s};
}

void predict_motion(const Recogniser& recogniser, const RecognitionOptions& options,
                    double motion_rad, Recognition& recognition) {
  const auto* learned = std::get_if<LearnedTransition>(&options.transition);
  const bool from_model = learned != nullptr && learned->slip.empty();
  predict(recognition.belief, recogniser.states,
          from_model ? recogniser.transition : options.transition, -motion_rad);
}

Recognition recognise(const Recogniser& recogniser, const RecognitionOptions& options,
                      const ObjectCamera& camera, Rng& rng) {
  check_options(options);
  Recognition recognition = begin_recognition(recogniser);
  double view_time_s = 0.0;
  for (;;) {
    update_with_view(recogniser, options, camera.extract, camera.bearing_rad(), recognition, rng);
    recognition.views.back().view_time_s = view_time_s;
    if (recognition_end(recogniser, options, recognition)) return recognition;
    const std::vector<ObjectViewAction> actions = camera.actions();
    if (actions.empty()) return recognition;
    const NextView next = next_view(recogniser, options, recognition, actions, rng);
    view_time_s = next.time_s;
    const ObjectViewAction& action = actions[next.decision.action];
    camera.turn(action);
    predict_motion(recogniser, options, action.yaw_rad, recognition);
  }
}

}  // namespace vantage
