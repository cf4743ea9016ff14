/// Level surfaces of a scene that something may stand on: its tables, as its file has them.
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

struct LevelSurfaceOptions {
  double min_height_m = 0.4;
  double max_height_m = 1.2;
  double max_tilt_rad = 0.05;
  double min_area_m2 = 0.04;
  double height_step_m = 0.01;  ///< boards that differ by less are one surface
  double gap_m = 0.03;          ///< and that are no farther apart
};

struct LevelSurface {
  Eigen::AlignedBox2d extent_m;  ///< world x, y
  double height_m = 0.0;         ///< world z, of its largest part
  double area_m2 = 0.0;
  std::string name;  ///< of its largest geom, or that geom's body; may be empty
};

/// Of the solid geoms of a scene, the robot left out: the highest level face of each, joined where
/// they meet. The largest first. `data` must have run kinematics.
std::vector<LevelSurface> level_surfaces(const mjModel& model, const mjData& data,
                                         const LevelSurfaceOptions& options = {});

}  // namespace vantage
