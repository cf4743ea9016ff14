#include "vantage/planners/tours/planned_tour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/planners/tours/joint_gain.hpp"

namespace vantage {
namespace {

struct ChangeText {
  std::string_view name;
  std::string_view sentence;
};
constexpr std::array<ChangeText, kPlanChanges> kChangeTexts{{
    {"first", "the first plan"},
    {"ended", "the plan before intended no further view"},
    {"kept", "goes on as intended"},
    {"gone", "the view intended next is no longer among those that can be taken"},
    {"exhausted", "the view intended next is expected to show nothing new any more"},
    {"unreachable", "no way leads to the view intended next"},
    {"unaffordable", "what is left does not pay for the view intended next"},
    {"cheaper", {}},  // its sentence has a number
    {"replanned", "the choice now prefers another view to the one intended next"},
}};

const ChangeText& text_of(PlanChange change) {
  return kChangeTexts.at(static_cast<std::size_t>(change));
}

bool shows_nothing(const PlanningProblem& problem, std::size_t view) {
  return gain_of(problem, view) <= 0.0 && problem.beyond_of(view) <= 0.0;
}

}  // namespace

std::string_view name_of(PlanChange change) { return text_of(change).name; }

std::optional<PlanChange> plan_change_of(std::string_view name) {
  const auto found = std::ranges::find(kChangeTexts, name, &ChangeText::name);
  if (found == kChangeTexts.end()) return std::nullopt;
  return static_cast<PlanChange>(found - kChangeTexts.begin());
}

std::string sentence_of(const PlanReason& reason) {
  if (reason.change != PlanChange::cheaper) return std::string(text_of(reason.change).sentence);
  return fmt::format("another tour costs {:.1f} s less than the best that goes on as intended",
                     reason.saved_s);
}

PlanReason why_planned(const PlanningProblem& problem, FormerPlan former,
                       const PlannedViews& plan) {
  expects(!plan.order.empty(), "a plan of at least one view");
  if (former == FormerPlan::none) return {PlanChange::first};
  if (former == FormerPlan::ended) return {PlanChange::ended};
  if (!problem.intended) return {PlanChange::gone};
  const std::size_t intended = *problem.intended;
  if (plan.order.front() == intended) return {PlanChange::kept};
  if (!std::isfinite(problem.leg_s(problem.here(), intended))) return {PlanChange::unreachable};
  if (!is_affordable(problem, std::array{intended})) return {PlanChange::unaffordable};
  if (!plan.costs || !plan.costs->intended_s) return {PlanChange::replanned};
  if (shows_nothing(problem, intended)) return {PlanChange::exhausted};
  return {PlanChange::cheaper, *plan.costs->intended_s - plan.costs->taken_s};
}

PlannedTour planned_tour(const PlanningProblem& problem, FormerPlan former,
                         const PlannedViews& plan) {
  PlannedTour tour{{}, why_planned(problem, former, plan)};
  JointGain gain(problem);
  double time_s = 0.0;
  std::size_t at = problem.here();
  for (const std::size_t view : plan.order) {
    PlannedStop& stop = tour.stops.emplace_back();
    stop.place_m = problem.place_m[view];
    stop.arrival_s = time_s + problem.leg_s(at, view);
    stop.gain = gain.add(view);
    stop.departure_s = stop.arrival_s + problem.scan_s_of(view);
    if (plan.costs) {
      stop.beyond = problem.beyond_of(view);
      stop.departure_s += problem.dwell_s(view);
    }
    time_s = stop.departure_s;
    at = view;
  }
  return tour;
}

}  // namespace vantage
