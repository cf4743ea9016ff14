// What is read off an episode's metrics.
#include "vantage/study/measures.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

#include "vantage/study/study_records.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

Json scan(double left, double actual, double simple, double adaptive, double leg_m, double path_m) {
  return {{"unobserved_cells", left + 10.0},
          {"observable_unobserved_cells", left},
          {"predicted", {{"simple", simple}, {"adaptive", adaptive}}},
          {"actual_new_cells", actual},
          {"path_length_m", path_m},
          {"leg_length_m", leg_m},
          {"pose_error_m", 0.002},
          {"pose_error_before_registration_m", 0.02},
          {"fallback", leg_m > 2.0},
          {"precision", 1.0},
          {"recall", 0.5}};
}

Json metrics(const std::string& method) {
  return {{"method", method},
          {"observable_cells", 100.0},
          {"path_length_m", 4.5},
          {"collisions", 0},
          {"simulated_time_s", 60.0},
          {"map", {{"precision", 0.9}, {"recall", 0.8}}},
          {"scans",
           {scan(60.0, 50.0, 0.0, 0.0, 0.0, 0.0), scan(30.0, 30.0, 40.0, 33.0, 1.5, 1.5),
            scan(20.0, 10.0, 15.0, 9.0, 3.0, 4.5)}}};
}

ResolvedEpisode planned_scans(int scans) {
  Tabletop task;
  task.scans = scans;
  return {.setup = {}, .task = task};
}

std::optional<double> scalar(const EpisodeMeasures& measures, const char* name) {
  return measures.scalars[*find_scalar(name)];
}

TEST(Measures, AreaSumsTheShareLeft) {
  const auto full = measure(metrics("adaptive"), planned_scans(3));
  EXPECT_DOUBLE_EQ(*scalar(full, "area"), 0.6 + 0.3 + 0.2);
  EXPECT_DOUBLE_EQ(*scalar(full, "observed_share"), 0.8);
}

/// The first scan is taken before any choice.
TEST(Measures, AreaFromScanTwoLeavesTheFirstScanOut) {
  EXPECT_DOUBLE_EQ(*scalar(measure(metrics("adaptive"), planned_scans(3)), "area_from_scan_2"),
                   0.3 + 0.2);
  EXPECT_DOUBLE_EQ(*scalar(measure(metrics("adaptive"), planned_scans(5)), "area_from_scan_2"),
                   0.3 + 3 * 0.2);
  EXPECT_DOUBLE_EQ(*scalar(measure(metrics("adaptive"), planned_scans(1)), "area_from_scan_2"),
                   0.0);
}

TEST(Measures, AnEpisodeThatEndsEarlyKeepsItsLastShare) {
  const auto early = measure(metrics("adaptive"), planned_scans(5));
  EXPECT_DOUBLE_EQ(*scalar(early, "area"), 0.6 + 0.3 + 3 * 0.2);
  EXPECT_DOUBLE_EQ(*scalar(early, "scans"), 3.0);
}

/// Of three scans the first is left out; 5 of the 60 cells are beyond the range.
TEST(Measures, ForecastsAreHeldAgainstWhatWasSeen) {
  Json known = metrics("adaptive");
  const auto band = [](double from_m, const Json& to_m, double predicted, int actual, int outside) {
    return Json{{"from_m", from_m},
                {"to_m", to_m},
                {"predicted_cells", predicted},
                {"actual_cells", actual},
                {"outside_cells", outside}};
  };
  known["scans"][0]["by_distance"] = {band(0.0, 1.0, 1000.0, 1, 0)};
  known["scans"][1]["by_distance"] = {band(0.0, 1.0, 10.0, 10, 0), band(1.0, 2.0, 9.0, 18, 1)};
  known["scans"][2]["by_distance"] = {band(0.0, 1.0, 15.0, 10, 0), band(1.0, 2.0, 9.0, 18, 0),
                                      band(2.0, nullptr, 0.0, 4, 4)};
  const auto measured = measure(known, planned_scans(3));
  EXPECT_DOUBLE_EQ(*scalar(measured, "forecast_ratio"), 43.0 / 60.0);
  EXPECT_DOUBLE_EQ(*scalar(measured, "forecast_ratio_to_1_m"), 1.25);
  EXPECT_DOUBLE_EQ(*scalar(measured, "forecast_ratio_to_2_m"), 0.5);
  EXPECT_FALSE(scalar(measured, "forecast_ratio_to_3_m"));
  EXPECT_DOUBLE_EQ(*scalar(measured, "forecast_ratio_beyond_3_m"), 0.0);
  EXPECT_DOUBLE_EQ(*scalar(measured, "outside_share"), 5.0 / 61.0);
  const Curve& ratios = measured.curves[*find_curve("forecast_ratio")];
  EXPECT_EQ(ratios, (Curve{1001.0 / 2.0, 20.0 / 29.0, 25.0 / 33.0}));
  EXPECT_FALSE(scalar(measure(metrics("adaptive"), planned_scans(3)), "forecast_ratio"))
      << "of a former run";
}

TEST(Measures, ScansToNinetyFivePercent) {
  Json json = metrics("adaptive");
  EXPECT_DOUBLE_EQ(*scalar(measure(json, planned_scans(7)), "scans_to_95"), 7.0) << "never there";
  json["scans"][1]["observable_unobserved_cells"] = 5.0;
  EXPECT_DOUBLE_EQ(*scalar(measure(json, planned_scans(7)), "scans_to_95"), 2.0);
  json["scans"][1]["observable_unobserved_cells"] = 15.0;
  json["scans"][2]["observable_unobserved_cells"] = 15.0;
  EXPECT_DOUBLE_EQ(*scalar(measure(json, planned_scans(7)), "scans_to_80"), 2.0);
  EXPECT_DOUBLE_EQ(*scalar(measure(json, planned_scans(7)), "scans_to_90"), 7.0);
}

TEST(Measures, PredictionErrorsBeginWithTheFirstChoice) {
  const auto measures = measure(metrics("adaptive"), planned_scans(3));
  EXPECT_DOUBLE_EQ(*scalar(measures, "prediction_error_cells"), 2.0);
  ASSERT_EQ(measures.prediction_errors.size(), 2U);
  EXPECT_EQ(measures.prediction_errors[0].first, "simple");
  EXPECT_EQ(measures.prediction_errors[0].second, (Curve{10.0, 5.0}));
}

TEST(Measures, AMethodWithoutGainPredictsNothing) {
  EXPECT_FALSE(scalar(measure(metrics("random"), planned_scans(3)), "prediction_error_cells"));
}

TEST(Measures, Curves) {
  const auto measures = measure(metrics("simple"), planned_scans(3));
  EXPECT_EQ(measures.curves[*find_curve("unobserved_cells")], (Curve{70.0, 40.0, 30.0}));
  EXPECT_EQ(measures.curves[*find_curve("distance_m")], (Curve{0.0, 1.5, 4.5}));
  EXPECT_DOUBLE_EQ(*scalar(measures, "fallbacks"), 1.0);
}

/// 0, 20, 40 s: the share left after the scans of 10 s and of 39 s, the last one too.
TEST(Measures, CurvesOverTimeEndAfterTheLastScan) {
  Json timed = metrics("adaptive");
  timed["scans"].erase(2);
  timed["scans"][0]["time_s"] = 10.0;
  timed["scans"][1]["time_s"] = 39.0;
  const auto curve = *find_curve("share_left_over_time");
  EXPECT_EQ(measure(timed, planned_scans(3)).curves[curve], (Curve{1.0, 0.6, 0.3}));
  EXPECT_EQ(curve_axis(curve).first, 0.0);
  EXPECT_EQ(curve_axis(curve).step, 20.0);
  const auto path = *find_curve("share_left_over_path");
  EXPECT_EQ(measure(timed, planned_scans(3)).curves[path], (Curve{0.6, 0.6, 0.3}));
  EXPECT_TRUE(curve_axis(*find_curve("share_left")).label.empty());
}

TEST(Measures, NothingToObserveIsNoDivisionByZero) {
  Json json = metrics("simple");
  json["observable_cells"] = 0;
  EXPECT_DOUBLE_EQ(*scalar(measure(json, planned_scans(3)), "area"), 0.0);
}

TEST(Measures, MissingKeysAreErrors) {
  Json json = metrics("simple");
  json.erase("map");
  EXPECT_THROW(measure(json, planned_scans(3)), nlohmann::json::exception);
}

Json recognition_metrics() {
  const auto view = [](double entropy_bits, double error_m) -> Json {
    return {
        {"entropy_bits", entropy_bits}, {"position_error_m", error_m}, {"angle_error_rad", 0.01}};
  };
  return {{"method", "mutual_information"}, {"correct", true},
          {"category_correct", true},       {"entropy_bits", 0.5},
          {"map_probability", 0.9},         {"bin_error", 1},
          {"path_length_m", 2.5},           {"collisions", 0},
          {"simulated_time_s", 8.0},        {"observations", {view(3.0, 0.01), view(0.5, 0.03)}}};
}

TEST(Measures, RecognitionHasMeasuresOfItsOwnAndNoneOfMapping) {
  const auto measures = measure(recognition_metrics(), {.setup = {}, .task = RecognitionTask{}});
  EXPECT_DOUBLE_EQ(*scalar(measures, "correct"), 1.0);
  EXPECT_DOUBLE_EQ(*scalar(measures, "bin_error"), 1.0);
  EXPECT_DOUBLE_EQ(*scalar(measures, "views"), 2.0);
  EXPECT_DOUBLE_EQ(*scalar(measures, "view_position_error_m"), 0.02);
  EXPECT_DOUBLE_EQ(*scalar(measures, "path_length_m"), 2.5);
  for (const char* name : {"area", "observed_share", "scans", "precision", "pose_error_m"}) {
    EXPECT_FALSE(scalar(measures, name)) << name;
  }
  EXPECT_EQ(measures.curves[*find_curve("view_entropy_bits")], (Curve{3.0, 0.5}));
  EXPECT_TRUE(measures.curves[*find_curve("share_left")].empty());
  EXPECT_FALSE(scalar(measure(metrics("adaptive"), planned_scans(3)), "correct"));
}

TEST(Measures, AnEpisodeInterruptedBeforeItsFirstViewHasNoEstimate) {
  Json metrics = recognition_metrics();
  metrics["observations"] = Json::array();
  metrics["bin_error"] = nullptr;
  const auto measures = measure(metrics, {.setup = {}, .task = RecognitionTask{}});
  EXPECT_FALSE(scalar(measures, "bin_error"));
  EXPECT_FALSE(scalar(measures, "view_position_error_m"));
}

TEST(Measures, OfAFlightPastObjects) {
  const Json flight = {{"method", "stomp"},
                       {"status", "failed"},
                       {"objects", {{{"correct", true}}, {{"correct", false}}}},
                       {"accuracy", 0.5},
                       {"mean_entropy_observed_nats", nullptr},
                       {"objects_unseen", 2},
                       {"mean_entropy_nats", 1.25},
                       {"observations_total", 9},
                       {"objects_found", 2},
                       {"false_objects", 0},
                       {"flight_time_s", 70.0},
                       {"simulated_time_s", 70.0},
                       {"path_length_m", 31.0},
                       {"collisions", 1},
                       {"minimum_clearance_m", 0.0},
                       {"tracking_error_m", {{"mean", 0.02}, {"max", 0.09}}},
                       {"plan_time_s", {{"median", 0.004}, {"p95", 0.006}}},
                       {"late_plans", 0},
                       {"missed_deadlines", 0},
                       {"energy_j", 5000.0}};
  const auto episode = load_episode(
      std::filesystem::path(VANTAGE_SOURCE_DIR) / "assets/episodes/trajectory.yaml", {});
  const auto measures = measure(flight, episode);
  EXPECT_DOUBLE_EQ(*scalar(measures, "accuracy"), 0.5);
  EXPECT_DOUBLE_EQ(*scalar(measures, "observations"), 9.0);
  EXPECT_DOUBLE_EQ(*scalar(measures, "mean_entropy_nats"), 1.25);
  EXPECT_FALSE(scalar(measures, "mean_entropy_observed_nats")) << "none was observed";
  EXPECT_DOUBLE_EQ(*scalar(measures, "objects_unseen"), 2.0);
  EXPECT_DOUBLE_EQ(*scalar(measures, "collided"), 1.0);
  EXPECT_DOUBLE_EQ(*scalar(measures, "tracking_error_m"), 0.02);
  EXPECT_DOUBLE_EQ(*scalar(measures, "replan_time_p95_s"), 0.006);
  EXPECT_FALSE(scalar(measures, "area")) << "nothing is mapped";
  EXPECT_FALSE(scalar(measures, "correct")) << "not one object but several";
}

TEST(Measures, OfATaskAreAllColumns) {
  for_each_task([](const auto& task) {
    const Measures measures = task.measures();
    ASSERT_FALSE(measures.scalars.empty()) << task.name;
    std::set<std::string_view> seen;
    for (const ScalarMeasure& measure : measures.scalars) {
      EXPECT_NE(measure.of, nullptr) << task.name << " " << measure.name.name;
      EXPECT_TRUE(seen.insert(measure.name.name).second) << task.name << " " << measure.name.name;
      const auto column = find_scalar(measure.name.name);
      ASSERT_TRUE(column) << task.name << " " << measure.name.name;
      EXPECT_FALSE(scalar_measures()[*column].title.empty());
      EXPECT_EQ(scalar_measures()[*column].title, measure.name.title) << "one title a column";
      EXPECT_EQ(scalar_measures()[*column].wall, measure.name.wall) << measure.name.name;
      EXPECT_EQ(scalar_measures()[*column].better, measure.name.better) << measure.name.name;
    }
    seen.clear();  // scalars and curves are columns of different files
    for (const CurveMeasure& measure : measures.curves) {
      EXPECT_NE(measure.of, nullptr) << task.name << " " << measure.name.name;
      EXPECT_TRUE(seen.insert(measure.name.name).second) << task.name << " " << measure.name.name;
      const auto column = find_curve(measure.name.name);
      ASSERT_TRUE(column) << task.name << " " << measure.name.name;
      EXPECT_EQ(curve_measures()[*column].title, measure.name.title) << "one title a column";
    }
  });
}

TEST(Measures, SayWhichDirectionIsBetter) {
  EXPECT_EQ(measure_text(curve_measures()[*find_curve("share_left")]),
            "share of the observable cells left, lower is better");
  EXPECT_EQ(measure_text(scalar_measures()[*find_scalar("recall")]),
            "recall of occupied cells, higher is better");
  EXPECT_EQ(measure_text(scalar_measures()[*find_scalar("scans")]), "scans taken");
}

TEST(Measures, AMapOfNothingHasNoPrecision) {
  Json none = metrics("adaptive");
  none["map"] = {{"precision", nullptr}, {"recall", nullptr}};
  EXPECT_FALSE(scalar(measure(none, planned_scans(3)), "precision"));
}

TEST(Measures, EveryTaskSaysWhatToLookAtFirst) {
  for_each_task([](const auto& task) {
    const Measures measures = task.measures();
    EXPECT_GE(measures.headlines.size(), 5U) << task.name;
    EXPECT_LE(measures.headlines.size(), 7U) << task.name;
    for (const std::string_view name : measures.headlines) {
      EXPECT_TRUE(std::ranges::any_of(
          measures.scalars,
          [&](const ScalarMeasure& measure) { return measure.name.name == name; }))
          << task.name << " " << name;
    }
  });
}

TEST(Measures, EveryColumnIsOneOfATask) {
  std::set<std::string_view> of_tasks;
  for_each_task([&](const auto& task) {
    for (const ScalarMeasure& measure : task.measures().scalars) of_tasks.insert(measure.name.name);
    for (const CurveMeasure& measure : task.measures().curves) of_tasks.insert(measure.name.name);
  });
  std::set<std::string> columns;
  for (const auto& names : {scalar_names(), curve_names()}) {
    const std::set<std::string> unique(names.begin(), names.end());
    EXPECT_EQ(unique.size(), names.size());
    columns.insert(unique.begin(), unique.end());
  }
  EXPECT_EQ(columns, std::set<std::string>(of_tasks.begin(), of_tasks.end()));
}

TEST(Measures, EveryTaskHasThoseOfAllEpisodes) {
  for_each_task([](const auto& task) {
    for (const char* name : {"path_length_m", "collisions", "simulated_time_s"}) {
      EXPECT_TRUE(std::ranges::any_of(
          task.measures().scalars,
          [&](const ScalarMeasure& measure) { return measure.name.name == name; }))
          << task.name << " " << name;
    }
  });
}

/// The task decides which measures are taken, whatever keys the metrics have.
TEST(Measures, AreThoseOfTheTaskAndNotOfTheKeys) {
  Json all = metrics("adaptive");
  const Json others = recognition_metrics();
  for (const auto& [key, value] : others.items()) {
    if (!all.contains(key)) all[key] = value;
  }
  const auto mapped = measure(all, planned_scans(3));
  EXPECT_TRUE(scalar(mapped, "area"));
  EXPECT_FALSE(scalar(mapped, "correct"));
  const auto recognised = measure(all, {.setup = {}, .task = RecognitionTask{}});
  EXPECT_FALSE(scalar(recognised, "area"));
  EXPECT_TRUE(scalar(recognised, "correct"));
  EXPECT_TRUE(recognised.prediction_errors.empty());
}

TEST(StudyRecords, TellEveryMeasureWhereItStands) {
  const RecordTexts records = study_records();
  const auto expect_told = [&](std::string_view file, const MeasureName& measure) {
    const auto is = [&](const RecordText& record) {
      return record.file == file && record.name == measure.name &&
             record.text == measure_text(measure);
    };
    EXPECT_EQ(std::ranges::count_if(records, is), 1) << file << " " << measure.name;
  };
  for (const MeasureName& measure : scalar_measures()) {
    expect_told(measure.wall ? "timings.csv" : "results.csv", measure);
  }
  for (const MeasureName& measure : curve_measures()) expect_told("curves", measure);
}

}  // namespace
}  // namespace vantage
