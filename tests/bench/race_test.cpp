// Who gets somewhere more often, and who sooner: of episodes that were run, arrived or not.
#include "bench/tables/race.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "vantage/study/study_reading.hpp"

namespace vantage::bench {
namespace {

const std::filesystem::path kStudy =
    std::filesystem::path(VANTAGE_SOURCE_DIR) / "tests/bench/ten_tables.yaml";

/// The time of an episode by its name; empty: it does not get there.
using TimeOf = std::function<std::string(const std::string&)>;

StudyTables study_of(const TimeOf& time) {
  CsvTable table{{"episode", "status", "time_to_98_s"}, {}};
  for (const auto& [name, levels] : episode_levels(read_study_file(kStudy, {}, "report").study)) {
    table.rows.push_back({name, "completed", time(name)});
  }
  return {kStudy, table};
}

Race race_of(const StudyTables& study) {
  return race(study, "time_to_98_s", "adaptive", "tour", "greedy");
}

bool is_by(const std::string& episode, const char* choice) {
  return episode.ends_with(std::string("/adaptive/") + choice);
}

TEST(Race, IsOfThePairsThatBothArrive) {
  const Race got = race_of(study_of([](const std::string& name) -> std::string {
    if (name.starts_with("report_40/")) return is_by(name, "greedy") ? "" : "1000";
    return is_by(name, "tour") ? "60" : "100";
  }));
  EXPECT_EQ(got.arrived, 10U);
  EXPECT_EQ(got.other_arrived, 9U);
  ASSERT_TRUE(got.pairs && got.pairs->ratio);
  EXPECT_EQ(got.pairs->pairs, 9U);
  EXPECT_DOUBLE_EQ(*got.pairs->ratio, 0.6);
  EXPECT_TRUE(got.is_won_by(0.6));
  EXPECT_FALSE(got.is_won_by(0.59));
  EXPECT_THAT(got.text(), testing::HasSubstr("10 and 9 of 10 get there"));
}

TEST(Race, IsNotWonByWhoArrivesLessOften) {
  const Race got = race_of(study_of([](const std::string& name) -> std::string {
    if (!is_by(name, "tour")) return "100";
    return name.starts_with("report_40/") ? "" : "10";
  }));
  EXPECT_FALSE(got.is_won_by(1.0));
}

TEST(Race, IsWonByWhoArrivesAlone) {
  const Race got =
      race_of(study_of([](const std::string& name) { return is_by(name, "greedy") ? "" : "100"; }));
  EXPECT_FALSE(got.pairs.has_value());
  EXPECT_TRUE(got.is_won_by(0.1));
  EXPECT_TRUE(got.is_significant()) << "in ten tables of ten";
}

TEST(Race, IsNotWonWhereTheTwoNeverMeet) {
  const Race got = race_of(study_of([](const std::string& name) -> std::string {
    if (is_by(name, "tour")) return name.starts_with("report_b_") ? "1" : "";
    return name.starts_with("report_b_") ? "" : "100";
  }));
  EXPECT_EQ(got.arrived, 5U);
  EXPECT_EQ(got.other_arrived, 5U);
  EXPECT_FALSE(got.is_won_by(10.0));
  EXPECT_FALSE(got.is_ahead());
}

/// Of two tables twice as fast, of all others as fast: a ratio below 1 whose interval holds 1.
TEST(Race, IsAheadBeyondTheInterval) {
  const auto tour_takes = [](const std::function<double(const std::string&)>& time) {
    return race_of(study_of([&](const std::string& name) {
      return is_by(name, "tour") ? std::to_string(time(name)) : "100";
    }));
  };
  const Race ahead = tour_takes([](const auto&) { return 90.0; });
  EXPECT_TRUE(ahead.is_ahead());
  EXPECT_TRUE(ahead.is_significant());
  EXPECT_EQ(ahead.why_not_ahead(), "");
  EXPECT_EQ(ahead.why_lost(0.9), "");
  const Race level = tour_takes(
      [](const std::string& name) { return name.starts_with("report_4/") ? 50.0 : 100.0; });
  EXPECT_TRUE(level.is_won_by(1.0));
  EXPECT_FALSE(level.is_ahead());
  EXPECT_EQ(level.why_not_ahead(), "the interval holds 1");
  const Race behind = tour_takes([](const auto&) { return 110.0; });
  EXPECT_EQ(behind.why_not_ahead(), "is behind");
}

/// The other gets to an end at two of ten tables, twice as slowly.
TEST(Race, IsNotAheadByTwoPairsButByArrivingFarMoreOften) {
  const auto arrives_at = [](const std::vector<std::string>& tables) {
    return race_of(study_of([&](const std::string& name) -> std::string {
      const bool two = name.starts_with("report_4/") || name.starts_with("report_8/");
      if (is_by(name, "greedy")) return two ? "100" : "";
      const bool more = std::ranges::any_of(
          tables, [&](const std::string& table) { return name.starts_with(table); });
      return two || more ? "50" : "";
    }));
  };
  const Race three = arrives_at({"report_15/"});
  EXPECT_TRUE(three.is_won_by(0.5));
  EXPECT_DOUBLE_EQ(three.arrival_p, 1.0) << "one table of ten, either way";
  EXPECT_FALSE(three.is_ahead()) << "two pairs are no lead";
  EXPECT_FALSE(three.is_significant());
  EXPECT_EQ(three.why_not_ahead(), "p 0.5: of 2 pairs it cannot be below 0.5");
  const Race all = arrives_at({"report_"});
  EXPECT_DOUBLE_EQ(all.arrival_p, 2.0 / 256.0) << "of eight tables that differ";
  EXPECT_TRUE(all.is_ahead());
  EXPECT_THAT(all.text(), testing::HasSubstr("10 and 2 of 10 get there, p 0.0078"));
}

TEST(Race, SaysWhatStandsAgainstIt) {
  const Race fewer = race_of(study_of([](const std::string& name) -> std::string {
    const bool first = name.starts_with("report_4/") || name.starts_with("report_8/");
    if (is_by(name, "tour")) return first ? "50" : "";
    return "100";
  }));
  EXPECT_EQ(
      fewer.why_lost(0.6),
      "it gets there in 2 episodes, the other in 10; p 0.5: of 2 pairs it cannot be below 0.5");
  EXPECT_EQ(fewer.why_lost(0.4),
            "it gets there in 2 episodes, the other in 10; 0.500 is above 0.4");
  EXPECT_EQ(fewer.why_not_ahead(), "gets there in 2 episodes, the other in 10");
}

TEST(StudyTables, MayBeComparedByAnotherFactor) {
  const StudyTables study = study_of([](const std::string& name) -> std::string {
    return name.find("/adaptive/") != std::string::npos ? "60" : "120";
  });
  const Race got =
      race(study.compared_by("gain", "simple"), "time_to_98_s", "tour", "adaptive", "simple");
  ASSERT_TRUE(got.pairs && got.pairs->ratio);
  EXPECT_EQ(got.pairs->pairs, 10U);
  EXPECT_DOUBLE_EQ(*got.pairs->ratio, 0.5);
}

TEST(Race, IsNotRunWhereNobodyArrivesOrOneIsMissing) {
  EXPECT_THROW(race_of(study_of([](const std::string&) { return ""; })), NotRun);
  CsvTable table{{"episode", "status", "time_to_98_s"}, {}};
  for (const auto& [name, levels] : episode_levels(read_study_file(kStudy, {}, "report").study)) {
    if (name != "report_4/start_1/adaptive/tour") table.rows.push_back({name, "completed", "1"});
  }
  EXPECT_THROW(race_of({kStudy, table}), NotRun);
}

}  // namespace
}  // namespace vantage::bench
