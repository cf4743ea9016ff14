/// What a trajectory optimiser is given, asks and hands back.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace vantage {

/// The waypoints that are optimised at once: x, y, z (m, world) and yaw (rad) a column.
struct Horizon {
  Eigen::Vector4d before = Eigen::Vector4d::Zero();  ///< the waypoint flown last
  Eigen::Matrix4Xd points;  ///< K of them; the first and the last are not moved
  Eigen::Vector4d after = Eigen::Vector4d::Zero();  ///< the next nominal one beyond

  [[nodiscard]] Eigen::Index count() const { return points.cols(); }
  [[nodiscard]] Eigen::Index free_points() const {
    return count() > 2 ? count() - 2 : Eigen::Index{0};
  }
  /// The i-th point, `before` for -1 and `after` for K.
  [[nodiscard]] Eigen::Vector4d point(Eigen::Index i) const {
    if (i < 0) return before;
    return i < count() ? Eigen::Vector4d(points.col(i)) : after;
  }
};

/// J(q_i) of each of the K points, finite; without the cost of control. What a point costs may
/// depend on it and on its two neighbours alone: gradients by differences rely on it.
using PathCost = std::function<void(const Horizon&, Eigen::Ref<Eigen::VectorXd> cost_of_point)>;

struct OptimisedHorizon {
  Eigen::Matrix4Xd points;    ///< the best that were seen; yaw in (-pi, pi] where it was free
  double cost = 0.0;          ///< of them, control included
  double initial_cost = 0.0;  ///< of the points that were given
  int evaluations = 0;        ///< calls of the cost
};

/// The same points, each yaw within half a turn of the one before it.
Horizon unwrapped(Horizon horizon);

}  // namespace vantage
