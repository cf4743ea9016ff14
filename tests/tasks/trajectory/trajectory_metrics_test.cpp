// What a flight along a path measures, and the rows and pictures of its run folder.
#include "vantage/tasks/trajectory/trajectory_metrics.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/terminal.hpp"
#include "tests/tasks/trajectory/noted_flight.hpp"
#include "vantage/information/quantile.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"

namespace vantage {
namespace {

using support::NotedFlight;

/// The second of the true ones is nearest the second found, though the first is near it, too.
TEST(FlightMetrics, MatchWhatTheyFoundNearestFirstWhateverItsHeight) {
  NotedFlight flight;
  flight.beliefs().found(5, {0.0, 0.0, 0.8});
  flight.beliefs().found(6, {0.4, 0.0, 0.8});
  const FlightTruth truth{{},
                          {{"mug_1", "mug", 0.0, {0.25, 0.0, 2.8}},
                           {"bowl_2", "bowl", 0.0, {0.45, 0.0, 0.1}},
                           {"mug_3", "mug", 0.0, {0.0, -0.3, 0.8}}}};
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 0.0;
  add_trajectory_metrics(truth, flight.parts, metrics);
  EXPECT_NEAR(metrics["objects"][0]["position_error_m"].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(metrics["objects"][1]["position_error_m"].get<double>(), 0.05, 1e-9);
  EXPECT_FALSE(metrics["objects"][2]["found"].get<bool>()) << "each is found once";
  EXPECT_EQ(metrics["found"][0]["object"], 0);
  EXPECT_EQ(metrics["found"][1]["object"], 1);
}

TEST(FlightMetrics, FindWhatIsWithinHalfAMetre) {
  NotedFlight flight;
  flight.beliefs().found(5, {0.0, 0.0, 0.8});
  flight.beliefs().found(6, {3.0, 0.0, 0.8});
  const FlightTruth truth{
      {}, {{"mug_1", "mug", 0.0, {0.0, 0.49, 0.8}}, {"bowl_2", "bowl", 0.0, {3.51, 0.0, 0.8}}}};
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 0.0;
  add_trajectory_metrics(truth, flight.parts, metrics);
  EXPECT_TRUE(metrics["objects"][0]["found"].get<bool>());
  EXPECT_TRUE(metrics["objects"][0]["estimate"].is_null()) << "found, and not looked at";
  EXPECT_FALSE(metrics["objects"][1]["found"].get<bool>());
  EXPECT_EQ(metrics["objects_found"], 1);
  EXPECT_EQ(metrics["false_objects"], 1);
  EXPECT_EQ(metrics["objects_unseen"], 2);
}

TEST(FlightMetrics, MeasureWhatTheyWereGiven) {
  NotedFlight flight;
  flight.beliefs().found(5, {1.0, 1.0, 0.8});
  flight.beliefs().found(6, {5.0, 4.0, 0.7});
  const ObjectObservation seen = flight.look(5, {1.0, 1.0, 0.9});
  const FlightTruth truth{
      {.collisions = 2,
       .minimum_clearance_m = 0.31,
       .tracking_error_mean_m = 0.02,
       .tracking_error_max_m = 0.07,
       .energy_j = 432.0,
       .flown_m = 9.0},
      {{"bowl_2", "bowl", 0.0, {-3.0, 2.0, 0.9}}, {"mug_1", "mug", 0.0, {1.0, 1.2, 0.75}}}};
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 61.5;
  add_trajectory_metrics(truth, flight.parts, metrics);
  const auto& never = metrics["objects"][0];
  for (const char* key : {"estimate", "unknown_probability", "position_error_m"}) {
    EXPECT_TRUE(never[key].is_null()) << key;
  }
  EXPECT_FALSE(never["found"].get<bool>());
  EXPECT_FALSE(never["correct"].get<bool>());
  EXPECT_EQ(never["observations"], 0);
  EXPECT_TRUE(never["looks"].empty());
  EXPECT_NEAR(never["entropy_nats"].get<double>(), std::numbers::ln2, 1e-9);
  const auto& mug = metrics["objects"][1];
  EXPECT_EQ(mug["truth"], "mug_1");
  EXPECT_EQ(mug["estimate"], "mug_1");
  EXPECT_TRUE(mug["correct"].get<bool>());
  EXPECT_EQ(mug["observations"], 1);
  EXPECT_EQ(mug["x_m"], 1.0);
  EXPECT_EQ(mug["y_m"], 1.2);
  EXPECT_EQ(mug["z_m"], 0.75);
  EXPECT_EQ(mug["entropy_nats"], seen.entropy_nats);
  ASSERT_EQ(mug["looks"].size(), 1U);
  const auto& look = mug["looks"][0];
  EXPECT_EQ(look["time_s"], 7.5);
  EXPECT_NEAR(look["bearing_rad"].get<double>(), 0.25 * std::numbers::pi, 1e-9);
  EXPECT_EQ(look["direction"], 1);
  EXPECT_EQ(look["distance_m"], 1.4);
  EXPECT_NEAR(look["elevation_rad"].get<double>(), std::atan2(0.9, std::numbers::sqrt2), 1e-9);
  EXPECT_EQ(look["pixels"], 321);
  EXPECT_EQ(look["features"].dump(), R"(["colour"])");
  EXPECT_EQ(look["feature_time_s"], seen.report.feature_time_s);
  EXPECT_EQ(look["entropy_nats"], seen.entropy_nats);
  EXPECT_EQ(look["estimate"], "mug_1");
  EXPECT_EQ(look["map_probability"], seen.map_probability);
  EXPECT_EQ(look["unknown_probability"], seen.unknown_probability);
  const auto& stranger = metrics["found"][1];
  EXPECT_EQ(stranger["x_m"], 5.0);
  EXPECT_EQ(stranger["y_m"], 4.0);
  EXPECT_EQ(stranger["z_m"], 0.7);
  EXPECT_TRUE(stranger["estimate"].is_null() && stranger["object"].is_null());
  EXPECT_NEAR(stranger["entropy_nats"].get<double>(), std::numbers::ln2, 1e-9);
  EXPECT_EQ(metrics["found"][0]["object"], 1);
  EXPECT_EQ(metrics["found"][0]["estimate"], "mug_1");
  EXPECT_EQ(metrics["accuracy"], 0.5);
  EXPECT_EQ(metrics["mean_entropy_observed_nats"], seen.entropy_nats);
  EXPECT_NEAR(metrics["mean_entropy_nats"].get<double>(),
              0.5 * (seen.entropy_nats + std::numbers::ln2), 1e-9);
  EXPECT_EQ(metrics["objects_unseen"], 1);
  EXPECT_EQ(metrics["objects_found"], 1);
  EXPECT_EQ(metrics["false_objects"], 1);
  EXPECT_EQ(metrics["observations_total"], 1);
  EXPECT_EQ(metrics["flight_time_s"], 61.5);
  EXPECT_EQ(metrics["minimum_clearance_m"], 0.31);
  EXPECT_EQ(metrics["tracking_error_m"]["mean"], 0.02);
  EXPECT_EQ(metrics["tracking_error_m"]["max"], 0.07);
  EXPECT_EQ(metrics["energy_j"], 432.0);
}

TEST(FlightMetrics, OfOneObjectAreItsOwn) {
  NotedFlight flight;
  flight.beliefs().found(5, {1.0, 1.0, 0.8});
  const ObjectObservation seen = flight.look(5, {1.0, 1.0, 0.9});
  const FlightTruth truth{{}, {{"mug_1", "mug", 0.0, {1.0, 1.2, 0.75}}}};
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 0.0;
  add_trajectory_metrics(truth, flight.parts, metrics);
  EXPECT_EQ(metrics["accuracy"], 1.0);
  EXPECT_EQ(metrics["mean_entropy_nats"], seen.entropy_nats);
}

TEST(FlightMetrics, HaveQuantilesOfTheTimesOfTheirPlans) {
  NotedFlight flight;
  flight.recorded();
  std::vector<double> time_s;
  for (int i = 0; i < 5; ++i) {
    std::vector<CandidatePlan> plans = flight.parts.propose();
    flight.parts.score(plans);
    flight.parts.choose(plans);
    flight.parts.act(plans.front());
    time_s.push_back(flight.recorded().plan_time_s);
  }
  nlohmann::ordered_json metrics;
  metrics["simulated_time_s"] = 0.0;
  add_trajectory_metrics({{}, {}}, flight.parts, metrics);
  EXPECT_EQ(metrics["replans"], 5);
  EXPECT_EQ(metrics["plan_time_s"]["median"], quantile(time_s, 0.5));
  EXPECT_EQ(metrics["plan_time_s"]["p95"], quantile(time_s, 0.95));
}

/// The row of the record that was told last.
std::string steps_row_of(NotedFlight& flight, const WaypointRecord& record) {
  flight.recorder.waypoint(record, 4);
  return flight.rows.back();
}

TEST(FlightRecords, HaveARowAWaypoint) {
  NotedFlight flight;
  WaypointRecord record;
  record.waypoint = 2;
  record.time_s = 12.3456;
  record.T_world_body = make_pose({1.1, -2.2, 1.8}, 0.3);
  record.planner = "stomp";
  record.plan_time_s = 0.25;
  record.latency_s = 0.5;
  record.missed = true;
  record.cost = 3.25;
  record.planned_clearance_m = 0.4;
  record.target = ViewTarget{.object = 7, .direction = 3};
  record.objects = 5;
  record.known = 2;
  record.observations = 9;
  record.mean_entropy_nats = 0.75;
  record.clearance_m = 0.31;
  record.tracking_error_m = 0.02;
  record.flown_m = 6.5;
  record.collisions = 1;
  EXPECT_EQ(steps_row_of(flight, record),
            "12.346,3,1.1000,-2.2000,1.8000,0.3000,stomp,0.25,0.5,false,true,3.25,0.4000,7,3,5,2,9,"
            "0.75000,0.3100,0.02000,6.5000,1");
  record.late = true;
  record.missed = false;
  record.target.reset();
  EXPECT_EQ(steps_row_of(flight, record),
            "12.346,3,1.1000,-2.2000,1.8000,0.3000,stomp,0.25,0.5,true,false,3.25,0.4000,-1,-1,5,2,"
            "9,0.75000,0.3100,0.02000,6.5000,1");
}

/// Five metres level and one up.
TEST(FlightRecords, HaveARowAPlanThatWasWeighed) {
  NotedFlight flight({}, false);
  CandidatePlan plan;
  plan.planner = "stomp";
  plan.points.resize(4, 3);
  plan.points.col(0) = Eigen::Vector4d(0.0, 0.0, 1.8, 0.1);
  plan.points.col(1) = Eigen::Vector4d(3.0, 4.0, 1.8, 0.2);
  plan.points.col(2) = Eigen::Vector4d(3.0, 4.0, 2.8, 0.5);
  plan.cost = 1.5;
  plan.clearance_m = 0.45;
  CandidatePlan other = flight.aside(1);
  other.clear = false;
  flight.recorder.decision({plan, other}, 1);
  flight.recorder.commit();
  const CsvTable table = read_csv(flight.run.directory() / "candidates.csv");
  using Row = std::vector<std::string>;
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0], (Row{"1", "0", "stomp", "3.0000", "4.0000", "2.8000", "0.5000", "1.5",
                                "6.0000", "0.4500", "1", "0"}));
  EXPECT_EQ(table.rows[1], (Row{"1", "1", "by hand", "-2.3000", "-1.8000", "1.8000", "0.0100",
                                "2.5", "0.0000", "0.7500", "0", "1"}));
}

TEST(FlightRecords, HaveARowALook) {
  NotedFlight flight;
  ObjectObservation observation;
  observation.time_s = 12.3456;
  observation.direction = 3;
  observation.bearing_rad = 0.5;
  observation.distance_m = 1.4;
  observation.elevation_rad = 0.6;
  observation.pixels = 321;
  observation.report.features = {"colour", "sift"};
  observation.report.feature_time_s = 0.125;
  observation.entropy_nats = 0.75;
  observation.estimate = "mug, blue";
  observation.map_probability = 0.9;
  flight.recorder.observation(7, observation, 2, {});
  flight.recorder.commit();
  const CsvTable table = read_csv(flight.run.directory() / "looks.csv");
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"12.346", "2", "7", "3", "0.5000", "1.4000", "0.6000", "321",
                                      "colour sift", "0.125", "0.75000", "mug, blue", "0.90000"}));
}

/// The second pixel is beside the object.
TEST(FlightRecords, ShowALookWithWhatIsBesideTheObjectDarker) {
  NotedFlight flight({}, false);
  ObjectView view;
  view.width_px = 2;
  view.height_px = 1;
  view.rgb = {200, 100, 40, 200, 100, 40};
  view.mask = {1, 0};
  flight.recorder.observation(7, {}, 2, view);
  const cv::Mat shown =
      cv::imread((flight.run.directory() / "views/look_002_object_7.png").string());
  ASSERT_EQ(shown.size(), cv::Size(2, 1));
  EXPECT_EQ(shown.at<cv::Vec3b>(0, 0), cv::Vec3b(40, 100, 200));
  EXPECT_EQ(shown.at<cv::Vec3b>(0, 1), cv::Vec3b(14, 35, 70));
}

TEST(FlightTask, IsAsLongAndAsWideAsItsPath) {
  const ResolvedEpisode episode =
      load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/trajectory.yaml",
                   {"scene=" VANTAGE_SOURCE_DIR "/models/scenes/trajectory_4/scene.xml"});
  const auto& task = std::get<TrajectoryFlight>(episode.task);
  const std::vector<FlightWaypoint> path = read_flight_path(episode.setup.scene);
  const TaskExtent extent = task.extent(episode.setup);
  EXPECT_EQ(extent.key, "waypoints");
  EXPECT_EQ(extent.count, path.size());
  const WindowContent window = task.window(episode.setup);
  EXPECT_EQ(window.scans, path.size());
  EXPECT_TRUE(window.follows_height);
  Eigen::Array2d least = path[0].p_world_m.head<2>().array();
  Eigen::Array2d most = least;
  for (const FlightWaypoint& waypoint : path) {
    least = least.min(waypoint.p_world_m.head<2>().array());
    most = most.max(waypoint.p_world_m.head<2>().array());
  }
  EXPECT_NEAR((window.overview_m.min() - least.matrix()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((window.overview_m.max() - most.matrix()).norm(), 0.0, 1e-12);
  const FlightMap map(flight_region(path), task.map);
  ASSERT_TRUE(window.map);
  EXPECT_EQ(window.map->size(), map.grid().size());
  EXPECT_EQ(window.map->min_corner_m, map.grid().frame.min_corner_m);
  EXPECT_EQ(TrajectoryFlight::report().view_heading, "The flight");
}

TEST(FlightRecords, ShowHowFarTheFlightHasCome) {
  if (!support::has_terminals()) GTEST_SKIP() << "no /dev/pts here";
  NotedFlight flight;
  WaypointRecord record;
  record.waypoint = 2;
  record.time_s = 12.3456;
  record.objects = 5;
  record.known = 4;
  record.observations = 9;
  const std::string shown = support::shown_progress([&] { flight.recorder.waypoint(record, 10); });
  EXPECT_NE(shown.find(" 30 % waypoint 3 of 10: 5 objects found, 4 known, 9 observations, 12.3 s "
                       "simulated"),
            std::string::npos)
      << shown;
}

}  // namespace
}  // namespace vantage
