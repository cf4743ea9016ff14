#include "vantage/tasks/exploration/simulated_exploration_robot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "vantage/sim/sensors/camera.hpp"
#include "vantage/tasks/exploration/start_check.hpp"
#include "vantage/tasks/mapping/simulated/simulated_mobile_base.hpp"

namespace vantage {
namespace {

/// The head is at rest when neither joint moves faster than this; the encoders say exactly where.
constexpr double kAtRest_rad_s = 0.004;
constexpr double kLeast_s = 0.1;
constexpr double kMost_s = 4.0;

Pose find_camera_pose(const World& world, const MobileBase& robot) {
  return to_se3(robot.T_world_base(world)).inverse() *
         T_world_camera(world.model(), world.snapshot(), robot.camera_id());
}

/// On the pan axis, at the height that the camera has when it looks straight on.
Pose find_sweep_pose(const World& world, const MobileBase& robot) {
  const Pose T_base_head =
      to_se3(robot.T_world_base(world)).inverse() * body_pose(world, robot.head_body_id());
  Pose T_base_sweep = Pose::Identity();
  T_base_sweep.translation() = T_base_head.translation();
  T_base_sweep.translation().z() = find_camera_pose(world, robot).translation().z();
  return T_base_sweep;
}

/// From the pan axis to the camera, along the floor; the head looks straight on.
double camera_ahead_m(const World& world, const MobileBase& robot) {
  return (find_camera_pose(world, robot).translation() -
          find_sweep_pose(world, robot).translation())
      .head<2>()
      .norm();
}

/// Where the robot starts: robot.start_site or robot.start_pose.
/// @throws ConfigError naming the scene's sites if it has none of that name.
Pose2 start_pose(const World& world, const EpisodeSetup& setup) {
  const RobotOptions& robot = setup.options.robot;
  if (robot.start_site.empty()) return robot.posed_start();
  if (const auto site = find_model_id(world.model(), ModelObject::site, robot.start_site)) {
    return project_to_se2(site_pose(world, *site));
  }
  std::vector<std::string> known = model_names(world.model(), ModelObject::site);
  std::erase_if(known, [](const std::string& name) { return name.starts_with("robot/"); });
  throw ConfigError(fmt::format("robot.start_site: no site '{}' in {}; {}", robot.start_site,
                                setup.scene.string(),
                                known.empty() ? "it has none: set robot.start_pose"
                                              : fmt::format("known: {}", fmt::join(known, ", "))));
}

/// The lift that brings the camera from `unlifted_m` to frontiers.height_m.
/// @throws ConfigError if it cannot.
double camera_lift_m(const MobileBase& robot, double unlifted_m, const Exploration& task) {
  const double height_m = task.frontiers.height_m;
  const double lift_m = height_m - unlifted_m;
  if (lift_m < robot.lift_min_m() - 1e-2 || lift_m > robot.lift_max_m() + 1e-6) {
    const double lowest_m = unlifted_m + robot.lift_min_m();
    const double highest_m = unlifted_m + robot.lift_max_m();
    const double fitting_m =
        std::floor(1e3 * std::clamp(height_m, lowest_m, highest_m) + 1e-6) / 1e3;
    throw ConfigError(fmt::format(
        "frontiers.height_m: {} is out of the camera's reach, {:.3f} to {:.3f}; {:.3f} fits, in "
        "robot.yaml episode_defaults: {{exploration: {{frontiers: {{height_m: {:.3f}}}}}}}",
        height_m, lowest_m, highest_m, fitting_m, fitting_m));
  }
  return std::clamp(lift_m, robot.lift_min_m(), robot.lift_max_m());
}

MobileBase placed_robot(World& world, const EpisodeSetup& setup, const Exploration& task) {
  MobileBase robot = mobile_base(world, setup, task.navigation);
  const Pose2 start = start_pose(world, setup);
  robot.place(world, start);
  const double lowest_m = find_sweep_pose(world, robot).translation().z();
  robot.place(world, start, camera_lift_m(robot, lowest_m, task));
  return robot;
}

}  // namespace

void check_camera_reach(const World& world, const MobileBase& robot, const Exploration& task) {
  const double now_m = find_sweep_pose(world, robot).translation().z();
  camera_lift_m(robot, now_m - robot.lift_m(world), task);
}

SimulatedExplorationRobot::SimulatedExplorationRobot(const EpisodeSetup& setup,
                                                     const Exploration& task)
    : DrivenByBase(setup.options, task, ModelSource{setup.scene, setup.robot.mjcf},
                   [&](World& world) { return placed_robot(world, setup, task); }),
      camera_(task.camera),
      images_(images_of(task.sweep, camera_)),
      T_base_sweep_(find_sweep_pose(base_.world(), base_.robot())),
      field_(swept_field(task.sweep, camera_, camera_ahead_m(base_.world(), base_.robot()))),
      renderer_(
          make_offscreen_renderer(base_.world().model(), camera_.width_px, camera_.height_px)),
      camera_noise_(Rng::stream(setup.options.seed, "camera")),
      measuring_(setup.options.threads > 1 ? std::launch::async : std::launch::deferred) {
  check_exploration_start(base_.world(), base_.robot(), base_.ground_truth().geometry(), setup,
                          task);
  check_turning_room(base_.world(), base_.robot(), start_text(setup.options.robot));
  base_.note_localisation(task.registration, setup.options.seed, start_notes_);
  if (std::string note = floor_map_note(task); !note.empty()) {
    start_notes_.push_back(std::move(note));
  }
}

/// Every other row backwards: it begins where the one before ended.
std::vector<Gaze> SimulatedExplorationRobot::gazes_in_turn(
    std::span<const std::size_t> images) const {
  std::vector<Gaze> gazes;
  for (const std::size_t image : images) gazes.push_back(images_.gazes()[image]);
  if (images.empty()) gazes = images_.gazes();
  bool backwards = false;
  for (auto row = gazes.begin(); row != gazes.end(); backwards = !backwards) {
    const auto end = std::find_if(row, gazes.end(),
                                  [&](const Gaze& gaze) { return gaze.tilt_rad != row->tilt_rad; });
    if (backwards) std::reverse(row, end);
    row = end;
  }
  return gazes;
}

ExplorationObservation SimulatedExplorationRobot::observe(std::span<const std::size_t> images) {
  base_.robot().command_twist(base_.world(), {});
  ExplorationObservation observation;
  std::vector<double> taken_s;
  const std::vector<Gaze> gazes = gazes_in_turn(images);
  observation.views.reserve(gazes.size());
  std::future<void> measuring;  // of an image, while the head turns to the next
  for (const Gaze& gaze : gazes) {
    turn_head(gaze);
    observation.views.push_back(draw_image());
    taken_s.push_back(base_.world().time_s());
    if (measuring.valid()) measuring.get();
    measuring = std::async(measuring_, [this, &drawn = observation.views.back().image] {
      measure_depth(drawn, camera_, camera_noise_);
    });
  }
  measuring.get();
  observation.views = arriving(std::move(observation.views), taken_s);
  base_.robot().command_head(base_.world(), 0.0, 0.0);
  observation.base_scan = read_base_scanner();
  observation.base_scan_height_m = base_scan_height_m();
  observation.T_world_base_odometry = estimated_base();
  return observation;
}

/// Of those that were taken at these times.
std::vector<HeadView> SimulatedExplorationRobot::arriving(std::vector<HeadView> taken,
                                                          std::span<const double> taken_s) {
  std::vector<HeadView> views;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    auto image = base_.faults().arriving(std::move(taken[i].image), taken_s[i]);
    if (image) views.push_back({std::move(*image), taken[i].T_base_camera});
  }
  return views;
}

void SimulatedExplorationRobot::look(const Gaze& gaze) {
  base_.robot().command_head(base_.world(), gaze.pan_rad, gaze.tilt_rad);
}

bool SimulatedExplorationRobot::head_rests() const {
  constexpr double kAtRest_rad_s = 0.05;  // a pixel while an image is exposed
  return base_.robot().head_rate_rad_s(base_.world()) < kAtRest_rad_s;
}

std::optional<HeadView> SimulatedExplorationRobot::take_image() {
  HeadView view = draw_image();
  measure_depth(view.image, camera_, camera_noise_);
  auto image = base_.faults().arriving(std::move(view.image), base_.world().time_s());
  if (!image) return std::nullopt;
  return HeadView{std::move(*image), view.T_base_camera};
}

void SimulatedExplorationRobot::turn_head(const Gaze& gaze) {
  look(gaze);
  const double period_s = base_.world().options().control_period_s;
  const auto fewest = std::lround(kLeast_s / period_s);
  const auto most = std::lround(kMost_s / period_s);
  for (long i = 0; i < most; ++i) {
    const double pan_before = base_.robot().head_pan_rad(base_.world());
    const double tilt_before = base_.robot().head_tilt_rad(base_.world());
    base_.tick();
    const double moved_rad =
        std::max(std::abs(base_.robot().head_pan_rad(base_.world()) - pan_before),
                 std::abs(base_.robot().head_tilt_rad(base_.world()) - tilt_before));
    if (i >= fewest && moved_rad < kAtRest_rad_s * period_s) return;
  }
}

/// Depth is exact yet.
HeadView SimulatedExplorationRobot::draw_image() {
  const mjData& now = base_.world().snapshot();
  return {
      exact_depth_image(*renderer_, base_.world().model(), now, base_.robot().camera_id(), camera_),
      find_camera_pose(base_.world(), base_.robot())};
}

Pose2 SimulatedExplorationRobot::base_for_sensor(const Pose& T_world_sweep) const {
  return compose(project_to_se2(T_world_sweep), inverse(project_to_se2(T_base_sweep_)));
}

Pose SimulatedExplorationRobot::estimated_sensor() const {
  return to_se3(estimated_base()) * T_base_sweep_;
}

}  // namespace vantage
