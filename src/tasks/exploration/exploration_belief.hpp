/// What the robot believes about the rooms it explores: pose, map, clutter.
#pragma once

#include <span>
#include <vector>

#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"

namespace vantage {

/// A sweep, or an image taken on the way, as it is kept to be taken into a map again: every
/// `stride_px`-th pixel of every so many rows, the middle ones where they do not come out even.
struct KeptSweep {
  std::vector<HeadView> views;
  std::size_t keyframe = 0;  ///< of the navigator's, at which it was taken
};

/// @param stride_px as far apart as the pixels that mark surfaces
std::vector<HeadView> thinned(const std::vector<HeadView>& views, int stride_px);

/// Its cloud holds a point or less a cell of each scan.
class ExplorationBelief : public MapBelief {
 public:
  ExplorationBelief(const EpisodeOptions& episode, const Exploration& task);

  /// Registration with `reference_map`, measurements, free space, holes.  [Potthast2016, 3.2]
  BeliefUpdate update(const ExplorationObservation& observation, const ReferenceMap& reference_map,
                      const Correction& plausible);

  /// An image that was taken on the way, by the pose tracked there: measurements and free space.
  void update(const HeadView& view, const Pose2& T_world_base);
  /// Fills holes of the map as it is now.
  void refill() { fill(task_.hole_filling); }

  /// Keeps an image that was taken there, for reintegrate().
  void keep(const HeadView& view, const Pose2& T_keyframe_base, std::size_t keyframe);
  /// Keeps what `observation` saw, for reintegrate().
  void keep(const ExplorationObservation& observation, std::size_t keyframe);
  /// Forgets map, clutter and cloud, and takes all that was kept into them from where it was seen.
  /// @param T_world_bases of each keyframe
  void reintegrate(std::span<const Pose2> T_world_bases);
  [[nodiscard]] const std::vector<KeptSweep>& kept() const { return kept_; }

 private:
  /// What the images of one sweep say. @return cells freed
  std::size_t integrate(const std::vector<HeadView>& views, const Pose2& base, int stride_px,
                        int hazard_stride_px);

  int threads_;
  Exploration task_;
  std::vector<KeptSweep> kept_;
};

}  // namespace vantage
