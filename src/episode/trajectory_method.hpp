/// How a vehicle plans its next waypoints, closed as a variant.
#pragma once

#include <string_view>
#include <variant>

#include "planners/trajectory/trajectory_optimiser.hpp"

namespace vantage {

/// The path as it is given, camera along it.
struct InitialPath {
  static constexpr std::string_view name = "initial";
  void fields(auto&&) {}
};
/// The path as it is given, camera towards the active target: what yaw alone is worth.
struct InitialYaw {
  static constexpr std::string_view name = "initial_yaw";
  void fields(auto&&) {}
};
/// Bends the path through the nearest unused directions, without optimising.
struct GreedyDetour {
  static constexpr std::string_view name = "greedy_detour";
  void fields(auto&&) {}
};

using TrajectoryMethod =
    std::variant<InitialPath, InitialYaw, GreedyDetour, Stomp, Mppi, Cem, CovariantGradient>;
template <>
inline constexpr std::string_view strategy_family<TrajectoryMethod> = "trajectory method";

}  // namespace vantage
