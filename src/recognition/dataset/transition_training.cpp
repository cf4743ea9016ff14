#include "vantage/recognition/dataset/transition_training.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "vantage/recognition/dataset/turntable_views.hpp"

namespace vantage {
namespace {

constexpr int kWalkViews = 4;

/// Sum over the features that could be extracted.
Eigen::VectorXd likelihood_of(const ViewFeatures& view,
                              std::span<const PreparedObservationModel> models) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(models.front().mean.cols());
  for (std::size_t f = 0; f < models.size(); ++f) {
    if (!view.features[f].extracted()) continue;
    sum += log_likelihood(models[f], view.features[f].vector);
  }
  return sum;
}

std::vector<ViewStep> walk(const TurntableViews& turntable, std::span<const ViewFeatures> views,
                           std::span<const PreparedObservationModel> models, int bins, Rng& rng) {
  const double bin_rad = 2.0 * std::numbers::pi / bins;
  double yaw_rad = views[turntable.views[rng.uniform_index(turntable.views.size())]].yaw_rad;
  std::vector<ViewStep> steps;
  for (int i = 0; i < kWalkViews; ++i) {
    const auto turn = i == 0 ? 0 : 1 + rng.uniform_index(static_cast<std::size_t>(bins - 1));
    const double motion_rad = static_cast<double>(turn) * bin_rad;
    const ViewFeatures& view = views[nearest_view(turntable, views, yaw_rad + motion_rad)];
    yaw_rad = view.yaw_rad;
    steps.push_back({.motion_rad = motion_rad, .log_likelihood = likelihood_of(view, models)});
  }
  return steps;
}

}  // namespace

TransitionCounts learn_transition(std::span<const ViewFeatures> views,
                                  const RecognitionModel& model, const VarianceEstimate& variance,
                                  double prior_moves, std::uint64_t seed) {
  const int bins = model.states.bins;
  std::vector<PreparedObservationModel> models;
  for (const FeatureModel& feature : model.features) {
    models.push_back(prepare(make_observation_model(feature, bins, variance)));
  }
  TransitionCounts counts = prior_counts(RigidTransition{}, bins, prior_moves);
  Rng rng = Rng::stream(seed, "walks");
  for (const TurntableViews& turntable : turntables_of(views)) {
    learn_sequence(model.states, walk(turntable, views, models, bins, rng), counts);
  }
  return counts;
}

LearnedTransition transition_of(const RecognitionModel& model) {
  const LearnedTransition rigid = as_learned(RigidTransition{}, model.states.bins);
  return model.transitions.slip.size() == 0 ? rigid : learned_from(model.transitions, rigid);
}

}  // namespace vantage
