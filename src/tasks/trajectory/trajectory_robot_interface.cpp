#include "vantage/tasks/trajectory/trajectory_robot_interface.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/model_source.hpp"

namespace vantage {
namespace {

/// Between measurements of the true clearance.
constexpr double kClearanceEvery_s = 0.1;
constexpr double kSameMoment_s = 1e-9;

Quadrotor hovering(World& world, const FlightWaypoint& start, double camera_pitch_rad) {
  Quadrotor vehicle(world.model());
  vehicle.place(world, make_pose(start.p_world_m, start.yaw_rad), camera_pitch_rad);
  return vehicle;
}

}  // namespace

TrajectoryRobotInterface::TrajectoryRobotInterface(const ResolvedEpisode& resolved,
                                                   const FlightWaypoint& start)
    : task_(resolved.episode.trajectory),
      world_(model_source(resolved), resolved.episode.simulation),
      vehicle_(hovering(world_, start, task_.camera_pitch_rad)),
      tracking_(world_, vehicle_, task_.tracking, Rng::stream(resolved.episode.seed, "pose")),
      clearance_(world_),
      renderer_(
          make_offscreen_renderer(world_.model(), task_.camera.width_px, task_.camera.height_px)),
      depth_noise_(Rng::stream(resolved.episode.seed, "camera")),
      colour_noise_(Rng::stream(resolved.episode.seed, "colour")) {
  clearance_.update(world_);
}

void TrajectoryRobotInterface::follow(std::span<const FlightWaypoint> waypoints) {
  path_.emplace(tracking_.reference(), waypoints, task_.tracking.limits);
  path_start_s_ = world_.time_s();
}

void TrajectoryRobotInterface::fly_for(double duration_s, const ImageCallback& on_image) {
  const double end_s = world_.time_s() + duration_s;
  while (world_.time_s() < end_s - kSameMoment_s) {
    throw_if_interrupted();
    tick();
    if (world_.time_s() >= next_image_s_ - kSameMoment_s) capture_now(on_image);
  }
}

void TrajectoryRobotInterface::fly_past(int waypoints, const ImageCallback& on_image) {
  expects(path_.has_value(), "a plan to follow");
  const auto last = path_->knots_s().size() - 1;
  const auto goal = std::min(last, static_cast<std::size_t>(passed() + waypoints));
  fly_for(path_start_s_ + path_->knots_s()[goal] - world_.time_s(), on_image);
}

MinimumJerkTrajectory TrajectoryRobotInterface::path_in(
    double delay_s, std::span<const FlightWaypoint> waypoints) const {
  const FlightReference from =
      path_ ? path_->at(world_.time_s() - path_start_s_ + delay_s) : tracking_.reference();
  return {from, waypoints, task_.tracking.limits};
}

std::optional<MinimumJerkTrajectory> TrajectoryRobotInterface::path_on(double delay_s) const {
  constexpr std::size_t kMinWaypoints = 3;  // it is at rest at the last
  if (!path_) return std::nullopt;
  const std::size_t waypoints = path_->knots_s().size() - 1;
  if (waypoints < static_cast<std::size_t>(passed(delay_s)) + kMinWaypoints) return std::nullopt;
  return path_->from(world_.time_s() - path_start_s_ + delay_s);
}

int TrajectoryRobotInterface::passed(double in_s) const {
  if (!path_) return 0;
  const double since_s = world_.time_s() - path_start_s_ + in_s + kSameMoment_s;
  const auto& knots_s = path_->knots_s();
  return static_cast<int>(std::upper_bound(knots_s.begin() + 1, knots_s.end(), since_s) -
                          (knots_s.begin() + 1));
}

void TrajectoryRobotInterface::tick() {
  const double period_s = world_.options().control_period_s;
  const Eigen::Vector3d before_m = true_body().translation();
  tracking_.tick(path_ ? path_->at(world_.time_s() - path_start_s_ + period_s)
                       : tracking_.reference());
  const Eigen::Vector3d after_m = true_body().translation();
  const double error_m = (after_m - tracking_.reference().p_world_m).norm();
  flown_s_ += period_s;
  flown_m_ += (after_m - before_m).norm();
  error_m_s_ += period_s * error_m;
  error_max_m_ = std::max(error_max_m_, error_m);
  energy_j_ += period_s * induced_power_W(vehicle_.thrusts_N(world_), vehicle_.rotor_radius_m());
  if (world_.time_s() >= next_clearance_s_ - kSameMoment_s) {
    clearance_.update(world_);
    next_clearance_s_ = world_.time_s() + kClearanceEvery_s;
  }
  if (tracking_.collisions() > 0) {
    clearance_.touched();
    throw EpisodeFailed(fmt::format("touched {} at {:.2f} s, ({:.2f}, {:.2f}, {:.2f}) m", touched(),
                                    world_.time_s(), after_m.x(), after_m.y(), after_m.z()));
  }
}

std::string TrajectoryRobotInterface::touched() const {
  std::vector<std::string> names;
  for (const int geom : vehicle_.touched_geoms(world_)) {
    const std::string name = model_name(world_.model(), ModelObject::geom, geom);
    names.push_back(name.empty() ? fmt::format("geom number {}", geom) : name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void TrajectoryRobotInterface::capture_now(const ImageCallback& on_image) {
  next_image_s_ = world_.time_s() + 1.0 / task_.image_rate_hz;
  FlightImage image;
  image.time_s = world_.time_s();
  image.depth = depth_image(*renderer_, world_.model(), world_.snapshot(), vehicle_.camera_id(),
                            task_.camera, depth_noise_);
  image.T_world_camera = estimated_body() * T_body_camera();
  image.with_colour = [&] {
    CameraImages images = colour_image();
    images.depth_m = image.depth.depth_m;
    return images;
  };
  on_image(image);
}

CameraImages TrajectoryRobotInterface::colour_image() {
  CameraImages images = rgbd_exposed(*renderer_, world_, vehicle_.camera_id(), task_.camera,
                                     task_.exposure, colour_noise_);
  images.segmentation.clear();  // truth
  if (task_.colour_noise == 0.0) return images;
  for (std::uint8_t& value : images.rgb) {
    const double noisy = value + task_.colour_noise * colour_noise_.normal();
    value = static_cast<std::uint8_t>(std::lround(std::clamp(noisy, 0.0, 255.0)));
  }
  return images;
}

Pose TrajectoryRobotInterface::T_body_camera() const {
  return vehicle_.T_body_camera(vehicle_.camera_pitch_rad(world_));
}

TrajectoryTruth TrajectoryRobotInterface::truth() const {
  return {.collisions = tracking_.collisions(),
          .minimum_clearance_m = clearance_.min_m(),
          .tracking_error_mean_m = flown_s_ > 0.0 ? error_m_s_ / flown_s_ : 0.0,
          .tracking_error_max_m = error_max_m_,
          .energy_j = energy_j_,
          .flown_m = flown_m_};
}

}  // namespace vantage
