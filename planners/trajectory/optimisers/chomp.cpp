#include "vantage/planners/trajectory/optimisers/chomp.hpp"

#include <algorithm>

#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {
namespace {

constexpr Eigen::Index kStride = 3;          // points so far apart share no neighbour
constexpr int kGradient = 4 * int{kStride};  // evaluations

Eigen::Vector4d acceleration(const Horizon& horizon, Eigen::Index i) {
  return horizon.point(i - 1) - 2.0 * horizon.point(i) + horizon.point(i + 1);
}

/// Length of the step of the point that moves most, in units of `scale`.
double longest_move(const Eigen::Matrix4Xd& step, const Eigen::Vector4d& scale) {
  double longest = 0.0;
  for (Eigen::Index d = 0; d < 4; ++d) {
    if (scale[d] <= 0.0) continue;  // it does not move there
    longest = std::max(longest, step.row(d).cwiseAbs().maxCoeff() / scale[d]);
  }
  return longest;
}

}  // namespace

PathGradient::PathGradient(Eigen::Index free_points)
    : gradient_(4, free_points), moved_(4, free_points), cost_here_(free_points + 2) {}

const Eigen::Matrix4Xd& PathGradient::operator()(PathSearch& search,
                                                 const Eigen::Matrix4Xd& free_points,
                                                 double difference) {
  const Eigen::Index n = free_points.cols();
  for (Eigen::Index t = 0; t < n; ++t) {  // A' (A Q + b)
    gradient_.col(t) = acceleration(search.tried(), t) - 2.0 * acceleration(search.tried(), t + 1) +
                       acceleration(search.tried(), t + 2);
  }
  cost_here_ = search.state_cost_of_point();
  for (Eigen::Index first = 0; first < std::min(kStride, n); ++first) {
    for (Eigen::Index d = 0; d < 4; ++d) {
      moved_ = free_points;
      for (Eigen::Index t = first; t < n; t += kStride) moved_(d, t) += difference;
      search.evaluate(moved_);
      for (Eigen::Index t = first; t < n; t += kStride) {  // its points are t, t + 1 and t + 2
        gradient_(d, t) +=
            (search.state_cost_of_point() - cost_here_).segment(t, 3).sum() / difference;
      }
    }
  }
  return gradient_;
}

OptimisedHorizon Chomp::operator()(const Horizon& horizon, const PathCost& cost, Rng&) const {
  PathSearch search(horizon, cost);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return search.result();
  const Smoothness smoothness(n);
  const Eigen::Vector4d scale(scale_m[0], scale_m[1], scale_m[2], scale_yaw_rad);
  PathGradient gradient_at(n);
  Eigen::Matrix4Xd mean = search.nominal();
  Eigen::Matrix4Xd trial = mean;
  Eigen::Matrix4Xd downhill;
  double here = search.best_cost();
  double step = first_step;
  bool better = true;
  while (better && search.evaluations() + kGradient < evaluations) {
    const Eigen::Matrix4Xd& gradient = gradient_at(search, mean, difference);
    downhill.noalias() = -gradient.lazyProduct(smoothness.covariance());
    downhill.array().colwise() *= scale.array().square();
    const double longest = longest_move(downhill, scale);
    if (longest <= 0.0) break;
    better = false;
    while (!better && step >= min_step && search.evaluations() < evaluations) {
      trial = mean + step / longest * downhill;
      const double there = search.evaluate(trial);
      better = there < here;
      if (better) {
        mean = trial;
        here = there;
      }
      step *= better ? 1.5 : 0.5;
    }
  }
  return search.result();
}

}  // namespace vantage
