/// What the robot believes about the table top: pose, cloud, table, map, clutter.
#pragma once

#include <optional>
#include <string>

#include "vantage/core/rng.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/perception/table_extraction.hpp"
#include "vantage/runtime/episode_setup.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"
#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

namespace vantage {

class TabletopBelief : public MapBelief {
 public:
  TabletopBelief(const EpisodeOptions& episode, const Tabletop& task);

  /// Registration, table extraction, measurements, free space, holes.  [Potthast2016, 3.2]
  /// The first scan is registered with `reference_map`.
  /// @throws EpisodeFailed if the first scan shows no table in the region of interest.
  BeliefUpdate update(const TabletopObservation& observation, const ReferenceMap& reference_map,
                      const Correction& plausible);

  /// As far as it was seen; only after the first update.
  [[nodiscard]] const TablePlane& table() const { return *table_; }

 private:
  Pose2 register_pose(const TabletopObservation& observation, const ReferenceMap& reference_map,
                      const Correction& plausible, BeliefUpdate& report);
  void extract_table(const PointCloud& cloud_world);
  PointCloud take_objects(const PointCloud& cloud_world);

  std::string scene_;  ///< for messages
  int threads_;
  Tabletop task_;
  PointCloud map_cloud_;  ///< all surfaces, for registration
  PointCloud unplaced_;   ///< in the region, but not yet over table that was seen
  std::optional<TablePlane> table_;
  Rng sampling_;
};

}  // namespace vantage
