#include "vantage/recognition/calibration/unknown_training.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "vantage/core/log.hpp"
#include "vantage/information/log_space.hpp"
#include "vantage/recognition/calibration/near_duplicates.hpp"

namespace vantage {
namespace {

using Kind = ShownView::Kind;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr int kMostSteps = 500;
constexpr double kLongestStep = 10.0;

/// What is known while the views of some objects are shown.
struct Showing {
  Kind kind = Kind::known;
  std::vector<int> kept;   ///< objects that are known
  std::vector<int> shown;  ///< objects whose views are shown
};

std::vector<int> where(int count, auto&& holds) {
  std::vector<int> found;
  for (int k = 0; k < count; ++k) {
    if (holds(static_cast<std::size_t>(k))) found.push_back(k);
  }
  return found;
}

/// All of them; without each group; without each category and what is near-duplicate to it.
std::vector<Showing> showings_of(const ObjectStates& states, const std::vector<int>& group) {
  const int count = states.object_count();
  const std::vector<int> all = where(count, [](std::size_t) { return true; });
  std::vector<Showing> showings{{Kind::known, all, all}};
  const auto leave_out = [&](Kind kind, const std::vector<int>& of) {
    for (const int out : std::set(of.begin(), of.end())) {
      std::vector<int> shown = where(count, [&](std::size_t k) { return of[k] == out; });
      std::set<int> groups;
      for (const int k : shown) groups.insert(group[static_cast<std::size_t>(k)]);
      std::vector<int> kept =
          where(count, [&](std::size_t k) { return of[k] != out && !groups.contains(group[k]); });
      if (kept.size() >= 2) showings.push_back({kind, std::move(kept), std::move(shown)});
    }
  };
  leave_out(Kind::instance, group);
  leave_out(Kind::category, states.category_of);
  return showings;
}

/// In the first fold, which the models are of.
std::vector<int> unseen_in(const Calibration& calibration) {
  const Eigen::MatrixXf& density = calibration.held_out.log_density.front();
  std::vector<int> unseen;
  for (Eigen::Index state = 0; state < density.rows(); ++state) {
    if (density(state, calibration.folds.front().first) == kRuledOut) {
      unseen.push_back(static_cast<int>(state));
    }
  }
  return unseen;
}

/// Of a few objects, or by features that tell little, all may hang together as near-duplicates, and
/// none could be left out. Then only those that are more alike are taken for that, until half of
/// the objects can. Where some can, the others stay: left out, they would be explained by a twin.
/// Of fewer than five objects four would not be left to say what one more looks like.
std::vector<Showing> enough_showings(std::span<const ObservationModel> models,
                                     const ObjectStates& states, std::span<const int> unseen,
                                     int threads) {
  std::vector<Showing> showings;
  constexpr double kConfused = 0.01;
  constexpr int kFewest = 5;
  for (const double confused : {kConfused, 0.1, 0.25, 0.5}) {
    showings =
        showings_of(states, near_duplicate_groups(models, states, threads, unseen, confused));
    std::set<int> left_out;
    for (const Showing& showing : showings) {
      if (showing.kind != Kind::known) left_out.insert(showing.shown.begin(), showing.shown.end());
    }
    const bool enough = confused == kConfused || 2 * std::ssize(left_out) >= states.object_count();
    if ((!left_out.empty() && enough) || states.object_count() < kFewest) break;
  }
  return showings;
}

double log_mean(std::span<const double> logs) {
  return log_sum_exp(logs) - std::log(static_cast<double>(logs.size()));
}

/// One feature of the views held out of one fold.
struct FoldFeature {
  const Eigen::MatrixXf& log_density;  ///< states x all views held out
  const CalibrationFold& fold;
  std::size_t feature = 0;
  double psi = 1.0;
  ObjectMoments moments;
};

class Shower {
 public:
  Shower(const Calibration& calibration, std::span<const ViewFeatures> views,
         const ObjectStates& states)
      : calibration_(calibration), views_(views), states_(states) {}

  /// The views of the fold that the showing is about.
  [[nodiscard]] std::vector<ShownView> show(const FoldFeature& of, const Showing& showing) const {
    const BackgroundDensities background = background_densities(of.moments, states_, showing.kept);
    const PreparedObservationModel prepared = prepare(background.gaussians);
    std::vector<ShownView> shown;
    for (Eigen::Index i = of.fold.first; i < of.fold.first + of.fold.count; ++i) {
      const int object =
          states_.object_of(calibration_.held_out.state[static_cast<std::size_t>(i)]);
      if (!std::ranges::binary_search(showing.shown, object)) continue;
      const std::size_t view = calibration_.view[static_cast<std::size_t>(i)];
      const Eigen::VectorXd unknown =
          of.psi * log_likelihood(prepared, views_[view].features[of.feature].vector);
      if (auto one = seen(of, showing, background, i, unknown)) shown.push_back(*one);
    }
    return shown;
  }

 private:
  /// None: it is to be of a known category, and no other object of that is known.
  [[nodiscard]] std::optional<ShownView> seen(const FoldFeature& of, const Showing& showing,
                                              const BackgroundDensities& background, Eigen::Index i,
                                              const Eigen::VectorXd& unknown) const {
    const auto last = static_cast<std::size_t>(unknown.size()) - 1;
    const std::span<const double> instances(unknown.data(), last);
    ShownView shown{.kind = showing.kind,
                    .known = of_known(of, showing, i),
                    .instance = last > 0 ? log_mean(instances) : kImpossible,
                    .category = unknown[unknown.size() - 1]};
    if (showing.kind == Kind::instance) {
      const int object =
          states_.object_of(calibration_.held_out.state[static_cast<std::size_t>(i)]);
      const int category = states_.category_of[static_cast<std::size_t>(object)];
      const auto found = std::ranges::find(background.category, category);
      if (found == background.category.end()) return std::nullopt;
    }
    return shown;
  }

  /// As begin_recognition() has it: each object alike, in each of its bins that are seen.
  [[nodiscard]] double of_known(const FoldFeature& of, const Showing& showing,
                                Eigen::Index i) const {
    std::vector<double> logs;
    logs.reserve(showing.kept.size() * static_cast<std::size_t>(states_.bins));
    int objects = 0;
    for (const int k : showing.kept) {
      const auto densities = of.log_density.col(i).segment(states_.state(k, 0), states_.bins);
      const auto seen = (densities.array() != kRuledOut).count();
      if (seen == 0) continue;
      ++objects;
      const double share =
          seen < states_.bins
              ? std::log(static_cast<double>(states_.bins) / static_cast<double>(seen))
              : 0.0;
      for (const float density : densities) {
        if (density != kRuledOut) logs.push_back(of.psi * static_cast<double>(density) + share);
      }
    }
    if (logs.empty()) return of.psi * static_cast<double>(kRuledOut);
    return log_sum_exp(logs) - std::log(static_cast<double>(objects * states_.bins));
  }

  const Calibration& calibration_;
  std::span<const ViewFeatures> views_;
  const ObjectStates& states_;
};

constexpr double kHalf = 0.5;  ///< of all is known

/// Of the mean log posterior of what the views show, times -1.
struct Loss {
  double value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
};

/// @param weight of a view, by its kind
Loss loss_at(std::span<const ShownView> views, const std::array<double, 3>& weight,
             const Eigen::Vector2d& factors) {
  Loss loss;
  for (const ShownView& view : views) {
    const auto kind = static_cast<std::size_t>(view.kind);
    // As prior_belief() shares what is unknown.
    const double share = view.instance == kImpossible ? kHalf : 0.5 * kHalf;
    const std::array log_p{std::log(kHalf) + view.known,
                           std::log(share) + view.instance + factors[0],
                           std::log(share) + view.category + factors[1]};
    const double all = log_sum_exp(log_p);
    const Eigen::Vector2d p(std::exp(log_p[1] - all), std::exp(log_p[2] - all));
    const Eigen::Vector2d shown(view.kind == Kind::instance ? 1.0 : 0.0,
                                view.kind == Kind::category ? 1.0 : 0.0);
    loss.value += weight[kind] * (all - log_p[kind]);
    loss.gradient += weight[kind] * (p - shown);
    loss.curvature += weight[kind] * (Eigen::Matrix2d(p.asDiagonal()) - p * p.transpose());
  }
  return loss;
}

/// Known views count half together, each kind of unknown ones as much as the other.
std::array<double, 3> weights_of(std::span<const ShownView> views) {
  std::array<double, 3> count{};
  for (const ShownView& view : views) count[static_cast<std::size_t>(view.kind)] += 1.0;
  const double both = count[1] > 0.0 && count[2] > 0.0 ? 2.0 : 1.0;
  std::array<double, 3> weight{};
  for (std::size_t k = 0; k < count.size(); ++k) {
    if (count[k] > 0.0) weight[k] = kHalf / (k == 0 ? 1.0 : both) / count[k];
  }
  return weight;
}

/// Newton's step, no longer than it can be trusted.
Eigen::Vector2d step_of(const Loss& loss, bool one_factor) {
  constexpr double kRidge = 1e-9;
  Eigen::Vector2d step;
  if (one_factor) {
    step.setConstant(-loss.gradient.sum() / (loss.curvature.sum() + kRidge));
  } else {
    step = -(loss.curvature + kRidge * Eigen::Matrix2d::Identity()).inverse() * loss.gradient;
  }
  const double longest = step.cwiseAbs().maxCoeff();
  return longest > kLongestStep ? Eigen::Vector2d(step * (kLongestStep / longest)) : step;
}

}  // namespace

UnknownFactors most_likely_factors(std::span<const ShownView> shown) {
  const std::array<double, 3> weight = weights_of(shown);
  const bool one_factor = weight[1] == 0.0 || weight[2] == 0.0;
  Eigen::Vector2d factors = Eigen::Vector2d::Zero();
  Loss loss = loss_at(shown, weight, factors);
  for (int i = 0; i < kMostSteps; ++i) {
    Eigen::Vector2d step = step_of(loss, one_factor);
    Loss next = loss_at(shown, weight, factors + step);
    while (next.value > loss.value && step.norm() > 1e-9) {
      step *= 0.5;
      next = loss_at(shown, weight, factors + step);
    }
    factors += step;
    loss = next;
    if (step.norm() <= 1e-6) break;
  }
  return {.instance = factors[0], .category = factors[1]};
}

std::vector<std::optional<UnknownFactors>> calibrate_unknown(const Calibration& calibration,
                                                             std::span<const ViewFeatures> views,
                                                             const ObjectStates& states,
                                                             std::span<const double> psi,
                                                             const LongWork& how) {
  std::vector<std::optional<UnknownFactors>> factors(psi.size());
  if (states.object_count() < 3 || calibration.view.empty()) return factors;
  std::vector<ObservationModel> models = calibration.folds.front().models;
  for (std::size_t f = 0; f < models.size(); ++f) models[f].psi = psi[f];
  const std::vector<Showing> showings =
      enough_showings(models, states, unseen_in(calibration), how.threads);
  const Shower shower(calibration, views, states);
  for (std::size_t f = 0; f < psi.size(); ++f) {
    if (psi[f] == 0.0) {
      factors[f] = UnknownFactors{};  // says nothing of anything
      continue;
    }
    std::vector<ShownView> shown;
    for (const CalibrationFold& fold : calibration.folds) {
      const FoldFeature of{calibration.held_out.log_density[f], fold, f, psi[f],
                           object_moments(fold.models[f], states)};
      std::vector<std::vector<ShownView>> parts(showings.size());
      work_through(showings.size(), how, "calibrating what is unknown",
                   [&](std::size_t i) { parts[i] = shower.show(of, showings[i]); });
      for (const auto& part : parts) shown.insert(shown.end(), part.begin(), part.end());
    }
    const auto some = [&](Kind kind) {
      return std::ranges::count(shown, kind, &ShownView::kind) > 0;
    };
    if (!some(Kind::known) || !(some(Kind::category) || some(Kind::instance))) continue;
    const UnknownFactors tempered = most_likely_factors(shown);
    factors[f] = {.instance = tempered.instance / psi[f], .category = tempered.category / psi[f]};
  }
  return factors;
}

}  // namespace vantage
