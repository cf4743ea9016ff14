#include "vantage/tasks/exploration/exploration_belief.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/sensor_model.hpp"

namespace vantage {
namespace {

/// Returns of an image in the world. One that is no higher above the floor than its error is of the
/// floor: elsewhere a few centimetres are an obstacle.
PointCloud surfaces_of(const PosedImage& posed, const Exploration& options) {
  constexpr double kSigmas = 5.0;  // of some hundred thousand returns hardly one is farther off
  const auto& [image, T_world_camera] = posed;
  PointCloud points = transform(to_cloud(image, options.stride_px), T_world_camera);
  const double camera_m = T_world_camera.translation().z();
  const Pose T_camera_world = T_world_camera.inverse();
  for (Eigen::Vector3f& p : points.points) {
    const double depth_m = (T_camera_world * p.cast<double>()).z();
    const double slope = std::abs(p.z() - camera_m) / depth_m;
    const double error_m = kSigmas * slope * depth_error_m(options.camera, depth_m);
    if (p.z() <= error_m) p.z() = 0.0F;
  }
  return points;
}

}  // namespace

ExplorationBelief::ExplorationBelief(const EpisodeOptions& episode, const Exploration& task)
    : MapBelief(task), threads_(episode.threads), task_(task) {}

BeliefUpdate ExplorationBelief::update(const ExplorationObservation& observation,
                                       const ReferenceMap& reference_map,
                                       const Correction& plausible) {
  const auto located = reference_map.locate(observation.base_scan, observation.base_scan_height_m,
                                            observation.T_world_base_odometry, plausible);
  BeliefUpdate report{.T_world_base = located.T_world_base,
                      .registered = located.converged,
                      .registration_note = located.reason,
                      .information = located.information,
                      .unconstrained = located.converged ? located.unconstrained : 3};
  const Pose T_world_base = to_se3(report.T_world_base);

  std::vector<PosedImage> images;
  for (const DepthImage& view : observation.views) {
    images.push_back({view.image, T_world_base * view.T_base_camera});
  }
  hazard_.observe(grid_, images, task_.hazard_stride_px, task_.hazard_floor_m, threads_);
  PointCloud points;
  for (const PosedImage& posed : images) append(points, surfaces_of(posed, task_));
  add_measurements(grid_, points.points, task_.sensor_model, threads_);
  report.freed_cells = carve_free_space(grid_, images, task_.free_space, threads_);
  append(cloud_, voxel_downsample(points, grid_.frame.cell_size_m.maxCoeff()));
  report.filled_cells = fill(task_.hole_filling);
  return report;
}

}  // namespace vantage
