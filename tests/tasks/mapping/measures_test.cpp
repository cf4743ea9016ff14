// What studies read of the metrics of a mapping task, and the lines on how it has ended.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "vantage/tasks/mapping/mapping_metrics.hpp"
#include "vantage/tasks/mapping/measures/forecast_measures.hpp"
#include "vantage/tasks/mapping/measures/mapping_measures.hpp"
#include "vantage/tasks/mapping/measures/progress_measures.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Of 1000 observable cells.
Json metrics_with(const std::vector<int>& cells_left) {
  Json metrics = {{"method", "adaptive"}, {"observable_cells", 1000}, {"scans", Json::array()}};
  for (const int left : cells_left) {
    metrics["scans"].push_back({{"observable_unobserved_cells", left}});
  }
  return metrics;
}

std::optional<double> scalar(const Json& metrics, std::string_view name,
                             std::size_t planned_scans = 12) {
  const Measures measures = mapping_measures();
  const auto named = [&](const ScalarMeasure& measure) { return measure.name.name == name; };
  const auto found = std::ranges::find_if(measures.scalars, named);
  if (found == measures.scalars.end()) throw std::out_of_range(std::string(name));
  return found->of({metrics, planned_scans});
}

Curve curve(const Json& metrics, std::string_view name) {
  const Measures measures = mapping_measures();
  const auto named = [&](const CurveMeasure& measure) { return measure.name.name == name; };
  const auto found = std::ranges::find_if(measures.curves, named);
  if (found == measures.curves.end()) throw std::out_of_range(std::string(name));
  return found->of({metrics, 12});
}

TEST(MappingMeasures, HaveNamesOfTheirOwnAndHeadlinesAmongThem) {
  const Measures measures = mapping_measures();
  std::set<std::string_view> names;
  for (const ScalarMeasure& measure : measures.scalars) {
    EXPECT_TRUE(names.insert(measure.name.name).second) << measure.name.name;
  }
  for (const std::string_view name : measures.headlines) EXPECT_TRUE(names.contains(name)) << name;
}

const std::vector<int> kSteps{600, 205, 195, 105, 95, 55, 45, 35, 25, 15};

TEST(MappingMeasures, CountTheScansToAShare) {
  const Json metrics = metrics_with(kSteps);
  EXPECT_EQ(scalar(metrics, "scans_to_80"), 3.0);
  EXPECT_EQ(scalar(metrics, "scans_to_90"), 5.0);
  EXPECT_EQ(scalar(metrics, "scans_to_95"), 7.0);
  EXPECT_EQ(scalar(metrics, "scans_to_97"), 9.0);
  EXPECT_EQ(scalar(metrics, "scans_to_98"), 10.0);
  EXPECT_EQ(scalar(metrics_with({600, 200, 0}), "scans_to_80"), 2.0) << "just that share";
  EXPECT_EQ(scalar(metrics_with({600, 201}), "scans_to_80"), 12.0) << "never: all that are planned";
  EXPECT_FALSE(scalar(metrics_with({}), "scans_to_80"));
}

TEST(MappingMeasures, SumTheShareLeft) {
  const Json metrics = metrics_with({600, 300, 125});
  EXPECT_DOUBLE_EQ(*scalar(metrics, "area", 3), 1.025);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "area", 5), 1.275) << "it has learnt all it could";
  EXPECT_DOUBLE_EQ(*scalar(metrics, "area", 2), 0.9);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "area_from_scan_2", 3), 0.425);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "area_from_scan_2", 4), 0.55);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "observed_share"), 0.875);
  EXPECT_EQ(scalar(metrics, "scans"), 3.0);
  EXPECT_FALSE(scalar(metrics_with({}), "area"));
  EXPECT_FALSE(scalar(metrics_with({}), "observed_share"));
  Json nothing_to_see = metrics_with({0, 0});
  nothing_to_see["observable_cells"] = 0;
  EXPECT_EQ(curve(nothing_to_see, "share_left"), (Curve{0.0, 0.0}));
}

Json scan_of(double actual, double simple, double adaptive, bool fallback) {
  return {{"actual_new_cells", actual},
          {"predicted", {{"simple", simple}, {"adaptive", adaptive}}},
          {"fallback", fallback}};
}

TEST(MappingMeasures, HoldPredictionsAgainstTheScansAfterTheFirst) {
  Json metrics = metrics_with({});
  metrics["scans"] =
      std::vector<Json>{scan_of(500.0, 1.0, 2.0, true), scan_of(30.0, 42.0, 33.0, false),
                        scan_of(10.0, 15.0, 5.5, true)};
  const PredictionErrors errors = mapping_measures().prediction_errors({metrics, 3});
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0].first, "simple");
  EXPECT_EQ(errors[0].second, (Curve{12.0, 5.0}));
  EXPECT_EQ(errors[1].second, (Curve{3.0, 4.5}));
  EXPECT_DOUBLE_EQ(*scalar(metrics, "prediction_error_cells"), 3.75);
  EXPECT_EQ(scalar(metrics, "fallbacks"), 2.0);
  metrics["method"] = "random";
  EXPECT_FALSE(scalar(metrics, "prediction_error_cells"));
}

Json band(double from_m, const Json& to_m, double predicted, int actual, int outside) {
  return {{"from_m", from_m},
          {"to_m", to_m},
          {"predicted_cells", predicted},
          {"actual_cells", actual},
          {"outside_cells", outside}};
}

Json scan_with(const std::vector<Json>& bands) {
  Json scan;
  scan["by_distance"] = bands;
  return scan;
}

Json at(double time_s, double path_m, int left) {
  return {{"time_s", time_s}, {"path_length_m", path_m}, {"observable_unobserved_cells", left}};
}

/// A band is where its middle is; one whose middle is at the limit is beyond it.
TEST(MappingMeasures, TellForecastsByDistance) {
  Json metrics = metrics_with({});
  metrics["scans"] =
      std::vector<Json>{scan_with({band(0.0, 1.0, 1000.0, 3, 1)}),
                        scan_with({band(0.0, 1.0, 6.0, 8, 2), band(0.5, 1.5, 3.0, 12, 0)}),
                        scan_with({band(1.0, 2.0, 5.0, 4, 0), band(2.0, 3.0, 7.0, 2, 0),
                                   band(3.0, nullptr, 9.0, 6, 5)})};
  EXPECT_DOUBLE_EQ(*scalar(metrics, "forecast_ratio"), 30.0 / 32.0);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "forecast_ratio_to_1_m"), 6.0 / 8.0);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "forecast_ratio_to_2_m"), 8.0 / 16.0);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "forecast_ratio_to_3_m"), 3.5);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "forecast_ratio_beyond_3_m"), 1.5);
  EXPECT_DOUBLE_EQ(*scalar(metrics, "outside_share"), 8.0 / 35.0);
  EXPECT_EQ(curve(metrics, "forecast_ratio"), (Curve{1001.0 / 4.0, 10.0 / 21.0, 22.0 / 13.0}));
  Json former;
  former["scans"] = std::vector<Json>{at(1.0, 0.0, 5), at(2.0, 0.5, 3)};
  EXPECT_FALSE(forecast_ratio({former, 2}));
  EXPECT_FALSE(outside_share({former, 2}));
  EXPECT_EQ(forecast_ratios({former, 2}), Curve{});
  EXPECT_FALSE(interval_coverage({former, 2}));
}

TEST(MappingMeasures, CountScansWithinTheInterval) {
  const auto scan = [](double actual) {
    return Json{{"actual_new_cells", actual},
                {"forecast", {{"cells", 14.0}, {"low_cells", 10.0}, {"high_cells", 20.0}}}};
  };
  Json metrics = metrics_with({});
  Json first = scan(15.0);
  first["forecast"] = nullptr;
  metrics["scans"] =
      std::vector<Json>{first, scan(9.0), scan(10.0), scan(12.0), scan(20.0), scan(21.0)};
  EXPECT_DOUBLE_EQ(*scalar(metrics, "interval_coverage"), 0.6);
}

TEST(MappingMeasures, TellHowSureItWasAtTheEnd) {
  Json metrics = metrics_with({});
  EXPECT_FALSE(scalar(metrics, "stop_confidence"));
  metrics["scans"] = std::vector<Json>{Json{{"left", {{"confidence", 0.5}}}},
                                       Json{{"left", {{"confidence", 0.93}}}}};
  EXPECT_EQ(scalar(metrics, "stop_confidence"), 0.93);
  metrics["scans"].push_back(Json{{"left", nullptr}});
  EXPECT_FALSE(scalar(metrics, "stop_confidence")) << "it was not asked there";
}

TEST(MappingMeasures, ReadTheScoreOfTheMapWhereThereIsOne) {
  Json metrics = metrics_with({});
  metrics["map"] = {{"precision", 0.75}, {"recall", nullptr}};
  EXPECT_EQ(scalar(metrics, "precision"), 0.75);
  EXPECT_FALSE(scalar(metrics, "recall"));
  EXPECT_FALSE(scalar(metrics, "time_to_80_s")) << "of a former run";
  metrics["time_to_80_s"] = 12.5;
  EXPECT_EQ(scalar(metrics, "time_to_80_s"), 12.5);
}

/// A share holds from one scan to the next.
TEST(MappingMeasures, StepDownAlongTimeAndWay) {
  Json metrics = metrics_with({});
  metrics["scans"] = std::vector<Json>{at(10.0, 0.5, 600), at(40.0, 2.0, 300), at(61.0, 2.5, 200)};
  EXPECT_EQ(curve(metrics, "share_left_over_time"), (Curve{1.0, 0.6, 0.3, 0.3, 0.2}));
  EXPECT_EQ(curve(metrics, "share_left_over_path"), (Curve{1.0, 0.6, 0.3, 0.2}));
  metrics["scans"].erase(2);
  EXPECT_EQ(curve(metrics, "share_left_over_time"), (Curve{1.0, 0.6, 0.3}));
  metrics["observable_cells"] = 0;
  EXPECT_TRUE(curve(metrics, "share_left_over_time").empty());
  EXPECT_TRUE(curve(metrics_with({}), "share_left_over_time").empty());
  EXPECT_TRUE(curve(metrics_with({5}), "share_left_over_time").empty()) << "of a former run";
  EXPECT_EQ(kAlongTime.first, 0.0);
  EXPECT_EQ(kAlongTime.step, 20.0);
  EXPECT_EQ(kAlongPath.first, 0.0);
  EXPECT_EQ(kAlongPath.step, 1.0);
}

std::vector<ScanRecord> records_with(const std::vector<int>& cells_left) {
  std::vector<ScanRecord> scans;
  for (const int left : cells_left) {
    ScanRecord& scan = scans.emplace_back();
    scan.time_s = 10.0 * static_cast<double>(scans.size());
    scan.path_length_m = 0.5 + static_cast<double>(scans.size());
    scan.observable_unobserved_cells = static_cast<std::size_t>(left);
  }
  return scans;
}

TEST(Progress, IsWhenAShareIsReached) {
  Json metrics;
  add_progress(records_with(kSteps), 1000, metrics);
  EXPECT_EQ(metrics["scans_to_80"], 3);
  EXPECT_EQ(metrics["scans_to_90"], 5);
  EXPECT_EQ(metrics["scans_to_95"], 7);
  EXPECT_EQ(metrics["scans_to_97"], 9);
  EXPECT_EQ(metrics["scans_to_98"], 10);
  EXPECT_EQ(metrics["time_to_90_s"], 50.0);
  EXPECT_EQ(metrics["path_to_95_m"], 7.5);
  EXPECT_EQ(reached_95({metrics, 10}), 1.0);
  add_progress(records_with({600, 200, 100, 51}), 1000, metrics);
  EXPECT_EQ(metrics["scans_to_80"], 2) << "just that share";
  EXPECT_EQ(metrics["scans_to_90"], 3);
  for (const char* key : {"scans_to_95", "time_to_95_s", "path_to_95_m"}) {
    EXPECT_TRUE(metrics[key].is_null()) << key;
  }
  EXPECT_EQ(reached_95({metrics, 4}), 0.0);
  EXPECT_FALSE(reached_95({metrics_with({}), 4})) << "of a former run";
  add_progress(records_with({0}), 0, metrics);
  EXPECT_EQ(metrics["scans_to_98"], 1) << "there is nothing to see";
}

/// 10 s of everything, 10 s of 0.6, 10 s of 0.25; nothing after the last scan.
TEST(Progress, SumsTheShareLeftOverTime) {
  Json metrics;
  add_progress(records_with({600, 250, 125}), 1000, metrics);
  EXPECT_DOUBLE_EQ(metrics["area_over_time"].get<double>(), 18.5);
}

Json ended_with(const std::vector<int>& cells_left) {
  return {{"method", "adaptive"},
          {"status", "completed"},
          {"observable_cells", 200},
          {"scans", metrics_with(cells_left)["scans"]},
          {"path_length_m", 4.567},
          {"collisions", 1},
          {"map", {{"precision", 0.91}, {"recall", nullptr}}},
          {"real_time_factor", 12.34}};
}

TEST(MappingOutcome, SaysWhatIsLeft) {
  EXPECT_EQ(mapping_outcome(ended_with({150, 25})),
            "adaptive: completed after 2 scans, 87.5 % of the observable cells observed\n"
            "path 4.57 m, 1 collisions, map precision 0.910, recall unknown, 12.3 x real time\n");
  EXPECT_NE(mapping_outcome(ended_with({})).find("after 0 scans, 0.0 % of"), std::string::npos);
  Json nothing_to_see = ended_with({0});
  nothing_to_see["observable_cells"] = 0;
  EXPECT_NE(mapping_outcome(nothing_to_see).find("after 1 scans, 0.0 % of"), std::string::npos);
}

TEST(MappingOutcome, SaysWhatCannotBeReached) {
  const auto said = [](int rooms, double share) {
    Json metrics = ended_with({});
    metrics["unreachable"] = {{"rooms", rooms}, {"share", share}};
    const std::string text = mapping_outcome(metrics);
    return text.substr(text.find("real time\n") + 10);
  };
  EXPECT_EQ(said(0, 0.0), "");
  EXPECT_EQ(said(1, 0.125),
            "not counted: 1 room that the robot cannot get to, 12.5 % of all that could be seen\n");
  EXPECT_EQ(
      said(2, 0.25),
      "not counted: 2 rooms that the robot cannot get to, 25.0 % of all that could be seen\n");
}

/// Bands with their middles at 2.5, 3 and 4 m.
TEST(MappingMeasures, ForecastsBeyondThreeMetresBeginThere) {
  Json metrics = metrics_with({});
  metrics["scans"] =
      std::vector<Json>{scan_with({band(0.0, 1.0, 1000.0, 3, 1)}),
                        scan_with({band(2.0, 3.0, 70.0, 10, 0), band(2.5, 3.5, 4.0, 2, 0),
                                   band(3.5, 4.5, 11.0, 8, 0)})};
  EXPECT_EQ(scalar(metrics, "forecast_ratio_beyond_3_m"), 1.5);
}

TEST(MappingMeasures, ReadEachNumberByItsKey) {
  Json metrics = metrics_with({});
  std::vector<std::string> keys{"area_over_time", "energy_j"};
  for (const char* percent : {"80", "90", "95", "97", "98"}) {
    keys.push_back(std::string("time_to_") + percent + "_s");
    keys.push_back(std::string("path_to_") + percent + "_m");
  }
  for (std::size_t i = 0; i < keys.size(); ++i) metrics[keys[i]] = 10.5 + static_cast<double>(i);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_EQ(scalar(metrics, keys[i]), 10.5 + static_cast<double>(i)) << keys[i];
  }
}

TEST(MappingMeasures, TellWhetherABudgetWasKept) {
  Json metrics = metrics_with({});
  EXPECT_FALSE(scalar(metrics, "budget_kept")) << "there was none";
  for (const bool kept : {true, false}) {
    metrics["budget"] = {{"kept", kept}};
    EXPECT_EQ(scalar(metrics, "budget_kept"), kept ? 1.0 : 0.0);
  }
}

TEST(MappingMeasures, ReadEachScan) {
  const auto scan = [](double k) {
    return Json{{"unobserved_cells", 10.0 * k},
                {"observable_unobserved_cells", 20.0 * k},
                {"path_length_m", 0.5 * k},
                {"pose_error_m", 0.25 * k},
                {"pose_error_before_registration_m", 0.75 * k},
                {"precision", 0.125 * k},
                {"recall", 0.0625 * k}};
  };
  Json metrics = metrics_with({});
  metrics["scans"] = std::vector<Json>{scan(1.0), scan(4.0), scan(1.0)};
  const auto times = [](double unit) { return Curve{unit, 4.0 * unit, unit}; };
  EXPECT_EQ(curve(metrics, "unobserved_cells"), times(10.0));
  EXPECT_EQ(curve(metrics, "observable_unobserved_cells"), times(20.0));
  EXPECT_EQ(curve(metrics, "distance_m"), times(0.5));
  EXPECT_EQ(curve(metrics, "pose_error_m"), times(0.25));
  EXPECT_EQ(curve(metrics, "precision"), times(0.125));
  EXPECT_EQ(curve(metrics, "recall"), times(0.0625));
  EXPECT_EQ(scalar(metrics, "pose_error_m"), 0.5) << "the mean";
  EXPECT_EQ(scalar(metrics, "pose_error_before_registration_m"), 1.5);
  EXPECT_EQ(scalar(metrics, "worst_pose_error_m"), 1.0);
  for (const char* name :
       {"pose_error_m", "pose_error_before_registration_m", "worst_pose_error_m"}) {
    EXPECT_FALSE(scalar(metrics_with({}), name)) << name;
  }
}

TEST(MappingMeasures, OfAMapInDoubt) {
  Json metrics = metrics_with({});
  for (const bool doubted : {false, true}) {
    metrics["localisation"] = {{"map_in_doubt", doubted}};
    EXPECT_EQ(scalar(metrics, "map_in_doubt"), doubted ? 1.0 : 0.0);
  }
  metrics.erase("localisation");
  EXPECT_FALSE(scalar(metrics, "map_in_doubt")) << "a run that ended before there was one";
}

TEST(MappingMeasures, KnowWhichDirectionIsBetter) {
  const std::set<std::string_view> higher{"observed_share", "reached_95", "precision", "recall"};
  const auto is_to_a_share = [](std::string_view name) {
    return name.starts_with("scans_to_") || name.starts_with("time_to_") ||
           name.starts_with("path_to_");
  };
  const Measures measures = mapping_measures();
  for (const ScalarMeasure& measure : measures.scalars) {
    const std::string_view name = measure.name.name;
    if (higher.contains(name)) {
      EXPECT_EQ(measure.name.better, Better::higher) << name;
    } else if (is_to_a_share(name) || name.find("error") != std::string_view::npos) {
      EXPECT_EQ(measure.name.better, Better::lower) << name;
    } else if (name == "scans" || name.starts_with("forecast_ratio")) {
      EXPECT_EQ(measure.name.better, Better::unsaid) << name << ": that is no aim of its own";
    }
  }
  for (const CurveMeasure& measure : measures.curves) {
    const std::string_view name = measure.name.name;
    const bool is_higher = higher.contains(name);
    if (name == "forecast_ratio") continue;
    EXPECT_EQ(measure.name.better, is_higher ? Better::higher : Better::lower) << name;
  }
}

TEST(MappingMeasures, StepDownWhereThereIsOneCellToSee) {
  Json metrics = metrics_with({});
  metrics["observable_cells"] = 1;
  metrics["scans"] = std::vector<Json>{at(10.0, 0.5, 1), at(30.0, 1.5, 0)};
  EXPECT_EQ(curve(metrics, "share_left_over_time"), (Curve{1.0, 1.0, 0.0}));
  EXPECT_EQ(curve(metrics, "share_left_over_path"), (Curve{1.0, 1.0, 0.0}));
}

}  // namespace
}  // namespace vantage
