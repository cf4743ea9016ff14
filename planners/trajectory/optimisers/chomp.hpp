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
/// [Ratliff2009]
struct Chomp {
  static constexpr std::string_view name = "covariant_gradient";
  int evaluations = 1001;
  double first_step = 0.5;
  double min_step = 1e-4;
  double difference = 1e-4;
  std::array<double, 3> scale_m{0.5, 0.5, 0.2};
  double scale_yaw_rad = 0.5;
  void fields(auto&& f) {
    f("evaluations", evaluations, "at most; fewer where no step downhill is left",
      between(1, 1'000'000));
    f("first_step", first_step, "of the point that moves most, as share of `scale`; > 0",
      above(0.0));
    f("min_step", min_step, "the same; smaller ones end it", above(0.0));
    f("difference", difference, "m or rad; higher looks past kinks, is less exact",
      between(1e-9, 0.1));
    f("scale_m", scale_m, "x, y, z move in proportion to its square", at_least(0.0));
    f("scale_yaw_rad", scale_yaw_rad, "the same of yaw", at_least(0.0));
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
