#include "vantage/tasks/mapping/mobile_robot_interface.hpp"

#include <fmt/format.h>

#include <string>

#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/tasks/model_source.hpp"

namespace vantage {

MobileRobotInterface::MobileRobotInterface(const ResolvedEpisode& resolved,
                                           const std::function<Pr2(World&)>& place)
    : episode_(resolved.episode),
      world_(model_source(resolved), resolved.episode.simulation),
      robot_(place(world_)),
      geometry_(world_.model(), world_.snapshot()),
      geometry_without_robot_(world_.model(), world_.snapshot(), kWithoutRobot),
      odometry_(episode_.odometry, Rng::stream(episode_.seed, "odometry"),
                robot_.T_world_base(world_)),
      scanner_noise_(Rng::stream(episode_.seed, "base scanner")) {
  restart_dead_reckoning();
  world_.on_step = [this](const World& world) {
    if (collisions_.update(robot_, world) > 0) report_touch();
  };
}

/// For whoever reads the log; the robot has no sense of touch.
void MobileRobotInterface::report_touch() const {
  std::string names;
  for (const int geom : robot_.touched_geoms(world_)) {
    names += " '" + model_name(world_.model(), ModelObject::geom, geom) + "'";
  }
  const Pose2 pose = robot_.T_world_base(world_);
  log_warning(fmt::format("{:.2f} s: the robot at ({:.2f}, {:.2f}) touches{}", world_.time_s(),
                          pose.x_m, pose.y_m, names));
}

void MobileRobotInterface::tick() {
  throw_if_interrupted();
  world_.advance_tick();
  odometry_.update(robot_.T_world_base(world_));
}

PlanarScan MobileRobotInterface::read_base_scanner() {
  geometry_.update(world_.snapshot());
  return planar_scan(geometry_, robot_.T_world_base_scan(world_), robot_.T_base_base_scan(),
                     robot_.base_body_id(), episode_.base_scanner, scanner_noise_);
}

DriveResult MobileRobotInterface::drive_along(std::span<const Pose2> path,
                                              const std::function<bool()>& go_on) {
  return drive(world_, robot_, odometry_, path, episode_.drive, [&](World&, const Pose2&) {
    throw_if_interrupted();
    return go_on();
  });
}

MobileRobotTruth MobileRobotInterface::truth() const {
  return {robot_.T_world_base(world_), collisions_.count()};
}

void MobileRobotInterface::correct_pose(const Pose2& T_world_base) {
  T_world_dead_reckoned_ = dead_reckoned_base();
  T_world_corrected_ = T_world_base;
  odometry_.correct(T_world_base);
}

void MobileRobotInterface::restart_dead_reckoning() {
  T_world_dead_reckoned_ = T_world_corrected_ = odometry_.estimate();
}

Pose2 MobileRobotInterface::dead_reckoned_base() const {
  return compose(T_world_dead_reckoned_,
                 compose(inverse(T_world_corrected_), odometry_.estimate()));
}

}  // namespace vantage
