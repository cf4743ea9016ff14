/// The parts of a table-top episode whose robot stands where it is put, opened for tests.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/run_request.hpp"
#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage::support {

/// It is where it is put, whatever it is to do.
struct StillTabletopRobot : SimulatedTabletopRobot {
  using SimulatedTabletopRobot::SimulatedTabletopRobot;
  [[nodiscard]] double time_s() const override { return now_s; }
  [[nodiscard]] double energy_used_j() const override { return used_j; }
  [[nodiscard]] Pose2 estimated_base() const override { return T_world_base; }
  void correct_pose(const Pose2& pose) override { T_world_base = pose; }
  void restart_dead_reckoning() override { ++restarts; }
  DriveResult drive_along(std::span<const Pose2> /*path*/, double /*max_speed_m_s*/,
                          const std::function<bool()>& /*go_on*/) override {
    return {};
  }

  double now_s = 0.0;
  double used_j = 0.0;
  Pose2 T_world_base;
  int restarts = 0;
};

struct StillTable {
  TemporaryDirectory folder;
  OwnScene scene{table_at(0.0, 0.0, 0.72, 0.5, 0.5) + objects_on(0.72) + kWalls};
  const ResolvedEpisode episode =
      load_episode(std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml",
                   {scene.set(), "map.cells=[17,17,9]", "laser.scan_duration_s=3"});
  const EpisodeOptions& options = episode.setup.options;
  const Tabletop task = std::get<Tabletop>(episode.task);
  StillTabletopRobot robot{episode.setup, task};
  const RunRequest request =
      mapping_request(episode, {folder.path() / "run", true, false, {}, true});
  EpisodeRun run{request};
  MappingRecorder recorder{run, recorded(robot), recorded_predictors(task, cell_predictors()),
                           task.scans};
  const MobileGroundTruth truth = robot.ground_truth();
  const GroundTruthMapEvaluator evaluator =
      tabletop_evaluator(task, options.threads, truth, robot.view_field());
};

/// With the robot as at first.
inline StillTable& still_table() {
  set_verbosity(Verbosity::quiet);
  static StillTable table;
  table.robot.now_s = 0.0;
  table.robot.used_j = 0.0;
  table.robot.T_world_base = {-1.5, 0.0, 0.0};
  table.robot.restarts = 0;
  return table;
}

/// With what the parts keep to themselves.
struct StillParts : TabletopParts {
  StillParts(StillTable& table, const Tabletop& task, TabletopBelief& belief,
             const OutsideChoice* outside)
      : TabletopParts(
            MappingContext{table.options, table.robot, table.evaluator, table.recorder, outside},
            task, table.robot, belief) {}
  using MappingParts::Before;
  using TabletopParts::approach;
  using TabletopParts::before_update;
  using TabletopParts::budget_;
  using TabletopParts::correct_records;
  using TabletopParts::current_;
  using TabletopParts::expected_left_cells;
  using TabletopParts::first_usable;
  using TabletopParts::intended_m_;
  using TabletopParts::limit_reached;
  using TabletopParts::measure;
  using TabletopParts::navigator_;
  using TabletopParts::note_agreeing_loops;
  using TabletopParts::predict;
  using TabletopParts::record_scan;
  using TabletopParts::scans_;
  using TabletopParts::scans_tell_pose_;
  using TabletopParts::views_have_gains_;
  using TabletopParts::views_of_truth;
  void end_with(const std::vector<Candidate>& views) { MappingParts::end(views); }
};

struct StillBelief : TabletopBelief {
  using MapBelief::grid_;
  using TabletopBelief::TabletopBelief;
};

/// Parts at the table that have done nothing yet.
struct AtStillTable {
  explicit AtStillTable(const Tabletop& task, const OutsideChoice* outside = nullptr)
      : belief(table.options, task), parts(table, task, belief, outside) {}

  StillTable& table = still_table();
  StillBelief belief;
  StillParts parts;
};

}  // namespace vantage::support
