#include "vantage/belief/observation/gaussian_statistics.hpp"

#include <algorithm>

namespace vantage {
namespace {

/// Keeps densities finite where all views of all states are the same.
constexpr double kSmallestVariance = 1e-12;

struct Moments {
  Eigen::ArrayXd mean;
  Eigen::ArrayXd variance;
};

std::size_t index_of(Eigen::Index state) { return static_cast<std::size_t>(state); }

Eigen::ArrayXd mean_of(const GaussianStatistics& statistics, Eigen::Index state) {
  return statistics.mean.col(state).cast<double>().array();
}

/// Of the means of those states in [begin, end) that have views; empty if none has.
Moments moments_between(const GaussianStatistics& statistics, Eigen::Index begin,
                        Eigen::Index end) {
  Moments moments;
  double states = 0.0;
  for (Eigen::Index j = begin; j < end; ++j) {
    if (statistics.count[index_of(j)] == 0) continue;
    const Eigen::ArrayXd mean = mean_of(statistics, j);
    if (states == 0.0) moments = {.mean = 0.0 * mean, .variance = 0.0 * mean};
    states += 1.0;
    const Eigen::ArrayXd change = mean - moments.mean;
    moments.mean += change / states;
    moments.variance += change * (mean - moments.mean);
  }
  if (states > 0.0) moments.variance /= states;
  return moments;
}

/// s_pool^2 of each dimension: within states, between them where no state has two views.
Eigen::ArrayXd pooled_variance(const GaussianStatistics& statistics) {
  Eigen::ArrayXd deviation = Eigen::ArrayXd::Zero(statistics.dimensions());
  double freedom = 0.0;
  for (Eigen::Index j = 0; j < statistics.states(); ++j) {
    freedom += std::max(statistics.count[index_of(j)] - 1, 0);
    deviation += statistics.squared_deviation.col(j).cast<double>().array();
  }
  if (freedom > 0.0) return deviation / freedom;
  return moments_between(statistics, 0, statistics.states()).variance;
}

/// What is known of a state without views.
Moments guessed(const GaussianStatistics& statistics, Eigen::Index state, Eigen::Index bins,
                const Eigen::ArrayXd& pooled) {
  const Eigen::Index first = state - state % bins;
  Moments moments = moments_between(statistics, first, first + bins);
  if (moments.mean.size() == 0) moments = moments_between(statistics, 0, statistics.states());
  moments.variance += pooled;
  return moments;
}

}  // namespace

GaussianStatistics empty_statistics(int dimensions, int states) {
  expects(dimensions >= 1 && states >= 0, "statistics have dimensions");
  GaussianStatistics statistics;
  statistics.mean.resize(dimensions, 0);
  statistics.squared_deviation.resize(dimensions, 0);
  add_states(statistics, states);
  return statistics;
}

void add_states(GaussianStatistics& statistics, int states) {
  expects(states >= 0, "states are added, never taken away");
  const Eigen::Index total = statistics.mean.cols() + states;
  statistics.mean.conservativeResize(Eigen::NoChange, total);
  statistics.mean.rightCols(states).setZero();
  statistics.squared_deviation.conservativeResize(Eigen::NoChange, total);
  statistics.squared_deviation.rightCols(states).setZero();
  statistics.count.resize(index_of(total), 0);
}

void add_view(GaussianStatistics& statistics, int state,
              const Eigen::Ref<const Eigen::VectorXf>& feature) {
  expects(state >= 0 && state < statistics.states(), "a state of the statistics");
  expects(feature.size() == statistics.dimensions(), "a feature of as many dimensions");
  expects(feature.allFinite(), "a feature of finite numbers");
  const int count = ++statistics.count[index_of(state)];
  const Eigen::ArrayXd x = feature.cast<double>().array();
  const Eigen::ArrayXd before = mean_of(statistics, state);
  const Eigen::ArrayXd after = before + (x - before) / count;
  statistics.mean.col(state) = after.cast<float>();
  statistics.squared_deviation.col(state) += ((x - before) * (x - after)).cast<float>().matrix();
}

void merge(GaussianStatistics& statistics, const GaussianStatistics& other) {
  expects(statistics.dimensions() == other.dimensions() && statistics.states() == other.states(),
          "statistics of the same dimensions and states");
  for (Eigen::Index j = 0; j < statistics.states(); ++j) {
    const double added = other.count[index_of(j)];
    if (added == 0.0) continue;
    const double total = statistics.count[index_of(j)] + added;
    const Eigen::ArrayXd before = mean_of(statistics, j);
    const Eigen::ArrayXd change = mean_of(other, j) - before;
    statistics.mean.col(j) = (before + change * (added / total)).cast<float>();
    statistics.squared_deviation.col(j) +=
        other.squared_deviation.col(j) +
        (change.square() * (added * (total - added) / total)).cast<float>().matrix();
    statistics.count[index_of(j)] = static_cast<int>(total);
  }
}

Eigen::ArrayXd ShrunkVariance::operator()(int count, const Eigen::ArrayXd& squared_deviation,
                                          const Eigen::ArrayXd& pooled) const {
  return (nu0 * pooled + squared_deviation) / (nu0 + count - 1.0);
}

Eigen::ArrayXd LiteralVariance::operator()(int count, const Eigen::ArrayXd& squared_deviation,
                                           const Eigen::ArrayXd& pooled) const {
  return count > 1 ? Eigen::ArrayXd(squared_deviation / count) : pooled;
}

ObservationModel make_observation_model(const GaussianStatistics& statistics, int bins,
                                        const VarianceEstimate& estimate) {
  expects(bins >= 1 && statistics.states() % bins == 0, "whole objects of `bins` states");
  std::visit([](const auto& e) { check_options(e, "variance"); }, estimate);
  if (std::ranges::all_of(statistics.count, [](int count) { return count == 0; })) {
    throw InputError("training: no state has a view");
  }
  const Eigen::ArrayXd pooled = pooled_variance(statistics);
  const double share = std::visit([](const auto& e) { return e.floor; }, estimate);
  const double least = std::max(share * pooled.mean(), kSmallestVariance);
  ObservationModel model;
  model.mean = statistics.mean;
  model.variance.resizeLike(statistics.mean);
  for (Eigen::Index j = 0; j < statistics.states(); ++j) {
    const int count = statistics.count[index_of(j)];
    Moments moments;
    if (count == 0) {
      moments = guessed(statistics, j, bins, pooled);
      model.mean.col(j) = moments.mean.cast<float>();
    } else {
      const auto deviation = statistics.squared_deviation.col(j).cast<double>().array();
      moments.variance =
          std::visit([&](const auto& e) { return e(count, deviation, pooled); }, estimate);
    }
    model.variance.col(j) = moments.variance.max(least).cast<float>();
  }
  return model;
}

}  // namespace vantage
