/// CHOMP: covariant gradient descent, in the metric of smooth paths.
#pragma once

#include <array>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/trajectory/optimisers/path_search.hpp"

namespace vantage {

/// Q -= step R^-1 (grad J + R Q + A' b). The gradient of the control cost is exact, that of the
/// points' costs is by forward differences: as these depend on a point's neighbours at most, every
/// third point is moved at once and 3 x 4 evaluations make a gradient. They count like any other.
/// A step that makes it worse is halved, one that helps grows. Needs no random numbers.
struct Chomp {
  static constexpr std::string_view name = "covariant_gradient";
  static constexpr StrategyText text{
      .summary =
          "CHOMP: descends the gradient of the cost, by finite differences, in the metric of "
          "smooth paths. Needs no random numbers; settles in the nearest minimum.",
      .formula = "Q <- Q - eta R^-1 grad J",
      .source = "Ratliff2009"};
  int evaluations = 1001;
  double first_step = 0.5;
  double min_step = 1e-4;
  double difference = 1e-4;
  std::array<double, 3> scale_m{0.5, 0.5, 0.2};
  double scale_yaw_rad = 0.5;
  void fields(auto&& f) {
    f("evaluations", evaluations,
      "greatest number of evaluations of a path's cost, fewer where no step downhill is left; "
      "higher settles better and takes longer",
      between(1, 1'000'000));
    f("first_step", first_step,
      "length of the first step, that of the point that moves most as a share of `scale_m` and "
      "`scale_yaw_rad`; higher moves farther at first",
      above(0.0));
    f("min_step", min_step,
      "length of a step, measured likewise, below which it ends; lower settles better", above(0.0));
    f("difference", difference,
      "finite difference of the gradient, in m and rad; higher looks past kinks and is less exact",
      between(1e-9, 0.1));
    f("scale_m", scale_m,
      "scale of motion along x, y and z: steps are in proportion to its square; 0: does not move "
      "along that axis",
      at_least(0.0));
    f("scale_yaw_rad", scale_yaw_rad,
      "scale of motion in yaw: steps are in proportion to its square; 0: yaw stays", at_least(0.0));
  }
  OptimisedHorizon operator()(const Horizon& horizon, const PathCost& cost, Rng& rng) const;
};

/// Gradients of a path's cost, control included. Allocates once.
class PathGradient {
 public:
  explicit PathGradient(Eigen::Index free_points);

  /// 4 x n, at the free points that `search` has just evaluated; takes 12 evaluations.
  const Eigen::Matrix4Xd& operator()(PathSearch& search, const Eigen::Matrix4Xd& free_points,
                                     double difference);

 private:
  Eigen::Matrix4Xd gradient_;
  Eigen::Matrix4Xd moved_;
  Eigen::VectorXd cost_here_;
};

}  // namespace vantage
