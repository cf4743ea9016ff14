/// The task `exploration`: a robot with an RGB-D camera on its head explores rooms by their
/// frontiers.  [Potthast2016, chapter 3], [Yamauchi1997]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

#include "vantage/belief/map/headroom.hpp"
#include "vantage/planners/views/frontiers.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/exploration/head_sweep.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

/// When exploring is no longer worth a scan, asked alike of every method: the best view in reach
/// promises too little, by what was learnt of clutter.
struct EnoughOptions {
  double share = 0.0015;  ///< of the cells known; less is too little, higher ends earlier
  int scans = 3;          ///< in a row after which it was too little; 0 explores all there is
  void fields(auto&& f) {
    f("share", share, between(0.0, 1.0));
    f("scans", scans, at_least(0));
  }
};

struct Exploration : MappingOptions {
  static constexpr std::string_view name = "exploration";

  HeadSweep sweep;
  RgbdOptions camera{.tells_far = true};
  FrontierOptions frontiers{.min_cells = 60, .height_m = 1.47, .height_band_m = {{0.2, 1.7}}};
  HeadroomOptions headroom;
  double start_room_m = 0.75;  ///< round the start, known to be free for the robot
  int max_candidates = 30;     ///< the largest clusters; more take longer to score
  double reach_m = 1.0;        ///< nearest place farther from its frontier: out of reach
  double taken_m = 0.3;        ///< places nearer to one that was scanned from are not proposed
  double poor_m = 1.0;         ///< the same round a place whose scan showed too little
  int poor_cells = 2000;       ///< fewer new cells are too little; higher gives up sooner
  EnoughOptions enough;
  double keyframe_m = 0.5;  ///< between places on the way where walls are remembered to drive by
  double reference_novelty_m =
      0.05;                  ///< walls nearer than this to remembered ones are not remembered
  int stride_px = 3;         ///< pixels between those that mark surfaces; higher is faster
  int hazard_stride_px = 8;  ///< pixels between those that count clutter; higher is faster
  void fields(auto&& f) {
    MappingOptions::fields(f);
    f("sweep", sweep);
    f("camera", camera);
    f("frontiers", frontiers);
    f("headroom", headroom);
    f("start_room_m", start_room_m, at_least(0.0));
    f("max_candidates", max_candidates, at_least(1));
    f("reach_m", reach_m, at_least(0.0));
    f("taken_m", taken_m, above(0.0));
    f("poor_m", poor_m, at_least(0.0));
    f("poor_cells", poor_cells, at_least(0));
    f("enough", enough);
    f("keyframe_m", keyframe_m, above(0.0));
    f("reference_novelty_m", reference_novelty_m, at_least(0.0));
    f("stride_px", stride_px, between(1, 100));
    f("hazard_stride_px", hazard_stride_px, between(1, 100));
  }
  /// What concerns the task and the rest of the episode. @throws ConfigError
  void check_with(const EpisodeOptions& episode) const;

  void find_files(const std::filesystem::path&) {}
  [[nodiscard]] std::vector<InputFile> inputs() const { return {}; }
  [[nodiscard]] ModelSource model_source(const EpisodeSetup& setup) const;
  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] WindowContent window() const;
  [[nodiscard]] static ReportSections report();
  [[nodiscard]] static std::string_view metrics_task() { return "next_best_view"; }
  [[nodiscard]] static std::string_view robot_kind() { return MobileBaseDescription::name; }
  [[nodiscard]] static Measures measures();
  [[nodiscard]] static std::string outcome(const nlohmann::ordered_json& metrics);
  /// @throws ConfigError or InputError if the episode cannot begin.
  void require_start(const EpisodeSetup& setup) const;
  RunOutcome run(const RunRequest& request) const;
};

}  // namespace vantage
