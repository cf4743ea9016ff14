/// Planning several views ahead in an episode: what the choice needs to know, and what it plans.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/choice/view_problem.hpp"
#include "vantage/planners/tours/planned_tour.hpp"
#include "vantage/tasks/mapping/driving/budget_keeper.hpp"
#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

struct PlanningSituation {
  const MapBelief& belief;
  const BlockField& transmission;
  const MobileRobotInterface& robot;
  const PathField& paths;
  const BudgetKeeper& budget;
  int threads;
  std::size_t scans_left = std::numeric_limits<std::size_t>::max();
  /// Of a choice that knows the truth: views that cannot be reached yet, and the ways as they
  /// really are.
  std::span<const Candidate> later = {};
  PathLengths* true_ways = nullptr;
  const PartialScans* partial_scans = nullptr;  ///< null: every scan is a whole one
  FormerPlan former = FormerPlan::none;
  std::optional<Eigen::Vector2d> intended_m = {};  ///< where the last plan wanted to scan next
};

/// What each candidate shows, exhausted ones left out, and the ways between them; behind them those
/// of `situation.later`.
/// @param gain what they are expected to show; with a choice that knows the truth, what they do
PlanningProblem planning_problem(const MappingOptions& options, const Gain& gain,
                                 const std::vector<Candidate>& candidates,
                                 const PlanningSituation& situation);

struct MappingPlan {
  /// Indices of candidates, exhausted ones left out, the next one first, up to the first that
  /// cannot be reached yet; empty if none can be taken.
  std::vector<std::size_t> order;
  PlannedTour tour;  ///< the same with times, and with what cannot be reached yet
  /// Per candidate, what it alone is expected to show, in the unit of the gain; 0 of exhausted
  /// ones.
  std::vector<double> gains;
};
/// @param options whose choice plans_views()
MappingPlan plan_ahead(const MappingOptions& options, const std::vector<Candidate>& candidates,
                       const PlanningSituation& situation, Rng& rng);

}  // namespace vantage
