#include "vantage/tasks/exploration/office_belief.hpp"

#include <cmath>
#include <utility>

#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/sensor_model.hpp"

namespace vantage {
namespace {

/// Returns of an image in the world. One that is no higher above the floor than its error is of the
/// floor: elsewhere a few centimetres are an obstacle.
PointCloud surfaces_of(const DepthImage& view, const Pose& T_world_camera,
                       const ExplorationOptions& options) {
  constexpr double kSigmas = 5.0;  // of some hundred thousand returns hardly one is farther off
  PointCloud points = transform(to_cloud(view.image, options.stride_px), T_world_camera);
  const double camera_m = T_world_camera.translation().z();
  for (Eigen::Vector3f& p : points.points) {
    const double depth_m = (T_world_camera.inverse() * p.cast<double>()).z();
    const double slope = std::abs(p.z() - camera_m) / depth_m;
    const double error_m = kSigmas * slope * depth_error_m(options.camera, depth_m);
    if (p.z() <= error_m) p.z() = 0.0F;
  }
  return points;
}

}  // namespace

OfficeBelief::OfficeBelief(const Episode& episode)
    : episode_(episode),
      grid_(episode.grid_frame()),
      filled_(grid_),
      hazard_(episode.clutter_hazard, grid_.frame.cells) {}

BeliefUpdate OfficeBelief::update(const OfficeObservation& observation,
                                  const ReferenceMap& reference_map) {
  const auto located = reference_map.locate(observation.base_scan, observation.base_scan_height_m,
                                            observation.T_world_base_odometry);
  BeliefUpdate report{.T_world_base = located.T_world_base,
                      .registered = located.converged,
                      .registration_note = located.reason};
  const Pose T_world_base = to_se3(report.T_world_base);
  const ExplorationOptions& options = episode_.exploration;

  PointCloud points;
  for (const DepthImage& view : observation.views) {
    const Pose T_world_camera = T_world_base * view.T_base_camera;
    hazard_.observe(grid_, view.image, T_world_camera, options.hazard_stride_px);
    append(points, surfaces_of(view, T_world_camera, options));
  }
  add_measurements(grid_, points.points, episode_.sensor_model);
  for (const DepthImage& view : observation.views) {
    report.freed_cells += carve_free_space(grid_, view.image, T_world_base * view.T_base_camera,
                                           episode_.free_space, episode_.threads);
  }
  append(cloud_, voxel_downsample(points, grid_.frame.cell_size_m.maxCoeff()));
  auto filling = fill_holes(grid_, episode_.hole_filling);
  report.filled_cells = filling.filled_cells;
  filled_ = std::move(filling.grid);
  return report;
}

}  // namespace vantage
