/// The task `tabletop`: probabilistic next best view on what stands on a table.  [Potthast2016,
/// chapter 3]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

#include "vantage/perception/table_extraction.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/mapping/external/planner_files.hpp"
#include "vantage/tasks/mapping/hindsight/view_coverage.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

class World;

struct Tabletop : MappingOptions {
  static constexpr std::string_view name = "tabletop";
  static constexpr StrategyText text{.summary =
                                         "A mobile robot scans the clutter on a table with its "
                                         "tilting laser, from the next best of a ring of views.",
                                     .source = "Potthast2016, chapter 3"};

  LaserOptions laser;
  TableOptions table;
  ObjectCropOptions objects;
  RingOfViews candidates;
  void fields(auto&& f) {
    MappingOptions::fields(f);
    f("laser", laser, "tilting laser scanner that scans the table");
    f("table", table, "how the table top is found in a scan");
    f("objects", objects, "which points above the table top enter the map");
    f("candidates", candidates, "candidate views on a ring round the mapped region");
  }
  /// What concerns the task and the rest of the episode. @throws ConfigError
  void check_with(const EpisodeOptions& episode) const;

  void find_files(const std::filesystem::path& base) { find_planner(choice, base); }
  /// The map follows the scene's table where it is left open. @throws InputError, ConfigError
  void resolve(const EpisodeSetup& setup);
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
  /// Of a robot with a tilting laser, alone in its world. @throws ConfigError as check_reach()
  void check_robot(const World& alone, const RobotFolder& robot) const;
  RunOutcome run(const RunRequest& request) const;
  /// Of the ring's views, which observability is defined by, behind the base's own poses given.
  ViewCoverage coverage(const EpisodeSetup& setup, const std::vector<Pose2>& T_world_bases) const;
};

}  // namespace vantage
