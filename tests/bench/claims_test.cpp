// A claim that needs what was not measured is not run: never yes, and never another number.
#include "bench/claims/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <set>
#include <string>

#include "bench/claims/recognition_claims.hpp"
#include "tests/support/csv_column.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/study/measures.hpp"
#include "vantage/study/study_reading.hpp"

namespace vantage::bench {
namespace {

namespace fs = std::filesystem;
using Findings = std::vector<Finding>;
using Hold = std::function<Findings(const StudyTables&)>;

const fs::path kRoot = VANTAGE_SOURCE_DIR;

/// Results of every episode that a study plans, each with every number that a claim may ask for.
CsvTable invented_results(const fs::path& study) {
  CsvTable table{{"episode", "status"}, {}};
  for (const std::string& name : scalar_names()) table.columns.push_back(name);
  for (const char* label :
       {"simple", "visibility_weighted", "adaptive", "beer_lambert a=0.98", "beer_lambert a=0.99",
        "beer_lambert", "beer_lambert a=0.997", "beer_lambert a=0.998", "beer_lambert a=0.999",
        "beer_lambert a=0.9995", "beer_lambert a=0.9998"}) {
    table.columns.push_back(std::string("prediction_error_") + label + "_cells");
  }
  const StudyReading reading = read_study_file(study, {}, "report");
  for (const auto& [name, levels] : episode_levels(reading.study)) {
    auto& row = table.rows.emplace_back(std::vector<std::string>{name, "completed"});
    for (std::size_t c = 2; c < table.columns.size(); ++c) {
      const double share = static_cast<double>(hash_bytes(name + table.columns[c]) % 1000) / 1000.0;
      row.push_back(std::to_string(0.5 + share));
    }
  }
  return table;
}

/// By some claim; the others change none, and intervals take their time.
bool is_asked_for(const std::string& column) {
  constexpr std::array kTables{"area",
                               "area_from_scan_2",
                               "area_over_time",
                               "prediction_error_cells",
                               "scans",
                               "scans_to_95",
                               "observed_share",
                               "path_length_m",
                               "time_to_95_s",
                               "time_to_98_s",
                               "path_to_95_m",
                               "path_to_98_m",
                               "scans_to_98",
                               "collisions",
                               "interval_coverage",
                               "stop_confidence",
                               "reached_95",
                               "simulated_time_s",
                               "correct",
                               "category_correct",
                               "changed_correct",
                               "detectable",
                               "detectable_correct",
                               "views",
                               "view_position_error_m",
                               "view_angle_error_rad",
                               "accuracy",
                               "mean_entropy_observed_nats",
                               "objects_unseen",
                               "observations",
                               "collided",
                               "minimum_clearance_m",
                               "tracking_error_m",
                               "missed_deadlines",
                               "targets_correct",
                               "hidden_views",
                               "precision",
                               "worst_pose_error_m",
                               "map_in_doubt",
                               "budget_kept"};
  return column.starts_with("prediction_error_") || column.starts_with("forecast_ratio") ||
         std::ranges::find(kTables, column) != kTables.end();
}

struct Case {
  const char* study;
  Hold hold;
};

class Claims : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] fs::path study() const {
    return kRoot / "assets/studies" / (std::string(GetParam().study) + ".yaml");
  }
  [[nodiscard]] Findings found(const CsvTable& results) const {
    return GetParam().hold(StudyTables(study(), results));
  }
  /// A claim whose text changes with a number needs it: without it, it is not run.
  void expect_not_run(const Findings& before, const Findings& changed, const Findings& without) {
    ASSERT_EQ(before.size(), without.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool needs_it = changed[i].measured != before[i].measured;
      if (needs_it) {
        EXPECT_EQ(without[i].verdict, Verdict::not_run) << before[i].claim;
      } else if (without[i].verdict != Verdict::not_run) {
        EXPECT_EQ(without[i].measured, before[i].measured) << before[i].claim;
      }
      if (needs_it) needed_.insert(before[i].claim);
    }
  }
  /// A claim that nothing changes would be one about nothing, or about what is not tried here.
  void expect_all_needed(const Findings& findings) const {
    for (const Finding& finding : findings) EXPECT_TRUE(needed_.contains(finding.claim));
  }
  std::set<std::string> needed_;
};

TEST_P(Claims, AllAreHeldAgainstWholeResults) {
  for (const Finding& finding : found(invented_results(study()))) {
    EXPECT_NE(finding.verdict, Verdict::not_run) << finding.claim << ": " << finding.measured;
  }
}

TEST_P(Claims, NoneHoldsWithoutResults) {
  CsvTable none;
  for (const Finding& finding : found(none)) {
    EXPECT_EQ(finding.verdict, Verdict::not_run) << finding.claim;
    EXPECT_FALSE(finding.measured.empty()) << "it says what is missing";
  }
}

/// The first of each method, and the last.
TEST_P(Claims, AMissingEpisodeOfAnyMethod) {
  const CsvTable whole = invented_results(study());
  const Findings before = found(whole);
  const auto levels = StudyTables(study(), whole).levels();
  for (const std::string& level : levels) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < whole.rows.size(); ++i) {
      const std::string of_row = "/" + whole.rows[i][0] + "/";
      const bool one_of_several_draws = of_row.find("/" + level + "_1/") != std::string::npos;
      if (one_of_several_draws || of_row.find("/" + level + "/") != std::string::npos) {
        rows.push_back(i);
      }
    }
    ASSERT_FALSE(rows.empty()) << level;
    for (const std::size_t row : {rows.front(), rows.back()}) {
      CsvTable other = whole;
      std::fill(other.rows[row].begin() + 2, other.rows[row].end(), "1000000");
      CsvTable less = whole;
      less.rows.erase(less.rows.begin() + static_cast<std::ptrdiff_t>(row));
      expect_not_run(before, found(other), found(less));
    }
  }
  EXPECT_FALSE(needed_.empty());
}

TEST_P(Claims, AMissingTable) {
  const CsvTable whole = invented_results(study());
  const Findings before = found(whole);
  for (std::size_t column = 2; column < whole.columns.size(); ++column) {
    if (!is_asked_for(whole.columns[column])) continue;
    CsvTable less = whole;
    for (auto& row : less.rows) row[column].clear();
    CsvTable other = whole;
    for (std::size_t i = 0; i < other.rows.size(); ++i) {
      // Where 1 is yes, some are.
      other.rows[i][column] = i % 2 == 0 ? "1" : std::to_string(1000 * (i + 7));
    }
    expect_not_run(before, found(other), found(less));
  }
  expect_all_needed(before);
}

TEST_P(Claims, WhatIsNoNumberIsMissing) {
  CsvTable broken = invented_results(study());
  for (auto& row : broken.rows) {
    for (std::size_t column = 2; column < row.size(); ++column) row[column] = "nan";
  }
  for (const Finding& finding : found(broken)) EXPECT_EQ(finding.verdict, Verdict::not_run);
}

INSTANTIATE_TEST_SUITE_P(
    Studies, Claims,
    testing::Values(
        Case{"tabletop", tabletop_findings}, Case{"tabletop_predictors", prediction_findings},
        Case{"office_small",
             [](const StudyTables& s) {
               return office_findings(s, "Fig. 3.15", {20, 25});
             }},
        Case{"office_large",
             [](const StudyTables& s) {
               return office_findings(s, "Fig. 3.16", {60, 70});
             }},
        Case{"planning_tabletop", planning_tabletop_findings},
        Case{"planning_office_small",
             [](const StudyTables& s) { return planning_office_findings(s, 0.92, std::nullopt); }},
        Case{"planning_office_large",
             [](const StudyTables& s) { return planning_office_findings(s, 0.80, 0.65); }},
        Case{"honest_stop", stop_findings}, Case{"budgets", budget_findings},
        Case{"buildings", building_findings},
        Case{"recognition_flight", flight_recognition_findings},
        Case{"recognition_clutter", clutter_findings},
        Case{"change_flight", flight_change_findings}, Case{"trajectory", trajectory_findings},
        Case{"faults_tabletop", mapping_fault_findings},
        Case{"faults_office", mapping_fault_findings},
        Case{"faults_recognition", recognition_fault_findings},
        Case{"faults_trajectory", trajectory_fault_findings}),
    [](const auto& info) { return std::string(info.param.study); });

/// What is held of `tour` against the oracle, where both take as long but the oracle does not get
/// there in those scenes.
Finding near_oracle_without(std::string_view scenes) {
  const fs::path study = kRoot / "assets/studies/planning_office_small.yaml";
  CsvTable results = invented_results(study);
  for (auto& row : results.rows) {
    const bool away = row[0].starts_with(scenes) && row[0].ends_with("/oracle_tour");
    for (std::size_t i = 2; i < row.size(); ++i) row[i] = away ? "" : "1";
  }
  for (const Finding& finding :
       planning_office_findings(StudyTables(study, results), 0.92, std::nullopt)) {
    if (finding.claim.find("oracle_tour") != std::string::npos) return finding;
  }
  return {};
}

/// What is held of a lost pose, where one episode is so far off and doubts its map or does not.
Verdict of_lost_pose(const char* worst_m, const char* in_doubt) {
  const fs::path study = kRoot / "assets/studies/faults_tabletop.yaml";
  CsvTable results = invented_results(study);
  const std::size_t worst = support::column_index(results, "worst_pose_error_m");
  const std::size_t doubt = support::column_index(results, "map_in_doubt");
  for (auto& row : results.rows) {
    const bool it = &row == &results.rows.back();
    row[worst] = it ? worst_m : "0.01";
    row[doubt] = it ? in_doubt : "0";
  }
  return mapping_fault_findings(StudyTables(study, results)).at(2).verdict;
}

TEST(FaultClaims, AMapWithALostPoseSaysSo) {
  EXPECT_EQ(of_lost_pose("0.05", "0"), Verdict::yes);
  EXPECT_EQ(of_lost_pose("0.06", "0"), Verdict::no);
  EXPECT_EQ(of_lost_pose("0.06", "1"), Verdict::yes);
  EXPECT_EQ(of_lost_pose("0.01", "1"), Verdict::yes) << "too careful is no lie";
}

TEST(PlanningClaims, AnOracleThatGetsThereLessOftenIsNothingToBeNearTo) {
  EXPECT_EQ(near_oracle_without("none").verdict, Verdict::yes);
  const Finding less = near_oracle_without("e_1/");
  EXPECT_EQ(less.verdict, Verdict::no) << less.measured;
  EXPECT_NE(less.measured.find("8 and 7 of 8 get there"), std::string::npos) << less.measured;
}

/// What is held of the way of the nearest frontier, whose episodes are `whole_m` long and take
/// `to_95_m` to 95 %, where the others take 10 m.
Finding nearest_of(const char* whole_m, const char* to_95_m) {
  const fs::path study = kRoot / "assets/studies/office_small.yaml";
  CsvTable results = invented_results(study);
  for (auto& row : results.rows) {
    const bool nearest = row[0].ends_with("/nearest_frontier");
    for (std::size_t i = 2; i < row.size(); ++i) {
      if (results.columns[i] == "path_length_m") row[i] = nearest ? whole_m : "10";
      if (results.columns[i] == "path_to_95_m") row[i] = nearest ? to_95_m : "10";
      if (results.columns[i] == "scans_to_95") row[i] = nearest ? "20" : "10";
    }
  }
  return office_findings(StudyTables(study, results), "Fig. 3.15", {})[2];
}

TEST(OfficeClaims, TheWayIsThatToTheSameShare) {
  EXPECT_EQ(nearest_of("5", "5").verdict, Verdict::yes) << nearest_of("5", "5").measured;
  EXPECT_EQ(nearest_of("5", "10").verdict, Verdict::no) << "an end that came sooner";
  EXPECT_EQ(nearest_of("11", "5").verdict, Verdict::no);
}

TEST(TabletopClaims, AnOracleIsNoBoundWhereItIsBeaten) {
  const fs::path study = kRoot / "assets/studies/tabletop.yaml";
  CsvTable results = invented_results(study);
  const std::size_t area = support::column_index(results, "area");
  for (auto& row : results.rows) {
    const bool worse = row[0].ends_with("/oracle") && row[0].starts_with("report_4/");
    row[area] = worse ? "3" : row[0].ends_with("/simple") ? "2" : "1";
  }
  for (const Finding& finding : tabletop_findings(StudyTables(study, results))) {
    if (finding.claim.find("is ahead of `simple`") == std::string::npos) continue;
    EXPECT_THAT(finding.measured, testing::HasSubstr("`oracle` 0.60"));
    EXPECT_THAT(finding.measured, testing::HasSubstr("beaten by `simple` in 5 of 50; "
                                                "`oracle_lookahead` 0.50"));
    EXPECT_THAT(finding.measured, testing::EndsWith("beaten by `simple` in 0 of 50"));
    return;
  }
  ADD_FAILURE() << "no such claim";
}

/// Of explorations that say they are done, wrongly in one scene.
TEST(StopClaims, ErrorsOfOneSceneAreAlike) {
  const fs::path study = kRoot / "assets/studies/honest_stop.yaml";
  CsvTable results = invented_results(study);
  for (auto& row : results.rows) {
    for (std::size_t i = 2; i < row.size(); ++i) {
      if (results.columns[i] == "stop_confidence") row[i] = "0.9";
      if (results.columns[i] == "observed_share") row[i] = row[0].starts_with("e_1/") ? "0.9" : "1";
    }
  }
  const Finding seldom = stop_findings(StudyTables(study, results)).front();
  EXPECT_EQ(seldom.verdict, Verdict::no) << seldom.measured;
  EXPECT_THAT(seldom.measured, testing::StartsWith("wrongly in 4 of the 32 "));
  EXPECT_THAT(seldom.measured, testing::HasSubstr("; 12.5 % [0.0, 37.5]"));
}

/// Of forecasts that are right but in one office, up to 2 m.
Finding forecasts_where_one_is(const char* ratio) {
  const fs::path study = kRoot / "assets/studies/office_small.yaml";
  CsvTable results = invented_results(study);
  for (auto& row : results.rows) {
    for (std::size_t i = 2; i < row.size(); ++i) {
      if (results.columns[i].starts_with("forecast_ratio")) row[i] = "1";
      if (results.columns[i] == "forecast_ratio_to_2_m" && row[0].starts_with("f_2/")) {
        row[i] = row[0].find("/start_3/") != std::string::npos ? ratio : "1.1";
      }
    }
  }
  for (const Finding& finding : office_findings(StudyTables(study, results), "Fig. 3.15", {})) {
    if (finding.claim.find("forecasts") != std::string::npos) return finding;
  }
  return {};
}

TEST(OfficeClaims, ForecastsAreHeldOfficeByOfficeAndDistanceByDistance) {
  const Finding within = forecasts_where_one_is("1.09");
  EXPECT_EQ(within.verdict, Verdict::yes) << within.measured;
  EXPECT_THAT(within.measured,
              testing::HasSubstr("up to 2 m 1.00 to 1.10, up to 3 m 1.00 to 1.00"));
  const Finding above = forecasts_where_one_is("1.11");
  EXPECT_EQ(above.verdict, Verdict::no) << above.measured;
  EXPECT_THAT(above.why, testing::StartsWith("not in f_2 up to 2 m (1.105):"));
  EXPECT_EQ(forecasts_where_one_is("0.69").verdict, Verdict::no) << "0.895 on average";
}

/// What is held of contacts, where the flights of a method touch something.
Verdict contacts(const Case& flights, const std::string& method) {
  const fs::path study = kRoot / "assets/studies" / (std::string(flights.study) + ".yaml");
  CsvTable results = invented_results(study);
  const std::size_t column = support::column_index(results, "collisions");
  for (auto& row : results.rows) {
    row[column] = row[0].find("/" + method) != std::string::npos ? "1" : "0";
  }
  for (const Finding& finding : flights.hold(StudyTables(study, results))) {
    if (finding.claim.starts_with("no contact with anything")) return finding.verdict;
  }
  return Verdict::not_run;
}

TEST(FlightClaims, AContactCountsWhateverChoosesTheViews) {
  for (const Case& flights : {Case{"recognition_flight", flight_recognition_findings},
                              Case{"change_flight", flight_change_findings},
                              Case{"recognition_clutter", clutter_findings}}) {
    EXPECT_EQ(contacts(flights, "none"), Verdict::yes) << flights.study;
    EXPECT_EQ(contacts(flights, "random"), Verdict::no) << flights.study;
  }
}

/// `study` without each of the entries of a list in turn.
void without_each(const Json& study, const char* list,
                  const std::function<void(const Json&)>& see) {
  for (std::size_t i = 0; i < study.at(list).size(); ++i) {
    Json less = study;
    less[list].erase(i);
    see(less);
  }
}

void expect_same_or_not_run(const Findings& before, const Findings& after) {
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (after[i].verdict == Verdict::not_run) continue;
    EXPECT_EQ(after[i].measured, before[i].measured) << after[i].claim;
  }
}

TEST(RecognitionClaims, AMissingMethodIsNotRun) {
  const Json simple = read_json(kRoot / "bench/results/recognition/simple/summary.json");
  const Findings before = recognition_findings(simple);
  for (const Finding& finding : before) EXPECT_NE(finding.verdict, Verdict::not_run);
  without_each(simple, "methods", [&](const Json& less) {
    expect_same_or_not_run(before, recognition_findings(less));
  });
  for (const Finding& finding : recognition_findings(Json::object())) {
    EXPECT_EQ(finding.verdict, Verdict::not_run);
  }
}

TEST(RecognitionClaims, AMissingScenarioIsNotRun) {
  const Json changes = read_json(kRoot / "bench/results/recognition/changes/summary.json");
  const Findings before = change_findings(changes);
  without_each(changes, "changes",
               [&](const Json& less) { expect_same_or_not_run(before, change_findings(less)); });
  for (const Finding& finding : change_findings(Json::object())) {
    EXPECT_EQ(finding.verdict, Verdict::not_run);
  }
  for (const Finding& finding : kernel_findings(Json::object(), Json::object())) {
    EXPECT_EQ(finding.verdict, Verdict::not_run);
  }
}

Figures figures_on_two_threads() {
  Figures figures;
  for (const auto& entry : fs::directory_iterator(kRoot / "bench/results")) {
    if (entry.path().extension() != ".json") continue;
    const Json benchmark = read_json(entry.path());
    figures.emplace(benchmark.at("name").get<std::string>(), benchmark.at("figures"));
  }
  figures["decision"]["castray_threads"] = 2;  // of former versions 1
  // Measured where nothing else runs, if at all.
  for (const char* name : {"planning_tabletop", "planning_office_large"}) {
    figures.try_emplace(name, Json{{"decision_ms", 40.0}});
  }
  figures.try_emplace("env", Json{{"decisions_per_s", 5.0}, {"swept_numpy_over_cpp", 1.0}});
  return figures;
}

TEST(SpeedClaims, AMissingFigureIsNotRun) {
  Figures figures = figures_on_two_threads();
  const Findings before = speed_findings(figures);
  for (const Finding& finding : before)
    EXPECT_NE(finding.verdict, Verdict::not_run) << finding.claim;
  figures["decision"]["castray_threads"] = 1;
  expect_same_or_not_run(before, speed_findings(figures));
  EXPECT_EQ(speed_findings(figures)[3].verdict, Verdict::not_run) << "on fewer threads";
  figures["decision"]["castray_threads"] = 2;
  for (const auto& [name, values] : figures) {
    Figures less = figures;
    less.erase(name);
    expect_same_or_not_run(before, speed_findings(less));
  }
  for (const Finding& finding : speed_findings({})) EXPECT_EQ(finding.verdict, Verdict::not_run);
}

TEST(SpeedClaims, AMissHasAReasonOfItsOwn) {
  Figures figures = figures_on_two_threads();
  figures["decision"]["castray_over_sweep"] = 100.0;
  for (const char* name : {"planning_tabletop", "planning_office_large"}) {
    figures[name]["decision_ms"] = 1e4;
  }
  const Findings findings = speed_findings(figures);
  EXPECT_FALSE(findings[3].why.empty()) << findings[3].claim;
  std::set<std::string> reasons;
  for (const Finding& finding : findings) {
    if (finding.why.empty()) continue;
    EXPECT_TRUE(reasons.insert(finding.why).second) << finding.claim << ": " << finding.why;
  }
}

TEST(Findings, SayWhatHolds) {
  const Findings findings{held("goal", "a",
                               [] {
                                 return Measured{"1", true, "never said"};
                               }),
                          held("goal", "b",
                               [] {
                                 return Measured{"2", false, "because"};
                               }),
                          held("goal", "c", []() -> Measured { throw NotRun("`x` of `y`"); })};
  EXPECT_THAT(findings_table(findings),
              testing::AllOf(testing::HasSubstr("| goal | a | 1 | yes |  |"),
                             testing::HasSubstr("| goal | b | 2 | **no** | because |"),
                             testing::HasSubstr("| goal | c | `x` of `y` | not run |  |")));
}

}  // namespace
}  // namespace vantage::bench
