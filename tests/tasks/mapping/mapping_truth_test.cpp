// What a map is held against, and what becomes of it in metrics.json.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"
#include "vantage/tasks/mapping/mapping_metrics.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// A robot beside a table, and walls that begin 2.95 m from its middle, 10 cm thick.
struct WalledTable {
  support::OwnScene scene{support::table_at(0.0, 0.0, 0.72, 0.5, 0.5) + support::objects_on(0.72) +
                          support::kWalls};
  const ResolvedEpisode episode = load_episode(
      std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml",
      {scene.set(), "map.cells=[33,33,17]", "laser.scan_duration_s=3", "robot.start_view=2"});
  const Tabletop task = std::get<Tabletop>(episode.task);
  const SimulatedTabletopRobot robot{episode.setup, task};
  const MobileGroundTruth truth = robot.ground_truth();
};

const WalledTable& walled_table() {
  set_verbosity(Verbosity::quiet);
  static const WalledTable table;
  return table;
}

/// Columns of 0.1 m from x = 2 on, five cells high each. The wall's front is in column 9, its back
/// in column 10.
GridFrame frame_at_wall() {
  return make_grid_frame({2.65, 0.0, 1.05}, {1.3, 0.1, 0.5}, {13, 1, 5});
}
std::size_t cell_at_wall(int column, int row) { return frame_at_wall().index({column, 0, row}); }

struct WallEvaluator : GroundTruthMapEvaluator {
  WallEvaluator()
      : GroundTruthMapEvaluator(walled_table().truth, frame_at_wall(),
                                {.half_width_rad = 0.5, .tilt_min_rad = -0.5, .tilt_max_rad = 0.5},
                                2) {}
  using GroundTruthMapEvaluator::set_left_out;
};

/// From where columns 0 to 9 are seen.
const std::vector<Pose> kBeforeWall{make_pose({1.0, 0.0, 1.05}, 0.0)};
/// From where columns 10 to 12 are seen.
const std::vector<Pose> kBehindWall{make_pose({4.5, 0.0, 1.05}, std::numbers::pi)};

bool holds(const CellSet& set, std::size_t cell) {
  return (set[cell / 64] >> (cell % 64) & 1U) != 0;
}

TEST(KnownCells, AreThoseThatAreFreeOrOccupied) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {65.0, 1.0, 1.0}, {65, 1, 1}));
  grid.log_odds[0] = -2.0F;
  grid.log_odds[63] = 2.0F;
  grid.log_odds[64] = 2.0F;
  const KnownCells known = known_cells(grid);
  EXPECT_EQ(known.set, (CellSet{(std::uint64_t{1} << 63) + 1, 1}));
  ASSERT_EQ(known.flags.size(), 65U);
  for (std::size_t cell = 0; cell < 65; ++cell) {
    EXPECT_EQ(known.flags[cell], cell == 0 || cell >= 63 ? 1 : 0) << cell;
  }
  const OccupancyGrid words(make_grid_frame({0.0, 0.0, 0.0}, {64.0, 1.0, 1.0}, {64, 1, 1}));
  EXPECT_EQ(known_cells(words).set, CellSet(1, 0));
}

TEST(TrueCells, AreObservableOnceTheyAreSeen) {
  WallEvaluator evaluator;
  OccupancyGrid grid(frame_at_wall());
  EXPECT_EQ(evaluator.observable_cells(), 0U);
  EXPECT_EQ(evaluator.observable_unobserved(grid), 0U);
  evaluator.add_observable(kBeforeWall);
  EXPECT_EQ(evaluator.observable_cells(), 50U);
  const CellSet seen = evaluator.observable_set();
  ASSERT_EQ(seen.size(), 2U);
  for (int column = 0; column < 13; ++column) {
    for (int row = 0; row < 5; ++row) {
      EXPECT_EQ(holds(seen, cell_at_wall(column, row)), column <= 9) << column << ", " << row;
    }
  }
  EXPECT_EQ(evaluator.observable_unobserved(grid), 50U);
  grid.log_odds.front() = -2.0F;
  grid.log_odds.back() = 2.0F;
  EXPECT_EQ(evaluator.observable_unobserved(grid), 49U) << "the last cell is behind the wall";
  evaluator.add_observable(kBehindWall);
  EXPECT_EQ(evaluator.observable_cells(), 65U);
  EXPECT_EQ(evaluator.observable_unobserved(grid), 63U);
  ASSERT_EQ(evaluator.observing_poses().size(), 2U);
  EXPECT_TRUE(evaluator.observing_poses()[0].matrix() == kBeforeWall[0].matrix());
  EXPECT_TRUE(evaluator.observing_poses()[1].matrix() == kBehindWall[0].matrix());
}

TEST(TrueCells, ThatAViewShowsAreThoseThatItSees) {
  WallEvaluator evaluator;
  evaluator.add_observable(kBeforeWall);
  const CellSet before = evaluator.observable_set();
  EXPECT_EQ(evaluator.visible_set(kBeforeWall[0]), before);
  OccupancyGrid grid(frame_at_wall());
  EXPECT_EQ(evaluator.true_new_cells(known_cells(grid), kBeforeWall[0]), 50U);
  EXPECT_EQ(evaluator.true_new_cells(known_cells(grid), kBehindWall[0]), 15U);
  grid.log_odds[cell_at_wall(0, 0)] = -2.0F;
  grid.log_odds[cell_at_wall(12, 4)] = -2.0F;
  const KnownCells known = known_cells(grid);
  evaluator.remember_visible(kBehindWall);
  EXPECT_EQ(evaluator.true_new_cells(known, kBeforeWall[0]), 49U) << "worked out anew";
  EXPECT_EQ(evaluator.true_new_cells(known, kBehindWall[0]), 14U) << "remembered";
}

TEST(TrueCells, ThatAreLeftOutAreSeenFromElsewhereAlone) {
  WallEvaluator evaluator;
  evaluator.add_observable(kBeforeWall);
  EXPECT_FALSE(evaluator.left_out());
  evaluator.set_left_out(3, kBehindWall);
  ASSERT_TRUE(evaluator.left_out());
  EXPECT_EQ(evaluator.left_out()->rooms, 3);
  EXPECT_EQ(evaluator.left_out()->cells, 15U);
  EXPECT_EQ(evaluator.observable_cells(), 50U) << "they are not to be counted";
  evaluator.set_left_out(1, kBeforeWall);
  EXPECT_EQ(evaluator.left_out()->cells, 0U);
}

/// An occupied cell on the wall, one far from it, and a free one: of five cells of the wall's front
/// three are at most one off an occupied cell.
TEST(TrueCells, MeasureAMap) {
  WallEvaluator evaluator;
  evaluator.add_observable(kBeforeWall);
  OccupancyGrid grid(frame_at_wall());
  grid.log_odds[cell_at_wall(0, 0)] = 2.0F;
  grid.log_odds[cell_at_wall(9, 2)] = 2.0F;
  grid.log_odds[cell_at_wall(3, 1)] = -2.0F;
  ScanRecord record;
  evaluator.measure(grid, 1, record);
  EXPECT_EQ(record.unobserved_cells, 62U);
  EXPECT_EQ(record.observable_unobserved_cells, 47U);
  EXPECT_DOUBLE_EQ(record.precision, 0.5);
  EXPECT_DOUBLE_EQ(record.recall, 0.6);
  EXPECT_DOUBLE_EQ(evaluator.score(grid, 0).recall, 0.2);
  EXPECT_DOUBLE_EQ(evaluator.score(grid, 2).recall, 1.0);
}

TEST(TruePose, IsWhatPosesOfAScanAreHeldAgainst) {
  const Pose2 truth = walled_table().truth.T_world_base();
  ASSERT_GT(std::abs(truth.x_m), 0.2);
  ASSERT_GT(std::abs(truth.y_m), 0.2);
  ASSERT_GT(std::abs(truth.yaw_rad), 0.3);
  const Pose2 error{0.3, -0.4, 0.2};
  const ScanPoses poses{.dead_reckoned = {truth.x_m + 0.6, truth.y_m - 0.8, 0.0},
                        .tracked = {truth.x_m - 0.05, truth.y_m + 0.12, 0.0},
                        .kept = compose(truth, error)};
  ScanRecord record;
  record.collisions = 7;
  WallEvaluator().measure_pose(poses, record);
  EXPECT_NEAR(record.pose_error_before_registration_m, 1.0, 1e-9);
  EXPECT_NEAR(record.pose_error_tracked_m, 0.13, 1e-9);
  EXPECT_NEAR(record.pose_error_at_scan_m, 0.5, 1e-9);
  EXPECT_NEAR(record.pose_error_m, 0.5, 1e-9);
  EXPECT_NEAR(record.yaw_error_rad, 0.2, 1e-9);
  EXPECT_NEAR(record.T_true_kept.x_m, error.x_m, 1e-9);
  EXPECT_NEAR(record.T_true_kept.y_m, error.y_m, 1e-9);
  EXPECT_NEAR(record.T_true_kept.yaw_rad, error.yaw_rad, 1e-9);
  EXPECT_EQ(record.collisions, 0);
}

/// An episode at the wall that has come to these scans.
struct EndedAtWall {
  MappingOptions options;
  WallEvaluator evaluator;
  OccupancyGrid grid{frame_at_wall()};
  ClutterHazard hazard{options.clutter_hazard, frame_at_wall().cells};
  std::vector<ScanRecord> scans = std::vector<ScanRecord>(2);
  std::vector<Candidate> views = std::vector<Candidate>(3);
  LocalisationSummary localisation;

  EndedAtWall() { evaluator.add_observable(kBeforeWall); }
  [[nodiscard]] Json metrics() const {
    Json metrics;
    add_mapping_metrics(options, {grid, hazard, evaluator, scans, views, localisation}, metrics);
    return metrics;
  }
};

TEST(MappingMetrics, TellWhatEachScanCameTo) {
  EndedAtWall ended;
  ScanRecord& scan = ended.scans[1];
  scan.predicted_cells = {{"simple", 12.5}, {"adaptive", 7.25}};
  scan.by_distance = {
      {.from_m = 0.5, .to_m = 1.0, .predicted_cells = 3.5, .actual_cells = 4, .outside_cells = 1},
      {.from_m = 1.0,
       .to_m = std::numeric_limits<double>::infinity(),
       .predicted_cells = 0.0,
       .actual_cells = 2,
       .outside_cells = 2}};
  scan.forecast = ForecastRecord{3.5, {1.5, 9.5}};
  scan.left = LeftRecord{80.5, 0.25, 0.875};
  const Json told = ended.metrics()["scans"];
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0]["predicted"], Json::object());
  EXPECT_EQ(told[0]["by_distance"], Json::array());
  EXPECT_TRUE(told[0]["forecast"].is_null());
  EXPECT_TRUE(told[0]["left"].is_null());
  EXPECT_EQ(told[1]["predicted"], (Json{{"simple", 12.5}, {"adaptive", 7.25}}));
  const Json& bands = told[1]["by_distance"];
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands[0]["from_m"], 0.5);
  EXPECT_EQ(bands[0]["to_m"], 1.0);
  EXPECT_EQ(bands[0]["predicted_cells"], 3.5);
  EXPECT_EQ(bands[0]["actual_cells"], 4);
  EXPECT_EQ(bands[0]["outside_cells"], 1);
  EXPECT_TRUE(bands[1]["to_m"].is_null());
  EXPECT_EQ(told[1]["forecast"], (Json{{"cells", 3.5}, {"low_cells", 1.5}, {"high_cells", 9.5}}));
  EXPECT_EQ(told[1]["left"],
            (Json{{"expected_cells", 80.5}, {"share", 0.25}, {"confidence", 0.875}}));
}

TEST(MappingMetrics, TellTheTransmissionThatTheGainAssumes) {
  EndedAtWall ended;
  ended.options.gain = AdaptiveGain{};
  ended.scans[0].hazard_scale = 3.0;
  ended.scans[1].hazard_scale = 1.5;
  const double transmission = ended.hazard.global_transmission();
  ASSERT_LT(transmission, 0.999);
  EXPECT_NEAR(ended.metrics()["observability"].get<double>(), std::pow(transmission, 1.5), 1e-12);
  ended.scans.clear();
  EXPECT_NEAR(ended.metrics()["observability"].get<double>(), transmission, 1e-12);
  BeerLambertGain assumed;
  assumed.a = 0.75;
  ended.options.gain = assumed;
  EXPECT_EQ(ended.metrics()["observability"], 0.75);
  ended.options.gain = SimpleGain{};
  EXPECT_TRUE(ended.metrics()["observability"].is_null());
}

TEST(MappingMetrics, ScoreTheMapOnceThereIsAScan) {
  EndedAtWall ended;
  ended.grid.log_odds[cell_at_wall(0, 0)] = 2.0F;
  ended.grid.log_odds[cell_at_wall(9, 2)] = 2.0F;
  ended.scans[0].observable_unobserved_cells = 20;
  ended.scans[1].observable_unobserved_cells = 4;
  ended.scans[1].time_s = 30.0;
  const Json scored = ended.metrics();
  EXPECT_EQ(scored["observable_cells"], 50);
  EXPECT_FALSE(scored.contains("unreachable"));
  EXPECT_EQ(scored["map"]["tolerance_cells"], 1);
  EXPECT_DOUBLE_EQ(scored["map"]["precision"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(scored["map"]["recall"].get<double>(), 0.6);
  EXPECT_EQ(scored["scans_to_90"], 2);
  EXPECT_EQ(scored["time_to_90_s"], 30.0);
  EXPECT_EQ(scored["observability_per_slice"].size(), 5U);
  EXPECT_EQ(scored["candidates"].size(), 3U);
  EXPECT_NEAR(scored["region"]["min_m"][0].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(scored["region"]["max_m"][2].get<double>(), 1.3, 1e-9);
  ended.scans.clear();
  const Json nothing = ended.metrics();
  EXPECT_TRUE(nothing["map"]["precision"].is_null());
  EXPECT_TRUE(nothing["map"]["recall"].is_null());
  EXPECT_EQ(nothing["map"]["tolerance_cells"], 1);
}

TEST(MappingMetrics, TellWhatCannotBeReached) {
  EndedAtWall ended;
  ended.evaluator.set_left_out(3, kBehindWall);
  const Json told = ended.metrics()["unreachable"];
  EXPECT_EQ(told["rooms"], 3);
  EXPECT_EQ(told["cells"], 15);
  EXPECT_DOUBLE_EQ(told["share"].get<double>(), 15.0 / 65.0);
  WallEvaluator blind;
  blind.set_left_out(0, {});
  Json nothing;
  add_mapping_metrics(
      ended.options,
      {ended.grid, ended.hazard, blind, ended.scans, ended.views, ended.localisation}, nothing);
  EXPECT_EQ(nothing["unreachable"]["share"], 0.0) << "nothing can be seen at all";
}

/// As sure as it is asked for is sure enough.
TEST(MappingMetrics, DoubtTheMapThatIsTooUnsureOrContradictsItself) {
  EndedAtWall ended;
  const double tolerance_m = map_tolerance_m(ended.options);
  ended.scans[0].map_sigma_m = tolerance_m;
  ended.scans[1].map_sigma_m = 0.5 * tolerance_m;
  ended.scans[1].registered = false;
  ended.localisation.pose_sigma_m = 0.25;
  ended.localisation.loops = 4;
  ended.localisation.loops_refused = 3;
  ended.localisation.corrections = 2;
  const Json sure = ended.metrics()["localisation"];
  EXPECT_EQ(sure["map_sigma_m"], tolerance_m);
  EXPECT_EQ(sure["tolerance_m"], tolerance_m);
  EXPECT_EQ(sure["trusted"], true);
  EXPECT_EQ(sure["registered_scans"], 1);
  EXPECT_EQ(sure["pose_sigma_m"], 0.25);
  EXPECT_EQ(sure["loops"], 4);
  EXPECT_EQ(sure["loops_refused"], 3);
  EXPECT_EQ(sure["corrections"], 2);
  EXPECT_TRUE(sure["contradicted_share"].is_null());
  EXPECT_EQ(sure["map_in_doubt"], false);
  EXPECT_TRUE(sure["doubt"].is_null());
  ended.localisation.contradicted_share = 0.125;
  ended.localisation.doubt = "walls are drawn twice";
  const Json doubted = ended.metrics()["localisation"];
  EXPECT_EQ(doubted["trusted"], true);
  EXPECT_EQ(doubted["contradicted_share"], 0.125);
  EXPECT_EQ(doubted["map_in_doubt"], true);
  EXPECT_EQ(doubted["doubt"], "walls are drawn twice");
  ended.localisation.doubt.clear();
  ended.scans[1].map_sigma_m = 1.01 * tolerance_m;
  const Json unsure = ended.metrics()["localisation"];
  EXPECT_EQ(unsure["trusted"], false);
  EXPECT_EQ(unsure["map_in_doubt"], true);
  ended.scans.clear();
  EXPECT_EQ(ended.metrics()["localisation"]["map_sigma_m"], 0.0);
  EXPECT_EQ(ended.metrics()["localisation"]["registered_scans"], 0);
}

TEST(LocalisationSummary, BeginsWithNothing) {
  const LocalisationSummary summary;
  EXPECT_EQ(summary.loops, 0U);
  EXPECT_EQ(summary.loops_refused, 0U);
  EXPECT_EQ(summary.corrections, 0U);
  EXPECT_EQ(summary.pose_sigma_m, 0.0);
  EXPECT_FALSE(summary.contradicted_share);
  const BeliefUpdate update;
  EXPECT_TRUE(update.registered);
  EXPECT_EQ(update.unconstrained, 0);
  EXPECT_EQ(update.freed_cells, 0U);
  EXPECT_EQ(update.filled_cells, 0U);
  const LeftOut left_out;
  EXPECT_EQ(left_out.rooms, 0);
  EXPECT_EQ(left_out.cells, 0U);
}

/// In a process of its own, whose exit code says what becomes of it.
void interrupted_in(const std::function<void()>& work) {
  catch_interrupts();
  std::raise(SIGINT);
  try {
    work();
  } catch (const Interrupted& error) {
    std::_Exit(static_cast<int>(error.code()));
  }
  std::_Exit(0);
}

TEST(TrueCells, AreNotWorkedOutOnceTheEpisodeIsInterrupted) {
  WallEvaluator evaluator;
  const testing::ExitedWithCode interrupted(130);
  EXPECT_EXIT(interrupted_in([&] { evaluator.add_observable(kBeforeWall); }), interrupted, "");
  EXPECT_EXIT(interrupted_in([&] { evaluator.set_left_out(1, kBehindWall); }), interrupted, "");
  EXPECT_EXIT(interrupted_in([&] { evaluator.remember_visible(kBehindWall); }), interrupted, "");
}

}  // namespace
}  // namespace vantage
