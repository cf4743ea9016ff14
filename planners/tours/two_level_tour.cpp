#include "vantage/planners/tours/two_level_tour.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "vantage/planners/tours/joint_gain.hpp"
#include "vantage/planners/tours/view_route.hpp"

namespace vantage {
namespace {

using Views = std::vector<std::size_t>;

/// The view that adds most, again and again, until they show that share of what all would.
Views covering(const PlanningProblem& problem, Views views, double share) {
  const double enough = share * joint_gain(problem, views);
  JointGain shown(problem);
  Views chosen;
  while (!views.empty() && shown.total() < enough) {
    const auto best = std::ranges::max_element(
        views, {}, [&](std::size_t view) { return shown.of_adding(view); });
    if (shown.of_adding(*best) <= 0.0) break;  // rounding alone keeps it from all there is
    shown.add(*best);
    chosen.push_back(*best);
    views.erase(best);
  }
  return chosen;
}

/// Of each square of the floor, the view that shows most.
Views of_regions(const PlanningProblem& problem, const Views& views, double region_m) {
  std::map<std::pair<int, int>, std::size_t> best;
  for (const std::size_t view : views) {
    const Eigen::Array2i square = (problem.place_m[view] / region_m).array().floor().cast<int>();
    const auto [entry, is_new] = best.try_emplace({square.x(), square.y()}, view);
    if (!is_new && gain_of(problem, view) > gain_of(problem, entry->second)) entry->second = view;
  }
  Views representatives;
  for (const auto& [square, view] : best) representatives.push_back(view);
  return representatives;
}

/// The route through the near views that leads on to `next`: the shortest one with the way there.
Views joined_route(const PlanningProblem& problem, const Views& near, std::size_t next) {
  Views all = near;
  all.push_back(next);
  Views order = shortest_route(travel_between(problem, all, problem.here()), all.size() - 1);
  for (std::size_t& place : order) place = all[place];
  return order;
}

}  // namespace

PlannedViews TwoLevelTour::operator()(const PlanningProblem& problem, Rng& /*rng*/) const {
  Views near;
  Views far;
  for (const std::size_t view : affordable_views(problem)) {
    (problem.leg_s(problem.here(), view) <= horizon_s ? near : far).push_back(view);
  }
  Views shown_near = covering(problem, near, cover);
  // Where no view is expected to show anything, one is taken all the same.
  if (!shown_near.empty() || !far.empty()) near = std::move(shown_near);
  const Views regions = route_through(problem, of_regions(problem, far, region_m));
  if (regions.empty()) return {affordable_part(problem, route_through(problem, near))};
  Views order = joined_route(problem, near, regions.front());
  order.insert(order.end(), regions.begin() + 1, regions.end());
  return {affordable_part(problem, std::move(order))};
}

}  // namespace vantage
