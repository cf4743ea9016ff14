#include "bench/model/modelled_exploration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "vantage/belief/map/headroom.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/sim/sensors/laser.hpp"
#include "vantage/tasks/exploration/frontier_views.hpp"

namespace vantage::bench {
namespace {

// Of episodes with physics.
constexpr double kStart_s = 13.9;  ///< until the first scan begins
constexpr double kScan_s = 19.6;
constexpr double kDrive_s = 2.5;  ///< of each drive, and of each metre of it
constexpr double kMetre_s = 2.2;

/// Ways between looks at the walls.
constexpr double kLook_m = 0.6;

/// A picture of few pixels is enough to learn how far beams go.
CameraImages depth_image(const RayScene& geometry, const RgbdOptions& camera,
                         const Pose& T_world_camera) {
  constexpr int kWidth_px = 40;
  constexpr int kHeight_px = 30;
  CameraImages image{.width_px = kWidth_px,
                     .height_px = kHeight_px,
                     .focal_px = 0.5 * kHeight_px / std::tan(0.5 * camera.fovy_rad),
                     .range_max_m = camera.range_max_m,
                     .rgb = {},
                     .depth_m = {}};
  for (int row = 0; row < kHeight_px; ++row) {
    for (int column = 0; column < kWidth_px; ++column) {
      const Eigen::Vector3d ray = image.ray(row, column);
      const RayHit hit =
          geometry.cast(T_world_camera.translation(), T_world_camera.linear() * ray.normalized(),
                        image.range_max_m * ray.norm());
      image.depth_m.push_back(hit.hit() ? static_cast<float>(hit.distance_m / ray.norm())
                                        : std::numeric_limits<float>::infinity());
    }
  }
  return image;
}

}  // namespace

ModelledBuilding::ModelledBuilding(ResolvedEpisode episode)
    : resolved(std::move(episode)),
      task(std::get<Exploration>(resolved.task)),
      robot(resolved.setup, task),
      truth(robot.ground_truth()),
      evaluator(task, 1, truth, robot.view_field(), robot.T_base_sweep()) {}

ModelledExploration::ModelledExploration(const ModelledBuilding& building, const Exploration& task)
    : building_(building),
      task_(task),
      grid_(task.map.frame()),
      hazard_(task.clutter_hazard, grid_.frame.cells),
      floor_(make_floor_map(task.floor_map)),
      traversed_(floor_.size(), 0),
      travel_(1.1 / kMetre_s),
      pose_(building.truth.T_world_base()),
      choice_rng_(choice_stream(task.choice, 700)),
      time_s_(kStart_s) {
  if (task.gaze.chooses()) partial_scans_ = PartialScans{building.robot.sweep_images(), task.gaze};
  clear_footprint(floor_, pose_, task.navigation.inflation_m() + floor_.cell_m);
  traverse(task.start_room_m);
}

std::vector<ReachedShare> ModelledExploration::run(const std::vector<double>& shares) {
  std::vector<ReachedShare> levels;
  for (const double share : shares) levels.push_back({share});
  while (scans_ < task_.scans) {
    scan();
    note_shares(levels);
    if (levels.back().scans > 0 || !go_on()) break;
  }
  return levels;
}

void ModelledExploration::note_shares(std::vector<ReachedShare>& levels) const {
  const auto& evaluator = building_.evaluator;
  const double share = 1.0 - static_cast<double>(evaluator.observable_unobserved(grid_)) /
                                 static_cast<double>(evaluator.observable_cells());
  for (ReachedShare& level : levels) {
    if (level.scans == 0 && share >= level.share) level = {level.share, time_s_, way_m_, scans_};
  }
}

void ModelledExploration::scan() {
  const Pose T_world_sweep = to_se3(pose_) * building_.robot.T_base_sweep();
  learn_hazard(T_world_sweep);
  const CellSet seen = building_.evaluator.visible_set(T_world_sweep);
  const auto& surface = building_.evaluator.surface();
  const SweepImages& sweep = building_.robot.sweep_images();
  const Pose T_sweep_world = T_world_sweep.inverse();
  int shown = 0;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    const bool is_seen = (seen[cell / 64] >> (cell % 64) & 1U) != 0;
    if (!is_seen || grid_.state(cell) != CellState::unobserved) continue;
    if (!images_.empty() &&
        !sweep.any_shows(images_, T_sweep_world * grid_.frame.centre(grid_.frame.cell(cell)))) {
      continue;
    }
    ++shown;
    grid_.log_odds[cell] = surface[cell] != 0 ? 3.0F : -3.0F;
  }
  look_at_walls();
  block_columns(floor_, grid_, traversed_, task_.headroom);
  ++scans_;
  const std::size_t images = images_.empty() ? sweep.gazes().size() : images_.size();
  time_s_ += kScan_s * static_cast<double>(images) / static_cast<double>(sweep.gazes().size());
  visited_.add(T_world_sweep.translation().head<2>(),
               shown < task_.poor_cells ? std::max(task_.poor_m, task_.taken_m) : task_.taken_m);
}

void ModelledExploration::learn_hazard(const Pose& T_world_sweep) {
  std::vector<CameraImages> images;
  std::vector<Pose> poses;
  Eigen::Matrix3d optical;
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const SweepImages& sweep = building_.robot.sweep_images();
  for (std::size_t image = 0; image < sweep.gazes().size(); ++image) {
    if (!images_.empty() && !std::ranges::binary_search(images_, image)) continue;
    const Gaze& gaze = sweep.gazes()[image];
    Pose T_world_camera = T_world_sweep *
                          Eigen::AngleAxisd(gaze.pan_rad, Eigen::Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(gaze.tilt_rad, Eigen::Vector3d::UnitY());
    T_world_camera.linear() = T_world_camera.linear() * optical;
    images.push_back(depth_image(building_.truth.geometry(), task_.camera, T_world_camera));
    poses.push_back(T_world_camera);
  }
  std::vector<PosedImage> posed;
  for (std::size_t i = 0; i < images.size(); ++i) posed.push_back({images[i], poses[i]});
  hazard_.observe(grid_, posed, 1, task_.hazard_floor_m);
}

bool ModelledExploration::go_on() {
  clear_footprint(floor_, pose_, building_.robot.inscribed_radius_m());
  const PathField paths = make_path_field(floor_, pose_, task_.navigation);
  std::vector<Candidate> views = frontier_views(task_,
                                                {.grid = grid_,
                                                 .paths = paths,
                                                 .T_base_sweep = building_.robot.T_base_sweep(),
                                                 .visited = visited_},
                                                plans_views(task_.choice));
  if (views.empty()) return false;
  const Candidate& view = views[chosen(paths, views)];
  visited_.add(view.T_world_sensor.translation().head<2>(), task_.taken_m);
  const double left_s = time_s_;
  drive(plan_path(paths, building_.robot.base_for_sensor(view.T_world_sensor)));
  if (partial_scans_) choose_images(time_s_ - left_s);
  return true;
}

void ModelledExploration::choose_images(double way_s) {
  const BlockField transmission = hazard_.transmission();
  const Lookout lookout{.grid = grid_,
                        .attenuation = attenuation_of(task_.gain, {grid_, &transmission}),
                        .field_of_view = building_.robot.view_field(),
                        .T_world_sweep = to_se3(pose_) * building_.robot.T_base_sweep(),
                        .block_m = task_.planning.block_m};
  images_ = worthwhile_images(*partial_scans_, {lookout, kScan_s, way_s});
}

std::size_t ModelledExploration::chosen(const PathField& paths, std::vector<Candidate>& views) {
  const BlockField transmission = hazard_.transmission();
  if (plans_views(task_.choice)) return next_of_plan(paths, transmission, views);
  const auto gains_bits =
      view_gains_bits(task_.gain, {grid_, &transmission}, views, building_.robot.view_field(), 1);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].gain_bits = gains_bits[i];
  return choose_view(task_.choice, views, choice_rng_);
}

std::size_t ModelledExploration::next_of_plan(const PathField& paths,
                                              const BlockField& transmission,
                                              const std::vector<Candidate>& views) {
  constexpr double kSame_m = 1.5;
  std::vector<Eigen::Vector2d> places_m;
  for (const Candidate& view : views) {
    const Pose2 base = building_.robot.base_for_sensor(view.T_world_sensor);
    places_m.emplace_back(base.x_m, base.y_m);
  }
  PlanningProblem problem =
      make_view_problem({.map = {grid_, &transmission},
                         .gain = task_.gain,
                         .candidates = views,
                         .places_m = places_m,
                         .field_of_view = building_.robot.view_field(),
                         .paths = paths,
                         .travel_time = travel_,
                         .scan_s = kScan_s,
                         .elapsed_s = time_s_,
                         .threads = 1,
                         .partial_scans = partial_scans_ ? &*partial_scans_ : nullptr},
                        task_.planning);
  if (intended_m_) problem.intended = view_near(problem, *intended_m_, kSame_m);
  const auto order = plan_views(task_.choice, problem, choice_rng_).order;
  intended_m_.reset();
  if (order.size() > 1) intended_m_ = places_m[order[1]];
  return order.empty() ? choose_view(NearestFrontier{}, views, choice_rng_) : order.front();
}

void ModelledExploration::drive(const PlannedPath& path) {
  constexpr double kStep_m = 0.2;
  double length_m = 0.0;
  double since_look_m = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    const Pose2& to = path.waypoints[i];
    const Eigen::Vector2d from_m(path.waypoints[i - 1].x_m, path.waypoints[i - 1].y_m);
    const Eigen::Vector2d leg_m = Eigen::Vector2d(to.x_m, to.y_m) - from_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(leg_m.norm() / kStep_m)));
    for (int step = 1; step <= steps; ++step) {
      const Eigen::Vector2d p_m = from_m + leg_m * step / steps;
      pose_ = {p_m.x(), p_m.y(), to.yaw_rad};
      traverse(building_.robot.inscribed_radius_m());
      since_look_m += leg_m.norm() / steps;
      if (since_look_m < kLook_m) continue;
      since_look_m = 0.0;
      look_at_walls();
    }
    length_m += leg_m.norm();
  }
  pose_ = path.end;
  way_m_ += length_m;
  const double taken_s = kDrive_s + kMetre_s * length_m;
  time_s_ += taken_s;
  travel_.observe(length_m, taken_s);
}

/// All round, without noise.
void ModelledExploration::look_at_walls() {
  PlanarScannerOptions scanner = task_.base_scanner;
  scanner.sector_rad = 2.0 * std::numbers::pi;
  scanner.noise_sigma_m = 0.0;
  Pose T_world_scanner = to_se3(pose_);
  T_world_scanner.translation().z() = building_.robot.base_scan_height_m();
  const PlanarScan scan =
      planar_scan(building_.truth.geometry(), T_world_scanner, {}, -1, scanner, noise_rng_);
  add_planar_scan(floor_, scan, pose_, task_.floor_map);
}

void ModelledExploration::traverse(double radius_m) {
  const Eigen::Vector2d p_m(pose_.x_m, pose_.y_m);
  for (std::size_t cell = 0; cell < floor_.size(); ++cell) {
    if ((floor_.centre(floor_.cell(cell)) - p_m).norm() <= radius_m) traversed_[cell] = 1;
  }
}

}  // namespace vantage::bench
