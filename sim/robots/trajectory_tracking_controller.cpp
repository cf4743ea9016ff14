#include "vantage/sim/robots/trajectory_tracking_controller.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

FlightReference standing_at(const FlightReference& reference) {
  return {.p_world_m = reference.p_world_m, .yaw_rad = reference.yaw_rad};
}

}  // namespace

void add_gusts(World& world, int body_id, const std::vector<Gust>& gusts) {
  for (const Gust& gust : gusts) {
    world.add_outside_force(
        {body_id, [gust](double time_s) { return gust.force_world_N(time_s); }});
  }
}

std::string_view to_string(FlightStatus status) {
  switch (status) {
    case FlightStatus::arrived: return "arrived";
    case FlightStatus::contact: return "contact";
    case FlightStatus::stopped: return "stopped";
    case FlightStatus::timeout: return "timeout";
  }
  return "unknown";
}

TrajectoryTrackingController::TrajectoryTrackingController(World& world, const Quadrotor& vehicle,
                                                           const TrajectoryTrackingOptions& options,
                                                           Rng rng)
    : world_(world), vehicle_(vehicle), options_(options), estimate_(options.pose_noise, rng) {
  check_options(options_, "trajectory tracking");
  if (world_.options().steps_per_tick() != 1) {
    throw ConfigError(
        "world.control_period_s must equal world.timestep_s: a quadrotor is commanded "
        "at every step");
  }
  const Pose T_world_body = vehicle_.state(world_).T_world_body;
  reference_.p_world_m = T_world_body.translation();
  reference_.yaw_rad = project_to_se2(T_world_body).yaw_rad;
  add_gusts(world_, vehicle_.base_body_id(), options_.gusts);
}

FlightState TrajectoryTrackingController::estimate() const {
  return estimate_.of(vehicle_.state(world_));
}

FlightResult TrajectoryTrackingController::fly_to(std::span<const FlightWaypoint> waypoints,
                                                  const KeepFlying& keep) {
  return follow(MinimumJerkTrajectory(reference_, waypoints, options_.limits), keep);
}

FlightResult TrajectoryTrackingController::follow(const MinimumJerkTrajectory& path,
                                                  const KeepFlying& keep) {
  begin();
  return result_since(fly(path, keep));
}

FlightResult TrajectoryTrackingController::hold(double duration_s) {
  begin();
  const FlightReference here = standing_at(reference_);
  const double end_s = world_.time_s() + duration_s;
  while (world_.time_s() < end_s - 1e-9) {
    tick(here);
    if (collisions_.count() > log_.collisions) return result_since(FlightStatus::contact);
  }
  return result_since(FlightStatus::arrived);
}

FlightStatus TrajectoryTrackingController::fly(const MinimumJerkTrajectory& path,
                                               const KeepFlying& keep) {
  const double start_s = world_.time_s();
  const double latest_s = start_s + path.duration_s() + options_.timeout_s;
  double settled_s = 0.0;
  while (world_.time_s() < latest_s) {
    const double period_s = world_.options().control_period_s;
    tick(path.at(world_.time_s() - start_s + period_s));
    if (collisions_.count() > log_.collisions) return FlightStatus::contact;
    if (keep && !keep(*this)) return FlightStatus::stopped;
    const bool at_goal = world_.time_s() - start_s >= path.duration_s() && is_at(path.goal());
    settled_s = at_goal ? settled_s + period_s : 0.0;
    if (at_goal && settled_s >= options_.settle_time_s) return FlightStatus::arrived;
  }
  return FlightStatus::timeout;
}

bool TrajectoryTrackingController::is_at(const FlightWaypoint& goal) const {
  const FlightState now = estimate();
  const double turn_rad = wrap_angle(project_to_se2(now.T_world_body).yaw_rad - goal.yaw_rad);
  return (now.T_world_body.translation() - goal.p_world_m).norm() < options_.goal_tolerance_m &&
         std::abs(turn_rad) < options_.goal_tolerance_rad &&
         now.v_world_m_s.norm() < options_.rest_speed_m_s;
}

void TrajectoryTrackingController::tick(const FlightReference& reference) {
  const double period_s = world_.options().control_period_s;
  reference_ = reference;
  const FlightState before = vehicle_.state(world_);
  const Allocation given = control_flight(estimate_.of(before), reference, vehicle_.airframe(),
                                          period_s, options_.controller, memory_);
  vehicle_.command_thrusts(world_, given.thrust_N);
  world_.advance_tick();
  estimate_.update(period_s);
  collisions_.update(vehicle_, world_);
  log_tick(before, vehicle_.state(world_));
}

void TrajectoryTrackingController::begin() {
  log_ = {.start_s = world_.time_s(), .collisions = collisions_.count()};
}

void TrajectoryTrackingController::log_tick(const FlightState& before, const FlightState& after) {
  const double period_s = world_.options().control_period_s;
  const Eigen::Vector3d p_m = after.T_world_body.translation();
  const double error_m = (p_m - reference_.p_world_m).norm();
  log_.path_length_m += (p_m - before.T_world_body.translation()).norm();
  log_.squared_error_m2_s += period_s * error_m * error_m;
  log_.greatest_error_m = std::max(log_.greatest_error_m, error_m);
  log_.energy_J +=
      period_s * induced_power_W(vehicle_.thrusts_N(world_), vehicle_.rotor_radius_m());
}

FlightResult TrajectoryTrackingController::result_since(FlightStatus status) const {
  FlightResult result{.status = status,
                      .duration_s = world_.time_s() - log_.start_s,
                      .path_length_m = log_.path_length_m,
                      .greatest_error_m = log_.greatest_error_m,
                      .energy_J = log_.energy_J};
  if (result.duration_s > 0.0) {
    result.rms_error_m = std::sqrt(log_.squared_error_m2_s / result.duration_s);
  }
  return result;
}

}  // namespace vantage
