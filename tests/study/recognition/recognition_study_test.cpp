#include "vantage/study/recognition/recognition_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;

/// Of four starts, `right` are recognised, with so many views each.
MethodTrials method(const std::string& name, int right, int views) {
  MethodTrials method{.method = name, .trials = {}};
  for (int i = 0; i < 4; ++i) {
    method.trials.push_back({.object = 0,
                             .estimate = i < right ? 0 : 1,
                             .name = "cup_" + std::to_string(i + 1),
                             .correct = i < right,
                             .category_correct = true,
                             .observations = views,
                             .bin_error = i % 2,
                             .features = 3,
                             .feature_time_s = 0.5});
  }
  return method;
}

RecognitionStudy small_study() {
  RecognitionStudy study{.options = {}, .states = {}, .methods = {}, .changes = {}};
  study.states.objects = {"cup_1", "cup_2"};
  study.states.categories = {"cup"};
  study.options.starts = 4;
  study.methods = {method("single view, all features", 2, 1), method("random", 3, 3),
                   method("mutual_information", 4, 2)};
  study.changes = {{.method = "star",
                    .scenario = Change::pose,
                    .trials = {{.decision = Change::pose, .observations = 1, .detectable = true},
                               {.decision = Change::object, .observations = 2},
                               {.decision = Change::none, .observations = 3, .detectable = true},
                               {.decision = Change::pose, .observations = 2}}}};
  return study;
}

TEST(RecognitionStudy, SummariesAreMeansAndPairedDifferences) {
  const auto all = summaries(small_study());
  ASSERT_EQ(all.size(), 3U);
  EXPECT_DOUBLE_EQ(all[1].accuracy_percent.mean, 75.0);
  EXPECT_DOUBLE_EQ(all[1].category_percent, 100.0);
  EXPECT_DOUBLE_EQ(all[1].observations.mean, 3.0);
  EXPECT_DOUBLE_EQ(all[1].bin_error->mean, 0.5);
  ASSERT_EQ(all[2].differences.size(), 2U);
  EXPECT_EQ(all[2].differences[0].reference, "single view, all features");
  EXPECT_DOUBLE_EQ(all[2].differences[0].accuracy_percent.mean, 50.0);
  EXPECT_DOUBLE_EQ(all[2].differences[0].p_value, 0.5);
  EXPECT_DOUBLE_EQ(all[2].differences[1].observations.mean, -1.0);
  EXPECT_DOUBLE_EQ(all[2].differences[1].observations.interval.low, -1.0);
  ASSERT_EQ(all[0].differences.size(), 1U);
}

/// Of two objects one is always recognised: a thousand starts say no more than two.
TEST(RecognitionStudy, IntervalsAreOfObjectsNotOfStarts) {
  RecognitionStudy study = small_study();
  study.methods.resize(1);
  study.methods[0].trials.clear();
  for (int i = 0; i < 1000; ++i) {
    const bool first = i % 2 == 0;
    study.methods[0].trials.push_back({.object = first ? 0 : 1,
                                       .estimate = 0,
                                       .name = first ? "cup_1" : "cup_2",
                                       .correct = first,
                                       .category_correct = true,
                                       .observations = 1});
  }
  const Estimate accuracy = summaries(study)[0].accuracy_percent;
  EXPECT_DOUBLE_EQ(accuracy.mean, 50.0);
  EXPECT_DOUBLE_EQ(accuracy.interval.low, 0.0);
  EXPECT_DOUBLE_EQ(accuracy.interval.high, 100.0);
}

TEST(RecognitionStudy, ObjectsThatTheModelDoesNotKnowCountForTheirCategory) {
  RecognitionStudy study = small_study();
  study.methods.resize(1);
  study.methods[0].trials[3].object = -1;
  study.methods[0].trials[3].name = "cup_9";
  study.methods[0].trials[2].category_correct = false;
  const MethodSummary summary = summaries(study)[0];
  EXPECT_NEAR(summary.accuracy_percent.mean, 200.0 / 3.0, 1e-9);
  EXPECT_DOUBLE_EQ(summary.category_percent, 75.0);
  EXPECT_THAT(recognition_tables(study), HasSubstr("1 of 4 objects are not in the model"));
}

TEST(RecognitionStudy, ChangesCountWhatWasSeenAndWhatItWas) {
  const RecognitionStudy study = small_study();
  EXPECT_DOUBLE_EQ(study.changes[0].accuracy(), 0.75);
  EXPECT_DOUBLE_EQ(study.changes[0].kind_accuracy(), 0.5);
  EXPECT_DOUBLE_EQ(study.changes[0].detectable_accuracy(), 0.5);
  EXPECT_DOUBLE_EQ(study.changes[0].detectable_share(), 0.5);
}

TEST(RecognitionStudy, AClassifierHasNoFiguresOfPoseAndCost) {
  RecognitionStudy study = small_study();
  study.methods.push_back(method("linear_svm", 3, 1));
  study.methods.back().label_only = true;
  EXPECT_THAT(recognition_tables(study),
              HasSubstr("100.00 | 1.00 [1.00, 1.00] | - | - | - | - | - | - |\n"));
  const support::TemporaryDirectory folder;
  write_recognition_study(study, folder.path() / "out");
  const std::string csv = read_file(folder.path() / "out" / "results.csv");
  EXPECT_THAT(csv, HasSubstr("\"linear_svm\",0,cup_1,cup_1,1,1,1,,,,,,,,\n"));
  const auto summary =
      nlohmann::json::parse(read_file(folder.path() / "out" / "summary.json"))["methods"];
  EXPECT_TRUE(summary[3]["bin_error"].is_null());
  EXPECT_TRUE(summary[3]["feature_time_s"].is_null());
  EXPECT_TRUE(summary[2]["feature_time_s"].is_number());
}

TEST(RecognitionStudy, FilesHoldARowATrialAndATable) {
  const support::TemporaryDirectory folder;
  write_recognition_study(small_study(), folder.path() / "out");
  const std::string csv = read_file(folder.path() / "out" / "results.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 13);
  EXPECT_THAT(csv, HasSubstr("\"random\",3,cup_4,cup_2,0,1,3,1,3,"));
  EXPECT_EQ(std::ranges::count(read_file(folder.path() / "out" / "changes.csv"), '\n'), 5);
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "out" / "summary.json"));
  EXPECT_EQ(summary["methods"][2]["method"], "mutual_information");
  EXPECT_DOUBLE_EQ(summary["methods"][2]["accuracy_percent"]["mean"].get<double>(), 100.0);
  EXPECT_DOUBLE_EQ(summary["changes"][0]["observations"].get<double>(), 2.0);
  const std::string tables = read_file(folder.path() / "out" / "recognition.md");
  EXPECT_THAT(tables, HasSubstr("| random | 75.00 ["));
  EXPECT_THAT(tables, HasSubstr("| pose | star | 75.00 | 50.00 | 50.0 | 50.00 | 2.00 |"));
}

}  // namespace
}  // namespace vantage
