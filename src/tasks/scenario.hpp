/// An episode: this struct is the YAML file, key by key.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/floor_map.hpp"
#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/control/base_controller.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/perception/clouds/registration.hpp"
#include "vantage/perception/table_extraction.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/sim/robots/drive.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/sensors/laser.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/change_detection/change_detection_task.hpp"
#include "vantage/tasks/exploration/exploration_options.hpp"
#include "vantage/tasks/recognition/recognition_task.hpp"
#include "vantage/tasks/trajectory/trajectory_task.hpp"

namespace vantage {

struct RobotOptions {
  std::string model = "models/robots/pr2/pr2.xml";  ///< MJCF of the robot
  int start_view = 0;           ///< table top: position on the ring of views where the robot starts
  double start_behind_m = 0.0;  ///< table top: how far behind that position, seen from the table
  std::string start_site;       ///< office: site of the scene where it starts; empty: start_pose
  std::array<double, 3> start_pose{0.0, 0.0, 0.0};  ///< office: x m, y m, yaw rad, world
  void fields(auto&& f) {
    f("model", model);
    f("start_view", start_view, at_least(0));
    f("start_behind_m", start_behind_m, between(0.0, 100.0));
    f("start_site", start_site);
    f("start_pose", start_pose);
  }
};

/// The region of interest and its grid.
struct MapOptions {
  std::array<double, 3> centre_m{0.0, 0.0, 0.982};  ///< world
  std::array<double, 3> size_m{1.0, 1.0, 0.504};    ///< m, > 0
  std::array<int, 3> cells{129, 129, 65};           ///< finer maps cost time in proportion
  void fields(auto&& f) {
    f("centre_m", centre_m, between(-1000.0, 1000.0));
    f("size_m", size_m, Range{0.0, 1000.0, true});
    f("cells", cells, between(1, 4096));
  }
  void check() const;  ///< at most 2^26 cells
  [[nodiscard]] double count() const;
};

struct MetricsOptions {
  int tolerance_cells =
      1;  ///< cells an occupied cell may be off the true surface and still be right
  /// Office: between the poses, reachable from the start, that say which cells are observable;
  /// lower misses fewer, takes longer.
  double pose_spacing_m = 1.0;
  /// Gains whose prediction of newly observed cells is recorded at every scan, beside that of the
  /// gain in use. Empty: every gain that predicts cells; in an office, where rays to every cell
  /// take seconds, those that can be swept. Each costs the time of one view.
  std::vector<Gain> predictors;
  void fields(auto&& f) {
    f("tolerance_cells", tolerance_cells, between(0, 10));
    f("pose_spacing_m", pose_spacing_m, between(0.05, 100.0));
    f("predictors", predictors);
  }
  void check() const;  ///< every predictor predicts cells
};

struct RecordingOptions {
  double video_speed = 10.0;  ///< simulated seconds per second of video
  int video_fps = 25;
  int height_px = 720;  ///< of the video; its width is 16:9
  void fields(auto&& f) {
    f("video_speed", video_speed, between(1.0, 1000.0));
    f("video_fps", video_fps, between(1, 120));
    f("height_px", height_px, between(120, 2160));
  }
};

struct Episode {
  /// or recognition, change_detection, trajectory
  std::string task = "next_best_view";
  std::string setting = "table_top";                         ///< or office
  std::string scene = "models/scenes/tabletop_8/scene.xml";  ///< MJCF
  std::uint64_t seed = 1;                                    ///< of every random stream
  int scans = 10;                                            ///< the first one included
  int threads = 2;                                           ///< results do not depend on it
  RobotOptions robot;
  WorldOptions simulation;
  LaserOptions laser;
  PlanarScannerOptions base_scanner;
  OdometryOptions odometry;
  RegistrationOptions registration;
  TableOptions table;
  ObjectCropOptions objects;
  MapOptions map;
  InverseSensorModel sensor_model;
  FreeSpaceUpdate free_space;
  HoleFilling hole_filling;
  ClutterHazardOptions clutter_hazard;
  RingOfViews candidates;          ///< table top
  ExplorationOptions exploration;  ///< office
  Gain gain = AdaptiveGain{};
  ViewChoice choice = GreedyGain{};
  FloorMapOptions floor_map;
  NavigationOptions navigation;
  DriveOptions drive;
  MetricsOptions metrics;
  RecordingOptions recording;
  RecognitionTask recognition;
  ChangeDetectionTask change_detection;
  TrajectoryTask trajectory;

  void fields(auto&& f) {
    f("task", task);
    f("setting", setting);
    f("scene", scene);
    f("seed", seed);
    f("scans", scans, between(1, 10000));
    f("threads", threads, between(1, 256));
    f("robot", robot);
    f("simulation", simulation);
    f("laser", laser);
    f("base_scanner", base_scanner);
    f("odometry", odometry);
    f("registration", registration);
    f("table", table);
    f("objects", objects);
    f("map", map);
    f("sensor_model", sensor_model);
    f("free_space", free_space);
    f("hole_filling", hole_filling);
    f("clutter_hazard", clutter_hazard);
    f("candidates", candidates);
    f("exploration", exploration);
    f("gain", gain);
    f("choice", choice);
    f("floor_map", floor_map);
    f("navigation", navigation);
    f("drive", drive);
    f("metrics", metrics);
    f("recording", recording);
    f("recognition", recognition);
    f("change_detection", change_detection);
    f("trajectory", trajectory);
  }
  void check() const;  ///< what concerns more than one part

  /// Round one object on a table, or past several along a path.
  [[nodiscard]] bool flies() const {
    return task == "recognition" || detects_change() || flies_trajectory();
  }
  [[nodiscard]] bool detects_change() const { return task == "change_detection"; }
  [[nodiscard]] bool flies_trajectory() const { return task == "trajectory"; }
  [[nodiscard]] bool in_office() const { return setting == "office"; }
  [[nodiscard]] GridFrame grid_frame() const {
    return make_grid_frame(map.centre_m, map.size_m, map.cells);
  }
};

/// An episode as it will run: defaults filled in, overrides applied, files found.
struct ResolvedEpisode {
  Episode episode;
  std::string name;             ///< of the file, without extension
  std::filesystem::path scene;  ///< found
  std::filesystem::path robot;  ///< found
};

/// @throws ConfigError or InputError naming file, line, key and value.
ResolvedEpisode load_episode(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides);

/// The same of a configuration that was read already from `path`.
ResolvedEpisode resolve_episode(const ConfigNode& root, const std::filesystem::path& path);

/// "adaptive" for a greedy choice by that gain, "random" or "oracle" for a choice that looks at
/// none, "gain_over_distance of simple" for another that does. In trajectory flight the planner's
/// label, and what its cost leaves out.
std::string method_name(const Episode& episode);

std::string episode_yaml(const Episode& episode);

}  // namespace vantage
