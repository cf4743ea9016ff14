/// The parts of exploration with a robot that does what it is told.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/overrides.hpp"
#include "tests/tasks/exploration/exploration_drive.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage::support {

/// Nothing but a floor; a map of 4 x 4 x 2 m in cells of 0.1 m about the start.
inline ResolvedEpisode scripted_episode(const std::filesystem::path& folder,
                                        const std::vector<std::string>& more) {
  set_verbosity(Verbosity::quiet);
  const std::filesystem::path scene = folder / "open.xml";
  write_file(scene,
             "<mujoco><worldbody><geom type=\"plane\" size=\"9 9 0.1\"/></worldbody></mujoco>");
  std::vector<std::string> overrides = {
      "scene=" + scene.string(), "robot.start_pose=[0,0,0]", "map.size_m=[4,4,2]",
      "map.cells=[40,40,20]",    "floor_map.half_size_m=2",  "camera.width_px=160",
      "camera.height_px=120",    "metrics.pose_spacing_m=2", "frontiers.min_cells=1"};
  return load_episode(
      std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/office_small.yaml",
      support::overridden(std::move(overrides), more));
}

/// It is where it is put, and sees what it is given; its planar scanner sees nothing.
struct ToldRobot : SimulatedExplorationRobot {
  using SimulatedExplorationRobot::SimulatedExplorationRobot;
  [[nodiscard]] Pose2 estimated_base() const override { return T_world_base; }
  void correct_pose(const Pose2& pose) override { T_world_base = pose; }
  PlanarScan read_base_scanner() override { return {}; }
  DriveResult drive_along(std::span<const Pose2> path, double /*max_speed_m_s*/,
                          const std::function<bool()>& go_on) override {
    for (const Pose2& waypoint : path) {
      if (drives) T_world_base = waypoint;
      for (int tick = 0; tick < 10; ++tick) go_on();
    }
    return {};
  }
  ExplorationObservation observe(std::span<const std::size_t> /*images*/) override {
    ExplorationObservation seen;
    seen.views = sweeps.at(std::min(observed, sweeps.size() - 1));
    seen.base_scan = base_scan;
    seen.T_world_base_odometry = T_world_base;
    ++observed;
    return seen;
  }
  [[nodiscard]] bool head_rests() const override { return rests; }
  void look(const Gaze& gaze) override { looks.push_back(gaze); }
  std::optional<HeadView> take_image() override {
    ++asked;
    return view;
  }

  Pose2 T_world_base;
  bool drives = true;
  std::vector<std::vector<HeadView>> sweeps;  ///< one after the other, the last one for ever
  std::size_t observed = 0;
  PlanarScan base_scan;
  bool rests = true;
  std::vector<Gaze> looks;
  std::optional<HeadView> view;  ///< none: it is lost
  int asked = 0;                 ///< for an image
};

/// What is protected is open.
struct OpenExploration : ExplorationParts {
  using ExplorationParts::ExplorationParts;
  using MappingParts::current_;
  using MappingParts::navigator_;
  using MappingParts::scans_;
  using MappingParts::views_have_gains_;

  void open_floor() {
    std::ranges::fill(navigator_.floor().log_odds, -2.0F);
    std::ranges::fill(navigator_.floor().blocked, std::uint8_t{0});
  }
  /// A scan that showed so much; from a corner unless said otherwise.
  void record_as(double new_cells, std::size_t unobserved_cells,
                 const Eigen::Vector2d& scanned_from_m = {-1.8, -1.8}) {
    current_.actual_new_cells = new_cells;
    current_.unobserved_cells = unobserved_cells;
    current_.time_s = 40.0 * static_cast<double>(scans_.size() + 1);
    current_.scan_time_s = 36.0;
    current_.T_world_sensor = make_pose({scanned_from_m.x(), scanned_from_m.y(), 1.47}, 0.0);
    record();
  }
  [[nodiscard]] bool has_view_within(double radius_m, const Eigen::Vector2d& p_m) const {
    return std::ranges::any_of(views(), [&](const Candidate& view) {
      return (view.T_world_sensor.translation().head<2>() - p_m).norm() < radius_m;
    });
  }
};

struct ScriptedDrive : ExplorationDrive<ToldRobot> {
  explicit ScriptedDrive(const std::vector<std::string>& more = {})
      : ExplorationDrive(
            [&](const std::filesystem::path& folder) { return scripted_episode(folder, more); }) {
    task.localisation.loops.close = false;
    task.enough.scans = 0;
    run.begin();
  }
};

/// Ahead of the base, across the whole image.
inline HeadView wall_view(float depth_m) {
  HeadView view;
  view.image.width_px = 65;
  view.image.height_px = 49;
  view.image.focal_px = 55.0;
  view.image.range_max_m = 3.5;
  view.image.depth_m.assign(65 * 49, depth_m);
  view.T_base_camera = make_pose({0.0, 0.0, 1.2}, 0.0);
  view.T_base_camera.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return view;
}

/// No two alike.
inline std::vector<HeadView> wall_views(std::size_t count) {
  std::vector<HeadView> views;
  for (std::size_t i = 0; i < count; ++i) {
    views.push_back(wall_view(1.5F + 0.01F * static_cast<float>(i)));
  }
  return views;
}

/// One reading, of something above the map.
inline HeadView upward_view() {
  HeadView view;
  view.image.width_px = 3;
  view.image.height_px = 3;
  view.image.focal_px = 100.0;
  view.image.range_max_m = 3.5;
  view.image.depth_m.assign(9, 0.0F);
  view.image.depth_m[4] = 2.0F;
  view.T_base_camera = make_pose({0.0, 0.0, 1.2}, 0.0);
  return view;
}

}  // namespace vantage::support
