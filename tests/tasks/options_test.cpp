// Defaults and ranges of the options that tasks have of their own.
#include <gtest/gtest.h>

#include <initializer_list>
#include <numbers>

#include "tests/tasks/own_numbers.hpp"
#include "vantage/tasks/mapping/driving/scan_record.hpp"
#include "vantage/tasks/object_flight/observation_record.hpp"
#include "vantage/tasks/object_flight/orbit_robot_interface.hpp"
#include "vantage/tasks/recognition/table_obstacles.hpp"
#include "vantage/tasks/task.hpp"
#include "vantage/tasks/trajectory/waypoint_record.hpp"

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
                                             {"max_contradicted", 0.06, between(0.0, 1.0)},
                                             {"max_unregistered", 0.2, between(0.0, 1.0)}});
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
  expect_own_numbers(task.frontiers,
                     {{"min_cells", 60, at_least(1)}, {"height_m", 1.47, between(-1e6, 1e6)}});
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
  EXPECT_TRUE(ChangeDetectionTask{}.decision.all_features) << "any of them could show a turn";
  EXPECT_FALSE(ChangeDetectionTask{}.decision.views.about_object);
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

template <class Number>
void expect_all(Number expected, std::initializer_list<Number> numbers) {
  int place = 0;
  for (const Number number : numbers) {
    EXPECT_EQ(number, expected) << "number " << place;
    ++place;
  }
}

TEST(TaskRecords, OfScansBeginWithNothing) {
  const ScanRecord s{};
  expect_all(0.0, {s.time_s, s.actual_new_cells, s.plan_time_s, s.map_time_s, s.scan_time_s,
                   s.energy_j, s.scan_energy_j, s.path_length_m, s.leg_length_m, s.planned_way_m});
  expect_all(0.0, {s.pose_error_m, s.pose_error_before_registration_m, s.pose_error_tracked_m,
                   s.yaw_error_rad, s.pose_error_at_scan_m, s.pose_sigma_m, s.map_sigma_m,
                   s.precision, s.recall});
  expect_all<std::size_t>(
      0, {s.unobserved_cells, s.observable_unobserved_cells, s.candidates, s.keyframe});
  expect_all(0, {s.unconstrained, s.collisions});
  EXPECT_EQ(s.chosen_view, -1) << "the scan at the start";
  EXPECT_EQ(s.hazard_scale, 1.0);
  EXPECT_TRUE(s.registered);
  EXPECT_FALSE(s.fallback || s.forecast || s.left);
  const LeftRecord left{};
  expect_all(0.0, {ForecastRecord{}.cells, left.expected_cells, left.share, left.confidence});
}

TEST(TaskRecords, OfViewsBeginWithNothing) {
  const ObservationRecord o{};
  expect_all(0.0, {o.time_s, o.gain_bits, o.map_probability, o.unknown_probability,
                   o.position_error_m, o.angle_error_rad, o.true_yaw_rad, o.path_length_m,
                   o.leg_length_m, SuspectedChange{}.probability});
  expect_all(0, {o.bearing_id, o.object_px, o.estimated_bin, o.bin_error, o.collisions});
  expect_all(1.0, {o.expected_visible, o.seen_share});
  EXPECT_EQ(o.target, 0U);
  EXPECT_FALSE(o.flight || o.change);
  EXPECT_EQ(SuspectedChange{}.verdict, Change::none);
  const BearingOption option{};
  EXPECT_EQ(option.id, 0);
  EXPECT_EQ(option.bearing_rad, 0.0);
  EXPECT_EQ(option.target, 0U);
  const FlightPlan plan{};
  expect_all(0.0, {plan.duration_s, plan.path_m, plan.energy_j});
  EXPECT_TRUE(FlightObservation{}.arrived);
}

TEST(TaskRecords, OfWaypointsBeginWithNothing) {
  const WaypointRecord w{};
  expect_all(0.0, {w.time_s, w.plan_time_s, w.latency_s, w.cost, w.planned_clearance_m,
                   w.mean_entropy_nats, w.clearance_m, w.tracking_error_m, w.flown_m});
  expect_all(0, {w.waypoint, w.objects, w.known, w.observations, w.collisions});
  EXPECT_FALSE(w.late || w.missed || w.target);
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

/// Nothing has a size yet; there is as much room as the options say if nothing else is said.
TEST(TaskRecords, OfThingsOnTheTableBeginWithNothing) {
  expect_all(0.0, {Post{}.radius_m, Post{}.height_m, Screen{}.yaw_rad, Screen{}.half_m,
                   Screen{}.height_m, StandingRoom::Place{}.yaw_rad});
  expect_all(0.0,
             {Post{}.offset_m.norm(), Screen{}.offset_m.norm(), StandingRoom::Place{}.p_m.norm()});
  const StandingRule rule{};
  EXPECT_EQ(rule.reach_m, ClutterOptions{}.reach_m);
  EXPECT_EQ(rule.spacing_m, ClutterOptions{}.spacing_m);
  EXPECT_TRUE(rule.round_m.empty());
}

}  // namespace
}  // namespace vantage
