#include "vantage/recognition/dataset/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"

namespace vantage {
namespace {

constexpr Eigen::Index kMaxViews = 4000;

constexpr double kSameDirection_rad = 0.0175;

/// Of each view, the first of its object that was taken from the same direction in the same
/// recording: pictures of a burst show the same thing, and are held out together or not at all.
std::vector<std::size_t> first_alike(std::span<const ViewFeatures> views) {
  std::map<std::tuple<std::filesystem::path, std::string, int>, std::vector<std::size_t>> seen;
  std::vector<std::size_t> first(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    auto& others = seen[{views[i].folder, views[i].name.object, views[i].name.video}];
    const auto alike = std::ranges::find_if(others, [&](std::size_t k) {
      const double apart_rad = views[i].yaw_rad - views[k].yaw_rad;
      return std::abs(std::remainder(apart_rad, 2.0 * std::numbers::pi)) < kSameDirection_rad;
    });
    first[i] = alike == others.end() ? i : *alike;
    if (alike == others.end()) others.push_back(i);
  }
  return first;
}

/// Of each view, in which fold it is held out; -1: in none.
std::vector<int> folds_of(const HeldOutShare& by, std::span<const ViewFeatures> views,
                          std::uint64_t seed) {
  const std::vector<std::size_t> first = first_alike(views);
  std::vector<int> folds;
  std::map<std::string, int> recordings;  // that have a view of that name
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string name = to_string(views[i].name);
    const int recording = ++recordings[name];
    Rng rng = Rng::stream(seed, "hold out " + name + std::string(recording - 1, '+'));
    const int fold = rng.uniform() < by.share ? 0 : -1;
    folds.push_back(first[i] == i ? fold : folds[first[i]]);
  }
  return folds;
}

std::vector<int> folds_of(const HeldOutVideos& /*by*/, std::span<const ViewFeatures> views,
                          std::uint64_t /*seed*/) {
  std::vector<int> folds;
  for (const ViewFeatures& view : views) folds.push_back(view.name.video);
  return folds;
}

std::vector<int> folds_of(const HeldOutRecordings& /*by*/, std::span<const ViewFeatures> views,
                          std::uint64_t /*seed*/) {
  std::map<std::pair<std::filesystem::path, int>, int> recordings;
  std::vector<int> folds;
  for (const ViewFeatures& view : views) {
    const auto root = view.folder.parent_path().parent_path();
    folds.push_back(
        recordings.emplace(std::pair(root, view.name.video), static_cast<int>(recordings.size()))
            .first->second);
  }
  return folds;
}

std::vector<int> folds_of(const HeldOutAuto& by, std::span<const ViewFeatures> views,
                          std::uint64_t seed) {
  return folds_of(HeldOutShare{.share = by.share}, views, seed);
}

/// The views of a fold, and all others.
struct Split {
  std::vector<std::size_t> held_out;
  std::vector<std::size_t> trained_on;
  /// No state has two views to train on: of the held-out views of objects with even indices, or of
  /// those with odd ones, variances are those of the others.
  bool thin = false;
  int half = 0;
};

/// Parts a split whose states have a single view each into halves of the objects.
void add_split(Split split, std::span<const int> shown, int bins, std::vector<Split>& splits) {
  std::map<int, int> views_of_state;
  for (const std::size_t i : split.trained_on) ++views_of_state[shown[i]];
  split.thin = !split.trained_on.empty() &&
               std::ranges::all_of(views_of_state, [](const auto& s) { return s.second < 2; });
  if (!split.thin) {
    splits.push_back(std::move(split));
    return;
  }
  for (const int half : {0, 1}) {
    Split part{.held_out = {}, .trained_on = split.trained_on, .thin = true, .half = half};
    std::ranges::copy_if(split.held_out, std::back_inserter(part.held_out),
                         [&](std::size_t i) { return shown[i] / bins % 2 == half; });
    splits.push_back(std::move(part));
  }
}

bool has_all_features(const ViewFeatures& view) {
  return std::ranges::all_of(view.features, &FeatureResult::extracted);
}

std::vector<Split> splits_of(std::span<const ViewFeatures> views, std::span<const int> shown,
                             int bins, const HoldOutOptions& options) {
  const std::vector<int> folds = std::visit(
      [&](const auto& by) { return folds_of(by, views, options.seed); }, options.held_out);
  std::set<int> numbers(folds.begin(), folds.end());
  numbers.erase(-1);
  if (numbers.empty()) numbers.insert(std::numeric_limits<int>::max());  // all is trained on
  std::vector<Split> splits;
  for (const int fold : numbers) {
    Split split;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (folds[i] != fold) {
        split.trained_on.push_back(i);
      } else if (has_all_features(views[i])) {
        split.held_out.push_back(i);
      }
    }
    add_split(std::move(split), shown, bins, splits);
  }
  return splits;
}

/// Leaves out views of objects of which the fold trains on none: no model could know them.
void drop_unknown(Split& split, std::span<const int> shown, int bins) {
  std::set<int> known;
  for (const std::size_t i : split.trained_on) known.insert(shown[i] / bins);
  std::erase_if(split.held_out, [&](std::size_t i) { return !known.contains(shown[i] / bins); });
}

void limit(Split& split, Eigen::Index most, std::uint64_t seed) {
  Rng rng = Rng::stream(seed, "views held out");
  std::vector<std::size_t> kept;
  for (const auto i : some_indices(static_cast<Eigen::Index>(split.held_out.size()), most, rng)) {
    kept.push_back(split.held_out[static_cast<std::size_t>(i)]);
  }
  split.held_out = std::move(kept);
}

/// s_pool^2 over the objects of one half, at least the estimate's floor; nothing if no state of
/// them has two views.
std::optional<Eigen::ArrayXd> variance_of_half(std::span<const ViewFeatures> views,
                                               std::span<const int> shown, std::size_t feature,
                                               const RecognitionModel& model, int half,
                                               const VarianceEstimate& variance) {
  const int bins = model.states.bins;
  GaussianStatistics statistics =
      empty_statistics(model.features[feature].statistics.dimensions(), model.states.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const FeatureResult& result = views[i].features[feature];
    if (shown[i] / bins % 2 == half && result.extracted()) {
      add_view(statistics, shown[i], result.vector);
    }
  }
  double freedom = 0.0;
  for (const int count : statistics.count) freedom += std::max(count - 1, 0);
  if (freedom == 0.0) return std::nullopt;
  const Eigen::ArrayXd pooled =
      statistics.squared_deviation.cast<double>().rowwise().sum().array() / freedom;
  const double floor = std::visit([](const auto& e) { return e.floor; }, variance);
  return pooled.max(std::max(floor * pooled.mean(), 1e-9));
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
  ObservationModel made = make_observation_model(trained, model.states.bins, variance);
  if (!split.thin) return made;
  // How far views of a state scatter is not in this fold. It is in the views of other objects.
  const auto spread = variance_of_half(views, shown, feature, model, 1 - split.half, variance);
  if (spread) made.variance.colwise() = spread->cast<float>().matrix();
  return made;
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

/// Of the views that were appended last.
void rule_out_unseen(const Split& split, std::span<const int> shown, Eigen::MatrixXf& densities) {
  std::vector<bool> seen(static_cast<std::size_t>(densities.rows()), false);
  for (const std::size_t i : split.trained_on) seen[static_cast<std::size_t>(shown[i])] = true;
  for (Eigen::Index state = 0; state < densities.rows(); ++state) {
    if (seen[static_cast<std::size_t>(state)]) continue;
    densities.row(state)
        .tail(static_cast<Eigen::Index>(split.held_out.size()))
        .setConstant(kRuledOut);
  }
}

}  // namespace

Calibration hold_out(std::span<const ViewFeatures> views, std::span<const int> shown,
                     const RecognitionModel& model, const HoldOutOptions& options,
                     const LongWork& how) {
  std::vector<Split> splits = splits_of(views, shown, model.states.bins, options);
  Calibration calibration;
  calibration.held_out.bins = model.states.bins;
  calibration.held_out.log_density.resize(model.features.size());
  for (Split& split : splits) {
    if (options.only_seen) drop_unknown(split, shown, model.states.bins);
    limit(split, kMaxViews / static_cast<Eigen::Index>(splits.size()), options.seed);
    calibration.folds.push_back(
        {.models = {}, .first = std::ssize(calibration.view), .count = std::ssize(split.held_out)});
    for (const std::size_t i : split.held_out) {
      calibration.held_out.state.push_back(shown[i]);
      calibration.view.push_back(i);
    }
  }
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    for (std::size_t s = 0; s < splits.size(); ++s) {
      const Split& split = splits[s];
      ObservationModel trained = model_of(views, shown, model, f, split, options.variance);
      append_densities(calibration.held_out.log_density[f], trained, views, f, split, how);
      if (options.only_seen) rule_out_unseen(split, shown, calibration.held_out.log_density[f]);
      calibration.folds[s].models.push_back(std::move(trained));
    }
  }
  return calibration;
}

}  // namespace vantage
