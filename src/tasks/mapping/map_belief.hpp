/// What a robot believes of a region that it maps: occupancy, clutter, surfaces.
#pragma once

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

/// What taking a scan into the belief came to.
struct BeliefUpdate {
  Pose2 T_world_base;      ///< after registration
  bool registered = true;  ///< false: the pose tracked on the way was kept
  std::string registration_note;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the registration
  int unconstrained =
      0;  ///< directions of (x, y, yaw) in which the tracked pose is kept; 3: not registered
  std::size_t freed_cells = 0;
  std::size_t filled_cells = 0;
};

class MapBelief {
 public:
  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// The grid with holes filled: what planning looks at.
  [[nodiscard]] const OccupancyGrid& filled_grid() const { return filled_; }
  [[nodiscard]] const ClutterHazard& hazard() const { return hazard_; }
  /// Surfaces, world.
  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }

 protected:
  explicit MapBelief(const MappingOptions& options)
      : grid_(options.map.frame()),
        filled_(grid_),
        hazard_(options.clutter_hazard, grid_.frame.cells) {}
  ~MapBelief() = default;

  /// @return cells filled
  std::size_t fill(const HoleFilling& options) {
    auto filling = fill_holes(grid_, options);
    filled_ = std::move(filling.grid);
    return filling.filled_cells;
  }

  OccupancyGrid grid_;
  OccupancyGrid filled_;
  ClutterHazard hazard_;
  PointCloud cloud_;
};

}  // namespace vantage
