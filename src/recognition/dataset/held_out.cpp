#include "vantage/recognition/dataset/held_out.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"

namespace vantage {
namespace {

constexpr Eigen::Index kMaxViews = 4000;

/// Of each view, in which fold it is held out; -1: in none.
std::vector<int> folds_of(const HeldOutShare& by, std::span<const ViewFeatures> views,
                          std::uint64_t seed) {
  std::vector<int> folds;
  std::map<std::string, int> recordings;  // that have a view of that name
  for (const ViewFeatures& view : views) {
    const std::string name = to_string(view.name);
    const int recording = ++recordings[name];
    Rng rng = Rng::stream(seed, "hold out " + name + std::string(recording - 1, '+'));
    folds.push_back(rng.uniform() < by.share ? 0 : -1);
  }
  return folds;
}

std::vector<int> folds_of(const HeldOutVideos& /*by*/, std::span<const ViewFeatures> views,
                          std::uint64_t /*seed*/) {
  std::vector<int> folds;
  for (const ViewFeatures& view : views) folds.push_back(view.name.video);
  return folds;
}

/// The views of a fold, and all others.
struct Split {
  std::vector<std::size_t> held_out;
  std::vector<std::size_t> trained_on;
};

bool has_all_features(const ViewFeatures& view) {
  return std::ranges::all_of(view.features, &FeatureResult::extracted);
}

std::vector<Split> splits_of(std::span<const ViewFeatures> views, const HoldOutOptions& options) {
  const std::vector<int> folds = std::visit(
      [&](const auto& by) { return folds_of(by, views, options.seed); }, options.held_out);
  std::set<int> numbers(folds.begin(), folds.end());
  numbers.erase(-1);
  if (numbers.empty()) numbers.insert(std::numeric_limits<int>::max());  // all is trained on
  std::vector<Split> splits;
  for (const int fold : numbers) {
    Split& split = splits.emplace_back();
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (folds[i] != fold) {
        split.trained_on.push_back(i);
      } else if (has_all_features(views[i])) {
        split.held_out.push_back(i);
      }
    }
  }
  return splits;
}

void limit(Split& split, Eigen::Index most, std::uint64_t seed) {
  Rng rng = Rng::stream(seed, "views held out");
  std::vector<std::size_t> kept;
  for (const auto i : some_indices(static_cast<Eigen::Index>(split.held_out.size()), most, rng)) {
    kept.push_back(split.held_out[static_cast<std::size_t>(i)]);
  }
  split.held_out = std::move(kept);
}

ObservationModel model_of(std::span<const ViewFeatures> views, std::span<const int> shown,
                          const RecognitionModel& model, std::size_t feature, const Split& split,
                          const VarianceEstimate& variance) {
  FeatureModel trained{.name = model.features[feature].name,
                       .statistics = empty_statistics(
                           model.features[feature].statistics.dimensions(), model.states.size()),
                       .blobs = {}};
  for (const std::size_t i : split.trained_on) {
    const FeatureResult& result = views[i].features[feature];
    if (result.extracted()) add_view(trained.statistics, shown[i], result.vector);
  }
  return make_observation_model(trained, model.states.bins, variance);
}

/// Columns of ln densities, on the right of those that are there.
void append_densities(Eigen::MatrixXf& densities, const ObservationModel& model,
                      std::span<const ViewFeatures> views, std::size_t feature, const Split& split,
                      const LongWork& how) {
  const PreparedObservationModel prepared = prepare(model);
  const Eigen::Index before = densities.cols();
  const auto added = static_cast<Eigen::Index>(split.held_out.size());
  densities.conservativeResize(model.states(), before + added);
  work_through(split.held_out.size(), how, "calibrating psi", [&](std::size_t i) {
    const FeatureResult& result = views[split.held_out[i]].features[feature];
    densities.col(before + static_cast<Eigen::Index>(i)) =
        log_likelihood(prepared, result.vector).cast<float>();
  });
}

}  // namespace

Calibration hold_out(std::span<const ViewFeatures> views, std::span<const int> shown,
                     const RecognitionModel& model, const HoldOutOptions& options,
                     const LongWork& how) {
  std::vector<Split> splits = splits_of(views, options);
  Calibration calibration;
  calibration.held_out.bins = model.states.bins;
  calibration.held_out.log_density.resize(model.features.size());
  for (Split& split : splits) {
    limit(split, kMaxViews / static_cast<Eigen::Index>(splits.size()), options.seed);
    for (const std::size_t i : split.held_out) calibration.held_out.state.push_back(shown[i]);
  }
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    for (const Split& split : splits) {
      ObservationModel trained = model_of(views, shown, model, f, split, options.variance);
      append_densities(calibration.held_out.log_density[f], trained, views, f, split, how);
      if (calibration.models.size() == f) calibration.models.push_back(std::move(trained));
    }
  }
  return calibration;
}

}  // namespace vantage
