#include "vantage/tasks/exploration/exploration_robot_interface.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/tasks/start_check.hpp"

namespace vantage {
namespace {

/// The head is at rest when neither joint moves more than this in a tick; the encoders say exactly
/// where.
constexpr double kAtRest_rad = 1e-4;
constexpr int kFewestTicks = 4;
constexpr int kMaxTicks = 160;

/// On the pan axis, at the height that the camera has when it looks straight on.
Pose find_sweep_pose(const World& world, const Pr2& robot) {
  const Pose T_base_world = to_se3(robot.T_world_base(world)).inverse();
  const int head = model_id(world.model(), ModelObject::body, "robot/head_pan");
  const Pose T_base_camera =
      T_base_world * T_world_camera(world.model(), world.snapshot(), robot.camera_id());
  Pose T_base_sweep = Pose::Identity();
  T_base_sweep.translation() = (T_base_world * body_pose(world, head)).translation();
  T_base_sweep.translation().z() = T_base_camera.translation().z();
  return T_base_sweep;
}

Pr2 placed_robot(World& world, const ResolvedEpisode& resolved) {
  Pr2 robot(world.model());
  const Pose2 start = office_start(world, resolved);
  robot.place(world, start);
  const double lowest_m = find_sweep_pose(world, robot).translation().z();
  robot.place(world, start, camera_lift_m(robot, lowest_m, resolved.episode));
  return robot;
}

}  // namespace

ExplorationRobotInterface::ExplorationRobotInterface(const ResolvedEpisode& resolved)
    : MobileRobotInterface(resolved, [&](World& world) { return placed_robot(world, resolved); }),
      T_base_sweep_(find_sweep_pose(world_, robot_)),
      field_(swept_field(episode_.exploration.sweep, episode_.exploration.camera)),
      renderer_(make_offscreen_renderer(world_.model(), episode_.exploration.camera.width_px,
                                        episode_.exploration.camera.height_px)),
      camera_noise_(Rng::stream(episode_.seed, "camera")) {
  check_turning_room(world_, robot_, office_start_text(episode_));
}

OfficeObservation ExplorationRobotInterface::observe() {
  robot_.command_twist(world_, {});
  OfficeObservation observation;
  std::vector<double> pans_rad = pan_angles_rad(episode_.exploration.sweep);
  for (const double tilt_rad : episode_.exploration.sweep.tilts_rad) {
    for (const double pan_rad : pans_rad) {
      turn_head(pan_rad, tilt_rad);
      observation.views.push_back(take_image());
    }
    std::ranges::reverse(pans_rad);  // the next row begins where this one ends
  }
  robot_.command_head(world_, 0.0, 0.0);
  observation.base_scan = read_base_scanner();
  observation.base_scan_height_m = robot_.base_scan_height_m();
  observation.T_world_base_odometry = odometry_.estimate();
  return observation;
}

void ExplorationRobotInterface::turn_head(double pan_rad, double tilt_rad) {
  robot_.command_head(world_, pan_rad, tilt_rad);
  for (int i = 0; i < kMaxTicks; ++i) {
    const double pan_before = robot_.head_pan_rad(world_);
    const double tilt_before = robot_.head_tilt_rad(world_);
    tick();
    const double moved_rad = std::max(std::abs(robot_.head_pan_rad(world_) - pan_before),
                                      std::abs(robot_.head_tilt_rad(world_) - tilt_before));
    if (i >= kFewestTicks && moved_rad < kAtRest_rad) return;
  }
}

DepthImage ExplorationRobotInterface::take_image() {
  const mjData& now = world_.snapshot();
  const Pose T_base_camera = to_se3(robot_.T_world_base(world_)).inverse() *
                             T_world_camera(world_.model(), now, robot_.camera_id());
  return {depth_image(*renderer_, world_.model(), now, robot_.camera_id(),
                      episode_.exploration.camera, camera_noise_),
          T_base_camera};
}

Pose2 ExplorationRobotInterface::base_for_sweep(const Pose& T_world_sweep) const {
  return compose(project_to_se2(T_world_sweep), inverse(project_to_se2(T_base_sweep_)));
}

}  // namespace vantage
