#include "planners/trajectory/covariant_gradient.hpp"

#include <algorithm>

#include "planners/trajectory/smoothness.hpp"

namespace vantage {
namespace {

constexpr Eigen::Index kStride = 3;          // points so far apart share no neighbour
constexpr int kGradient = 4 * int{kStride};  // evaluations

Eigen::Vector4d acceleration(const Horizon& horizon, Eigen::Index i) {
  return horizon.point(i - 1) - 2.0 * horizon.point(i) + horizon.point(i + 1);
}

}  // namespace

void path_gradient(PathSearch& search, const Eigen::Matrix4Xd& free_points, double difference,
                   Eigen::Matrix4Xd& gradient) {
  const Eigen::Index n = free_points.cols();
  for (Eigen::Index t = 0; t < n; ++t) {  // A' (A Q + b)
    gradient.col(t) = acceleration(search.tried(), t) - 2.0 * acceleration(search.tried(), t + 1) +
                      acceleration(search.tried(), t + 2);
  }
  const Eigen::VectorXd here = search.state_cost_of_point();
  Eigen::Matrix4Xd moved(4, n);
  for (Eigen::Index first = 0; first < std::min(kStride, n); ++first) {
    for (Eigen::Index d = 0; d < 4; ++d) {
      moved = free_points;
      for (Eigen::Index t = first; t < n; t += kStride) moved(d, t) += difference;
      search.evaluate(moved);
      for (Eigen::Index t = first; t < n; t += kStride) {  // its points are t, t + 1 and t + 2
        gradient(d, t) += (search.state_cost_of_point() - here).segment(t, 3).sum() / difference;
      }
    }
  }
}

OptimisedHorizon CovariantGradient::operator()(const Horizon& horizon, const PathCost& cost,
                                               Rng&) const {
  PathSearch search(horizon, cost);
  const Eigen::Index n = horizon.free_points();
  if (n == 0) return search.result();
  const Smoothness smoothness(n);
  const Eigen::Vector4d scale(scale_m[0], scale_m[1], scale_m[2], scale_yaw_rad);
  Eigen::Matrix4Xd mean = search.nominal();
  Eigen::Matrix4Xd gradient(4, n);
  Eigen::Matrix4Xd downhill(4, n);
  double here = search.best_cost();
  double step = first_step;
  while (search.evaluations() + kGradient < evaluations) {
    path_gradient(search, mean, difference, gradient);
    downhill = -(scale.cwiseAbs2().asDiagonal() * gradient * smoothness.covariance());
    // In units of `scale`; what does not move has none.
    double longest = 0.0;
    for (Eigen::Index d = 0; d < 4; ++d) {
      if (scale[d] > 0.0)
        longest = std::max(longest, downhill.row(d).cwiseAbs().maxCoeff() / scale[d]);
    }
    if (longest <= 0.0) break;
    downhill /= longest;
    bool better = false;
    while (!better && step >= least_step && search.evaluations() < evaluations) {
      const double there = search.evaluate(mean + step * downhill);
      better = there < here;
      if (better) {
        mean += step * downhill;
        here = there;
      }
      step *= better ? 1.5 : 0.5;
    }
    if (!better) break;
  }
  return search.result();
}

}  // namespace vantage
