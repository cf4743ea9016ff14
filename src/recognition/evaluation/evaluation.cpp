#include "vantage/recognition/evaluation/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"

namespace vantage {
namespace {

/// Of the object that it is held for, or that an unknown one is held to be of; where the model has
/// the true one, the most probable of its categories.
int estimated_category(const ObjectStates& states, const ObjectBelief& belief, int truth) {
  if (truth == kNoCategory && is_unknown(states, belief)) return unknown_category(states, belief);
  if (truth == kNoCategory || states.unknown_size() == 0) {
    return states.category_of[static_cast<std::size_t>(most_probable_object(states, belief))];
  }
  Eigen::Index best = 0;
  p_category(states, belief).maxCoeff(&best);
  return static_cast<int>(best);
}

Trial trial_of(const Recogniser& recogniser, const Recognition& known, const TestViews& test,
               std::size_t view) {
  Trial trial = judged(recogniser.states, test, view, known.belief);
  trial.observations = static_cast<int>(known.views.size());
  for (const ViewReport& report : known.views) {
    trial.features += static_cast<int>(report.features.size());
    trial.feature_time_s += report.feature_time_s;
    trial.selection_time_s += report.selection_time_s;
    trial.view_time_s += report.view_time_s;
  }
  return trial;
}

int index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

}  // namespace

Trial judged(const ObjectStates& states, const TestViews& test, std::size_t view, int estimate) {
  Trial trial{.object = is_known(test, view) ? states.object_of(test.shown[view]) : -1,
              .estimate = estimate,
              .name = test.views[view].name.object,
              .category = test.views[view].name.category,
              .observations = 1};
  trial.correct = trial.object == estimate;
  if (estimate < states.object_count()) {
    trial.category_correct =
        states.category_of[static_cast<std::size_t>(estimate)] == test.category[view];
  }
  return trial;
}

Trial judged(const ObjectStates& states, const TestViews& test, std::size_t view,
             const ObjectBelief& belief) {
  const bool unknown = is_unknown(states, belief);
  Trial trial = judged(states, test, view,
                       unknown ? states.object_count() : most_probable_object(states, belief));
  const int shown = test.shown[view];
  trial.correct = trial.correct || (unknown && shown < 0);
  trial.category_correct =
      estimated_category(states, belief, test.category[view]) == test.category[view];
  trial.probability = estimate_of(states, belief).probability;
  trial.unknown_probability = p_unknown(states, belief);
  trial.entropy_bits = state_entropy_bits(belief);
  if (shown >= 0) trial.bin_error = bin_error(states, expected_state(states, belief), shown);
  return trial;
}

bool is_known(const TestViews& test, std::size_t view) { return test.shown[view] >= 0; }

TestViews read_test_views(const DatasetIndex& dataset, const RecognitionModel& model, int video,
                          const LongWork& how, std::span<const std::string> recordings) {
  std::vector<ViewEntry> entries = chosen_views(dataset, {{video}}, recordings);
  fit_to(notes_of(model), entries);
  std::vector<TrainedFeature> extractors;
  for (const FeatureModel& feature : model.features) {
    extractors.push_back(extractor_of(feature, "recognition model"));
  }
  TestViews test;
  test.views = extract_features(entries, extractors, how, "extracting features of test views");
  test.shown = states_shown_if_known(test.views, model.states);
  for (const ViewFeatures& view : test.views) {
    test.category.push_back(index_of(model.states.categories, view.name.category));
  }
  test.turntables = turntables_of(test.views);
  return test;
}

std::vector<Start> draw_starts(const TestViews& test, int count, std::uint64_t seed) {
  Rng rng = Rng::stream(seed, "starts");
  std::vector<Start> starts;
  for (int i = 0; i < count; ++i) {
    const std::size_t turntable = rng.uniform_index(test.turntables.size());
    const std::vector<std::size_t>& views = test.turntables[turntable].views;
    starts.push_back({.turntable = turntable, .view = views[rng.uniform_index(views.size())]});
  }
  return starts;
}

std::vector<Method> published_methods(const RecognitionOptions& common) {
  std::vector<Method> methods;
  const auto add = [&](std::string name, const ObjectViewChoice& views, int max_views,
                       const auto& change) {
    RecognitionOptions options = common;
    options.views.choice = views;
    options.max_views = max_views;
    change(options);
    methods.push_back({.name = std::move(name), .options = std::move(options)});
  };
  const auto all = [](RecognitionOptions& o) { o.all_features = true; };
  const auto chosen = [](const InformationMeasure& measure) {
    return [measure](RecognitionOptions& o) { o.features.measure = measure; };
  };
  add("single view, all features", RandomObjectView{}, 1, all);
  add("single view, features by loss_of_entropy", RandomObjectView{}, 1, chosen(LossOfEntropy{}));
  add("single view, features by mutual_information", RandomObjectView{}, 1,
      chosen(MutualInformation{}));
  const std::array<ObjectViewChoice, 5> choices{
      RandomObjectView{}, StarView{}, JeffreysDivergence{}, LossOfEntropy{}, MutualInformation{}};
  for (const ObjectViewChoice& views : choices) {
    const std::string name(strategy_name_of(views));
    add(name + ", all features", views, common.max_views, all);
    add(name, views, common.max_views, chosen(MutualInformation{}));
  }
  return methods;
}

DatasetCamera::DatasetCamera(const Recogniser& recogniser, const TestViews& test,
                             std::span<const Eigen::MatrixXf> log_likelihood, const Start& start)
    : recogniser_(&recogniser),
      test_(&test),
      log_likelihood_(log_likelihood),
      turntable_(start.turntable),
      view_(start.view),
      seen_{start.view} {}

ObjectCamera DatasetCamera::as_object_camera() {
  return {.extract = [this](std::size_t feature) { return extract(feature); },
          .bearing_rad = [this] { return bearing_rad_; },
          .actions = [this] { return actions(); },
          .turn = [this](const ObjectViewAction& action) { turn(action); }};
}

ExtractedFeature DatasetCamera::extract(std::size_t feature) const {
  return {.result = test_->views[view_].features[feature],
          .time_s = recogniser_->features[feature].observation.cost_s,
          .log_likelihood =
              log_likelihood_[feature].col(static_cast<Eigen::Index>(view_)).cast<double>()};
}

/// A camera further on sees the object turned back.
std::size_t DatasetCamera::view_after(double turn_rad) const {
  return nearest_view(test_->turntables[turntable_], test_->views,
                      test_->views[view_].yaw_rad - turn_rad);
}

double DatasetCamera::turn_to(std::size_t view) const {
  const double turn_rad = test_->views[view_].yaw_rad - test_->views[view].yaw_rad;
  const double whole_rad = 2.0 * std::numbers::pi;
  return turn_rad - whole_rad * std::floor(turn_rad / whole_rad);
}

std::vector<ObjectViewAction> DatasetCamera::actions() const {
  constexpr double kNear = 0.26;  // of a bin
  const double bin_rad = recogniser_->states.bin_rad();
  std::vector<ObjectViewAction> actions;
  std::vector<std::size_t> offered{view_};
  const auto offer = [&](std::size_t view, double turn_rad) {
    const bool visited = std::ranges::find(seen_, view) != seen_.end();
    actions.push_back({.yaw_rad = turn_rad, .visited = visited});
    offered.push_back(view);
  };
  for (const bool near : {true, false}) {
    for (int turn = 1; turn < recogniser_->states.bins; ++turn) {
      const double turn_rad = turn * bin_rad;
      const std::size_t view = view_after(turn_rad);
      const double off_rad = std::remainder(turn_to(view) - turn_rad, 2.0 * std::numbers::pi);
      const bool is_near = std::abs(off_rad) <= kNear * bin_rad;
      if (near && is_near) offer(view, turn_rad);
      // No view near there: the nearest, as far as it is.
      const bool is_new = std::ranges::find(offered, view) == offered.end();
      if (!near && !is_near && is_new) offer(view, turn_to(view));
    }
  }
  return actions;
}

void DatasetCamera::turn(const ObjectViewAction& action) {
  view_ = view_after(action.yaw_rad);
  bearing_rad_ += action.yaw_rad;
  seen_.push_back(view_);
}

std::vector<Eigen::MatrixXf> log_likelihoods(const Recogniser& recogniser, const TestViews& test,
                                             const LongWork& how) {
  const auto views = static_cast<Eigen::Index>(test.views.size());
  std::vector<Eigen::MatrixXf> all(recogniser.features.size(),
                                   Eigen::MatrixXf::Zero(recogniser.states.size(), views));
  work_through(test.views.size(), how, "likelihoods of test views", [&](std::size_t i) {
    for (std::size_t f = 0; f < all.size(); ++f) {
      const FeatureResult& feature = test.views[i].features[f];
      if (!feature.extracted()) continue;
      all[f].col(static_cast<Eigen::Index>(i)) =
          log_likelihood(recogniser.features[f].prepared, feature.vector).cast<float>();
    }
  });
  return all;
}

std::vector<Trial> run_trials(const Recogniser& recogniser, const TestViews& test,
                              std::span<const Eigen::MatrixXf> log_likelihood,
                              std::span<const Start> starts, const Method& method,
                              std::uint64_t seed, const LongWork& how) {
  check_options(method.options, method.name);
  expects(log_likelihood.size() == recogniser.features.size(), "likelihoods of every feature");
  std::vector<Trial> trials(starts.size());
  work_through(starts.size(), how, method.name, [&](std::size_t i) {
    Rng rng = Rng::stream(seed, fmt::format("trial {}", i));
    DatasetCamera camera(recogniser, test, log_likelihood, starts[i]);
    const Recognition known = recognise(recogniser, method.options, camera.as_object_camera(), rng);
    trials[i] = trial_of(recogniser, known, test, camera.view());
  });
  return trials;
}

}  // namespace vantage
