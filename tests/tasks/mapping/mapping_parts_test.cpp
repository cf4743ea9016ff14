// What the parts that all mapping tasks share make of what they are given, part by part.
#include "vantage/tasks/mapping/mapping_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/csv_column.hpp"
#include "tests/support/terminal.hpp"
#include "tests/tasks/mapping/run_request.hpp"
#include "tests/tasks/mapping/still_table.hpp"
#include "vantage/planners/prediction_bands.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {

using support::AtStillTable;
using support::still_table;
using support::StillParts;
using support::StillTable;
using support::StillTabletopRobot;

std::vector<double> scored_gains(const ViewChoice& choice, const OutsideChoice* outside = nullptr,
                                 bool have_gains = false) {
  Tabletop task = still_table().task;
  task.gain = SimpleGain{};
  task.choice = choice;
  AtStillTable at(task, outside);
  at.parts.views_have_gains_ = have_gains;
  std::vector<Candidate> views = at.parts.views();
  at.parts.score(views);
  std::vector<double> gains;
  for (const Candidate& view : views) gains.push_back(view.gain_bits);
  return gains;
}

/// Of those who look at gains, the ones that do not work them out themselves.
TEST(MappingParts, ScoreViewsForWhoeverWeighsTheirGains) {
  const AtStillTable at(still_table().task);
  const std::vector<double> gains =
      view_gains_bits(Gain{SimpleGain{}}, {at.belief.filled_grid(), nullptr}, at.parts.views(),
                      at.table.robot.view_field(), 1);
  ASSERT_GT(std::ranges::min(gains), 0.0);
  const std::vector<double> none(gains.size(), 0.0);
  const OutsideChoice outside{.name = "mine", .decide = {}, .ended = {}};
  EXPECT_EQ(scored_gains(GreedyGain{}), gains);
  EXPECT_EQ(scored_gains(GreedyGain{}, nullptr, true), none) << "they have theirs already";
  EXPECT_EQ(scored_gains(RandomView{}), none) << "nobody looks";
  EXPECT_EQ(scored_gains(RandomView{}, &outside), gains);
  EXPECT_EQ(scored_gains(TourChoice{}), none) << "the plan has them";
  EXPECT_EQ(scored_gains(TourChoice{}, &outside), gains);
}

TEST(MappingParts, TellTheTruthToOraclesAlone) {
  const auto told = [](const ViewChoice& choice) {
    Tabletop task = still_table().task;
    task.choice = choice;
    AtStillTable at(task);
    std::vector<Candidate> views(at.parts.views().begin(), at.parts.views().begin() + 3);
    at.parts.score(views);
    return views;
  };
  const StillTable& table = still_table();
  const KnownCells nothing = known_cells(OccupancyGrid(table.task.map.frame()));
  for (const Candidate& view : told(OracleView{})) {
    ASSERT_TRUE(view.true_new_cells);
    EXPECT_EQ(*view.true_new_cells,
              static_cast<double>(table.evaluator.true_new_cells(nothing, view.T_world_sensor)));
    EXPECT_GT(*view.true_new_cells, 0.0);
    EXPECT_TRUE(view.true_new_cell_set == nullptr);
  }
  for (const Candidate& view : told(OracleLookahead{})) {
    ASSERT_TRUE(view.true_new_cell_set != nullptr);
    EXPECT_EQ(*view.true_new_cell_set,
              table.evaluator.true_new_cell_set(nothing, view.T_world_sensor));
    EXPECT_FALSE(view.true_new_cells);
  }
  for (const Candidate& view : told(GreedyGain{})) {
    EXPECT_FALSE(view.true_new_cells || view.true_new_cell_set);
  }
}

/// Behind a wall across the floor, at y = 0.7 m, are some of the places that it may look from.
TEST(MappingParts, PartThePlacesOfTheOracleByWhetherTheyAreInReach) {
  Tabletop task = still_table().task;
  task.choice = OracleTour{};
  AtStillTable at(task);
  std::ranges::fill(at.parts.navigator_.floor().log_odds, -2.0F);
  block_box(at.parts.navigator_.floor(), {Eigen::Vector2d(-6.0, 0.69), Eigen::Vector2d(6.0, 0.71)});
  const auto paths = at.parts.navigator_.plan();
  const auto near = at.parts.views_of_truth(*paths, true);
  const auto far = at.parts.views_of_truth(*paths, false);
  EXPECT_EQ(near.size() + far.size(), at.table.evaluator.observing_poses().size());
  EXPECT_GT(near.size(), 0U);
  EXPECT_GT(far.size(), 0U);
  for (std::size_t i = 0; i < near.size(); ++i) {
    EXPECT_EQ(near[i].id, static_cast<int>(i));
    EXPECT_EQ(near[i].path_length_m,
              path_length_m(*paths, at.table.robot.base_for_sensor(near[i].T_world_sensor)));
  }
  for (const Candidate& view : far) EXPECT_TRUE(std::isinf(view.path_length_m));
  AtStillTable greedy(still_table().task);
  EXPECT_TRUE(greedy.parts.views_of_truth(*paths, true).empty());
}

/// It drives 10, 30 and 20 s, and takes 4000, 9000 and 2000 J for that.
TEST(MappingParts, LearnTheirRatesFromScanToScan) {
  AtStillTable at(still_table().task);
  for (const auto& [time_s, energy_j] :
       {std::pair{30.0, 6000.0}, {80.0, 17000.0}, {120.0, 21000.0}}) {
    ScanRecord& scan = at.parts.current_;
    scan.time_s = time_s;
    scan.energy_j = energy_j;
    scan.scan_time_s = 20.0;
    scan.scan_energy_j = 2000.0;
    at.parts.record_scan();
    EXPECT_EQ(at.parts.current_.time_s, 0.0) << "the next one begins";
  }
  ASSERT_EQ(at.parts.scans().size(), 3U);
  EXPECT_EQ(at.parts.scans()[1].energy_j, 17000.0);
  EXPECT_NEAR(at.parts.budget_.rates().driving_w(), 15000.0 / 60.0, 1e-9);
  EXPECT_NEAR(at.parts.budget_.rates().scanning_w(), 100.0, 1e-9);
  EXPECT_EQ(at.parts.budget_.rates().scan_s(), 20.0);
}

TEST(MappingParts, NameTheScanThatTheMapIsLeastSureAt) {
  AtStillTable at(still_table().task);
  EXPECT_EQ(at.parts.distrust(), "") << "no scan yet";
  const double tolerance_m = map_tolerance_m(at.table.task);
  at.parts.scans_.resize(3);
  at.parts.scans_[0].map_sigma_m = tolerance_m;
  EXPECT_EQ(at.parts.distrust(), "") << "just as sure as is asked for";
  at.parts.scans_[1].map_sigma_m = 3.0 * tolerance_m;
  at.parts.scans_[2].map_sigma_m = 2.0 * tolerance_m;
  EXPECT_NE(at.parts.distrust().find("at scan 2 "), std::string::npos) << at.parts.distrust();
}

TEST(MappingParts, EndAtTheLimitOfScansAndSaySo) {
  Tabletop task = still_table().task;
  task.scans = 3;
  std::size_t scans = 0;
  int scans_left = -1;
  std::optional<bool> at_limit;
  const OutsideChoice outside{
      .name = "mine", .decide = {}, .ended = [&](const MapSituation& situation, bool limit) {
        scans = situation.scans;
        scans_left = situation.scans_left;
        at_limit = limit;
      }};
  AtStillTable at(task, &outside);
  const std::vector<Candidate> views = at.parts.views();
  at.parts.scans_.resize(2);
  EXPECT_EQ(at.parts.limit_reached(views), "");
  at.parts.end_with(views);
  EXPECT_EQ(at_limit, false);
  EXPECT_EQ(scans, 2U);
  EXPECT_EQ(scans_left, 1);
  at.parts.scans_.resize(3);
  EXPECT_EQ(at.parts.limit_reached(views), "limit of 3 scans");
  at.parts.end_with(views);
  EXPECT_EQ(at_limit, true);
  EXPECT_EQ(scans_left, 0);
  at.parts.end_with({});
  EXPECT_EQ(at_limit, false) << "there was nothing more to see";
  at.parts.scans_.resize(4);
  at.parts.end_with(views);
  EXPECT_EQ(scans_left, 0);
}

TEST(MappingParts, TryAScanThatShowsNothingFourTimes) {
  AtStillTable at(still_table().task);
  at.parts.scans_.resize(2);
  int asked = 0;
  const auto usable_at = [&](int attempt) {
    asked = 0;
    return at.parts.first_usable<std::string>([&, attempt](std::string& seen) {
      seen = "seen";
      return ++asked == attempt;
    });
  };
  EXPECT_EQ(usable_at(1), "seen");
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(usable_at(4), "seen");
  EXPECT_EQ(asked, 4);
  try {
    usable_at(5);
    FAIL() << "it goes on";
  } catch (const EpisodeFailed& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("scan 3 "), std::string::npos) << what;
    EXPECT_NE(what.find("4 times in a row"), std::string::npos) << what;
  }
  EXPECT_EQ(asked, 4);
}

/// The map shows nothing new. What no cell was seen of counts as one.
TEST(MappingParts, RecordWhatAScanWasGiven) {
  AtStillTable at(still_table().task);
  StillTabletopRobot& robot = at.table.robot;
  const Pose expected_at = at.parts.views()[4].T_world_sensor;
  const auto scan = [&] {
    at.parts.predict(expected_at);
    StillParts::Before before = at.parts.before_update();
    before.start_s = wall_s() - 1000.0;
    before.dead_reckoned = {0.5, 0.0, 0.0};
    before.tracked = {0.0, 0.25, 0.0};
    BeliefUpdate update;
    update.T_world_base = {-1.25, 0.5, 0.75};
    update.registered = false;
    update.unconstrained = 3;
    robot.now_s += 42.5;
    robot.used_j += 1234.5;
    at.parts.measure(before, update, make_pose({1.0, 2.0, 3.0}, 0.5));
    EXPECT_LE(at.parts.current_.map_time_s, wall_s() - before.start_s);
  };
  scan();
  const ScanRecord& record = at.parts.current_;
  EXPECT_GE(record.map_time_s, 999.0);
  EXPECT_EQ(record.time_s, 42.5);
  EXPECT_EQ(record.energy_j, 1234.5);
  EXPECT_FALSE(record.registered);
  EXPECT_EQ(record.unconstrained, 3);
  EXPECT_EQ(record.T_world_base.yaw_rad, 0.75);
  EXPECT_TRUE(record.T_world_sensor.matrix() == make_pose({1.0, 2.0, 3.0}, 0.5).matrix());
  const Pose2 truth = at.table.truth.T_world_base();
  EXPECT_NEAR(record.pose_error_before_registration_m, std::hypot(0.5 - truth.x_m, truth.y_m),
              1e-9);
  EXPECT_NEAR(record.pose_error_tracked_m, std::hypot(truth.x_m, 0.25 - truth.y_m), 1e-9);
  EXPECT_NEAR(record.pose_error_m, std::hypot(-1.25 - truth.x_m, 0.5 - truth.y_m), 1e-9);
  EXPECT_EQ(record.unobserved_cells, at.belief.grid().size());
  EXPECT_EQ(record.observable_unobserved_cells, at.table.evaluator.observable_cells());
  EXPECT_EQ(record.actual_new_cells, 0.0);
  EXPECT_FALSE(record.forecast) << "nothing was learnt before";
  std::array<Candidate, 1> view;
  view[0].T_world_sensor = expected_at;
  const BlockField transmission = at.belief.hazard().transmission();
  ASSERT_EQ(record.predicted_cells.size(), cell_predictors().size());
  for (std::size_t i = 0; i < record.predicted_cells.size(); ++i) {
    const Gain gain = cell_predictors()[i];
    EXPECT_EQ(record.predicted_cells[i].first, strategy_name_of(gain));
    EXPECT_EQ(
        record.predicted_cells[i].second,
        view_gains_bits(gain, {at.belief.filled_grid(), &transmission}, view, robot.view_field(), 1)
            .front());
  }
  ForecastInterval interval(at.table.task.intervals, kForecastsAtTables);
  interval.start(1.0);
  for (int later = 0; later < 2; ++later) {
    at.parts.record_scan();
    scan();
    double cells = 0.0;
    for (const PredictionBand& band : record.by_distance) cells += band.predicted_cells;
    ASSERT_TRUE(record.forecast);
    EXPECT_GT(cells, 0.0);
    EXPECT_DOUBLE_EQ(record.forecast->cells, cells);
    EXPECT_DOUBLE_EQ(record.forecast->interval.low, interval.of(cells).low);
    EXPECT_DOUBLE_EQ(record.forecast->interval.high, interval.of(cells).high);
    interval.observe(cells, 0.0);
  }
}

/// At the second scan it sees every other cell of the field, and a few that it was not to see.
TEST(MappingParts, HoldTheirHazardAgainstWhatWasToBeSeen) {
  Tabletop task = still_table().task;
  task.forecast.calibrate = true;
  task.clutter_hazard.prior_hazard = 0.1;
  AtStillTable at(task);
  const FieldOfView field = at.table.robot.view_field();
  const Pose T_world_sensor = at.parts.views()[4].T_world_sensor;
  at.parts.predict(T_world_sensor);
  at.parts.measure(at.parts.before_update(), {}, T_world_sensor);
  EXPECT_EQ(at.parts.current_.hazard_scale, 1.0);
  at.parts.record_scan();

  at.parts.predict(T_world_sensor);
  const StillParts::Before before = at.parts.before_update();
  const GridFrame& frame = at.belief.grid().frame;
  double inside = 0.0;
  double outside = 0.0;
  for (std::size_t cell = 0; cell < before.grid.size(); ++cell) {
    const Eigen::Vector3d p_m = T_world_sensor.inverse() * frame.centre(frame.cell(cell));
    if (field.contains(p_m) ? cell % 2 != 0 : cell % 20 != 0) continue;
    at.belief.grid_.log_odds[cell] = -2.0F;
    ++(field.contains(p_m) ? inside : outside);
  }
  ASSERT_GT(inside, 100.0);
  ASSERT_GT(outside, 10.0);
  at.parts.measure(before, {}, T_world_sensor);
  ForecastCalibration expected(task.forecast);
  const auto forecast = [&](double factor) {
    return predict_by_distance(
               {.transmission = expected.transmission(at.belief.hazard().transmission(), factor)},
               before.grid, T_world_sensor, field, field.range_max_m, 1)
        .front()
        .predicted_cells;
  };
  const ScanRecord& record = at.parts.current_;
  EXPECT_EQ(record.actual_new_cells, inside + outside);
  ASSERT_TRUE(record.forecast);
  EXPECT_NEAR(record.forecast->cells, forecast(1.0), 1e-6 * forecast(1.0));
  expected.observe(forecast(1.0), forecast(0.5), inside);
  ASSERT_LT(std::abs(std::log(expected.scale())), 0.99) << "as far as one scan may go";
  ASSERT_GT(std::abs(std::log(expected.scale())), 1e-4);
  EXPECT_NEAR(record.hazard_scale, expected.scale(), 1e-6);
}

TEST(MappingParts, RecordTheWayThatWasPlanned) {
  AtStillTable at(still_table().task);
  Candidate view = at.parts.views()[7];
  view.path_length_m = 3.25;
  at.parts.approach(view, std::nullopt);
  EXPECT_EQ(at.parts.current_.planned_way_m, 3.25);
}

/// Two looks from one place show less than twice as much as one; an oracle expects no more.
TEST(MappingParts, ExpectOfAllViewsTogetherWhatAdaptiveSays) {
  AtStillTable at(still_table().task);
  std::vector<Candidate> views(at.parts.views().begin(), at.parts.views().begin() + 1);
  const BlockField transmission = at.belief.hazard().transmission();
  const double gain =
      view_gains_bits(Gain{AdaptiveGain{}}, {at.belief.filled_grid(), &transmission}, views,
                      at.table.robot.view_field(), 1)
          .front();
  const double one = at.parts.expected_left_cells(views);
  EXPECT_NEAR(one, gain, 0.1 * gain);
  views.push_back(views[0]);
  const double both = at.parts.expected_left_cells(views);
  EXPECT_GE(both, one);
  EXPECT_LT(both, 1.9 * one);
  views[1].exhausted = true;
  EXPECT_DOUBLE_EQ(at.parts.expected_left_cells(views), one);
  Tabletop task = at.table.task;
  task.choice = OracleTour{};
  task.gain = SimpleGain{};
  AtStillTable oracle(task);
  EXPECT_DOUBLE_EQ(oracle.parts.expected_left_cells(views), one);
}

/// Cells of a row of four that are occupied since the first scan, and since the second.
std::vector<VoxelRecord> voxels_of_two_scans(bool lean) {
  StillTable& table = still_table();
  const support::TemporaryDirectory folder;
  const RunRequest request =
      support::mapping_request(table.episode, {folder.path() / "run", true, false, {}, lean});
  const EpisodeRun run(request);
  MappingRecorder recorder(run, recorded(table.robot), {}, 5);
  EXPECT_EQ(recorder.logs_events(), !lean);
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {4.0, 1.0, 1.0}, {4, 1, 1}));
  recorder.write_map(grid, {});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "run" / "map.bt")) << "nothing is known";
  grid.log_odds[0] = 1.0F;
  recorder.write_map(grid, {});
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run" / "map.bt"));
  EXPECT_EQ(read_voxels(folder.path() / "run" / "voxels.bin").voxels[0].step, 0);
  grid.log_odds[0] = 0.0F;
  recorder.write_map(grid, {});
  grid.log_odds[0] = 1.0F;
  recorder.scan({}, 1, grid);
  grid.log_odds[1] = 1.0F;
  recorder.scan({}, 2, grid);
  recorder.write_map(grid, {});
  return read_voxels(folder.path() / "run" / "voxels.bin").voxels;
}

TEST(MappingRecorder, KeepsSinceWhichScanCellsAreOccupied) {
  const auto kept = voxels_of_two_scans(false);
  ASSERT_EQ(kept.size(), 4U);
  EXPECT_FLOAT_EQ(kept[0].x, -1.5F);
  EXPECT_EQ(kept[0].step, 0);
  EXPECT_FLOAT_EQ(kept[1].x, -0.5F);
  EXPECT_EQ(kept[1].step, 1);
  EXPECT_EQ(kept[2].kind, kVoxelUnobserved);
  const auto lean = voxels_of_two_scans(true);
  ASSERT_EQ(lean.size(), 4U);
  EXPECT_EQ(lean[0].step, 1) << "it looks at the map at the end alone";
}

/// `simple` counts cells, `fsmi` bits.
TEST(MappingRecorder, KeepsHowManyCellsViewsWereToShowIfTheGainCountsThem) {
  StillTable& table = still_table();
  const support::TemporaryDirectory folder;
  const RunRequest request =
      support::mapping_request(table.episode, {folder.path() / "run", true, false, {}, false});
  const EpisodeRun run(request);
  MappingRecorder recorder(run, recorded(table.robot), {}, 5);
  std::vector<Candidate> views(2);
  views[1].gain_bits = 12.5;
  recorder.decision(views, 1, SimpleGain{});
  recorder.decision(views, 1, FsmiGain{});
  recorder.commit();
  const CsvTable kept = read_csv(folder.path() / "run" / "candidates.csv");
  const std::size_t column = support::column_index(kept, "predicted_cells");
  std::vector<std::string> cells;
  for (const auto& row : kept.rows) cells.push_back(row.at(column));
  EXPECT_EQ(cells, (std::vector<std::string>{"0", "12.5", "", ""}));
}

TEST(MappingParts, LeaveOutViewsThatCannotBePaid) {
  Tabletop task = still_table().task;
  task.budget.time_s = 100.0;
  AtStillTable at(task);
  std::vector<Candidate> views(at.parts.views().begin(), at.parts.views().begin() + 2);
  views[0].path_length_m = 3.0;
  views[1].path_length_m = 400.0;
  at.parts.score(views);
  EXPECT_FALSE(views[0].exhausted);
  EXPECT_TRUE(views[1].exhausted);
}

TEST(MappingParts, SayWhichScanWasNotRegisteredInAllDirections) {
  AtStillTable at(still_table().task);
  const auto said = [&](bool registered, int unconstrained) {
    const Pose T_world_sensor = at.parts.views()[4].T_world_sensor;
    at.parts.predict(T_world_sensor);
    BeliefUpdate update;
    update.registered = registered;
    update.registration_note = "too few points";
    update.unconstrained = unconstrained;
    at.table.robot.now_s += 40.0;
    testing::internal::CaptureStderr();
    at.parts.measure(at.parts.before_update(), update, T_world_sensor);
    const std::string text = testing::internal::GetCapturedStderr();
    at.parts.record_scan();
    return text;
  };
  EXPECT_EQ(said(true, 0), "");
  const std::string unregistered = said(false, 3);
  EXPECT_NE(unregistered.find("scan 2: not registered, too few points: "), std::string::npos)
      << unregistered;
  const std::string along = said(true, 2);
  EXPECT_NE(along.find("scan 3: registered, but for 2 of 3 directions"), std::string::npos)
      << along;
}

TEST(MappingRecorder, ShowsHowFarTheEpisodeHasCome) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  StillTable& table = still_table();
  const support::TemporaryDirectory folder;
  const RunRequest request =
      support::mapping_request(table.episode, {folder.path() / "run", true, false, {}, true});
  const EpisodeRun run(request);
  MappingRecorder recorder(run, recorded(table.robot), {}, 5);
  ScanRecord record;
  record.observable_unobserved_cells = 700;
  record.time_s = 12.5;
  const OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.5}, {4.0, 1.0, 1.0}, {4, 1, 1}));
  const std::string shown = support::shown_progress([&] { recorder.scan(record, 3, grid); });
  EXPECT_NE(shown.find(" 60 % scan 3 of 5: 700 observable cells left, 12.5 s simulated"),
            std::string::npos)
      << shown;
}

}  // namespace
}  // namespace vantage
