/// Which views the next waypoints take: of all objects that the path comes by, one after the other.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/planners/trajectory/observation_ring.hpp"

namespace vantage {

/// The dissertation's: the nearest object, from its unused direction nearest the remaining path, at
/// every waypoint until it is known.  [Potthast2016, 5.2]
struct NearestObject {
  static constexpr std::string_view name = "nearest";
  void fields(auto&&) {}
};

/// Views by what they tell and how far off the path they are, each for as long as it takes; between
/// them the camera looks where the vehicle goes, which is how it finds what comes next.
struct ViewsOnTheWay {
  static constexpr std::string_view name = "on_the_way";
  double before_m = 1.0;
  double after_m = 0.4;
  double apart_m = 0.5;
  double off_m = 0.5;
  double reach_m = 0.7;
  void fields(auto&& f) {
    f("before_m", before_m, "along the path, that a view is turned to; higher looks ahead less",
      at_least(0.0));
    f("after_m", after_m, "that it is kept in view; higher looks ahead less", at_least(0.0));
    f("apart_m", apart_m, "along the path, between views; lower takes more on one pass",
      above(0.0));
    f("off_m", off_m, "distance from the path that halves what a view is worth", above(0.0));
    f("reach_m", reach_m, "views farther from the path are not taken; higher leaves it more",
      at_least(0.0));
  }
};

struct ScheduledView {
  std::size_t object = 0;
  int direction = 0;
  double at_m = 0.0;     ///< along the path
  double utility = 0.0;  ///< nats
};

/// In the order in which the path comes by. Of an object that is not yet known (H >= tau) so many
/// views, the worthiest first, as are expected to tell what it is.
/// @param remaining waypoints from the vehicle on, at least one
std::vector<ScheduledView> schedule_views(const ViewsOnTheWay& options,
                                          std::span<const ObservedObject> objects,
                                          const Eigen::Matrix4Xd& remaining, double tau_nats);

/// The view that each waypoint looks at: index into `views`, nothing between them.
std::vector<std::optional<std::size_t>> views_of_points(const ViewsOnTheWay& options,
                                                        std::span<const ScheduledView> views,
                                                        const Eigen::Matrix4Xd& remaining);

}  // namespace vantage
