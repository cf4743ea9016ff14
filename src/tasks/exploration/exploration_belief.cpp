#include "vantage/tasks/exploration/exploration_belief.hpp"

#include <algorithm>
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
PointCloud surfaces_of(const PosedImage& posed, const Exploration& options, int stride_px) {
  constexpr double kSigmas = 5.0;  // of some hundred thousand returns hardly one is farther off
  const auto& [image, T_world_camera] = posed;
  PointCloud points = transform(to_cloud(image, stride_px), T_world_camera);
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

std::vector<HeadView> thinned(const std::vector<HeadView>& views, int stride_px) {
  std::vector<HeadView> thin;
  for (const HeadView& view : views) {
    const CameraImages& image = view.image;
    const int rows = (image.height_px - 1) / stride_px + 1;
    const int columns = (image.width_px - 1) / stride_px + 1;
    const int first_row = (image.height_px - 1 - (rows - 1) * stride_px) / 2;
    const int first_column = (image.width_px - 1 - (columns - 1) * stride_px) / 2;
    CameraImages kept{.width_px = columns,
                      .height_px = rows,
                      .focal_px = image.focal_px / stride_px,
                      .range_max_m = image.range_max_m,
                      .rgb = {},
                      .depth_m = {}};
    kept.depth_m.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        kept.depth_m.push_back(
            image.depth_at(first_row + row * stride_px, first_column + column * stride_px));
      }
    }
    thin.push_back({std::move(kept), view.T_base_camera});
  }
  return thin;
}

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
  report.freed_cells =
      integrate(observation.views, report.T_world_base, task_.stride_px, task_.hazard_stride_px);
  report.filled_cells = fill(task_.hole_filling);
  return report;
}

void ExplorationBelief::update(const HeadView& view, const Pose2& T_world_base) {
  integrate({view}, T_world_base, task_.stride_px, task_.hazard_stride_px);
}

void ExplorationBelief::keep(const HeadView& view, const Pose2& T_keyframe_base,
                             std::size_t keyframe) {
  const HeadView from_keyframe{view.image, to_se3(T_keyframe_base) * view.T_base_camera};
  kept_.push_back({thinned({from_keyframe}, task_.stride_px), keyframe});
}

void ExplorationBelief::keep(const ExplorationObservation& observation, std::size_t keyframe) {
  kept_.push_back({thinned(observation.views, task_.stride_px), keyframe});
}

void ExplorationBelief::reintegrate(std::span<const Pose2> T_world_bases) {
  grid_ = OccupancyGrid(task_.map.frame());
  hazard_ = ClutterHazard(task_.clutter_hazard, grid_.frame.cells);
  cloud_ = {};
  // Of what is kept, so many as come nearest to those that were counted at first.
  const int hazard_stride_px =
      std::max(1, (task_.hazard_stride_px + task_.stride_px / 2) / task_.stride_px);
  for (const KeptSweep& sweep : kept_) {
    integrate(sweep.views, T_world_bases[sweep.keyframe], 1, hazard_stride_px);
  }
  refill();
}

std::size_t ExplorationBelief::integrate(const std::vector<HeadView>& views, const Pose2& base,
                                         int stride_px, int hazard_stride_px) {
  const Pose T_world_base = to_se3(base);
  std::vector<PosedImage> images;
  for (const HeadView& view : views) {
    images.push_back({view.image, T_world_base * view.T_base_camera});
  }
  hazard_.observe(grid_, images, hazard_stride_px, task_.hazard_floor_m, threads_);
  PointCloud points;
  for (const PosedImage& posed : images) append(points, surfaces_of(posed, task_, stride_px));
  add_measurements(grid_, points.points, task_.sensor_model, threads_);
  const std::size_t freed_cells = carve_free_space(grid_, images, task_.free_space, threads_);
  append(cloud_, voxel_downsample(points, grid_.frame.cell_size_m.maxCoeff()));
  return freed_cells;
}

}  // namespace vantage
