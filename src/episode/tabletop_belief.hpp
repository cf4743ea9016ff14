/// What the robot believes about the table top: pose, cloud, table, map, clutter.
#pragma once

#include <optional>
#include <string>

#include "src/belief/clutter_hazard.hpp"
#include "src/belief/floor_map.hpp"
#include "src/belief/occupancy_grid.hpp"
#include "src/core/rng.hpp"
#include "src/episode/tabletop_rig.hpp"
#include "src/perception/point_cloud.hpp"
#include "src/perception/table_extraction.hpp"

namespace vantage {

struct BeliefUpdate {
  Pose2 T_world_base;      ///< after registration
  bool registered = true;  ///< false: the odometry's pose was kept
  std::string registration_note;
  std::size_t freed_cells = 0;
  std::size_t filled_cells = 0;
};

class TabletopBelief {
 public:
  explicit TabletopBelief(const Episode& episode);

  /// Where the planar scanner says the base is, given the walls and legs it saw at
  /// `remember_walls`; `guess` if nothing fits.
  [[nodiscard]] Pose2 localise(const PlanarScan& scan, double scanner_height_m,
                               const Pose2& guess) const;
  void remember_walls(const PlanarScan& scan, double scanner_height_m, const Pose2& T_world_base);
  /// Registration, table extraction, measurements, free space, holes.  [Potthast2016, 3.2]
  /// @throws InputError if the first scan shows no table in the region of interest.
  BeliefUpdate update(const TabletopObservation& observation);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// As far as it was seen; only after the first update.
  [[nodiscard]] const TablePlane& table() const { return *table_; }
  /// The grid with holes filled: what planning looks at.
  [[nodiscard]] const OccupancyGrid& filled_grid() const { return filled_; }
  [[nodiscard]] const ClutterHazard& hazard() const { return hazard_; }
  [[nodiscard]] const PointCloud& object_cloud() const { return object_cloud_; }

 private:
  Pose2 register_pose(const TabletopObservation& observation, BeliefUpdate& report);
  [[nodiscard]] PointCloud prepare(const PlanarScan& scan, double scanner_height_m) const;
  void extract_table(const PointCloud& cloud_world);
  PointCloud take_objects(const PointCloud& cloud_world);

  Episode episode_;
  OccupancyGrid grid_;
  OccupancyGrid filled_;
  ClutterHazard hazard_;
  PointCloud map_cloud_;     ///< all surfaces, for registration
  PointCloud wall_cloud_;    ///< what the planar scanner saw from known places, to drive by
  PointCloud object_cloud_;  ///< on the table
  PointCloud unplaced_;      ///< in the region, but not yet over table that was seen
  std::optional<TablePlane> table_;
  Rng sampling_;
};

}  // namespace vantage
