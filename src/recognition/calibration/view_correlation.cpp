#include "vantage/recognition/calibration/view_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "vantage/belief/objects/object_belief.hpp"
#include "vantage/belief/objects/view_weight.hpp"
#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/recognition/dataset/turntable_views.hpp"

namespace vantage {
namespace {

constexpr int kWalks = 240;
constexpr int kWalkViews = 6;
constexpr int kSteps = 20;  ///< of correlations from 0 to 1
/// Seen from further above or below, an object looks different, which is no repetition.
constexpr double kAsHigh_rad = 10.0 * std::numbers::pi / 180.0;

/// Views of one object, one after the other.
struct Walk {
  int object = 0;
  std::vector<double> motion_rad;  ///< before each view
  std::vector<Eigen::VectorXd> log_likelihood;
};

std::string recording_of(const ViewFeatures& view, bool by_folder) {
  return by_folder ? view.folder.parent_path().parent_path().string()
                   : std::to_string(view.name.video);
}

/// The views of each recording; of one alone nothing can be held out.
std::map<std::string, std::vector<std::size_t>> recordings_of(std::span<const ViewFeatures> views) {
  std::map<std::string, std::vector<std::size_t>> recordings;
  for (const bool by_folder : {true, false}) {
    recordings.clear();
    for (std::size_t i = 0; i < views.size(); ++i) {
      recordings[recording_of(views[i], by_folder)].push_back(i);
    }
    if (recordings.size() > 1) break;
  }
  return recordings;
}

/// The views of a recording that the others lie round in elevation, of objects that they show too.
std::vector<std::size_t> as_high_as_others(std::span<const ViewFeatures> views,
                                           std::span<const std::size_t> recording) {
  double lowest_rad = std::numeric_limits<double>::infinity();
  double highest_rad = -std::numeric_limits<double>::infinity();
  std::set<std::string> known;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (std::ranges::binary_search(recording, i)) continue;
    lowest_rad = std::min(lowest_rad, views[i].elevation_rad - kAsHigh_rad);
    highest_rad = std::max(highest_rad, views[i].elevation_rad + kAsHigh_rad);
    known.insert(views[i].name.object);
  }
  std::vector<std::size_t> as_high;
  std::ranges::copy_if(recording, std::back_inserter(as_high), [&](std::size_t i) {
    const double at_rad = views[i].elevation_rad;
    return at_rad >= lowest_rad && at_rad <= highest_rad && known.contains(views[i].name.object);
  });
  return as_high;
}

std::vector<PreparedObservationModel> models_without(std::span<const ViewFeatures> views,
                                                     std::span<const int> shown,
                                                     std::span<const std::size_t> held_out,
                                                     const RecognitionModel& model,
                                                     const VarianceEstimate& variance) {
  std::vector<PreparedObservationModel> models;
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    FeatureModel trained{.name = model.features[f].name,
                         .statistics = empty_statistics(model.features[f].statistics.dimensions(),
                                                        model.states.known_size()),
                         .psi = model.features[f].psi,
                         .blobs = {}};
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (std::ranges::binary_search(held_out, i)) continue;
      const FeatureResult& result = views[i].features[f];
      if (result.extracted()) add_view(trained.statistics, shown[i], result.vector);
    }
    models.push_back(prepare(make_observation_model(trained, model.states.bins, variance)));
  }
  return models;
}

/// Different views of the turntable, in any order.
Walk walk_of(const TurntableViews& turntable, std::span<const ViewFeatures> views,
             std::span<const int> shown, const ObjectStates& states,
             std::span<const PreparedObservationModel> models, Rng rng) {
  Walk walk{.object = states.object_of(shown[turntable.views.front()]),
            .motion_rad = {},
            .log_likelihood = {}};
  std::vector<std::size_t> order = turntable.views;
  double yaw_rad = 0.0;
  for (std::size_t n = 0; n < std::min<std::size_t>(order.size(), kWalkViews); ++n) {
    std::swap(order[n], order[n + rng.uniform_index(order.size() - n)]);
    const ViewFeatures& view = views[order[n]];
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(states.known_size());
    for (std::size_t f = 0; f < models.size(); ++f) {
      const FeatureResult& result = view.features[f];
      if (result.extracted()) sum += log_likelihood(models[f], result.vector);
    }
    walk.motion_rad.push_back(n == 0 ? 0.0 : view.yaw_rad - yaw_rad);
    walk.log_likelihood.push_back(std::move(sum));
    yaw_rad = view.yaw_rad;
  }
  return walk;
}

/// ln p(object | views up to it) after each view. @param temperature exponent on all likelihoods
std::vector<double> log_p_after(const Walk& walk, const ObjectStates& states, double temperature,
                                double correlation, std::size_t views) {
  ObjectBelief belief = uniform_belief(states);
  std::vector<double> log_p;
  for (std::size_t n = 0; n < std::min(views, walk.motion_rad.size()); ++n) {
    predict(belief, states, RigidTransition{}, walk.motion_rad[n]);
    const double weight = temperature * view_weight(static_cast<int>(n), correlation);
    update(belief, weight * walk.log_likelihood[n]);
    constexpr double kLeast = 1e-12;  // one walk gone wrong does not decide alone
    log_p.push_back(std::log(std::max(p_object(states, belief)[walk.object], kLeast)));
  }
  return log_p;
}

/// The one of `values` for which the mean over the walks of `score` is highest, of equal ones the
/// first.
double best_of(const std::vector<double>& values, const std::vector<Walk>& walks,
               const LongWork& how, auto&& score) {
  Eigen::MatrixXd scores(std::ssize(values), std::ssize(walks));
  work_through(walks.size(), how, "correlation of views", [&](std::size_t w) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      scores(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(w)) =
          score(walks[w], values[i]);
    }
  });
  Eigen::Index best = 0;
  Eigen::VectorXd(scores.rowwise().mean()).maxCoeff(&best);
  return values[static_cast<std::size_t>(best)];
}

/// Of single views: models that lack a recording are surer of it than psi takes them for.
double honest_temperature(const std::vector<Walk>& walks, const ObjectStates& states,
                          const LongWork& how) {
  std::vector<double> temperatures;
  for (int i = -12; i <= 4; ++i) temperatures.push_back(std::exp2(0.25 * i));
  return best_of(temperatures, walks, how, [&](const Walk& walk, double temperature) {
    return log_p_after(walk, states, temperature, 0.0, 1).front();
  });
}

/// Held out for the walks of some of its views, by models of the others.
struct Recording {
  std::vector<std::size_t> views;
  std::vector<std::size_t> walked;
};

std::vector<Recording> held_out_of(std::span<const ViewFeatures> views) {
  std::vector<Recording> held_out;
  auto recordings = recordings_of(views);
  for (auto& [name, recording] : recordings) {
    std::vector<std::size_t> walked = as_high_as_others(views, recording);
    if (!walked.empty()) held_out.push_back({std::move(recording), std::move(walked)});
  }
  return held_out;
}

std::vector<Walk> walks_of(std::span<const ViewFeatures> views, std::span<const int> shown,
                           const Recording& recording, int count, const RecognitionModel& model,
                           const VarianceEstimate& variance, std::uint64_t seed,
                           const LongWork& how) {
  std::vector<ViewFeatures> own;
  std::vector<int> own_shown;
  for (const std::size_t i : recording.walked) {
    own.push_back(views[i]);
    own_shown.push_back(shown[i]);
  }
  const std::vector<TurntableViews> turntables = turntables_of(own);
  Rng rng = Rng::stream(seed, "views that repeat each other");
  const auto chosen = some_indices(std::ssize(turntables), count, rng);
  const auto models = models_without(views, shown, recording.views, model, variance);
  std::vector<Walk> walks(chosen.size());
  work_through(chosen.size(), how, "views that repeat each other", [&](std::size_t w) {
    walks[w] = walk_of(turntables[static_cast<std::size_t>(chosen[w])], own, own_shown,
                       model.states, models, Rng::stream(seed, "walk " + std::to_string(w)));
  });
  return walks;
}

}  // namespace

double learn_view_correlation(std::span<const ViewFeatures> views, std::span<const int> shown,
                              const RecognitionModel& model, const VarianceEstimate& variance,
                              std::uint64_t seed, const LongWork& how) {
  const std::vector<Recording> recordings = held_out_of(views);
  if (recordings.empty()) return 0.0;
  std::vector<Walk> walks;
  const int count = std::max(1, kWalks / static_cast<int>(recordings.size()));
  for (const Recording& recording : recordings) {
    std::vector<Walk> more = walks_of(views, shown, recording, count, model, variance, seed, how);
    std::ranges::move(more, std::back_inserter(walks));
  }
  const double temperature = honest_temperature(walks, model.states, how);
  std::vector<double> correlations;
  for (int step = 0; step <= kSteps; ++step) {
    correlations.push_back(static_cast<double>(step) / kSteps);
  }
  return best_of(correlations, walks, how, [&](const Walk& walk, double correlation) {
    const std::vector<double> log_p =
        log_p_after(walk, model.states, temperature, correlation, kWalkViews);
    return std::accumulate(log_p.begin() + 1, log_p.end(), 0.0) / static_cast<double>(kWalkViews);
  });
}

}  // namespace vantage
