// Decisions of the parts that all mapping tasks share: what views are worth, and which is taken.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "vantage/core/log.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/tours/joint_gain.hpp"
#include "vantage/tasks/mapping/mapping_parts.hpp"
#include "vantage/tasks/mapping/outside_decision.hpp"

namespace vantage {

/// Whether the plan of several views works out gains of all of them anyway.
bool MappingParts::plan_has_gains() const {
  return outside_ == nullptr && plans_views(options_.choice) && !knows_truth(options_.choice);
}

void MappingParts::score(std::vector<Candidate>& candidates) {
  budget_.leave_affordable(candidates);
  if (!views_have_gains_ && !plan_has_gains() &&
      (weighs_gain(options_.choice) || outside_ != nullptr || recorder_.logs_events())) {
    const auto gains = gains_bits(options_.gain, candidates, episode_.threads);
    for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].gain_bits = gains[i];
  }
  tell_truth(candidates);
}

/// What each view will really show, for the choices that are meant to know.
void MappingParts::tell_truth(std::vector<Candidate>& candidates) const {
  if (!knows_truth(options_.choice)) return;
  const KnownCells known = known_cells(belief_.grid());
  if (std::holds_alternative<OracleView>(options_.choice)) {
    for (Candidate& view : candidates) {
      view.true_new_cells =
          static_cast<double>(evaluator_.true_new_cells(known, view.T_world_sensor));
    }
  } else {
    for (Candidate& view : candidates) {
      view.true_new_cell_set =
          std::make_shared<CellSet>(evaluator_.true_new_cell_set(known, view.T_world_sensor));
    }
  }
}

/// Where `oracle_tour` may scan from; none of another choice.
std::span<const Pose> MappingParts::poses_of_truth() const {
  if (!std::holds_alternative<OracleTour>(options_.choice)) return {};
  return evaluator_.observing_poses();
}

std::vector<Candidate> MappingParts::views_of_truth(const PathField& paths, bool in_reach) const {
  std::vector<Candidate> views;
  for (const Pose& T_world_sensor : poses_of_truth()) {
    Candidate view;
    view.id = static_cast<int>(views.size());
    view.T_world_sensor = T_world_sensor;
    view.path_length_m = path_length_m(paths, robot_.base_for_sensor(T_world_sensor));
    if (std::isfinite(view.path_length_m) == in_reach) views.push_back(view);
  }
  return views;
}

std::size_t MappingParts::choose(std::vector<Candidate>& candidates) {
  tour_ = {};
  const std::size_t chosen =
      outside_ != nullptr ? chosen_outside(candidates) : own_choice(candidates);
  current_.candidates = candidates.size();
  current_.plan_time_s = wall_s() - decision_start_s_;
  recorder_.decision(candidates, chosen, options_.gain);
  // A choice from outside may have asked for a plan and not taken it.
  if (!tour_.stops.empty() && tour_.stops.front().id != candidates[chosen].id) tour_ = {};
  const bool in_cells = knows_truth(options_.choice) || predicts_cells(options_.gain);
  recorder_.plan(tour_,
                 {scans_.size() + 1, robot_.time_s(), in_cells ? "cells" : unit_of(options_.gain)});
  return chosen;
}

int MappingParts::scans_left() const {
  return std::max(0, options_.scans - static_cast<int>(scans_.size()));
}

std::size_t MappingParts::own_choice(std::vector<Candidate>& candidates) {
  if (asks_outside(options_.choice)) {
    throw ConfigError("choice: external is a program that is not asked here");
  }
  const ViewChoice choice = within_scans_left(options_.choice, std::max(1, scans_left()));
  return plans_views(choice) ? next_of_plan(candidates)
                             : choose_view(choice, candidates, choice_rng_);
}

/// A pose that is no candidate is one from now on.
std::size_t MappingParts::chosen_outside(std::vector<Candidate>& candidates) {
  const BlockField of_unobserved = transmission();
  const std::size_t chosen = decide_outside(
      *outside_, {belief_, of_unobserved, robot_, budget_, scans_.size(), scans_left(), &interval_},
      *navigator_.plan(), options_.gain, [&] { return own_choice(candidates); }, candidates);
  for (std::size_t i = views_.size(); i < candidates.size(); ++i) views_.push_back(candidates[i]);
  return chosen;
}

void MappingParts::end(const std::vector<Candidate>& views) {
  if (outside_ != nullptr && outside_->ended) {
    const BlockField of_unobserved = transmission();
    const bool at_limit = !views.empty() && (scans_left() == 0 || !budget_.affords_any(views));
    outside_->ended(
        map_situation({belief_, of_unobserved, robot_, budget_, scans_.size(), scans_left()}),
        at_limit);
  }
  budget_.come_home();
}

double MappingParts::expected_left_cells(const std::vector<Candidate>& views) {
  const BlockField of_unobserved = transmission();
  const auto planned = navigator_.plan();
  const PathField& paths = *planned;
  MappingOptions options = options_;
  options.choice = TourChoice{};
  const PlanningProblem problem = planning_problem(options, AdaptiveGain{}, views,
                                                   {.belief = belief_,
                                                    .transmission = of_unobserved,
                                                    .robot = robot_,
                                                    .paths = paths,
                                                    .budget = budget_,
                                                    .threads = episode_.threads});
  std::vector<std::size_t> all(problem.views());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return joint_gain(problem, all);
}

/// By the gain in use, or by `adaptive` where that says nothing of directions.
Lookout MappingParts::lookout(const OccupancyGrid& grid, const Pose& T_world_sensor) const {
  const Gain gain = can_sweep(options_.gain) ? options_.gain : Gain{AdaptiveGain{}};
  const BlockField of_unobserved = transmission();
  return {.grid = grid,
          .attenuation = attenuation_of(gain, {grid, &of_unobserved}),
          .field_of_view = robot_.view_field(),
          .T_world_sweep = T_world_sensor,
          .block_m = options_.planning.block_m};
}

std::vector<std::size_t> MappingParts::images_worth_taking(const Pose& T_world_sensor,
                                                           double way_s) const {
  return worthwhile_images(*partial_scans_, {lookout(belief_.filled_grid(), T_world_sensor),
                                             budget_.rates().scan_s(), way_s});
}

/// Where no view can be planned for, the nearest one: navigation goes as near as it can.
std::size_t MappingParts::next_of_plan(std::vector<Candidate>& candidates) {
  const BlockField of_unobserved = transmission();
  const auto planned = navigator_.plan();
  const PathField& paths = *planned;
  PlanningSituation situation{.belief = belief_,
                              .transmission = of_unobserved,
                              .robot = robot_,
                              .paths = paths,
                              .budget = budget_,
                              .threads = episode_.threads,
                              .scans_left = static_cast<std::size_t>(std::max(1, scans_left())),
                              .partial_scans = partial_scans_ ? &*partial_scans_ : nullptr,
                              .former = former_,
                              .intended_m = intended_m_};
  std::vector<Candidate> later;
  if (!poses_of_truth().empty() && evaluator_.true_paths() != nullptr) {
    later = views_of_truth(paths, false);
    tell_truth(later);
    situation.later = later;
    if (!true_ways_) true_ways_.emplace(*evaluator_.true_paths());
    situation.true_ways = &*true_ways_;
  }
  MappingPlan plan = plan_ahead(options_, candidates, situation, choice_rng_);
  former_ = FormerPlan::ended;
  intended_m_.reset();
  if (plan.tour.stops.size() > 1) {
    former_ = FormerPlan::goes_on;
    intended_m_ = plan.tour.stops[1].place_m;
  }
  tour_ = std::move(plan.tour);
  if (plan_has_gains()) {
    for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].gain_bits = plan.gains[i];
  }
  if (!plan.order.empty()) return plan.order.front();
  return choose_view(NearestFrontier{}, candidates, choice_rng_);
}

}  // namespace vantage
