// Numbers of a study, from its results.csv, held against its plan.
#include "bench/tables/study_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_directory.hpp"

namespace vantage::bench {
namespace {

/// Two starts in two scenes by two methods.
class Tables : public testing::Test {
 protected:
  Tables() {
    std::ofstream(folder_.path() / "s.yaml")
        << "episode: " VANTAGE_SOURCE_DIR
           "/assets/episodes/tabletop.yaml\n"
           "factors:\n"
           "  scene: {a: {scans: 1}, b: {scans: 2}}\n"
           "  start: {n: {seed: 1}, s: {seed: 2}}\n"
           "  method: {old: {gain: simple}, new: {gain: adaptive}}\n"
           "report: {compare: method, reference: old, panels: scene}\n";
    results_.columns = {"episode", "status", "area"};
    for (const char* row : {"a/n/old 4", "a/n/new 2", "a/s/old 6", "a/s/new 2", "b/n/old 8",
                            "b/n/new 4", "b/s/old 2", "b/s/new 2"}) {
      const std::string text(row);
      results_.rows.push_back({text.substr(0, 7), "completed", text.substr(8)});
    }
  }
  [[nodiscard]] StudyTables tables() const { return {folder_.path() / "s.yaml", results_}; }

  support::TemporaryDirectory folder_;
  CsvTable results_;
};

TEST_F(Tables, MeansAndPairs) {
  const StudyTables study = tables();
  EXPECT_DOUBLE_EQ(study.mean("area", "a", "old"), 5.0);
  EXPECT_DOUBLE_EQ(study.mean("area", "all", "new"), 2.5);
  EXPECT_DOUBLE_EQ(study.least("area", "b", "old"), 2.0);
  EXPECT_DOUBLE_EQ(study.ratio("area", "all", "new"), 0.5);
  EXPECT_DOUBLE_EQ(study.difference("area", "a", "new").mean, -3.0);
  EXPECT_EQ(study.difference("area", "all", "new").pairs, 4U);
  EXPECT_EQ(study.extent(), "8 of 8 episodes");
  EXPECT_THROW((void)study.ratio("area", "all", "old"), NotRun) << "the reference itself";
}

TEST_F(Tables, OneThatFailedBeforeItCameToAValueMayCountAsSomething) {
  EXPECT_THAT(tables().values("area", "a", "old", 9.0), testing::ElementsAre(4.0, 6.0));
  results_.rows[0] = {"a/n/old", "failed", ""};
  results_.rows[2][1] = "failed";  // with a value
  EXPECT_THAT(tables().values("area", "a", "old", 9.0), testing::ElementsAre(9.0, 6.0));
  EXPECT_THROW((void)tables().values("area", "a", "old"), NotRun) << "that is not to be a mean";
  EXPECT_THROW((void)tables().values("height", "a", "old", 9.0), NotRun) << "no such table";
  results_.rows[0][1] = "completed";
  EXPECT_THROW((void)tables().values("area", "a", "old", 9.0), NotRun) << "its value is lost";
  results_.rows.erase(results_.rows.begin());
  EXPECT_THROW((void)tables().values("area", "a", "old", 9.0), NotRun) << "it was not run";
}

TEST_F(Tables, AMissingEpisodeTakesWhatItIsPartOf) {
  results_.rows.erase(results_.rows.begin());  // a/n/old
  const StudyTables study = tables();
  EXPECT_THROW((void)study.mean("area", "a", "old"), NotRun);
  EXPECT_THROW((void)study.mean("area", "all", "old"), NotRun);
  EXPECT_THROW((void)study.difference("area", "a", "new"), NotRun) << "one of its pairs is gone";
  EXPECT_DOUBLE_EQ(study.mean("area", "a", "new"), 2.0);
  EXPECT_DOUBLE_EQ(study.ratio("area", "b", "new"), 0.6);
  EXPECT_THAT(study.markdown("area"), testing::HasSubstr("(1 of 2)"));
  EXPECT_EQ(study.extent(), "7 of 8 episodes");
}

TEST_F(Tables, WhatFailedCountsAndIsTold) {
  results_.rows[0][1] = "failed";
  EXPECT_EQ(tables().extent(), "8 of 8 episodes, 1 failed");
  EXPECT_DOUBLE_EQ(tables().mean("area", "a", "old"), 5.0);
}

TEST_F(Tables, AnEpisodeWithoutAResultIsMissing) {
  results_.rows[0][1] = "interrupted";
  EXPECT_THROW((void)tables().mean("area", "a", "old"), NotRun);
  results_.rows[0][1] = "failed";
  EXPECT_DOUBLE_EQ(tables().mean("area", "a", "old"), 5.0) << "what failed is a result";
}

TEST_F(Tables, WhatIsNotPlannedIsNotRun) {
  EXPECT_THROW((void)tables().mean("area", "a", "newer"), NotRun);
  EXPECT_THROW((void)tables().mean("volume", "a", "old"), NotRun);
  EXPECT_THROW((void)tables().mean("area", "c", "old"), NotRun);
}

TEST_F(Tables, AQuotientIsANumber) {
  EXPECT_DOUBLE_EQ(quotient(1.0, 4.0), 0.25);
  EXPECT_THROW((void)quotient(1.0, 0.0), NotRun);
  EXPECT_THROW((void)quotient(0.0, 0.0), NotRun);
}

}  // namespace
}  // namespace vantage::bench
