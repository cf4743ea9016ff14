/// How a vehicle plans its next waypoints, closed as a variant.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "vantage/core/fields.hpp"
#include "vantage/planners/trajectory/flight_cost.hpp"
#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"
#include "vantage/planners/trajectory/search_heading.hpp"
#include "vantage/planners/trajectory/simple_paths.hpp"
#include "vantage/planners/trajectory/view_schedule.hpp"

namespace vantage {

/// The path as it is given, camera along it.
struct GivenPath {
  static constexpr std::string_view name = "initial";
  void fields(auto&&) {}
};
/// The path as it is given, camera towards the active target: what yaw alone is worth.
struct GivenPathYaw {
  static constexpr std::string_view name = "initial_yaw";
  YawToTarget yaw;
  void fields(auto&& f) { f("range_m", yaw.range_m, "@@", above(0.0)); }
};
/// The path through the nearest unused directions on its way, camera likewise.
struct DetourPath {
  static constexpr std::string_view name = "greedy_detour";
  GreedyDetour detour;
  void fields(auto&& f) {
    f("range_m", detour.range_m, "@@", above(0.0));
    f("views", detour.views, "@@", between(1, kObservationDirections));
  }
};

using TrajectoryMethod = std::variant<GivenPath, GivenPathYaw, DetourPath, Stomp, Mppi, Cem, Chomp>;
template <>
inline constexpr std::string_view strategy_family<TrajectoryMethod> = "trajectory method";

/// Whether it minimises the cost of its way, or follows a rule.
bool optimises(const TrajectoryMethod& method);

/// What an optimised path looks at.
using ViewPlan = std::variant<NearestObject, ViewsOnTheWay>;
template <>
inline constexpr std::string_view strategy_family<ViewPlan> = "view plan";

/// What all methods plan by.
struct FlightPlannerOptions {
  FlightCostOptions cost;
  ViewPlan views = ViewsOnTheWay{};
  SearchOptions search;
  double observation_distance_m = 1.05;
  double range_m = 3.0;
  double path_deviation_tolerance_m = 1.2;
  double path_deviation_weight = 2.0;
  double clearance_m = 0.55;
  double sample_s = 0.05;
  void fields(auto&& f) {
    f("cost", cost, "@@");
    f("views", views, "@@");
    f("search", search, "of `on_the_way`, between its views");
    f("observation_distance_m", observation_distance_m,
      "Distance from camera to object of the best observation, on the optical axis: the body "
      "descends as far as that takes, never above the path. Higher: the object appears smaller.",
      between(0.3, 3.0));
    f("range_m", range_m, "level; farther objects are no targets of `nearest`", above(0.0));
    f("path_deviation_tolerance_m", path_deviation_tolerance_m,
      "Path-deviation tolerance: distance of a point of the horizon from its place on the given "
      "path that costs nothing. With a large one the smoothest plan cuts from one lane of a path "
      "to the next.",
      at_least(0.0));
    f("path_deviation_weight", path_deviation_weight,
      "1/m, of the deviation beyond it; higher keeps to the given path", at_least(0.0));
    f("clearance_m", clearance_m, "of the body's centre on a path that is flown, by the map",
      between(0.0, 3.0));
    f("sample_s", sample_s, "between places of a path whose clearance is looked at",
      between(0.01, 1.0));
  }
};

/// "stomp", "stomp rollouts=10 without c_v": what of the cost is left out is named.
std::string trajectory_method_name(const TrajectoryMethod& method, const FlightCostOptions& cost);

}  // namespace vantage
