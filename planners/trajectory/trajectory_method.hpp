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

struct GivenPath {
  static constexpr std::string_view name = "initial";
  static constexpr StrategyText text{
      .summary = "Flies the path as it is given, with the camera along it. The baseline."};
  void fields(auto&&) {}
};
struct GivenPathYaw {
  static constexpr std::string_view name = "initial_yaw";
  static constexpr StrategyText text{
      .summary =
          "Flies the path as it is given, with the camera towards the nearest object that is not "
          "known yet: shows what yaw alone is worth."};
  YawToTarget yaw;
  void fields(auto&& f) {
    f("range_m", yaw.range_m,
      "greatest horizontal distance of objects that the camera turns to; higher turns to them "
      "earlier",
      above(0.0));
  }
};
struct DetourPath {
  static constexpr std::string_view name = "greedy_detour";
  static constexpr StrategyText text{
      .summary =
          "Flies through the nearest unused viewpoints of the nearest unknown object that its way "
          "comes by, with the camera towards the object. A rule without cost or obstacles."};
  GreedyDetour detour;
  void fields(auto&& f) {
    f("range_m", detour.range_m,
      "greatest horizontal distance of objects that are visited; higher turns to them earlier",
      above(0.0));
    f("views", detour.views,
      "greatest number of views of an object within one horizon; higher goes farther round it",
      between(1, kObservationDirections));
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
  double observation_distance_m = 1.05;  ///< the body never climbs above the path for it
  double range_m = 3.0;
  /// With a large one the smoothest plan cuts from one lane of a path to the next.
  double path_deviation_tolerance_m = 1.2;
  double path_deviation_weight = 2.0;
  double clearance_m = 0.55;
  double sample_s = 0.05;
  void fields(auto&& f) {
    f("cost", cost, "cost of a path: obstacles, target in the image, recognition, information");
    f("views", views, "which views of objects the optimised waypoints take");
    f("search", search, "where the camera looks for objects between the views of `on_the_way`");
    f("observation_distance_m", observation_distance_m,
      "distance from camera to object, along the optical axis, of the best observation, for which "
      "the vehicle descends; higher makes objects smaller in the image",
      between(0.3, 3.0));
    f("range_m", range_m,
      "greatest horizontal distance of an object that `nearest` takes for its target", above(0.0));
    f("path_deviation_tolerance_m", path_deviation_tolerance_m,
      "distance of a waypoint from its place on the given path that costs nothing; higher leaves "
      "the path more freely",
      at_least(0.0));
    f("path_deviation_weight", path_deviation_weight,
      "weight of the deviation beyond the tolerance, in 1/m; higher keeps to the given path",
      at_least(0.0));
    f("clearance_m", clearance_m,
      "least clearance of the vehicle's centre on a path that is flown, by the map; higher rejects "
      "more plans",
      between(0.0, 3.0));
    f("sample_s", sample_s,
      "time between the points of a path whose clearance is checked; lower misses less and is "
      "slower",
      between(0.01, 1.0));
  }
};

/// "stomp", "stomp rollouts=10 without c_v": what of the cost is left out is named.
std::string trajectory_method_name(const TrajectoryMethod& method, const FlightCostOptions& cost);

}  // namespace vantage
