/// Which views the next waypoints take: of all objects that the path comes by, one after the other.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/planners/trajectory/observation_ring.hpp"

namespace vantage {

struct NearestObject {
  static constexpr std::string_view name = "nearest";
  static constexpr StrategyText text{
      .summary =
          "Looks at the nearest object until it is known, from its unused direction nearest the "
          "remaining path: the dissertation's way.",
      .source = "Potthast2016, 5.2"};
  void fields(auto&&) {}
};

/// Each view lasts as long as it takes; between views the camera looks where the vehicle goes,
/// which is how it finds what comes next.
struct ViewsOnTheWay {
  static constexpr std::string_view name = "on_the_way";
  static constexpr StrategyText text{
      .summary =
          "Schedules views of all objects that the path comes by, those first that tell most and "
          "lie nearest to the path; between them the camera looks for further objects.",
      .formula =
          "worth of a view = min(gain, H) 2^(-d / off_m), H the object's entropy, d the view's "
          "distance from the path"};
  double before_m = 1.0;
  double after_m = 0.4;
  double apart_m = 0.5;
  double off_m = 0.5;
  double reach_m = 0.7;
  void fields(auto&& f) {
    f("before_m", before_m,
      "distance along the path before a view at which the camera turns to it; higher looks ahead "
      "less",
      at_least(0.0));
    f("after_m", after_m,
      "distance along the path after a view over which the camera stays on it; higher looks ahead "
      "less",
      at_least(0.0));
    f("apart_m", apart_m,
      "least distance along the path between views; lower takes more on one pass", above(0.0));
    f("off_m", off_m,
      "distance from the path that halves what a view is worth; higher minds detours less",
      above(0.0));
    f("reach_m", reach_m, "greatest distance of a view from the path; higher leaves the path more",
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
