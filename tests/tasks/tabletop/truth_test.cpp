// Truth is taken of a scene at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/core/log.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using support::kWalls;
using support::OwnScene;
using support::table_at;

/// A box of 20 cm, its middle at `z_m`, free to fall on a table at 0.72 m.
std::string box_at(double z_m) {
  return fmt::format(
      "{}{}<body name='box' pos='-.15 .1 {}'><freejoint/><geom type='box' size='.1 .05 "
      ".1'/></body>",
      table_at(0.0, 0.0, 0.72, 0.5, 0.5), kWalls, z_m);
}

/// A robot beside it, and what is true there.
struct BesideTheBox {
  explicit BesideTheBox(double z_m) : scene(box_at(z_m)) {}
  const OwnScene scene;
  const ResolvedEpisode episode =
      load_episode(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml",
                   {scene.set(), "map.cells=[33,33,17]"});
  Tabletop task = std::get<Tabletop>(episode.task);
  const SimulatedTabletopRobot robot{episode.setup, task};
  const MobileGroundTruth truth = robot.ground_truth();
};

struct Truth {
  double top_m = 0.0;
  std::size_t observable_cells = 0;
};

Truth truth_of(double z_m) {
  set_verbosity(Verbosity::quiet);
  const BesideTheBox box(z_m);
  const auto& [scene, episode, task, robot, truth] = box;
  const RayHit hit = truth.geometry().cast({-0.15, 0.1, 2.0}, -Eigen::Vector3d::UnitZ(), 2.0);
  const auto evaluator = tabletop_evaluator(task, 2, truth, robot.view_field());
  return {2.0 - hit.distance_m, evaluator.observable_cells()};
}

TEST(Truth, IsWhereThingsComeToRest) {
  const Truth standing = truth_of(0.82);
  const Truth spawned = truth_of(0.90);
  EXPECT_NEAR(standing.top_m, 0.92, 1e-3);
  EXPECT_NEAR(spawned.top_m, 0.92, 1e-3);
  EXPECT_NEAR(static_cast<double>(spawned.observable_cells),
              static_cast<double>(standing.observable_cells),
              0.005 * static_cast<double>(standing.observable_cells));
}

/// Those given come first.
TEST(Truth, IsOfWhereTheRobotHasBeenAndOfTheRing) {
  set_verbosity(Verbosity::quiet);
  const BesideTheBox box(0.82);
  const auto& [scene, episode, task, robot, truth] = box;
  const Pose2 base = robot.base_for_sensor(tabletop_views(task)[4].T_world_sensor);
  const Pose2 elsewhere{2.0, 1.5, 0.5};
  const ViewCoverage coverage = task.coverage(episode.setup, {base, elsewhere});
  ASSERT_EQ(coverage.shows.size(), 32U);
  ASSERT_EQ(coverage.way_m.rows(), 32);
  EXPECT_NEAR(coverage.way_m(0, 6), 0.0, 1e-9) << "the same place";
  EXPECT_GE(coverage.way_m(1, 6) + 1e-9, std::hypot(base.x_m - 2.0, base.y_m - 1.5));
  EXPECT_GT(coverage.observable_cells, 0U);
}

/// What the oracles are told of the ring is worked out once; it must be what they would be told
/// anew.
TEST(Truth, RememberedOfTheRingIsTheTruth) {
  set_verbosity(Verbosity::quiet);
  BesideTheBox box(0.82);
  auto& [scene, episode, task, robot, truth] = box;
  const auto anew = tabletop_evaluator(task, 1, truth, robot.view_field());
  task.choice = OracleView{};
  const auto remembered = tabletop_evaluator(task, 1, truth, robot.view_field());
  OccupancyGrid grid(task.map.frame());
  for (std::size_t cell = 0; cell < grid.size(); cell += 3) grid.log_odds[cell] = -2.0F;
  const KnownCells known = known_cells(grid);
  for (const Candidate& view : tabletop_views(task)) {
    const Pose& pose = view.T_world_sensor;
    const CellSet cells = remembered.true_new_cell_set(known, pose);
    EXPECT_EQ(cells, anew.true_new_cell_set(known, pose)) << view.id;
    std::size_t count = 0;
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const bool shown = (cells[cell / 64] >> (cell % 64) & 1U) != 0;
      EXPECT_FALSE(shown && cell % 3 == 0) << "known";
      count += shown ? 1 : 0;
    }
    EXPECT_EQ(remembered.true_new_cells(known, pose), count);
    EXPECT_GT(count, 0U);
  }
}

/// Above the box, whose top is at 0.92 m, there is nothing; that can be seen.
TEST(Truth, OfAMapIsWhatStandsThereNotWhatCanBeSeen) {
  set_verbosity(Verbosity::quiet);
  const BesideTheBox box(0.82);
  const auto& [scene, episode, task, robot, truth] = box;
  const auto evaluator = tabletop_evaluator(task, 1, truth, robot.view_field());
  const CellSet seen = evaluator.observable_set();
  OccupancyGrid grid(task.map.frame());
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const bool is_seen = (seen[cell / 64] >> (cell % 64) & 1U) != 0;
    const bool is_above = grid.frame.centre(grid.frame.cell(cell)).z() > 1.0;
    if (is_seen && is_above) grid.log_odds[cell] = 4.0F;
  }
  ASSERT_GT(grid.count(CellState::occupied), 0U);
  const MapScore score = evaluator.score(grid, 1);
  EXPECT_EQ(score.precision, 0.0);
  EXPECT_EQ(score.recall, 0.0);
}

/// Observable cells are numbered as they come.
TEST(Truth, OfEachPoseIsWhatASensorSeesOfTheObservable) {
  set_verbosity(Verbosity::quiet);
  const BesideTheBox box(0.82);
  const auto& [scene, episode, task, robot, truth] = box;
  const auto evaluator = tabletop_evaluator(task, 2, truth, robot.view_field());
  const Pose2 elsewhere{1.5, 0.4, 3.0};
  const ViewCoverage coverage = task.coverage(episode.setup, {elsewhere});
  const Pose T_base_sensor = to_se3(robot.estimated_base()).inverse() * robot.estimated_sensor();
  std::vector<Pose> poses{to_se3(elsewhere) * T_base_sensor};
  for (const Candidate& view : tabletop_views(task)) poses.push_back(view.T_world_sensor);
  const auto is_in = [](const CellSet& set, std::size_t cell) {
    return (set[cell / 64] >> (cell % 64) & 1U) != 0;
  };
  const CellSet observable = evaluator.observable_set();
  EXPECT_EQ(coverage.observable_cells, evaluator.observable_cells());
  ASSERT_EQ(coverage.shows.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const CellSet visible = evaluator.visible_set(poses[i]);
    const CellSet& shown = coverage.shows[i];
    ASSERT_EQ(shown.size(), (coverage.observable_cells + 63) / 64);
    std::size_t number = 0;
    for (std::size_t cell = 0; cell < task.map.frame().size(); ++cell) {
      if (!is_in(observable, cell)) continue;
      ASSERT_EQ(is_in(shown, number), is_in(visible, cell)) << i << " " << cell;
      ++number;
    }
    EXPECT_EQ(number, coverage.observable_cells);
  }
}

/// From one side to the other, 1.32 m from the middle, round a map of a metre that a disc of 0.19 m
/// stays out of: along diagonals and straight lines about 3.23 m.
TEST(Truth, OfTheRingHasWaysRoundTheMap) {
  set_verbosity(Verbosity::quiet);
  const BesideTheBox box(0.82);
  const ViewCoverage coverage = box.task.coverage(box.episode.setup, {});
  ASSERT_EQ(coverage.way_m.rows(), 30);
  EXPECT_NEAR(coverage.way_m(1, 16), (3.23 - 0.14) * std::cos(std::numbers::pi / 8.0), 0.1);
  EXPECT_NEAR(coverage.way_m(1, 4), 2.0 * 1.32 * std::sin(std::numbers::pi / 10.0), 0.01)
      << "to the next position straight on";
}

}  // namespace
}  // namespace vantage
