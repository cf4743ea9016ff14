// The lines on how flights have ended, and what studies read of their metrics.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include "vantage/tasks/object_flight/object_flight_metrics.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> scalar(const Measures& measures, const Json& metrics, std::string_view name) {
  const auto named = [&](const ScalarMeasure& measure) { return measure.name.name == name; };
  const auto found = std::ranges::find_if(measures.scalars, named);
  if (found == measures.scalars.end()) throw std::out_of_range(std::string(name));
  return found->of({metrics, 8});
}

TEST(Measures, OfEveryTaskHaveNamesOfTheirOwnAndHeadlinesAmongThem) {
  for_each_task([](const auto& task) {
    const Measures measures = task.measures();
    std::set<std::string_view> names;
    for (const ScalarMeasure& measure : measures.scalars) {
      EXPECT_TRUE(names.insert(measure.name.name).second) << measure.name.name;
    }
    EXPECT_FALSE(measures.headlines.empty()) << task.name;
    for (const std::string_view name : measures.headlines) {
      EXPECT_TRUE(names.contains(name)) << task.name << " " << name;
    }
  });
}

Json flown_along_a_path() {
  Json metrics = {{"method", "stomp"},
                  {"status", "completed"},
                  {"flight_time_s", 61.24},
                  {"simulated_time_s", 62.5},
                  {"accuracy", 0.625},
                  {"observations_total", 9},
                  {"mean_entropy_observed_nats", 0.4567},
                  {"objects_unseen", 1},
                  {"mean_entropy_nats", 0.75},
                  {"objects_found", 5},
                  {"false_objects", 4},
                  {"minimum_clearance_m", 0.352},
                  {"path_length_m", 23.456},
                  {"collisions", 3},
                  {"energy_j", 1234.5},
                  {"late_plans", 6},
                  {"missed_deadlines", 7},
                  {"real_time_factor", 3.21}};
  metrics["tracking_error_m"] = {{"mean", 0.03}, {"max", 0.09}};
  metrics["plan_time_s"] = {{"median", 0.05}, {"p95", 0.08}};
  metrics["objects"] = Json::array();
  for (const bool correct : {true, false, true}) {
    Json object;
    object["correct"] = correct;
    metrics["objects"].push_back(object);
  }
  return metrics;
}

TEST(FlightAlongAPath, SaysHowItHasEnded) {
  Json metrics = flown_along_a_path();
  EXPECT_EQ(TrajectoryFlight::outcome(metrics),
            "stomp: completed after 61.2 s, recognised 2 of 3 objects in 9 observations\n"
            "mean entropy 0.457 nats of the objects observed, 1 unseen, clearance 0.35 m, "
            "path 23.46 m, 3 collisions, 3.2 x real time\n");
  metrics["mean_entropy_observed_nats"] = nullptr;
  EXPECT_THAT(TrajectoryFlight::outcome(metrics), testing::HasSubstr("mean entropy - nats"));
}

TEST(FlightAlongAPath, IsMeasured) {
  const Measures measures = TrajectoryFlight::measures();
  Json metrics = flown_along_a_path();
  const auto value = [&](std::string_view name) { return scalar(measures, metrics, name); };
  EXPECT_EQ(value("path_length_m"), 23.456);
  EXPECT_EQ(value("collisions"), 3.0);
  EXPECT_EQ(value("simulated_time_s"), 62.5);
  EXPECT_EQ(value("accuracy"), 0.625);
  EXPECT_EQ(value("observations"), 9.0);
  EXPECT_EQ(value("mean_entropy_observed_nats"), 0.4567);
  EXPECT_EQ(value("objects_unseen"), 1.0);
  EXPECT_EQ(value("mean_entropy_nats"), 0.75);
  EXPECT_EQ(value("objects_found"), 5.0);
  EXPECT_EQ(value("false_objects"), 4.0);
  EXPECT_EQ(value("flight_time_s"), 61.24);
  EXPECT_EQ(value("minimum_clearance_m"), 0.352);
  EXPECT_EQ(value("collided"), 1.0) << "however often";
  EXPECT_EQ(value("tracking_error_m"), 0.03);
  EXPECT_EQ(value("replan_time_s"), 0.05);
  EXPECT_EQ(value("replan_time_p95_s"), 0.08);
  EXPECT_EQ(value("late_plans"), 6.0);
  EXPECT_EQ(value("missed_deadlines"), 7.0);
  EXPECT_EQ(value("energy_j"), 1234.5);
  metrics["collisions"] = 0;
  EXPECT_EQ(value("collided"), 0.0);
  std::set<std::string_view> of_wall_time;
  for (const ScalarMeasure& measure : measures.scalars) {
    if (measure.name.wall) of_wall_time.insert(measure.name.name);
  }
  EXPECT_THAT(of_wall_time,
              testing::UnorderedElementsAre("replan_time_s", "replan_time_p95_s", "late_plans"));
}

TEST(FlightAlongAPath, SaysWhatItIs) {
  const WindowContent window = TrajectoryFlight::window();
  EXPECT_EQ(window.gain_unit, "nats");
  EXPECT_TRUE(window.follows_height);
  EXPECT_EQ(window.step_word, "waypoint");
  EXPECT_EQ(TrajectoryFlight::report().step_word, "waypoint");
  EXPECT_TRUE(TrajectoryFlight::report().scene);
  EXPECT_FALSE(TrajectoryFlight::report().map);
}

Json view_of(double position_error_m, double angle_error_rad, double entropy_bits) {
  return {{"position_error_m", position_error_m},
          {"angle_error_rad", angle_error_rad},
          {"entropy_bits", entropy_bits}};
}

Json flown_round_an_object() {
  Json metrics = {
      {"method", "mutual_information"}, {"status", "completed"},   {"correct", true},
      {"entropy_bits", 1.234},          {"map_probability", 0.75}, {"bin_error", 2},
      {"path_length_m", 4.567},         {"collisions", 1},         {"simulated_time_s", 31.5},
      {"real_time_factor", 12.34}};
  metrics["observations"] =
      std::vector<Json>{view_of(0.02, 0.1, 3.5), view_of(0.05, 0.15, 2.5), view_of(0.08, 0.5, 1.5)};
  return metrics;
}

TEST(Recognition, SaysHowItHasEnded) {
  Json metrics = flown_round_an_object();
  metrics["targets"] = Json::array();
  EXPECT_EQ(RecognitionTask::outcome(metrics),
            "mutual_information: completed after 3 views\n"
            "entropy 1.23 bit, path 4.57 m, 1 collisions, 12.3 x real time\n");
  metrics["targets"] =
      std::vector<Json>{{{"estimate", "mug_1"}, {"correct", true}, {"truth", "mug_1"}},
                        {{"estimate", nullptr}, {"correct", false}, {"truth", "bowl_2"}}};
  EXPECT_THAT(RecognitionTask::outcome(metrics),
              testing::HasSubstr("after 3 views, recognised mug_1, which is right (mug_1), "
                                 "recognised nothing yet, which is wrong (bowl_2)\n"));
}

TEST(Recognition, IsMeasured) {
  const Measures measures = RecognitionTask::measures();
  Json metrics = flown_round_an_object();
  metrics["category_correct"] = false;
  const auto value = [&](std::string_view name) { return scalar(measures, metrics, name); };
  EXPECT_EQ(value("correct"), 1.0);
  EXPECT_EQ(value("category_correct"), 0.0);
  EXPECT_FALSE(value("targets_correct")) << "of a former run";
  metrics["targets_correct"] = 0.25;
  EXPECT_EQ(value("targets_correct"), 0.25);
  EXPECT_EQ(value("views"), 3.0);
  EXPECT_EQ(value("entropy_bits"), 1.234);
  EXPECT_EQ(value("map_probability"), 0.75);
  EXPECT_EQ(value("bin_error"), 2.0);
  EXPECT_DOUBLE_EQ(*value("view_position_error_m"), 0.05);
  EXPECT_DOUBLE_EQ(*value("view_angle_error_rad"), 0.25);
  EXPECT_EQ(value("hidden_views"), 0.0);
  EXPECT_FALSE(value("seen_share")) << "of a former run";
  const std::vector<std::string> reasons{"hidden", "", "hidden too"};
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    metrics["observations"][i]["not_segmented"] = reasons[i];
    metrics["observations"][i]["seen_share"] = 0.25 * static_cast<double>(i);
  }
  EXPECT_EQ(value("hidden_views"), 2.0);
  EXPECT_DOUBLE_EQ(*value("seen_share"), 0.25);
  ASSERT_EQ(measures.curves.size(), 1U);
  EXPECT_EQ(measures.curves[0].of({metrics, 8}), (Curve{3.5, 2.5, 1.5}));
  metrics["observations"] = Json::array();
  EXPECT_EQ(value("views"), 0.0);
  EXPECT_FALSE(value("seen_share"));
  EXPECT_FALSE(value("view_angle_error_rad"));
}

TEST(ChangeDetection, SaysHowItHasEnded) {
  Json metrics = flown_round_an_object();
  metrics["decision"] = "object";
  metrics["scenario"] = "pose";
  metrics["correct"] = false;
  metrics["change_probability"] = 0.9876;
  EXPECT_EQ(ChangeDetectionTask::outcome(metrics),
            "mutual_information: completed after 3 views, changed: object, which is wrong (pose)\n"
            "probability of a change 0.988, path 4.57 m, 1 collisions, 12.3 x real time\n");
  metrics["decision"] = nullptr;
  metrics["correct"] = true;
  metrics["change_probability"] = nullptr;
  EXPECT_THAT(ChangeDetectionTask::outcome(metrics),
              testing::AllOf(testing::HasSubstr("changed: nothing yet, which is right"),
                             testing::HasSubstr("probability of a change unknown,")));
}

TEST(ChangeDetection, IsMeasured) {
  const Measures measures = ChangeDetectionTask::measures();
  Json metrics = flown_round_an_object();
  metrics["changed_correct"] = true;
  metrics["detectable"] = true;
  metrics["detectable_correct"] = false;
  metrics["change_probability"] = nullptr;
  const auto value = [&](std::string_view name) { return scalar(measures, metrics, name); };
  EXPECT_EQ(value("changed_correct"), 1.0);
  EXPECT_EQ(value("detectable"), 1.0);
  EXPECT_EQ(value("detectable_correct"), 0.0);
  EXPECT_FALSE(value("change_probability"));
  EXPECT_EQ(value("path_length_m"), 4.567);
}

TEST(FlightsRoundAnObject, SayWhatTheyAre) {
  for (const ReportSections& report : {RecognitionTask::report(), ChangeDetectionTask::report()}) {
    EXPECT_EQ(report.steps, "observations");
    EXPECT_TRUE(report.scene);
    EXPECT_FALSE(report.map);
  }
  EXPECT_EQ(RecognitionTask::window().gain_unit, "bits");
  EXPECT_TRUE(RecognitionTask::window().follows_height);
  RecognitionTask task;
  task.decision.max_views = 5;
  EXPECT_EQ(task.extent({}).count, 5U);
  EXPECT_FALSE(task.window({}).map);
  task.targets = 3;
  EXPECT_EQ(task.extent({}).count, 15U) << "of each";
  EXPECT_EQ(task.extent({}).key, "max_views");
  ASSERT_TRUE(task.window({}).map);
  EXPECT_EQ(text_or_nothing({{"a", "b"}, {"c", 1}}, "a"), "b");
  EXPECT_EQ(text_or_nothing({{"a", "b"}, {"c", 1}}, "c"), "nothing yet");
}

TEST(Recognition, SaysWhichWayItsMeasuresAreBetter) {
  const Measures measures = RecognitionTask::measures();
  std::vector<std::string_view> higher;
  std::vector<std::string_view> lower;
  for (const ScalarMeasure& measure : measures.scalars) {
    EXPECT_FALSE(measure.name.wall) << measure.name.name;
    if (measure.name.better == Better::higher) higher.push_back(measure.name.name);
    if (measure.name.better == Better::lower) lower.push_back(measure.name.name);
  }
  EXPECT_THAT(higher, testing::ElementsAre("correct", "category_correct", "targets_correct",
                                           "seen_share", "map_probability"));
  EXPECT_THAT(lower, testing::ElementsAre("hidden_views", "views", "entropy_bits", "bin_error",
                                          "view_position_error_m", "view_angle_error_rad",
                                          "path_length_m", "collisions", "simulated_time_s"));
  EXPECT_THAT(std::vector(measures.headlines.begin(), measures.headlines.end()),
              testing::ElementsAre("correct", "map_probability", "entropy_bits", "views",
                                   "path_length_m", "simulated_time_s"));
  EXPECT_EQ(RecognitionTask::report().figures, "recognition");
  EXPECT_EQ(RecognitionTask::report().step_word, "view");
}

TEST(Recognition, ItsWindowHasTheMapOverItsTable) {
  RecognitionTask task;
  task.table_m = {1.0, -2.0, 0.5};
  task.map.size_m = {0.8, 0.6};
  EXPECT_FALSE(task.window({}).map) << "an object alone is not mapped";
  task.clutter.objects = 1;
  const std::optional<GridFrame> map = task.window({}).map;
  ASSERT_TRUE(map);
  EXPECT_NEAR((map->min_corner_m - Eigen::Vector3d(0.6, -2.3, 0.53)).norm(), 0.0, 1e-12);
  const GridFrame expected = TableMap::frame_of({1.0, -2.0, 0.5}, task.map);
  EXPECT_TRUE((map->cells == expected.cells).all());
}

}  // namespace
}  // namespace vantage
