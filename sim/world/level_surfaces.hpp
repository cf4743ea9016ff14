/// Level surfaces of a scene that something may stand on: its tables, as its file has them.
#pragma once

#include <Eigen/Geometry>

#include <optional>
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

/// A surface that is level but for `tilt_rad`, whatever its height.
struct NearSurface {
  double height_m = 0.0;  ///< world z, of its middle
  double area_m2 = 0.0;
  double tilt_rad = 0.0;
  std::string name;  ///< as LevelSurface has it
};

/// Of the solid geoms of a scene, the robot left out: the highest level face of each, joined where
/// they meet. The largest first. `data` must have run kinematics.
std::vector<LevelSurface> level_surfaces(const mjModel& model, const mjData& data,
                                         const LevelSurfaceOptions& options = {});

/// Where there is no level surface: the largest of those that are lower (from 10 cm on), higher (up
/// to 2 m), steeper (up to 0.5 rad) or smaller (a quarter of the area) than the options have it.
std::optional<NearSurface> nearest_to_level(const mjModel& model, const mjData& data,
                                            const LevelSurfaceOptions& options = {});

}  // namespace vantage
