/// What the robot believes about an office: pose, map, clutter.
#pragma once

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/mapping/belief_update.hpp"
#include "vantage/tasks/mapping/reference_map.hpp"

namespace vantage {

class OfficeBelief {
 public:
  explicit OfficeBelief(const Episode& episode);

  /// Registration with `reference_map`, measurements, free space, holes.  [Potthast2016, 3.2]
  BeliefUpdate update(const OfficeObservation& observation, const ReferenceMap& reference_map);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// The grid with holes filled: what planning looks at.
  [[nodiscard]] const OccupancyGrid& filled_grid() const { return filled_; }
  [[nodiscard]] const ClutterHazard& hazard() const { return hazard_; }
  /// Surfaces, world, a point or less a cell.
  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }

 private:
  Episode episode_;
  OccupancyGrid grid_;
  OccupancyGrid filled_;
  ClutterHazard hazard_;
  PointCloud cloud_;
};

}  // namespace vantage
