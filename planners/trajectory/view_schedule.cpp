#include "vantage/planners/trajectory/view_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Level, from the first waypoint to each.
std::vector<double> lengths_m(const Eigen::Matrix4Xd& waypoints) {
  std::vector<double> run_m{0.0};
  for (Eigen::Index i = 1; i < waypoints.cols(); ++i) {
    run_m.push_back(run_m.back() + (waypoints.col(i) - waypoints.col(i - 1)).head<2>().norm());
  }
  return run_m;
}

double length_at_m(const std::vector<double>& run_m, double at) {
  const auto before = std::min(static_cast<std::size_t>(at), run_m.size() - 1);
  const auto after = std::min(before + 1, run_m.size() - 1);
  return run_m[before] + (at - static_cast<double>(before)) * (run_m[after] - run_m[before]);
}

}  // namespace

std::vector<ScheduledView> schedule_views(const ViewsOnTheWay& options,
                                          std::span<const ObservedObject> objects,
                                          const Eigen::Matrix4Xd& remaining, double tau_nats) {
  expects(remaining.cols() > 0, "a path has waypoints");
  const std::vector<double> run_m = lengths_m(remaining);
  const Eigen::Matrix4Xd level = levelled(remaining);  // what is left is how far aside a view is
  std::vector<ScheduledView> candidates;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObservedObject& object = objects[i];
    if (object.entropy_nats < tau_nats) continue;
    for (int d = 0; d < kObservationDirections; ++d) {
      const auto at_d = static_cast<std::size_t>(d);
      if (object.used[at_d]) continue;
      const OnPath on_path = nearest_on_path(level, levelled(object.ring.view_m(d)));
      if (on_path.distance_m > options.reach_m) continue;
      const double utility = std::min(object.gain_nats[at_d], object.entropy_nats) *
                             std::exp2(-on_path.distance_m / options.off_m);
      candidates.push_back({i, d, length_at_m(run_m, on_path.at), utility});
    }
  }
  std::ranges::stable_sort(candidates, std::greater{}, &ScheduledView::utility);
  std::vector<ScheduledView> views;
  std::vector<double> told_nats(objects.size(), 0.0);
  for (const ScheduledView& candidate : candidates) {
    const ObservedObject& object = objects[candidate.object];
    const bool enough = told_nats[candidate.object] > object.entropy_nats - tau_nats;
    const bool meets_another = std::ranges::any_of(views, [&](const ScheduledView& view) {
      return std::abs(view.at_m - candidate.at_m) < options.apart_m;
    });
    if (enough || meets_another) continue;
    told_nats[candidate.object] += object.gain_nats[static_cast<std::size_t>(candidate.direction)];
    views.push_back(candidate);
  }
  std::ranges::stable_sort(views, {}, &ScheduledView::at_m);
  return views;
}

std::vector<std::optional<std::size_t>> views_of_points(const ViewsOnTheWay& options,
                                                        std::span<const ScheduledView> views,
                                                        const Eigen::Matrix4Xd& remaining) {
  const std::vector<double> run_m = lengths_m(remaining);
  std::vector<std::optional<std::size_t>> of_point(run_m.size());
  for (std::size_t i = 0; i < run_m.size(); ++i) {
    double nearest = 1.0;  // in units of how long before and after
    for (std::size_t v = 0; v < views.size(); ++v) {
      const double to_go_m = views[v].at_m - run_m[i];
      const double away = to_go_m >= 0.0 ? to_go_m / std::max(options.before_m, 1e-9)
                                         : -to_go_m / std::max(options.after_m, 1e-9);
      if (away > nearest) continue;
      nearest = away;
      of_point[i] = v;
    }
  }
  return of_point;
}

}  // namespace vantage
