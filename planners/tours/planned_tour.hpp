/// What a choice that plans ahead intends, stop by stop, and why that is what it intends now.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/planners/tours/planning_problem.hpp"

namespace vantage {

/// Why a plan begins where it does, against what the plan before intended.
enum class PlanChange : std::uint8_t {
  first,         ///< there was no plan before
  ended,         ///< the plan before intended no further view
  kept,          ///< the view that was intended next is taken
  gone,          ///< that view is no longer among those that can be taken
  exhausted,     ///< it is expected to show nothing new any more
  unreachable,   ///< no way leads there
  unaffordable,  ///< what is left does not pay for it, and for the way home where one is kept
  cheaper,       ///< another tour costs less than the best one found that begins there
  replanned      ///< the choice takes another view and weighs no tours that would tell why
};
inline constexpr std::size_t kPlanChanges = 9;

struct PlanReason {
  PlanChange change = PlanChange::first;
  /// Of `cheaper`: by how much, in s of the tour's cost. NaN of all others.
  double saved_s = std::numeric_limits<double>::quiet_NaN();
};

/// "cheaper"
std::string_view name_of(PlanChange change);
/// None of another name.
std::optional<PlanChange> plan_change_of(std::string_view name);
/// "another tour costs 14.2 s less than the best that goes on as intended"
std::string sentence_of(const PlanReason& reason);

/// What the plan before wanted after its first view.
enum class FormerPlan : std::uint8_t { none, ended, goes_on };

/// @param problem its `intended` is the view that a plan that goes on wanted next, if it is there
/// @param plan of that problem, not empty
PlanReason why_planned(const PlanningProblem& problem, FormerPlan former, const PlannedViews& plan);

struct PlannedStop {
  int id = -1;  ///< of its candidate; -1: a view that nobody can propose yet
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< of the base on the floor, world
  double yaw_rad = 0.0;                               ///< heading of the base, world
  double arrival_s = 0.0;                             ///< from now
  double departure_s = 0.0;  ///< from now: scanned, and what lies beyond observed
  double gain = 0.0;         ///< what it adds to the stops before it, in the unit of the gain
  double beyond = 0.0;       ///< what lies beyond it, which it leads to, in the same unit
};

struct PlannedTour {
  std::vector<PlannedStop> stops;  ///< the next one first
  PlanReason reason;

  /// Predicted time until it is done, from now.
  [[nodiscard]] double ends_s() const { return stops.empty() ? 0.0 : stops.back().departure_s; }
};

/// As the choice reckons: what lies beyond views counts, with its time, where it weighs tours by
/// it. Stops have neither id nor heading, which the problem does not know.
/// @param plan of that problem, not empty
PlannedTour planned_tour(const PlanningProblem& problem, FormerPlan former,
                         const PlannedViews& plan);

}  // namespace vantage
