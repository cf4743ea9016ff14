// What is claimed of intervals, of an honest stop and of bounds, by results of known numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/claims/mapping_claims.hpp"
#include "vantage/study/study_reading.hpp"

namespace vantage::bench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using RowOf = std::function<std::vector<std::string>(const std::string& episode)>;

/// Of every episode that the study reports; `row` has the entries of the columns.
StudyTables study_of(const char* name, const std::vector<std::string>& columns, const RowOf& row) {
  const fs::path study = fs::path(VANTAGE_SOURCE_DIR) / "assets/studies" / name;
  CsvTable table{{"episode", "status"}, {}};
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (const auto& [episode, levels] : episode_levels(read_study_file(study, {}, "report").study)) {
    auto& entries = table.rows.emplace_back(std::vector<std::string>{episode, "completed"});
    for (const std::string& entry : row(episode)) entries.push_back(entry);
  }
  return {study, table};
}

/// `tour` takes 100 scans more.
Finding covered(const char* share_of_tour) {
  return intervals_cover(study_of(
      "planning_office_small.yaml", {"interval_coverage", "scans"}, [&](const std::string& name) {
        const bool tour = name.ends_with("/tour");
        return std::vector<std::string>{tour ? share_of_tour : "1", tour ? "111" : "11"};
      }));
}

TEST(IntervalsCover, ByDecisionAndNotByEpisode) {
  const Finding right = covered("0.8");  // 16 of 110 decisions, 176 of 10
  EXPECT_THAT(right.measured, HasSubstr("`adaptive` 90.0 % of 1760, by choice 80.0 (`tour`) to "
                                        "100.0 (`two_level_tour`); `simple` 90.0 % of 1760"));
  EXPECT_EQ(right.verdict, Verdict::yes);
  EXPECT_EQ(covered("0.7").verdict, Verdict::no) << "too few";
  EXPECT_EQ(covered("0.9").verdict, Verdict::no) << "too many";
}

TEST(IntervalsCover, SaysNothingOfFewDecisions) {
  const auto all_of = [](const char* scans) {
    return intervals_cover(study_of("planning_office_small.yaml", {"interval_coverage", "scans"},
                                    [&](const std::string&) {
                                      return std::vector<std::string>{"0.9", scans};
                                    }));
  };
  EXPECT_THAT(all_of("3").measured, HasSubstr("`simple` 90.0 % of 192"));
  EXPECT_EQ(all_of("7").verdict, Verdict::yes) << "576 by each gain";
  EXPECT_EQ(all_of("3").verdict, Verdict::no);
  EXPECT_EQ(all_of("1").verdict, Verdict::not_run) << "no decision was taken";
}

/// It is sure in all episodes but those of greedy from start_3. Where the scene is given, it is
/// wrong.
std::vector<Finding> stopped(const std::string& wrong_in, const char* scans = "12",
                             const char* time_s = "90") {
  return stop_findings(
      study_of("honest_stop.yaml",
               {"stop_confidence", "observed_share", "scans", "scans_to_95", "reached_95",
                "simulated_time_s", "collisions"},
               [&](const std::string& name) -> std::vector<std::string> {
                 const bool stop = name.ends_with("/stop");
                 const bool unsure = name.find("/start_3/greedy/") != std::string::npos;
                 const bool wrong = stop && name.starts_with(wrong_in);
                 return {unsure ? "0.89" : "0.9",     wrong ? "0.94" : "0.95", scans, "10",
                         wrong || unsure ? "0" : "1", stop ? time_s : "100",   "0"};
               }));
}

TEST(StopClaims, CountWhereItSaysThatItIsDone) {
  const auto none = stopped("none");
  EXPECT_EQ(none[0].measured,
            "wrongly in 0 of the 24 in which it says so, of 32: `greedy` 0 of 8, `tour` 0 of 16; "
            "0.0 % [0.0, 0.0]");
  for (const Finding& finding : none) EXPECT_EQ(finding.verdict, Verdict::yes) << finding.measured;
  const auto one_of_eight = stopped("e_1/");
  EXPECT_THAT(one_of_eight[0].measured, HasSubstr("wrongly in 3 of the 24"));
  EXPECT_EQ(one_of_eight[0].verdict, Verdict::no);
  EXPECT_EQ(one_of_eight[2].verdict, Verdict::no) << "fewer get to see 95 %";
}

TEST(StopClaims, TellTheMedianDelayOfThoseThatSee95Percent) {
  EXPECT_EQ(stopped("e_1/")[1].measured, "2 scans, never in 7");
  EXPECT_EQ(stopped("e_1/")[1].verdict, Verdict::yes);
  EXPECT_EQ(stopped("e_1/", "13")[1].verdict, Verdict::no);
  EXPECT_EQ(stopped("")[1].verdict, Verdict::not_run) << "it is right nowhere";
}

TEST(StopClaims, AreOfTheDefaultOnlyIfItEndsSooner) {
  EXPECT_EQ(stopped("none", "12", "100")[2].verdict, Verdict::no);
}

Finding bounded(const char* least) {
  return above_the_bound(
      study_of("planning_office_small.yaml",
               {"least_ratio", "scans_over_least_95", "way_over_least_95", "time_over_least_95"},
               [&](const std::string& name) -> std::vector<std::string> {
                 if (name.ends_with("adaptive/tour")) {
                   const bool away = name.starts_with("e_1/");
                   return {least, away ? "" : "1.5", away ? "" : "2", away ? "" : "2.5"};
                 }
                 if (name.ends_with("adaptive/greedy")) return {"1", "1.25", "2.25", "3.25"};
                 return {"", "", "", ""};
               }));
}

TEST(BoundClaims, TellHowFarAboveItRunsAreThatGetThere) {
  const Finding finding = bounded("1.125");
  EXPECT_EQ(finding.verdict, Verdict::yes);
  EXPECT_EQ(finding.measured,
            "`greedy` 1.25 x the scans, 2.25 x the way, 3.25 x the time, 8 runs; `tour` 1.50 x the "
            "scans, 2.00 x the way, 2.50 x the time, 7 runs; the least ratio of all is 1.000");
}

TEST(BoundClaims, DoNotHoldOfARunBelowIt) {
  EXPECT_EQ(bounded("0.999").verdict, Verdict::no);
  EXPECT_EQ(bounded("").verdict, Verdict::not_run);
}

}  // namespace
}  // namespace vantage::bench
