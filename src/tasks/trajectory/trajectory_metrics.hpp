/// metrics.json of trajectory flight, as the contract has it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vantage/runtime/metrics.hpp"
#include "vantage/tasks/trajectory/trajectory_flight.hpp"

namespace vantage {

/// Found objects are matched to true ones by where they are, nearest first, each once.
nlohmann::ordered_json trajectory_metrics(const ResolvedEpisode& resolved,
                                          const RunSummary& summary,
                                          const TrajectoryRobotInterface& robot,
                                          const TrajectoryFlight& run);

}  // namespace vantage
