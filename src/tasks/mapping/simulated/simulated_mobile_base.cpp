#include "vantage/tasks/mapping/simulated/simulated_mobile_base.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "vantage/core/log.hpp"
#include "vantage/perception/clouds/reference_map.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/sim/world/settle.hpp"

namespace vantage {
namespace {

std::string geom_text(const mjModel& model, int geom) {
  const std::string name = model_name(model, ModelObject::geom, geom);
  return name.empty() ? fmt::format("geom number {}", geom) : fmt::format("'{}'", name);
}

/// With the robot where it starts and the scene's free bodies at rest.
/// @throws InputError naming the scene and the body if one does not come to rest.
MobileBase settled(const std::function<MobileBase(World&)>& place, World& world) {
  MobileBase robot = place(world);
  try {
    const std::vector<std::string> moved = settle_free_bodies(world);
    if (!moved.empty()) {
      log_info(
          fmt::format("bodies that came to rest before the start: {}", fmt::join(moved, ", ")));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("scene: {}: {}", world.source().scene.string(), error.what()));
  }
  return robot;
}

}  // namespace

MobileBase mobile_base(const World& world, const EpisodeSetup& setup,
                       const NavigationOptions& navigation) {
  MobileBase robot(world.model(), mobile_base_of(setup.robot, "robot.model"),
                   setup.robot.description.string());
  const double covered_m = robot.footprint().circumscribed_radius_m;
  constexpr double kRounded_m = 0.001;
  if (const double reach_m = circumscribed_radius_m(robot.outline());
      reach_m > covered_m + kRounded_m) {
    throw InputError(fmt::format(
        "robot: {}: footprint.circumscribed_radius_m {} is less than its outline reaches, {:.3f}",
        setup.robot.description.string(), covered_m, reach_m));
  }
  if (navigation.footprint_radius_m >= covered_m) return robot;
  throw ConfigError(fmt::format(
      "navigation.footprint_radius_m: {} is less than the robot's circumscribed_radius_m {}",
      navigation.footprint_radius_m, covered_m));
}

SimulatedMobileBase::SimulatedMobileBase(const EpisodeOptions& episode,
                                         const MappingOptions& options, const ModelSource& source,
                                         const std::function<MobileBase(World&)>& place)
    : drive_(options.drive),
      scanner_(options.base_scanner),
      world_(source, episode.simulation),
      robot_(settled(place, world_)),
      geometry_(world_.model(), world_.snapshot()),
      geometry_without_robot_(world_.model(), world_.snapshot(), kWithoutRobot),
      odometry_(options.odometry, Rng::stream(episode.seed, "odometry"),
                robot_.T_world_base(world_)),
      scanner_noise_(Rng::stream(episode.seed, "base scanner")),
      faults_(episode.faults, episode.seed) {
  restart_dead_reckoning();
  faults_.attach(world_);
  odometry_.on_increment = [this](const Pose2& increment) {
    return faults_.reported(increment, world_.time_s());
  };
  world_.on_step = [this](const World& world) {
    energy_used_j_ += robot_.power_w(world) * world.options().timestep_s;
    if (collisions_.update(robot_, world) > 0) report_touch();
  };
}

/// For whoever reads the log; the robot has no sense of touch.
void SimulatedMobileBase::report_touch() const {
  std::string names;
  for (const int geom : robot_.touched_geoms(world_)) {
    names += " '" + model_name(world_.model(), ModelObject::geom, geom) + "'";
  }
  const Pose2 pose = robot_.T_world_base(world_);
  log_warning(fmt::format("{:.2f} s: the robot at ({:.2f}, {:.2f}) touches{}", world_.time_s(),
                          pose.x_m, pose.y_m, names));
}

void SimulatedMobileBase::tick() {
  throw_if_interrupted();
  world_.advance_tick();
  odometry_.update(robot_.T_world_base(world_));
}

const RayScene& SimulatedMobileBase::seen_geometry() {
  geometry_.update(world_.snapshot());
  return geometry_;
}

PlanarScan SimulatedMobileBase::read_base_scanner() {
  PlanarScan scan =
      planar_scan(seen_geometry(), robot_.T_world_base_scan(world_), robot_.T_base_base_scan(),
                  robot_.base_scan_body_id(), scanner_, scanner_noise_);
  faults_.spoil_planar(scan, world_.time_s());
  return scan;
}

void SimulatedMobileBase::note_localisation(const RegistrationOptions& registration,
                                            std::uint64_t seed, std::vector<std::string>& notes) {
  Rng noise = Rng::stream(seed, "start check");
  const PlanarScan scan =
      planar_scan(seen_geometry(), robot_.T_world_base_scan(world_), robot_.T_base_base_scan(),
                  robot_.base_scan_body_id(), scanner_, noise);
  const ReferenceMap reference(registration);
  if (reference.walls_fix_pose(scan, base_scan_height_m())) return;
  notes.push_back(
      fmt::format("registration: from the start of {} the base scanner sees no walls within "
                  "base_scanner.range_max_m {} that fix where the robot is: {}",
                  world_.source().scene.string(), scanner_.range_max_m,
                  reference.posts_fix_pose(scan)
                      ? "it goes by posts, such as table legs, good to a centimetre or two"
                      : "odometry will drift between scans"));
}

DriveResult SimulatedMobileBase::drive_along(std::span<const Pose2> path, double max_speed_m_s,
                                             const std::function<bool()>& go_on) {
  DriveOptions options = drive_;
  options.controller.speed_m_s = std::min(options.controller.speed_m_s, max_speed_m_s);
  return drive(world_, robot_, odometry_, path, options, [&](World&, const Pose2&) {
    throw_if_interrupted();
    return go_on();
  });
}

void SimulatedMobileBase::correct_pose(const Pose2& T_world_base) {
  T_world_dead_reckoned_ = dead_reckoned_base();
  T_world_corrected_ = T_world_base;
  odometry_.correct(T_world_base);
}

void SimulatedMobileBase::restart_dead_reckoning() {
  T_world_dead_reckoned_ = T_world_corrected_ = odometry_.estimate();
}

Pose2 SimulatedMobileBase::dead_reckoned_base() const {
  return compose(T_world_dead_reckoned_,
                 compose(inverse(T_world_corrected_), odometry_.estimate()));
}

void check_turning_room(const World& world, const MobileBase& robot, const std::string& place) {
  if (const auto touched = robot.touched_by_turning(world); !touched.empty()) {
    throw ConfigError(fmt::format("{}: the robot would touch {} when it turns there", place,
                                  geom_text(world.model(), touched.front())));
  }
}

}  // namespace vantage
