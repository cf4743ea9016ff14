/// What the robot believes about the table top: pose, cloud, table, map, clutter.
#pragma once

#include <optional>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/perception/table_extraction.hpp"
#include "vantage/tasks/mapping/belief_update.hpp"
#include "vantage/tasks/mapping/reference_map.hpp"
#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

namespace vantage {

class TabletopBelief {
 public:
  explicit TabletopBelief(const Episode& episode);

  /// Registration, table extraction, measurements, free space, holes.  [Potthast2016, 3.2]
  /// The first scan is registered with `reference_map`.
  /// @throws InputError if the first scan shows no table in the region of interest.
  BeliefUpdate update(const TabletopObservation& observation, const ReferenceMap& reference_map);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// As far as it was seen; only after the first update.
  [[nodiscard]] const TablePlane& table() const { return *table_; }
  /// The grid with holes filled: what planning looks at.
  [[nodiscard]] const OccupancyGrid& filled_grid() const { return filled_; }
  [[nodiscard]] const ClutterHazard& hazard() const { return hazard_; }
  [[nodiscard]] const PointCloud& cloud() const { return object_cloud_; }

 private:
  Pose2 register_pose(const TabletopObservation& observation, const ReferenceMap& reference_map,
                      BeliefUpdate& report);
  void extract_table(const PointCloud& cloud_world);
  PointCloud take_objects(const PointCloud& cloud_world);

  Episode episode_;
  OccupancyGrid grid_;
  OccupancyGrid filled_;
  ClutterHazard hazard_;
  PointCloud map_cloud_;     ///< all surfaces, for registration
  PointCloud object_cloud_;  ///< on the table
  PointCloud unplaced_;      ///< in the region, but not yet over table that was seen
  std::optional<TablePlane> table_;
  Rng sampling_;
};

}  // namespace vantage
