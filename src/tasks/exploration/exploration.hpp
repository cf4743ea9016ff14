/// The task `exploration`: a robot with an RGB-D camera on its head explores rooms by their
/// frontiers.  [Potthast2016, chapter 3], [Yamauchi1997]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

#include "vantage/belief/map/floor_detail.hpp"
#include "vantage/belief/map/headroom.hpp"
#include "vantage/planners/gaze_choice.hpp"
#include "vantage/planners/views/frontiers.hpp"
#include "vantage/planners/views/left_forecast.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/exploration/head_sweep.hpp"
#include "vantage/tasks/mapping/external/planner_files.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

class World;

/// When exploring is no longer worth a scan, asked alike of every method: the best view, in reach
/// or not, promises too little, by what was learnt of clutter.
struct EnoughOptions {
  double share = 0.0015;
  int scans = 3;
  void fields(auto&& f) {
    f("share", share,
      "expected new cells of the best view, as a share of the known cells, below which a scan is "
      "not worth it; higher ends earlier",
      between(0.0, 1.0));
    f("scans", scans,
      "number of decisions in a row that fall below `share` until exploration ends; 0: explores "
      "until no candidate is left",
      at_least(0));
  }
};

struct Exploration : MappingOptions {
  static constexpr std::string_view name = "exploration";
  static constexpr StrategyText text{.summary =
                                         "A mobile robot explores rooms with the RGB-D camera on "
                                         "its head, by the frontiers of what it knows.",
                                     .source = "Potthast2016, chapter 3; Yamauchi1997"};

  HeadSweep sweep;
  GazeOptions gaze;
  RgbdOptions camera{.tells_far = true};
  FrontierOptions frontiers{.min_cells = 60, .height_m = 1.47, .height_band_m = {{0.2, 1.7}}};
  HeadroomOptions headroom;
  PassageOptions passages;
  FloorDetailOptions floor_detail;
  double start_room_m = 0.75;
  int max_candidates = 30;
  double reach_m = 1.0;
  double taken_m = 0.3;
  double poor_m = 1.0;
  int poor_cells = 2000;
  EnoughOptions enough;
  StopOptions stop;
  double keyframe_m = 0.5;
  double reference_novelty_m = 0.05;
  int stride_px = 3;
  int hazard_stride_px = 8;
  double hazard_floor_m = 0.05;
  void fields(auto&& f) {
    MappingOptions::fields(f);
    f("sweep", sweep, "where the head turns the camera at each stop");
    f("gaze", gaze, "which images of the sweep a scan takes, and images on the way to it");
    f("camera", camera, "RGB-D camera on the robot's head");
    f("frontiers", frontiers, "how frontiers are found and clustered into candidate views");
    f("headroom", headroom, "which places on the floor are blocked by what is above them");
    f("passages", passages, "how the robot goes through passages that are narrow for it");
    f("floor_detail", floor_detail, "finer map of the floor, which narrow passages are planned on");
    f("start_room_m", start_room_m,
      "radius round the start that is known to be free floor for the robot", at_least(0.0));
    f("max_candidates", max_candidates,
      "greatest number of candidate views, those of the largest frontiers; more take longer to "
      "score; choices that plan ahead have more, one for every place that is 1.5 m from these",
      at_least(1));
    f("reach_m", reach_m,
      "distance from a frontier to where it is looked at from, the last place on the way there "
      "that the robot gets to, above which its view counts as out of reach; without effect on "
      "choices that plan ahead",
      at_least(0.0));
    f("taken_m", taken_m,
      "distance from a place scanned from, or chosen before, within which no view is proposed; "
      "higher spreads scans out",
      above(0.0));
    f("poor_m", poor_m,
      "the same distance round a place whose scan showed too little; higher leaves such places "
      "alone",
      at_least(0.0));
    f("poor_cells", poor_cells,
      "number of new cells below which a scan showed too little; higher gives up on a place sooner",
      at_least(0));
    f("enough", enough, "stopping criterion: when the best view promises too little to go on");
    f("stop", stop,
      "stopping criterion by what is held for unseen: when enough of all that can be seen has been "
      "seen; `enough` goes on beside it");
    f("keyframe_m", keyframe_m,
      "distance driven between scans that are added to the reference map of walls; lower adds more "
      "of them",
      above(0.0));
    f("reference_novelty_m", reference_novelty_m,
      "distance to the reference map within which wall points are not added to it, as they carry "
      "more drift; 0: adds all",
      at_least(0.0));
    f("stride_px", stride_px,
      "pixel stride at which depth images mark surfaces in the map; higher is faster and coarser",
      between(1, 100));
    f("hazard_stride_px", hazard_stride_px,
      "pixel stride at which depth images count clutter; higher is faster and learns from fewer "
      "beams",
      between(1, 100));
    f("hazard_floor_m", hazard_floor_m,
      "height below which what stops a beam is the floor and no clutter; higher overlooks low "
      "things",
      between(0.0, 10.0));
  }
  /// What concerns the task and the rest of the episode. @throws ConfigError
  void check_with(const EpisodeOptions& episode) const;

  void find_files(const std::filesystem::path& base) { find_planner(choice, base); }
  void resolve(const EpisodeSetup&) { map.fill_in(); }
  [[nodiscard]] std::vector<InputFile> inputs() const { return planner_files(choice); }
  [[nodiscard]] ModelSource model_source(const EpisodeSetup& setup) const;
  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] WindowContent window() const;
  [[nodiscard]] static ReportSections report();
  [[nodiscard]] static std::string_view metrics_task() { return "next_best_view"; }
  [[nodiscard]] static std::string_view robot_kind() { return MobileBaseDescription::name; }
  [[nodiscard]] static Measures measures();
  [[nodiscard]] static RecordTexts records();
  [[nodiscard]] static std::string outcome(const nlohmann::ordered_json& metrics);
  /// @return what is worth a warning @throws ConfigError or InputError if the episode cannot begin.
  std::vector<std::string> require_start(const EpisodeSetup& setup) const;
  /// Of a robot with a head, alone in its world.
  /// @throws ConfigError if its camera cannot be at frontiers.height_m
  void check_robot(const World& alone, const RobotFolder& robot) const;
  RunOutcome run(const RunRequest& request) const;
  /// Of the poses that observability is defined by, behind the base's own poses given.
  ViewCoverage coverage(const EpisodeSetup& setup, const std::vector<Pose2>& T_world_bases) const;
};

}  // namespace vantage
