#include "vantage/tasks/object_flight/simulated_orbit_robot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "vantage/runtime/episode_loop.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/sim/sensors/camera.hpp"
#include "vantage/tasks/flight/full_turn.hpp"
#include "vantage/tasks/object_flight/object_on_table.hpp"

namespace vantage {
namespace {

/// Hovering with the camera at `T_world_place`, rotors carrying it.
Quadrotor placed(World& world, const RobotFolder& robot, const Pose& T_world_place,
                 double camera_pitch_rad) {
  if (!find_model_id(world.model(), ModelObject::body, "object")) {
    throw InputError(fmt::format(
        "{}: has no body 'object'; a scene of recognition has <include file=\"object.xml\"/>",
        world.source().scene.string()));
  }
  Quadrotor vehicle(world.model(), quadrotor_of(robot, "robot.model"), robot.description.string(),
                    world.source().scene.string());
  const Pose T_world_body = vehicle.body_for_camera(
      T_world_place.translation(), project_to_se2(T_world_place).yaw_rad, camera_pitch_rad);
  vehicle.place(world, T_world_body, camera_pitch_rad);
  return vehicle;
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

}  // namespace

SimulatedOrbitRobot::SimulatedOrbitRobot(const EpisodeSetup& setup, const ModelSource& source,
                                         const ObjectFlight& task,
                                         std::span<const ObjectOnTable> objects)
    : task_(task),
      objects_(objects_of(task, objects)),
      start_bearing_rad_(Rng::stream(setup.options.seed, "start bearing").uniform(0.0, kTurn_rad)),
      T_world_place_(objects_.front().orbit.place(start_bearing_rad_)),
      quadrotor_(setup.options, source, task.tracking,
                 {task.camera, task.exposure, task.colour_noise},
                 [&](World& world) {
                   return placed(world, setup.robot, T_world_place_, task.elevation_rad);
                 }),
      camera_noise_(Rng::stream(setup.options.seed, "camera")) {}

std::vector<SimulatedOrbitRobot::Object> SimulatedOrbitRobot::objects_of(
    const ObjectFlight& task, std::span<const ObjectOnTable> objects) {
  expects(!objects.empty(), "a place to look at");
  std::vector<Object> result;
  for (const ObjectOnTable& object : objects) {
    const auto on_table = [&](const Eigen::Vector2d& p_m) -> Eigen::Vector3d {
      return task.p_world_table_m() + Eigen::Vector3d(p_m.x(), p_m.y(), 0.0);
    };
    result.push_back(
        {task.orbit_round(on_table(object.told_m)), on_table(object.offset_m), object.yaw_rad});
  }
  return result;
}

FlightObservation SimulatedOrbitRobot::observe() {
  throw_if_interrupted();
  require_untouched(quadrotor_.tracking().hold(task_.settle_s));
  auto images = quadrotor_.faults().arriving(quadrotor_.colour_image(camera_noise_), time_s());
  const bool arrived = images.has_value();
  return {.arrived = arrived,
          .images = arrived ? std::move(*images) : CameraImages{},
          .T_world_camera = estimated_body() * quadrotor_.T_body_camera()};
}

FlightResult SimulatedOrbitRobot::fly_along(std::span<const Pose> T_world_places) {
  const FlightPlan planned = plan(T_world_places);
  T_world_place_ = T_world_places.back();
  const FlightResult flight =
      quadrotor_.tracking().fly_to(planned.waypoints, [](const TrajectoryTrackingController&) {
        throw_if_interrupted();
        return true;
      });
  require_untouched(flight);
  return flight;
}

/// A quadrotor that touches something does not fly on.
void SimulatedOrbitRobot::require_untouched(const FlightResult& flight) const {
  if (flight.status != FlightStatus::contact) return;
  throw EpisodeFailed(
      fmt::format("the quadrotor touched {} at {:.2f} s", quadrotor_.touched(), time_s()));
}

FlightPlan SimulatedOrbitRobot::plan(std::span<const Pose> T_world_places) const {
  expects(!T_world_places.empty(), "a place to fly to");
  FlightPlan plan;
  const FlightReference& reference = quadrotor_.tracking().reference();
  Eigen::Vector3d at_m = reference.p_world_m;
  for (const Pose& place : T_world_places) {
    plan.waypoints.push_back(waypoint(place));
    plan.path_m += (plan.waypoints.back().p_world_m - at_m).norm();
    at_m = plan.waypoints.back().p_world_m;
  }
  const MinimumJerkTrajectory path(reference, plan.waypoints, task_.tracking.limits);
  plan.duration_s = path.duration_s();
  const Airframe& airframe = quadrotor_.vehicle().airframe();
  const Allocation hover = allocate(airframe, {.collective_N = airframe.weight_N()});
  plan.energy_j =
      plan.duration_s * induced_power_W(hover.thrust_N, quadrotor_.vehicle().rotor_radius_m());
  return plan;
}

FlightWaypoint SimulatedOrbitRobot::waypoint(const Pose& T_world_place) const {
  const double yaw_rad = project_to_se2(T_world_place).yaw_rad;
  const Pose T_world_body = quadrotor_.vehicle().body_for_camera(T_world_place.translation(),
                                                                 yaw_rad, task_.elevation_rad);
  return {.p_world_m = T_world_body.translation(), .yaw_rad = yaw_rad};
}

OrbitGroundTruth SimulatedOrbitRobot::ground_truth(std::size_t object) const {
  const Quadrotor& vehicle = quadrotor_.vehicle();
  const World& world = quadrotor_.world();
  const FlightWaypoint meant = waypoint(T_world_place_);
  const Pose T_world_meant =
      make_pose(meant.p_world_m, meant.yaw_rad) * vehicle.T_body_camera(task_.elevation_rad);
  const Pose T_world_camera =
      vantage::T_world_camera(world.model(), world.snapshot(), vehicle.camera_id());
  const auto& [orbit, p_world_drawn_m, yaw_rad] = objects_[object];
  const Eigen::Vector3d p_world_object_m = p_world_drawn_m + world.moved_m(body_of_target(object));
  const Eigen::Vector3d from_object_m = T_world_camera.translation() - p_world_object_m;
  const double seen_rad = yaw_rad - std::atan2(from_object_m.y(), from_object_m.x());
  return {.collisions = quadrotor_.collisions(),
          .position_error_m = (T_world_camera.translation() - T_world_meant.translation()).norm(),
          .angle_error_rad = angle_between(T_world_camera.linear(), T_world_meant.linear()),
          .object_angle_rad = seen_rad - kTurn_rad * std::floor(seen_rad / kTurn_rad)};
}

}  // namespace vantage
