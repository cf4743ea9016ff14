// The parts of a flight round objects: where it looks from, what it keeps of each view, and what
// its metrics say of that.
#include "vantage/tasks/object_flight/object_flight_parts.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/tasks/object_flight/scripted_flight.hpp"
#include "vantage/runtime/log/video.hpp"
#include "vantage/tasks/object_flight/object_flight_metrics.hpp"

namespace vantage {
namespace {

using support::expect_same_places;
using support::expect_same_turn;
using support::kRightAngle_rad;
using support::ScriptedFlight;
using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(ScriptedFlight, BeginsWhereItsBearingsCountFrom) {
  ObjectFlightParts parts(context(), goal(1), what_is_it(), 2.0);
  robot_.flight.duration_s = 1.25;
  look(parts);
  expect_same_places(robot_.flown, orbit_arc(task_.orbit(), 0.5, 2.0, task_.arc_rad));
  const ObservationRecord& first = parts.records().front();
  ASSERT_TRUE(first.flight);
  EXPECT_EQ(first.flight->duration_s, 1.25);
  EXPECT_EQ(first.report.view_rad, 2.0);
  parts.observe();
  EXPECT_EQ(robot_.flights, 1) << "it is there";
  ObjectFlightParts at_start(context(), goal(1), what_is_it(), 0.5);
  look(at_start);
  EXPECT_EQ(robot_.flights, 1) << "where it began";
  EXPECT_FALSE(at_start.records().front().flight);
}

TEST_F(ScriptedFlight, OffersAllBearingsButTheOneItIsAt) {
  ObjectFlightParts parts(context(), goal(1), what_is_it(), 2.0);
  look(parts);
  const std::vector<BearingOption> options = offered(parts);
  ASSERT_EQ(options.size(), 3U);
  for (int id = 1; id < 4; ++id) {
    const BearingOption& option = options[static_cast<std::size_t>(id - 1)];
    EXPECT_EQ(option.id, id);
    EXPECT_NEAR(option.bearing_rad, wrap_turn(2.0 + kRightAngle_rad * id), 1e-12);
    expect_same_turn(option.action.yaw_rad, kRightAngle_rad * id);
    EXPECT_LE(std::abs(option.action.yaw_rad), std::numbers::pi + 1e-12);
    EXPECT_EQ(option.action.time_s, 2.0) << "and half a second of rest";
    EXPECT_EQ(option.action.path_m, 2.5);
    EXPECT_EQ(option.action.energy_j, 3.5);
    EXPECT_EQ(option.action.visible, 1.0);
    EXPECT_FALSE(option.action.visited);
    EXPECT_EQ(option.target, 0U);
    expect_same_places(option.T_world_way,
                       orbit_arc(task_.orbit(), 2.0, option.bearing_rad, task_.arc_rad));
  }
}

/// P(u) is 1/2: the bowl's other yaw bins have 0.45 of it, the mug's 0.05.
TEST_F(ScriptedFlight, RecordsWhatIsBelievedAndTurnsIt) {
  ObjectFlightParts parts(context(), goal(1), is_it_that_bowl(), 0.5);
  look(parts);
  const ObservationRecord first = parts.records().back();
  EXPECT_EQ(first.time_s, 2.0);
  EXPECT_EQ(first.bearing_id, 0);
  EXPECT_EQ(first.estimate, "bowl_2");
  EXPECT_EQ(first.category, "bowl");
  EXPECT_NEAR(first.map_probability, 0.95, 1e-9);
  EXPECT_EQ(first.unknown_probability, 0.0);
  EXPECT_NEAR(first.report.entropy_bits, 0.5 - 0.45 * std::log2(0.15) - 0.05 * std::log2(0.0125),
              1e-9);
  ASSERT_TRUE(first.change);
  EXPECT_EQ(first.change->verdict, Change::none) << "the place was not seen";
  EXPECT_NEAR(first.change->probability, 0.5, 1e-12);
  EXPECT_THAT(first.not_segmented, HasSubstr("no table"));
  EXPECT_EQ(first.object_px, 0);
  EXPECT_TRUE(first.T_world_camera.isApprox(robot_.T_world_camera));
  EXPECT_EQ(first.estimated_bin, 2);
  EXPECT_EQ(first.bin_error, 0);
  EXPECT_NEAR(first.true_yaw_rad, std::numbers::pi, 1e-3);

  std::vector<BearingOption> options = offered(parts);
  options[0].action.visible = 0.75;
  robot_.now_s = 4.5;
  robot_.flight = {FlightStatus::timeout, 1.25, 1.5, 0.125, 0.25, 40.0};
  robot_.T_world_body = task_.orbit().place(options[0].bearing_rad);
  parts.act(options[0]);
  expect_same_places(robot_.flown, options[0].T_world_way);
  look(parts);
  const ObservationRecord& second = parts.records().back();
  EXPECT_EQ(second.time_s, 4.5);
  EXPECT_EQ(second.bearing_id, 1);
  EXPECT_EQ(second.report.view_rad, options[0].bearing_rad);
  EXPECT_EQ(second.expected_visible, 0.75);
  ASSERT_TRUE(second.flight);
  EXPECT_EQ(second.flight->status, FlightStatus::timeout);
  EXPECT_EQ(second.flight->energy_J, 40.0);
  EXPECT_EQ(second.estimated_bin, 1) << "it is seen turned against the flight";
  EXPECT_EQ(second.bin_error, 1) << "what truly happened has not moved";
}

/// A quarter of a turn was meant, an eighth was flown: half of a yaw bin.
TEST_F(ScriptedFlight, TurnsWhatIsBelievedAsFarAsItCame) {
  ObjectFlightParts parts(context(), goal(1), is_it_that_bowl(), 0.5);
  look(parts);
  const std::vector<BearingOption> options = offered(parts);
  robot_.flight.status = FlightStatus::timeout;
  robot_.T_world_body = task_.orbit().place(options[0].bearing_rad - 0.5 * kRightAngle_rad);
  parts.act(options[0]);
  look(parts);
  EXPECT_NEAR(parts.records().back().report.view_rad,
              options[0].bearing_rad - 0.5 * kRightAngle_rad, 1e-9);
  const Eigen::VectorXd p = p_state(parts.tour().current().inquiry.recognition().belief);
  EXPECT_NEAR(p[6], p[5], 1e-9) << "of the bowl, between the bin it was seen in and the next";
}

/// 2 s have passed; it takes 2 s to any place and to rest there.
TEST_F(ScriptedFlight, TakesViewsUpToTheLimit) {
  FlightGoal limited = goal(1);
  limited.time_limit_s = 4.0;
  ObjectFlightParts in_time(context(), limited, what_is_it(), 0.5);
  look(in_time);
  EXPECT_EQ(offered(in_time).size(), 3U);
  limited.time_limit_s = 3.9;
  ObjectFlightParts too_late(context(), limited, what_is_it(), 0.5);
  look(too_late);
  EXPECT_THAT(too_late.finished(), HasSubstr("time_limit_s = 3.9"));
  EXPECT_TRUE(too_late.propose().empty());
}

/// Nothing of the table was seen yet, and nothing within 2 m of it is flown through.
TEST_F(ScriptedFlight, TriesLongAndHighWaysBeforeItGivesAPlaceUp) {
  FlightGoal among = goal(1);
  among.among_others.emplace();
  among.among_others->map.clearance_m = 2.0;
  ObjectFlightParts parts(context(), among, what_is_it(), 0.5);
  EXPECT_EQ(parts.finished(), "no view is reached clear of obstacles");
  const std::vector<OrbitWay> ways{{}, {true, 0.0}, {false, 0.35}, {true, 0.35}, {false, 0.7}};
  ASSERT_GE(robot_.planned.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    const double to_rad = 0.5 + kRightAngle_rad * static_cast<double>(i / 5);
    expect_same_places(robot_.planned[i], orbit_way(task_.orbit(), 0.5, task_.orbit(), to_rad,
                                                    task_.arc_rad, ways[i % 5]));
  }
}

TEST_F(ScriptedFlight, TakesTheFirstWayThatIsClearFromTheRobotOn) {
  FlightGoal among = goal(1);
  among.among_others.emplace();
  robot_.beside_m = {0.0, 0.0, 50.0};
  ObjectFlightParts parts(context(), among, what_is_it(), 0.5);
  const std::vector<BearingOption> options = offered(parts);
  ASSERT_EQ(options.size(), 4U);
  EXPECT_EQ(robot_.planned.size(), 4U);
  const TableMap unseen(task_.p_world_table_m(), among.among_others->map);
  const UprightCylinder usual{task_.p_world_table_m(), 0.05, 0.14};
  for (const BearingOption& option : options) {
    const Eigen::Vector3d eye_m = task_.orbit().place(option.bearing_rad).translation();
    EXPECT_DOUBLE_EQ(option.action.visible, unseen.visible_share(usual, {}, eye_m));
    EXPECT_LT(option.action.visible, 1.0);
  }
  robot_.T_world_body.translation() = task_.p_world_table_m() + Eigen::Vector3d(0.0, 0.0, 0.2);
  EXPECT_EQ(parts.finished(), "no view is reached clear of obstacles");
}

TEST_F(ScriptedFlight, ShowsWhatItChoosesAmongAndTheWayThere) {
  task_.decision.views.choice = MutualInformation{};
  FlightGoal both = goal(2);
  both.all_at_once = true;
  ObjectFlightParts parts(context(), both, what_is_it(), 0.5);
  robot_.beside_m = {0.0, 0.0, 0.25};
  look(parts);
  std::vector<BearingOption> options = offered(parts);
  parts.score(options);
  told_.clear();
  const std::size_t chosen = parts.choose(options);
  ASSERT_EQ(told_.size(), 2U);
  const auto& decision = std::get<Decision>(told_[0].what);
  EXPECT_EQ(decision.chosen, chosen);
  ASSERT_EQ(decision.candidates.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    const Orbit orbit = task_.orbit_round(both.p_world_m[options[i].target]);
    EXPECT_EQ(decision.candidates[i].id, static_cast<int>(i));
    EXPECT_TRUE(decision.candidates[i].T_world_sensor.isApprox(orbit.place(options[i].bearing_rad)))
        << i;
    EXPECT_GT(decision.candidates[i].gain_bits, 0.5) << "a mug or a bowl: nearly 1 bit";
  }
  const auto& way = std::get<PlannedFlight>(told_[1].what);
  const std::vector<Pose>& places = options[chosen].T_world_way;
  ASSERT_EQ(way.path_m.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_TRUE(way.path_m[i].isApprox(places[i].translation() + robot_.beside_m)) << i;
  }
  parts.act(options[chosen]);
  look(parts);
  EXPECT_EQ(parts.records()[0].gain_bits, 0.0);
  EXPECT_EQ(parts.records()[1].gain_bits, decision.candidates[chosen].gain_bits);
}

TEST_F(ScriptedFlight, ItsPlacesAreRoundEachTarget) {
  const FlightGoal both = goal(2);
  const ObjectFlightParts parts(context(), both, what_is_it(), 2.0);
  const std::vector<Candidate> places = parts.places();
  ASSERT_EQ(places.size(), 8U);
  for (int i = 0; i < 8; ++i) {
    const Candidate& place = places[static_cast<std::size_t>(i)];
    EXPECT_EQ(place.id, i);
    const Orbit orbit = task_.orbit_round(both.p_world_m[i < 4 ? 0 : 1]);
    EXPECT_TRUE(place.T_world_sensor.isApprox(orbit.place(2.0 + kRightAngle_rad * (i % 4)))) << i;
  }
}

/// The camera is 1 m from what is looked at first, above the middle of the table by 7 cm.
TEST_F(ScriptedFlight, AViewIsHeldAgainstTheTruthOfItsTarget) {
  const RecognitionTask& task = std::get<RecognitionTask>(episode_->task);
  const Eigen::Vector3d p_camera_m = task.orbit().place(truth_->start_bearing_rad()).translation();
  const ObjectStates& states = recogniser_.states;
  ObservationRecord record;
  record.position_error_m = record.angle_error_rad = 9.0;
  record.collisions = 9;
  evaluator_.measure(states, 0, states.state(1, 0), 0, record);
  EXPECT_NEAR(record.position_error_m, 0.0, 1e-3);
  EXPECT_NEAR(record.angle_error_rad, 0.0, 1e-3);
  EXPECT_EQ(record.collisions, 0);
  EXPECT_NEAR(record.true_yaw_rad, std::numbers::pi, 1e-3);
  EXPECT_EQ(record.bin_error, 2);
  evaluator_.measure(states, 1, states.state(1, 3), 0, record);
  EXPECT_EQ(record.bin_error, 1);
  evaluator_.measure(states, 1, states.state(1, 3), 1, record);
  const Eigen::Vector3d from_m = p_camera_m - task.p_world_table_m();
  EXPECT_NEAR(record.true_yaw_rad,
              wrap_turn(objects_[1].yaw_rad - std::atan2(from_m.y() - 0.1, from_m.x() - 0.2)),
              1e-3);
}

using FlightJson = nlohmann::ordered_json;

TEST_F(ScriptedFlight, ItsMetricsHaveAllOfEachRecord) {
  task_.segmentation.radius_m = 0.25;
  task_.segmentation.max_height_m = 0.5;
  ObjectFlightParts parts(context(), goal(1), is_it_that_bowl(), 0.5);
  travel(0.0);
  travel(3.0);
  look(parts);
  const std::vector<BearingOption> options = offered(parts);
  robot_.flight = {FlightStatus::timeout, 1.25, 1.5, 0.125, 0.25, 40.0};
  robot_.T_world_body = task_.orbit().place(options[0].bearing_rad);
  parts.act(options[0]);
  travel(4.0);
  look(parts);
  FlightJson metrics;
  add_observations(task_, parts, metrics);
  ASSERT_EQ(metrics["observations"].size(), 2U);
  EXPECT_FALSE(metrics["observations"][0].contains("flight"));
  const FlightJson& view = metrics["observations"][1];
  const ObservationRecord& record = parts.records()[1];
  EXPECT_EQ(view["view_rad"], options[0].bearing_rad);
  EXPECT_EQ(view["time_s"], 2.0);
  EXPECT_EQ(view["chosen_view"], 1);
  EXPECT_EQ(view["target"], 1) << "the first";
  EXPECT_EQ(view["entropy_bits"], record.report.entropy_bits);
  EXPECT_EQ(view["estimate"], "bowl_2");
  EXPECT_EQ(view["map_probability"], record.map_probability);
  EXPECT_EQ(view["unknown_probability"], 0.0);
  EXPECT_EQ(view["object_px"], 0);
  EXPECT_EQ(view["expected_visible"], 1.0);
  EXPECT_EQ(view["seen_share"], 1.0);
  EXPECT_EQ(view["not_segmented"], record.not_segmented);
  EXPECT_EQ(view["true_yaw_rad"], record.true_yaw_rad);
  EXPECT_EQ(view["position_error_m"], record.position_error_m);
  EXPECT_EQ(view["angle_error_rad"], record.angle_error_rad);
  EXPECT_EQ(view["estimated_bin"], 1);
  EXPECT_EQ(view["bin_error"], 1);
  EXPECT_EQ(view["bins"], 4);
  EXPECT_EQ(view["path_length_m"], 7.0);
  EXPECT_EQ(view["leg_length_m"], 4.0);
  EXPECT_EQ(view["change_probability"], record.change->probability);
  EXPECT_NEAR(record.change->probability, 0.5, 1e-12);
  EXPECT_EQ(view["decision"], "none") << "the place was not seen";
  ASSERT_EQ(view["skipped"].size(), 1U);
  EXPECT_EQ(view["skipped"][0]["feature"], "colour");
  EXPECT_EQ(view["skipped"][0]["reason"], record.not_segmented);
  EXPECT_EQ(view["flight"]["status"], std::string(to_string(FlightStatus::timeout)));
  EXPECT_EQ(view["flight"]["duration_s"], 1.25);
  EXPECT_EQ(view["flight"]["leg_length_m"], 1.5);
  EXPECT_EQ(view["flight"]["rms_error_m"], 0.125);
  EXPECT_EQ(view["flight"]["greatest_error_m"], 0.25);
  EXPECT_EQ(view["flight"]["energy_j"], 40.0);
  const Eigen::Vector3d ahead = robot_.T_world_camera.linear().col(2);  // its optical axis
  EXPECT_EQ(view["view"]["z_m"], 3.0);
  expect_same_turn(view["view"]["yaw_rad"], std::atan2(ahead.y(), ahead.x()));
  EXPECT_EQ(metrics["candidates"].size(), 4U);
  const FlightJson column = {{"min_m", {-0.25, -0.25, 0.72}}, {"max_m", {0.25, 0.25, 1.22}}};
  for (const char* corner : {"min_m", "max_m"}) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(metrics["region"][corner][i].get<double>(), column[corner][i].get<double>(),
                  1e-12);
    }
  }
}

TEST_F(ScriptedFlight, ItsMetricsEndWithTheLastEstimateOrNone) {
  ObjectFlightParts parts(context(), goal(1), is_it_that_bowl(), 0.5);
  const ObjectOnTable mug{.object = "mug_1", .category = "mug", .yaw_rad = 1.5};
  FlightJson before;
  add_estimate(mug, parts, before);
  EXPECT_EQ(before["truth"], "mug_1");
  EXPECT_EQ(before["true_yaw_rad"], 1.5);
  for (const char* key :
       {"estimate", "estimated_category", "map_probability", "unknown_probability", "bin_error"}) {
    EXPECT_TRUE(before.at(key).is_null()) << key;
  }
  EXPECT_NEAR(before["entropy_bits"].get<double>(),
              0.5 - 0.45 * std::log2(0.15) - 0.05 * std::log2(0.0125), 1e-9);
  look(parts);
  parts.act(offered(parts)[0]);
  look(parts);
  FlightJson after;
  add_estimate(mug, parts, after);
  EXPECT_EQ(after["estimate"], "bowl_2");
  EXPECT_EQ(after["estimated_category"], "bowl");
  EXPECT_NEAR(after["map_probability"].get<double>(), 0.95, 1e-9);
  EXPECT_EQ(after["unknown_probability"], 0.0);
  EXPECT_EQ(after["bin_error"], 1);
  EXPECT_EQ(after["entropy_bits"], parts.records().back().report.entropy_bits);
  FlightJson of_nothing;
  add_estimate({}, parts, of_nothing);
  for (const char* key : {"truth", "true_yaw_rad", "bin_error"}) {
    EXPECT_TRUE(of_nothing.at(key).is_null()) << key;
  }
}

/// A still of the video has the panel in its right half. Its images show nothing.
TEST_F(ScriptedFlight, ShowsInItsPanelWhereItIsAndWhatItBelieves) {
  if (const auto missing = missing_video_codec(); !missing.empty()) GTEST_SKIP() << missing;
  robot_.T_world_body = make_pose(task_.p_world_table_m() + Eigen::Vector3d(0.3, -0.25, 1.0), 1.5);
  const CameraImages image = robot_.observe().images;
  const auto at_origin = [] { return Pose(Pose::Identity()); };
  const auto expect_shown = [&](const char* folder, const FlightGoal& goal,
                                const Expectation& expectation) {
    RunOptions filmed = lean_options();
    filmed.directory = folder_ / folder;
    filmed.video = true;
    const RunRequest request{setup_, "recognition", "star", "a: 1\n", {}, filmed};
    const EpisodeRun run(request);
    ObjectFlightRecorder recorder(
        run, {.world = world_, .T_world_body = at_origin, .T_world_estimated = at_origin}, 8,
        false);
    ObjectFlightParts parts({setup_.options, task_, recogniser_, robot_, evaluator_, recorder},
                            goal, expectation.object.empty() ? what_is_it() : is_it_that_bowl(),
                            2.0, expectation);
    look(parts);
    RecognitionPanelInput expected{.observation_records = parts.records(), .orbit = task_.orbit()};
    expected.goal_rad = 2.0;
    expected.T_world_body = robot_.T_world_body;
    expected.camera_image = &image;
    expected.set_belief(recogniser_.states, parts.recognition().belief);
    expected.expected = expectation.object;
    expected.threshold = expectation.threshold;
    expected.method = task_.method_name();
    expected.targets_m = goal.p_world_m;
    TableMap map(task_.p_world_table_m(), goal.among_others.value_or(AmongOthers{}).map);
    if (goal.among_others) {
      map.insert(image, robot_.T_world_camera);
      expected.map = &map.grid();
    }
    const UprightCylinder usual{task_.p_world_table_m(), 0.05, 0.14};
    for (int id = 0; id < 4; ++id) {
      const double at_rad = std::fmod(2.0 + kRightAngle_rad * id, 4.0 * kRightAngle_rad);
      expected.bearings_rad.push_back(at_rad);
      if (!goal.among_others) continue;
      const Eigen::Vector3d eye_m = task_.orbit().place(at_rad).translation();
      expected.visible.push_back(map.visible_share(usual, {}, eye_m));
    }
    const cv::Mat still = cv::imread((filmed.directory / "frames/scan_01.png").string());
    release_run_directory(filmed.directory);
    ASSERT_EQ(still.size(), cv::Size(1280, 720)) << folder;
    const cv::Mat panel = draw_recognition_panel(expected, {640, 720});
    EXPECT_EQ(cv::norm(still(cv::Rect(640, 0, 640, 720)), panel, cv::NORM_INF), 0.0) << folder;
  };
  FlightGoal among = goal(2);
  among.among_others.emplace();
  expect_shown("alone", goal(1), {});
  expect_shown("expected", goal(1), {"bowl_2", 0.25});
  expect_shown("among others", among, {});
}

}  // namespace
}  // namespace vantage
