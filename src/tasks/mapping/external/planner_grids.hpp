/// The map as files that a planner of the user's may map into its memory.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

#include "vantage/core/error.hpp"
#include "vantage/planners/choice/outside_choice.hpp"

namespace vantage {

/// What the planner did to its folder keeps the grids out of it.
struct SpoiltFolder : OutputError {
  using OutputError::OutputError;
};

/// Writes, in place, the files `occupancy.raw`, `floor.raw` and `ways.raw`: what is mapped stays
/// mapped. They hold what the robot knows between a request and its answer.
/// @return of each its name in `folder`, type, shape and place in the world
/// @throws SpoiltFolder, OutputError
nlohmann::ordered_json write_planner_grids(const DecisionRequest& request,
                                           const std::filesystem::path& folder);

}  // namespace vantage
