/// What optimisers share: evaluating paths, counting that, keeping the best.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "vantage/planners/trajectory/optimisers/horizon.hpp"

namespace vantage {

/// Standard deviations of noise at the most free point.
struct PathNoise {
  std::array<double, 3> sigma_m{0.5, 0.5, 0.2};  ///< x, y, z; higher looks further afield
  double sigma_yaw_rad = 0.5;                    ///< higher tries other headings
  double decay = 0.97;  ///< factor an iteration, (0, 1]; lower settles sooner

  [[nodiscard]] Eigen::Vector4d sigma() const {
    return {sigma_m[0], sigma_m[1], sigma_m[2], sigma_yaw_rad};
  }
};

/// Cost of a horizon as it is, control included.
double path_cost(const Horizon& horizon, const PathCost& cost);

/// The one of several starts, at least one, that costs least; of equal ones the first. Plans, once
/// bent, are slow to straighten: it is worth the few evaluations to ask whether the plan at hand is
/// still better to start from than the nominal path or the smoothest.
std::size_t cheapest(std::span<const Horizon> starts, const PathCost& cost);

/// Tries free points of one horizon. The first try is that of the given ones.
class PathSearch {
 public:
  PathSearch(const Horizon& nominal, const PathCost& cost);

  [[nodiscard]] const Eigen::Matrix4Xd& nominal() const { return nominal_free_; }

  /// Cost of the path with these 4 x n free points, control included.
  double evaluate(const Eigen::Ref<const Eigen::Matrix4Xd>& free_points);
  /// Of each of the K points at the last evaluation, control included; and without it.
  [[nodiscard]] const Eigen::VectorXd& cost_of_point() const { return cost_of_point_; }
  [[nodiscard]] const Eigen::VectorXd& state_cost_of_point() const { return state_cost_; }
  /// The horizon of the last evaluation.
  [[nodiscard]] const Horizon& tried() const { return tried_; }

  [[nodiscard]] double best_cost() const { return best_cost_; }
  [[nodiscard]] const Eigen::Matrix4Xd& best() const { return best_free_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

  [[nodiscard]] OptimisedHorizon result() const;

 private:
  const PathCost& cost_;
  Eigen::Matrix4Xd given_;
  Horizon tried_;
  Eigen::Matrix4Xd nominal_free_;
  Eigen::Matrix4Xd best_free_;
  Eigen::VectorXd state_cost_;
  Eigen::VectorXd cost_of_point_;
  double initial_cost_ = 0.0;
  double best_cost_ = 0.0;
  int evaluations_ = 0;
};

}  // namespace vantage
