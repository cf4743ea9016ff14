/// A small software renderer for the map panel: perspective, z-buffer, shaded voxels, lines.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <span>

#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage {

/// Pinhole in OpenCV's convention (z forward, x right, y down), world upright.
struct MapCamera {
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  double focal_px = 1.0;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();

  /// x, y in px and 1/depth in 1/m; 1/depth <= 0 behind the camera.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& p_world) const;
  [[nodiscard]] Eigen::Vector3d p_world_camera() const {
    return T_camera_world.inverse().translation();
  }
};

/// Looks at the middle of `points_m` (world, not empty) from the direction (azimuth, elevation), so
/// close that they just fill `viewport`.
MapCamera fit_camera(std::span<const Eigen::Vector3d> points_m, double azimuth_rad,
                     double elevation_rad, const cv::Rect& viewport);

struct MapCanvas {
  cv::Mat bgr;            ///< CV_8UC3
  cv::Mat inverse_depth;  ///< CV_32F, 1/m, 0 where nothing was drawn
};
MapCanvas make_canvas(cv::Size size);

struct LineStyle {
  cv::Scalar bgr;
  double width_px = 2.0;
  double opacity = 1.0;         ///< where nothing stands before it
  double hidden_opacity = 0.1;  ///< behind something
};
void draw_line(MapCanvas& canvas, const MapCamera& camera, const Eigen::Vector3d& p0_world,
               const Eigen::Vector3d& p1_world, const LineStyle& style);

/// The occupied cells as cubes, coloured by height, lit along smoothed surface normals, with dark
/// rims where depth jumps.
void draw_voxels(MapCanvas& canvas, const MapCamera& camera, const OccupancyGrid& grid);

/// Colour of a height, 0 the bottom of the map, 1 its top.
cv::Vec3d height_colour_bgr(double share);

}  // namespace vantage
