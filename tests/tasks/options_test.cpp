// Defaults and ranges of the options that tasks have of their own.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/tasks/own_numbers.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {

using support::expect_own_numbers;
using support::kNull;

TEST(TaskOptions, OfAllThatMap) {
  expect_own_numbers(MappingOptions{}, {{"scans", 10, between(1, 10000)}});
  expect_own_numbers(MapOptions{}, {{"centre_m", kNull, between(-1000.0, 1000.0)},
                                    {"size_m", kNull, {0.0, 1000.0, true}},
                                    {"cells", kNull, between(1, 4096)}});
  expect_own_numbers(MetricsOptions{}, {{"tolerance_cells", 1, between(0, 10)},
                                        {"pose_spacing_m", 1.0, between(0.05, 100.0)},
                                        {"distance_band_m", 0.5, between(0.05, 100.0)}});
  expect_own_numbers(LocalisationOptions{}, {{"tolerance_cells", 4.0, above(0.0)},
                                             {"accept_drift", 0},
                                             {"max_contradicted", 0.03, between(0.0, 1.0)}});
  expect_own_numbers(
      BudgetOptions{},
      {{"time_s", kNull, above(0.0)}, {"energy_j", kNull, above(0.0)}, {"return_to_start", 0}});
}

TEST(TaskOptions, OfExploration) {
  expect_own_numbers(Exploration{}, {{"start_room_m", 0.75, at_least(0.0)},
                                     {"max_candidates", 30, at_least(1)},
                                     {"reach_m", 1.0, at_least(0.0)},
                                     {"taken_m", 0.3, above(0.0)},
                                     {"poor_m", 1.0, at_least(0.0)},
                                     {"poor_cells", 2000, at_least(0)},
                                     {"keyframe_m", 0.5, above(0.0)},
                                     {"reference_novelty_m", 0.05, at_least(0.0)},
                                     {"stride_px", 3, between(1, 100)},
                                     {"hazard_stride_px", 8, between(1, 100)},
                                     {"hazard_floor_m", 0.05, between(0.0, 10.0)}});
  expect_own_numbers(EnoughOptions{},
                     {{"share", 0.0015, between(0.0, 1.0)}, {"scans", 3, at_least(0)}});
  expect_own_numbers(HeadSweep{}, {{"pans", 9, between(1, 360)},
                                   {"tilts_rad[0]", 0.0, between(-1.5, 1.5)},
                                   {"tilts_rad[1]", 0.7, between(-1.5, 1.5)}});
  const Exploration task;
  EXPECT_TRUE(task.camera.tells_far);
  expect_own_numbers(task.frontiers, {{"min_cells", 60, at_least(1)}, {"height_m", 1.47}});
  ASSERT_TRUE(task.frontiers.height_band_m);
  EXPECT_EQ((*task.frontiers.height_band_m)[0], 0.2);
  EXPECT_EQ((*task.frontiers.height_band_m)[1], 1.7);
}

TEST(TaskOptions, OfFlightsRoundAnObject) {
  constexpr double kSixtyDegrees_rad = 1.0471975511965976;
  const auto expect_flight = [&](const auto& task) {
    expect_own_numbers(task,
                       {{"max_views", 8, between(1, 1000)},
                        {"placement_m", 0.01, between(0.0, 0.1)},
                        {"table_m[0]", 0.0, between(-1000.0, 1000.0)},
                        {"table_m[1]", 0.0, between(-1000.0, 1000.0)},
                        {"table_m[2]", 0.72, between(-1000.0, 1000.0)},
                        {"aim_height_m", 0.07, between(0.0, 1.0)},
                        {"distance_m", 1.0, between(0.6, 3.0)},
                        {"elevation_rad", std::numbers::pi / 4.0, between(0.0, kSixtyDegrees_rad)},
                        {"bearings", 8, between(2, 360)},
                        {"arc_rad", 0.2, {0.0, 1.5, true}},
                        {"settle_s", 0.5, between(0.0, 10.0)},
                        {"colour_noise", 4.0, between(0.0, 100.0)}});
  };
  expect_flight(RecognitionTask{});
  expect_flight(ChangeDetectionTask{});
  expect_own_numbers(RecognitionTask{}, {{"targets", 1, between(1, 10)},
                                         {"targets_at_once", 1},
                                         {"time_limit_s", 0.0, between(0.0, 36000.0)}});
  expect_own_numbers(ChangeDetectionTask{}, {{"expected_yaw_rad", kNull, between(-1000.0, 1000.0)},
                                             {"turned_rad", kNull, between(-1000.0, 1000.0)}});
}

TEST(TaskOptions, OfWhatStandsOnTheTable) {
  expect_own_numbers(ClutterOptions{}, {{"objects", 0, between(0, 40)},
                                        {"near_duplicates", 3, between(0, 40)},
                                        {"tall", 0, between(0, 40)},
                                        {"tall_m", 0.18, between(0.0, 1.0)},
                                        {"posts", 0, between(0, 10)},
                                        {"screens", 0, between(0, 10)},
                                        {"screen_m", 0.3, between(0.05, 1.0)},
                                        {"spacing_m", 0.05, between(0.01, 0.5)},
                                        {"reach_m", 0.3, between(0.05, 2.0)}});
  expect_own_numbers(TableMapOptions{}, {{"size_m[0]", 1.0, between(0.1, 10.0)},
                                         {"size_m[1]", 1.0, between(0.1, 10.0)},
                                         {"height_m", 0.5, between(0.05, 3.0)},
                                         {"foot_m", 0.03, between(0.0, 0.2)},
                                         {"cell_m", 0.02, between(0.005, 0.2)},
                                         {"columns", 160, between(8, 4096)},
                                         {"clearance_m", 0.35, between(0.0, 2.0)},
                                         {"margin_m", 0.03, between(0.0, 0.2)}});
  EXPECT_EQ(TableMapOptions{}.hazard.layers, 5);
  expect_own_numbers(ObjectDatabaseOptions{}, {{"seed", 1}, {"objects", 326, between(1, 100000)}});
}

TEST(TaskOptions, OfAFlightAlongAPath) {
  expect_own_numbers(TrajectoryFlight{},
                     {{"placement_m", 0.02, between(0.0, 0.1)},
                      {"horizon", 10, between(3, 100)},
                      {"latency_s", 0.1, between(0.0, 100.0)},
                      {"image_rate_hz", 10.0, between(0.1, 100.0)},
                      {"camera_pitch_rad", 0.35, between(0.0, 1.0471975511965976)},
                      {"colour_noise", 4.0, between(0.0, 100.0)}});
}

/// More than one thing on the table makes a map worth while.
TEST(TaskOptions, AnyClutterIsAmongOthers) {
  EXPECT_FALSE(RecognitionTask{}.among_others());
  EXPECT_FALSE((ClutterOptions{.near_duplicates = 5, .tall = 2}.any())) << "of no objects";
  EXPECT_TRUE(ClutterOptions{.objects = 1}.any());
  EXPECT_TRUE(ClutterOptions{.posts = 1}.any());
  EXPECT_TRUE(ClutterOptions{.screens = 1}.any());
  RecognitionTask task;
  task.targets = 2;
  EXPECT_TRUE(task.among_others());
  task.targets = 1;
  task.clutter.posts = 1;
  EXPECT_TRUE(task.among_others());
}

}  // namespace
}  // namespace vantage
