#include "vantage/recognition/dataset/few_views.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vantage {
namespace {

/// Best log density of each object.
Eigen::VectorXf by_object(const Eigen::MatrixXf& log_density, Eigen::Index view, int bins) {
  Eigen::VectorXf best(log_density.rows() / bins);
  for (Eigen::Index k = 0; k < best.size(); ++k) {
    best[k] = log_density.col(view).segment(k * bins, bins).maxCoeff();
  }
  return best;
}

/// The state of the object, other than the true one, that comes next.
int second_state(const Eigen::MatrixXf& log_density, Eigen::Index view, int truth, int bins) {
  int best = -1;
  for (Eigen::Index state = 0; state < log_density.rows(); ++state) {
    if (state / bins == truth / bins) continue;
    if (best < 0 || log_density(state, view) > log_density(best, view)) {
      best = static_cast<int>(state);
    }
  }
  return best;
}

/// Of the true object before the best other one.
double lead(const Eigen::MatrixXf& log_density, Eigen::Index view, int truth, int bins) {
  Eigen::VectorXf best = by_object(log_density, view, bins);
  const float own = best[truth / bins];
  best[truth / bins] = -INFINITY;
  return static_cast<double>(own - best.maxCoeff());
}

void append(Eigen::MatrixXf& densities, Eigen::Index view) {
  const Eigen::VectorXf copy = densities.col(view);
  densities.conservativeResize(Eigen::NoChange, densities.cols() + 1);
  densities.col(densities.cols() - 1) = copy;
}

}  // namespace

void add_a_mistake(HeldOutViews& held_out) {
  const auto views = static_cast<Eigen::Index>(held_out.state.size());
  const int bins = held_out.bins;
  if (views == 0 || held_out.log_density.front().rows() <= bins) return;
  // A view for all features: psi are adjusted to each other as well.
  std::vector<std::pair<double, Eigen::Index>> leads;
  for (Eigen::Index v = 0; v < views; ++v) {
    double sum = 0.0;
    for (const Eigen::MatrixXf& density : held_out.log_density) {
      const double of_feature = lead(density, v, held_out.state[static_cast<std::size_t>(v)], bins);
      sum += std::clamp(of_feature, -1e6, 1e6) / static_cast<double>(density.rows());
    }
    leads.emplace_back(sum, v);
  }
  std::ranges::sort(leads);
  const Eigen::Index median = leads[leads.size() / 2].second;
  const int truth = held_out.state[static_cast<std::size_t>(median)];
  const int second = second_state(held_out.log_density.front(), median, truth, bins);
  for (Eigen::MatrixXf& density : held_out.log_density) append(density, median);
  held_out.state.push_back(second);
}

LogObject log_object(const HeldOutViews& held_out, std::span<const double> psi, std::size_t views) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t v = 0; v < views; ++v) {
    Eigen::VectorXd logs = Eigen::VectorXd::Zero(held_out.log_density.front().rows());
    for (std::size_t f = 0; f < psi.size(); ++f) {
      logs += psi[f] * held_out.log_density[f].col(static_cast<Eigen::Index>(v)).cast<double>();
    }
    const Eigen::VectorXd p = (logs.array() - logs.maxCoeff()).exp();
    const int first = held_out.state[v] / held_out.bins * held_out.bins;
    const double log = std::log(std::max(p.segment(first, held_out.bins).sum() / p.sum(), 1e-12));
    sum += log;
    squares += log * log;
  }
  if (views == 0) return {};
  const auto n = static_cast<double>(views);
  const double variance = std::max(squares / n - (sum / n) * (sum / n), 0.0);
  return {.mean = sum / n, .standard_error = std::sqrt(variance / n)};
}

}  // namespace vantage
