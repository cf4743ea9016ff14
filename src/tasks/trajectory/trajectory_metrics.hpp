/// What a flight along a path measures: metrics.json as the contract has it, the line of its
/// outcome, and what studies read of it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "vantage/runtime/measure.hpp"
#include "vantage/tasks/trajectory/supports_ground_truth.hpp"
#include "vantage/tasks/trajectory/trajectory_ground_truth.hpp"
#include "vantage/tasks/trajectory/trajectory_parts.hpp"

namespace vantage {

/// What is really so at the end of a flight.
struct FlightTruth {
  TrajectoryGroundTruth vehicle;
  std::vector<ObjectOnSupport> objects;
};

/// Found objects are matched to true ones by where they are, nearest first, each once.
void add_trajectory_metrics(const FlightTruth& truth, const TrajectoryParts& run,
                            nlohmann::ordered_json& metrics);

std::string trajectory_outcome(const nlohmann::ordered_json& metrics);

Measures trajectory_measures();

}  // namespace vantage
