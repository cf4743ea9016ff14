#include "vantage/planners/trajectory/optimisers/horizon.hpp"

#include "vantage/geometry/pose.hpp"

namespace vantage {

Horizon unwrapped(Horizon horizon) {
  double previous = horizon.before[3];
  const auto follow = [&](double& yaw) {
    previous += wrap_angle(yaw - previous);
    yaw = previous;
  };
  for (Eigen::Index i = 0; i < horizon.count(); ++i) follow(horizon.points(3, i));
  follow(horizon.after[3]);
  return horizon;
}

}  // namespace vantage
