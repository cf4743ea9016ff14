#include "vantage/tasks/recognition/orbit_robot_interface.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/model_source.hpp"
#include "vantage/tasks/recognition/object_on_table.hpp"

namespace vantage {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

Orbit camera_orbit(const RecognitionTask& task) {
  const Eigen::Vector3d aim_m(task.table_m[0], task.table_m[1],
                              task.table_m[2] + task.aim_height_m);
  return Orbit::at_elevation(aim_m, task.distance_m, task.elevation_rad);
}

/// Hovering with the camera at `T_world_place`, rotors carrying it.
Quadrotor placed(World& world, const Pose& T_world_place, double camera_pitch_rad) {
  if (!find_model_id(world.model(), ModelObject::body, "object")) {
    throw InputError(fmt::format(
        "{}: has no body 'object'; a scene of recognition has <include file=\"object.xml\"/>",
        world.source().scene.string()));
  }
  Quadrotor vehicle(world.model());
  const Pose T_world_body = vehicle.body_for_camera(
      T_world_place.translation(), project_to_se2(T_world_place).yaw_rad, camera_pitch_rad);
  vehicle.place(world, T_world_body, camera_pitch_rad);
  return vehicle;
}

void add_colour_noise(CameraImages& images, double sigma, Rng& rng) {
  if (sigma == 0.0) return;
  for (std::uint8_t& value : images.rgb) {
    const double noisy = std::clamp(value + sigma * rng.normal(), 0.0, 255.0);
    value = static_cast<std::uint8_t>(std::lround(noisy));
  }
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

}  // namespace

OrbitRobotInterface::OrbitRobotInterface(const ResolvedEpisode& resolved)
    : episode_(resolved.episode),
      orbit_(camera_orbit(episode_.recognition)),
      start_bearing_rad_(Rng::stream(episode_.seed, "start bearing").uniform(0.0, kTurn_rad)),
      bearing_rad_(start_bearing_rad_),
      world_(model_source(resolved), episode_.simulation),
      vehicle_(placed(world_, orbit_.place(bearing_rad_), episode_.recognition.elevation_rad)),
      tracking_(world_, vehicle_, episode_.recognition.tracking,
                Rng::stream(episode_.seed, "pose")),
      object_yaw_rad_(draw_object_on_table(episode_).yaw_rad),
      renderer_(make_offscreen_renderer(world_.model(), episode_.recognition.camera.width_px,
                                        episode_.recognition.camera.height_px)),
      camera_noise_(Rng::stream(episode_.seed, "camera")) {}

FlightObservation OrbitRobotInterface::observe() {
  const RecognitionTask& task = episode_.recognition;
  throw_if_interrupted();
  require_untouched(tracking_.hold(task.settle_s));
  FlightObservation observation;
  observation.images = rgbd_exposed(*renderer_, world_, vehicle_.camera_id(), task.camera,
                                    task.exposure, camera_noise_);
  observation.images.segmentation.clear();  // truth
  add_colour_noise(observation.images, task.colour_noise, camera_noise_);
  observation.T_world_camera =
      estimated_body() * vehicle_.T_body_camera(vehicle_.camera_pitch_rad(world_));
  observation.bearing_rad = bearing_rad_;
  return observation;
}

FlightResult OrbitRobotInterface::fly_to(double bearing_rad) {
  const FlightPlan planned = plan(bearing_rad);
  bearing_rad_ = bearing_rad;
  const FlightResult flight =
      tracking_.fly_to(planned.waypoints, [](const TrajectoryTrackingController&) {
        throw_if_interrupted();
        return true;
      });
  require_untouched(flight);
  return flight;
}

/// A quadrotor that touches something does not fly on.
void OrbitRobotInterface::require_untouched(const FlightResult& flight) const {
  if (flight.status != FlightStatus::contact) return;
  std::vector<std::string> touched;
  for (const int geom : vehicle_.touched_geoms(world_)) {
    const std::string name = model_name(world_.model(), ModelObject::geom, geom);
    touched.push_back(name.empty() ? fmt::format("geom number {}", geom) : name);
  }
  throw EpisodeFailed(fmt::format("the quadrotor touched {} at {:.2f} s", fmt::join(touched, ", "),
                                  world_.time_s()));
}

FlightPlan OrbitRobotInterface::plan(double bearing_rad) const {
  FlightPlan plan;
  Eigen::Vector3d at_m = tracking_.reference().p_world_m;
  for (const Pose& place :
       orbit_arc(orbit_, bearing_rad_, bearing_rad, episode_.recognition.arc_rad)) {
    plan.waypoints.push_back(waypoint(place));
    plan.path_m += (plan.waypoints.back().p_world_m - at_m).norm();
    at_m = plan.waypoints.back().p_world_m;
  }
  const MinimumJerkTrajectory path(tracking_.reference(), plan.waypoints,
                                   episode_.recognition.tracking.limits);
  plan.duration_s = path.duration_s();
  const Airframe& airframe = vehicle_.airframe();
  const Allocation hover = allocate(airframe, {.collective_N = airframe.weight_N()});
  plan.energy_j = plan.duration_s * induced_power_W(hover.thrust_N, vehicle_.rotor_radius_m());
  return plan;
}

Eigen::Vector3d OrbitRobotInterface::p_world_table_m() const {
  return Eigen::Map<const Eigen::Vector3d>(episode_.recognition.table_m.data());
}

FlightWaypoint OrbitRobotInterface::waypoint(const Pose& T_world_place) const {
  const double yaw_rad = project_to_se2(T_world_place).yaw_rad;
  const Pose T_world_body = vehicle_.body_for_camera(T_world_place.translation(), yaw_rad,
                                                     episode_.recognition.elevation_rad);
  return {.p_world_m = T_world_body.translation(), .yaw_rad = yaw_rad};
}

FlightTruth OrbitRobotInterface::truth() const {
  const FlightWaypoint meant = waypoint(orbit_.place(bearing_rad_));
  const Pose T_world_meant = make_pose(meant.p_world_m, meant.yaw_rad) *
                             vehicle_.T_body_camera(episode_.recognition.elevation_rad);
  const Pose T_world_camera =
      vantage::T_world_camera(world_.model(), world_.snapshot(), vehicle_.camera_id());
  const double seen_rad = object_yaw_rad_ - orbit_.bearing_rad(T_world_camera.translation());
  return {.collisions = tracking_.collisions(),
          .position_error_m = (T_world_camera.translation() - T_world_meant.translation()).norm(),
          .angle_error_rad = angle_between(T_world_camera.linear(), T_world_meant.linear()),
          .object_angle_rad = seen_rad - kTurn_rad * std::floor(seen_rad / kTurn_rad)};
}

}  // namespace vantage
