#include "vantage/belief/observation/psi_rule.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kMinPsi = 1e-7;
constexpr double kMaxPsi = 10.0;
/// exp of less would be a denormal float, with which processors are slow.
constexpr float kNegligible = -60.0F;

/// ln p(state) = psi * score + base, up to its normalisation; states x views.
struct Regression {
  const Eigen::MatrixXf& score;
  const Eigen::MatrixXf& base;  ///< empty: zeros
  const std::vector<int>& state;
  int group = 1;  ///< so many consecutive states are one answer
};

/// Of the mean over views of ln p(true group of states), with respect to psi.
struct Derivatives {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

/// Of states with probabilities in proportion to exp(logit).
struct RuleMoments {
  double log_sum = 0.0;
  double mean = 0.0;  ///< of the scores, as the variance
  double variance = 0.0;
};

using Entries = Eigen::Ref<const Eigen::ArrayXf>;

RuleMoments moments_of(const Entries& logit, const Entries& score) {
  const float largest = logit.maxCoeff();
  Eigen::ArrayXf weight = (logit - largest).max(kNegligible).exp();
  const auto total = static_cast<double>(weight.sum());
  weight /= static_cast<float>(total);
  const float mean = (weight * score).sum();
  return {static_cast<double>(largest) + std::log(total), static_cast<double>(mean),
          static_cast<double>((weight * (score - mean).square()).sum())};
}

Derivatives derivatives_at(const Regression& regression, double psi) {
  Derivatives sum;
  Eigen::ArrayXf logit(regression.score.rows());
  for (Eigen::Index v = 0; v < regression.score.cols(); ++v) {
    const auto score = regression.score.col(v).array();
    logit = static_cast<float>(psi) * score;
    if (regression.base.size() > 0) logit += regression.base.col(v).array();
    const int truth = regression.state[static_cast<std::size_t>(v)];
    const Eigen::Index first = truth / regression.group * regression.group;
    const RuleMoments all = moments_of(logit, score);
    const RuleMoments own =
        moments_of(logit.segment(first, regression.group), score.segment(first, regression.group));
    sum.value += own.log_sum - all.log_sum;
    sum.first += own.mean - all.mean;
    sum.second += own.variance - all.variance;
  }
  const auto views = static_cast<double>(regression.score.cols());
  return {sum.value / views, sum.first / views, sum.second / views};
}

/// Where the first derivative is zero, or the end of the range that it points to: Newton's steps
/// as long as they stay between the bounds known so far, halving the exponent otherwise.
double most_likely_psi(const Regression& regression) {
  double low = kMinPsi;
  double high = kMaxPsi;
  if (derivatives_at(regression, high).first >= 0.0) return high;
  if (derivatives_at(regression, low).first <= 0.0) return low;
  double psi = std::sqrt(low * high);
  while (high / low > 1.0 + 1e-4) {
    const Derivatives at = derivatives_at(regression, psi);
    (at.first > 0.0 ? low : high) = psi;
    const double newton = psi - at.first / at.second;
    const bool inside = newton > low && newton < high;
    const double next = inside ? newton : std::sqrt(low * high);
    if (std::abs(next - psi) <= 1e-5 * psi) return next;
    psi = next;
  }
  return psi;
}

/// Scores relative to the best of each view, which changes no posterior, and bounded: a state that
/// is impossible is merely absurd, so that no product is 0 * inf.
Eigen::MatrixXf bounded(const Eigen::MatrixXf& log_density) {
  constexpr float kAbsurd = -1e9F;
  Eigen::MatrixXf scores = log_density;
  for (Eigen::Index v = 0; v < scores.cols(); ++v) {
    const float largest = scores.col(v).maxCoeff();
    if (std::isfinite(largest)) scores.col(v).array() -= largest;
  }
  return scores.cwiseMax(kAbsurd);
}

Eigen::MatrixXf weighted_sum(std::span<const Eigen::MatrixXf> scores, std::span<const double> psi) {
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(scores.front().rows(), scores.front().cols());
  for (std::size_t f = 0; f < scores.size(); ++f) sum += static_cast<float>(psi[f]) * scores[f];
  return sum;
}

void require_held_out(const HeldOutViews& held_out) {
  for (const Eigen::MatrixXf& density : held_out.log_density) {
    expects(density.cols() == static_cast<Eigen::Index>(held_out.state.size()),
            "a density for every view held out");
    expects(held_out.bins >= 1 && density.rows() % held_out.bins == 0, "states of whole objects");
    for (const int state : held_out.state) {
      expects(state >= 0 && state < density.rows(), "views of states that are modelled");
    }
  }
}

std::vector<Eigen::MatrixXf> scores_of(const HeldOutViews& held_out) {
  require_held_out(held_out);
  std::vector<Eigen::MatrixXf> scores;
  for (const Eigen::MatrixXf& density : held_out.log_density) scores.push_back(bounded(density));
  return scores;
}

}  // namespace

std::vector<double> CalibratedPsi::operator()(const PsiContext& context) const {
  const HeldOutViews& held_out = context.held_out;
  if (held_out.state.empty() || context.models.empty()) {
    throw InputError(
        "psi rule calibrated: no views were held out of training, there are too few: take more of "
        "each object, or another recording of them; psi=per_dimension needs none");
  }
  expects(held_out.log_density.size() == context.models.size(), "densities of every feature");
  const std::vector<Eigen::MatrixXf> scores = scores_of(held_out);
  const Eigen::MatrixXf none;
  // Of a single object nothing is to be known but its pose.
  const bool several_objects = scores.front().rows() > held_out.bins;
  const int group = about_object && several_objects ? held_out.bins : 1;
  std::vector<double> psi;
  for (const Eigen::MatrixXf& score : scores) {
    psi.push_back(most_likely_psi({score, none, held_out.state, group}));
  }
  if (psi.size() == 1) return psi;
  const double temperature =
      most_likely_psi({weighted_sum(scores, psi), none, held_out.state, group});
  for (double& p : psi) p *= temperature;
  for (int round = 0; round < joint_rounds; ++round) {
    for (std::size_t f = 0; f < psi.size(); ++f) {
      psi[f] = 0.0;
      const Eigen::MatrixXf others = weighted_sum(scores, psi);
      psi[f] = most_likely_psi({scores[f], others, held_out.state, group});
    }
  }
  return psi;
}

std::vector<double> PerDimensionPsi::operator()(const PsiContext& context) const {
  std::vector<double> psi;
  for (const ObservationModel& model : context.models) psi.push_back(1.0 / model.dimensions());
  return psi;
}

std::vector<double> DissertationPsi::operator()(const PsiContext& context) const {
  std::vector<double> psi;
  for (const ObservationModel& model : context.models) {
    psi.push_back(model.feature == "colour"         ? colour
                  : model.feature == "bounding_box" ? bounding_box
                  : model.feature == "sift"         ? sift
                  : model.feature == "vfh"          ? vfh
                                                    : other);
  }
  return psi;
}

std::vector<double> choose_psi(const PsiRule& rule, const PsiContext& context) {
  std::vector<double> psi = std::visit(
      [&](const auto& r) {
        check_options(r, "psi");
        return r(context);
      },
      rule);
  expects(psi.size() == context.models.size(), "a psi for every feature");
  return psi;
}

double mean_log_posterior(const HeldOutViews& held_out, std::span<const double> psi) {
  expects(psi.size() == held_out.log_density.size() && !held_out.state.empty(),
          "a psi for every feature, and views");
  const std::vector<Eigen::MatrixXf> scores = scores_of(held_out);
  const Eigen::MatrixXf none;
  return derivatives_at({weighted_sum(scores, psi), none, held_out.state}, 1.0).value;
}

}  // namespace vantage
