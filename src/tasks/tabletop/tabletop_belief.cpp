#include "vantage/tasks/tabletop/tabletop_belief.hpp"

#include <fmt/format.h>

#include "vantage/perception/clouds/registration.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {

/// Both scanners' returns in the base frame: the planar one sees the walls, which fix the pose
/// well.
PointCloud cloud_of(const TabletopObservation& observation) {
  PointCloud cloud = transform(to_cloud(observation.scan), observation.T_base_laser);
  append(cloud, to_cloud(observation.base_scan, observation.base_scan_height_m));
  return cloud;
}

}  // namespace

TabletopBelief::TabletopBelief(const EpisodeOptions& episode, const Tabletop& task)
    : MapBelief(task),
      scene_(episode.scene),
      threads_(episode.threads),
      task_(task),
      sampling_(Rng::stream(episode.seed, "table sampling")) {
  const Eigen::Vector3d centre_m = task_.map.centre();
  const Eigen::Vector3d size_m = task_.map.size();
  task_.table.region_centre_m = {centre_m.x(), centre_m.y()};
  task_.table.region_size_m = {2.0 * size_m.x(), 2.0 * size_m.y()};
}

BeliefUpdate TabletopBelief::update(const TabletopObservation& observation,
                                    const ReferenceMap& reference_map,
                                    const Correction& plausible) {
  BeliefUpdate report;
  report.T_world_base = register_pose(observation, reference_map, plausible, report);
  const Pose T_world_base = to_se3(report.T_world_base);
  const Pose T_world_sensor = T_world_base * observation.T_base_laser;

  const PointCloud laser_world = transform(to_cloud(observation.scan), T_world_sensor);
  extract_table(laser_world);
  const PointCloud objects = take_objects(laser_world);
  append(cloud_, objects);

  hazard_.observe(grid_, observation.scan, T_world_sensor, threads_);
  add_measurements(grid_, objects.points, task_.sensor_model, threads_);
  report.freed_cells =
      carve_free_space(grid_, observation.scan, T_world_sensor, task_.free_space, threads_);
  report.filled_cells = fill(task_.hole_filling);
  return report;
}

Pose2 TabletopBelief::register_pose(const TabletopObservation& observation,
                                    const ReferenceMap& reference_map, const Correction& plausible,
                                    BeliefUpdate& report) {
  const PointCloud scan_base = prepare_scan(
      cloud_of(observation), observation.T_base_laser.translation(), task_.registration);
  Pose2 pose = observation.T_world_base_odometry;
  const PointCloud& reference = map_cloud_.empty() ? reference_map.cloud() : map_cloud_;
  if (!reference.empty()) {
    auto result = register_scan(scan_base, reference, pose, task_.registration, plausible);
    if (reference_map.goes_by_posts() && (!result.converged || result.unconstrained > 0)) {
      const auto located = reference_map.locate(observation.base_scan,
                                                observation.base_scan_height_m, pose, plausible);
      if (located.converged && located.unconstrained == 0) result = located;
    }
    report.registered = result.converged;
    report.registration_note = result.reason;
    report.information = result.information;
    report.unconstrained = result.converged ? result.unconstrained : 3;
    pose = result.T_world_base;
  }
  append(map_cloud_, transform(scan_base, to_se3(pose)));
  return pose;
}

void TabletopBelief::extract_table(const PointCloud& cloud_world) {
  auto found = find_table(cloud_world, task_.table, sampling_, "table.");
  if (!table_ && !found.table) {
    throw EpisodeFailed(
        fmt::format("scene: {}: the first scan shows no table in the region of the map: {}", scene_,
                    found.reason));
  }
  if (!table_) {
    table_ = std::move(found.table);
  } else if (found.table) {
    merge_table(*table_, *found.table, task_.table.max_step_m);
  }
}

/// Points above the table's hull as far as it has been seen. The hull grows with every scan, so
/// points of the region that are not above it yet are kept for the next.
PointCloud TabletopBelief::take_objects(const PointCloud& cloud_world) {
  append(unplaced_, crop(cloud_world, grid_.frame.box()));
  const PointCloud objects = objects_on_table(unplaced_, *table_, task_.objects);
  const auto placed = [&](const Eigen::Vector3f& p) {
    return inside_hull(table_->hull, p.head<2>().cast<double>(), task_.objects.hull_margin_m);
  };
  std::erase_if(unplaced_.points, placed);
  return objects;
}

}  // namespace vantage
