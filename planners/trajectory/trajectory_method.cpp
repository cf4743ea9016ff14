#include "vantage/planners/trajectory/trajectory_method.hpp"

#include "vantage/core/names.hpp"

namespace vantage {

bool optimises(const TrajectoryMethod& method) {
  return !std::holds_alternative<GivenPath>(method) &&
         !std::holds_alternative<GivenPathYaw>(method) &&
         !std::holds_alternative<DetourPath>(method);
}

std::string trajectory_method_name(const TrajectoryMethod& method, const FlightCostOptions& cost) {
  std::string label = strategy_label(method);
  if (!cost.information) label += " without c_i";
  if (cost.centre_weight == 0.0) label += " without c_v";
  if (cost.literal) label += " literal";
  return label;
}

}  // namespace vantage
