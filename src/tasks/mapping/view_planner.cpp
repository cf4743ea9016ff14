#include "vantage/tasks/mapping/view_planner.hpp"

namespace vantage {
namespace {

/// A view so near to where one was intended looks at what that one would have.
constexpr double kSame_m = 1.5;

/// Stops are views of the problem: the open candidates, and behind them those of later.
PlannedTour tour_of(const PlanningProblem& problem, const PlannedViews& plan,
                    const std::vector<Candidate>& candidates, const std::vector<std::size_t>& open,
                    const PlanningSituation& situation) {
  PlannedTour tour = planned_tour(problem, situation.former, plan);
  for (std::size_t i = 0; i < tour.stops.size(); ++i) {
    const std::size_t i_view = plan.order[i];
    const bool later = i_view >= open.size();
    const Candidate& view =
        later ? situation.later[i_view - open.size()] : candidates[open[i_view]];
    if (!later) tour.stops[i].id = view.id;
    tour.stops[i].yaw_rad = situation.robot.base_for_sensor(view.T_world_sensor).yaw_rad;
  }
  return tour;
}

}  // namespace

PlanningProblem planning_problem(const MappingOptions& options, const Gain& gain,
                                 const std::vector<Candidate>& candidates,
                                 const PlanningSituation& situation) {
  std::vector<Candidate> views;
  std::vector<Eigen::Vector2d> places_m;
  for (const std::size_t i : open_candidates(candidates)) views.push_back(candidates[i]);
  views.insert(views.end(), situation.later.begin(), situation.later.end());
  for (const Candidate& view : views) {
    const Pose2 base = situation.robot.base_for_sensor(view.T_world_sensor);
    places_m.emplace_back(base.x_m, base.y_m);
  }
  const ViewPlanningInput input{.map = {situation.belief.filled_grid(), &situation.transmission},
                                .gain = gain,
                                .candidates = views,
                                .places_m = places_m,
                                .field_of_view = situation.robot.view_field(),
                                .paths = situation.paths,
                                .travel_time = situation.budget.rates().travel_time(),
                                .scan_s = situation.budget.rates().scan_s(),
                                .elapsed_s = situation.robot.time_s(),
                                .threads = situation.threads,
                                .partial_scans = situation.partial_scans,
                                .ways = situation.true_ways};
  PlanningProblem problem = knows_truth(options.choice)
                                ? make_true_view_problem(input, options.planning)
                                : make_view_problem(input, options.planning);
  if (situation.intended_m) problem.intended = view_near(problem, *situation.intended_m, kSame_m);
  problem.left = situation.budget.left();
  problem.left.scans = situation.scans_left;
  problem.home_s = situation.budget.home_s(places_m);
  problem.driving_w = situation.budget.rates().driving_w();
  problem.scanning_w = situation.budget.rates().scanning_w();
  return problem;
}

MappingPlan plan_ahead(const MappingOptions& options, const std::vector<Candidate>& candidates,
                       const PlanningSituation& situation, Rng& rng) {
  const PlanningProblem problem = planning_problem(options, options.gain, candidates, situation);
  const std::vector<std::size_t> open = open_candidates(candidates);
  const PlannedViews planned = plan_views(options.choice, problem, rng);
  MappingPlan plan;
  plan.gains.resize(candidates.size(), 0.0);
  for (std::size_t i = 0; i < open.size(); ++i) plan.gains[open[i]] = gain_of(problem, i);
  for (const std::size_t view : planned.order) {
    if (view >= open.size()) break;
    plan.order.push_back(open[view]);
  }
  if (!plan.order.empty()) plan.tour = tour_of(problem, planned, candidates, open, situation);
  return plan;
}

}  // namespace vantage
