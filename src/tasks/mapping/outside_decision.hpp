/// A decision of a mapping episode that somebody else takes.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vantage/planners/choice/outside_choice.hpp"
#include "vantage/planners/views/forecast_interval.hpp"
#include "vantage/tasks/mapping/driving/budget_keeper.hpp"
#include "vantage/tasks/mapping/driving/mobile_robot_interface.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"

namespace vantage {

/// What the robot knows, for whoever is asked.
struct OutsideSituation {
  const MapBelief& belief;
  const BlockField& transmission;
  const MobileRobotInterface& robot;
  const BudgetKeeper& budget;
  std::size_t scans = 0;
  int scans_left = 0;
  const ForecastInterval* interval = nullptr;  ///< of what `adaptive` forecasts
};

MapSituation map_situation(const OutsideSituation& situation);

/// The candidate that `outside` chooses. A pose of its own joins `candidates` as the last of them.
/// @throws EpisodeFailed if the answer cannot be carried out; what `outside` throws
std::size_t decide_outside(const OutsideChoice& outside, const OutsideSituation& situation,
                           const PathField& paths, const Gain& gain,
                           const std::function<std::size_t()>& own_choice,
                           std::vector<Candidate>& candidates);

}  // namespace vantage
