/// The views that an exploration chooses among: where the robot can stand to look past a frontier.
#pragma once

#include <vector>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/navigation/path_field.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/exploration/visited_places.hpp"

namespace vantage {

struct FrontierViewInput {
  const OccupancyGrid& grid;  ///< with holes filled
  const PathField& paths;     ///< from where the robot is
  Pose T_base_sweep;
  const VisitedPlaces& visited;
};

/// For each frontier the last place on the way there where the robot can stand, the largest
/// frontiers first, up to max_candidates. Where that was looked from already it is the place
/// nearest to the frontier, through a wall too.
/// @param all those of all frontiers, however far the place is from its frontier: a choice that
/// plans ahead knows of every one, and by the gain what is to be seen from there. Those beyond
/// max_candidates that are near one of the others, where they come into sight, are left out.
std::vector<Candidate> frontier_views(const Exploration& task, const FrontierViewInput& input,
                                      bool all);

}  // namespace vantage
