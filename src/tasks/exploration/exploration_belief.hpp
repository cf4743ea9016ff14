/// What the robot believes about the rooms it explores: pose, map, clutter.
#pragma once

#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"

namespace vantage {

/// Its cloud holds a point or less a cell.
class ExplorationBelief : public MapBelief {
 public:
  ExplorationBelief(const EpisodeOptions& episode, const Exploration& task);

  /// Registration with `reference_map`, measurements, free space, holes.  [Potthast2016, 3.2]
  BeliefUpdate update(const ExplorationObservation& observation, const ReferenceMap& reference_map,
                      const Correction& plausible);

 private:
  int threads_;
  Exploration task_;
};

}  // namespace vantage
