/// What optimised paths are compared with: only the heading follows the objects, or the path goes
/// through their nearest views without weighing anything.
#pragma once

#include <span>

#include "vantage/planners/trajectory/observation_ring.hpp"
#include "vantage/planners/trajectory/optimisers/horizon.hpp"

namespace vantage {

struct YawToTarget {
  double tau_nats = 0.1;
  double range_m = 3.0;
  void fields(auto&& f) {
    f("tau_nats", tau_nats,
      "entropy of an object below which it is known and not looked at; higher is satisfied sooner",
      at_least(0.0));
    f("range_m", range_m,
      "greatest horizontal distance of objects that are looked at; higher turns to them earlier",
      above(0.0));
  }
};

/// The same places; where an object that is not yet known is in range the waypoint heads for the
/// nearest one, elsewhere it keeps its heading. `initial_yaw`.
Eigen::Matrix4Xd initial_yaw(const Eigen::Matrix4Xd& waypoints,
                             std::span<const ObservedObject> objects,
                             const YawToTarget& options = {});

struct GreedyDetour {
  double tau_nats = 0.1;
  double range_m = 3.0;
  int views = 2;
  void fields(auto&& f) {
    f("tau_nats", tau_nats,
      "entropy of an object below which it is known and passed by; higher is satisfied sooner",
      at_least(0.0));
    f("range_m", range_m,
      "greatest horizontal distance of objects that are visited; higher turns to them earlier",
      above(0.0));
    f("views", views,
      "greatest number of views of an object within one horizon; higher goes farther round it",
      between(1, kObservationDirections));
  }
};

/// `initial_yaw` of a path that takes views of the active object on its way: of the unused ones
/// that it comes by those nearest it, each in place of the waypoint nearest it. Both ends stay.
Eigen::Matrix4Xd greedy_detour(const Horizon& horizon, std::span<const ObservedObject> objects,
                               const GreedyDetour& options = {});

}  // namespace vantage
