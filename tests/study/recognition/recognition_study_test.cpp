#include "vantage/study/recognition/recognition_study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/report/report_data.hpp"

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
  for (Trial& trial : study.methods[0].trials) trial.object = -1;
  EXPECT_THAT(recognition_tables(study), HasSubstr("so that the accuracy is of none"));
  EXPECT_TRUE(std::isnan(summaries(study)[0].accuracy_percent.mean)) << "no 0 %";
  EXPECT_THAT(recognition_tables(study), HasSubstr(study.methods[0].method + " | - | "));
  study.methods.push_back(study.methods[0]);
  study.methods[1].method = "ours";
  EXPECT_EQ(summaries(study)[1].differences.at(0).p_value, 1.0) << "nothing speaks for one";
  EXPECT_THAT(recognition_tables(small_study()), testing::Not(HasSubstr("not in the model")));
}

TEST(RecognitionStudy, EstimatesAreOfNothingUnlessTold) {
  EXPECT_EQ(Estimate{}.mean, 0.0);
  EXPECT_EQ(PairedEstimate{}.p_value, 1.0);
  EXPECT_EQ(MethodSummary{}.category_percent, 0.0);
  EXPECT_FALSE(MethodTrials{}.label_only);
  EXPECT_FALSE(MethodTrials{}.several_views);
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
  const auto whole = nlohmann::json::parse(read_file(folder.path() / "out" / "summary.json"));
  const auto config = read_file(folder.path() / "out" / "config.yaml");
  EXPECT_EQ(whole["config_hash"], hash_text(hash_bytes(config)));
  EXPECT_EQ(whole["threads"], study.threads);
  EXPECT_FALSE(whole["cpu"].get<std::string>().empty());
  const auto& summary = whole["methods"];
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

/// Of trials that all say 0.8, of unknown objects that were found or not, and of what it cost.
RecognitionStudy written_study() {
  RecognitionStudy study = small_study();
  study.methods = {method("random", 3, 3)};
  for (Trial& trial : study.methods[0].trials) {
    trial.probability = 0.8;
    trial.unknown_probability = 0.25;
    trial.entropy_bits = 1.5;
    trial.bin_error = 2;
    trial.selection_time_s = 0.25;
    trial.view_time_s = 2.0;
  }
  study.options.unknown_starts = 2;
  study.options.seed = 9;
  study.methods[0].unknown.trials = {{.object = -1,
                                      .estimate = 2,
                                      .name = "jug_1",
                                      .correct = true,
                                      .category_correct = true,
                                      .observations = 4,
                                      .unknown_probability = 0.75},
                                     {.object = -1,
                                      .estimate = 1,
                                      .name = "jug_1",
                                      .correct = false,
                                      .observations = 5,
                                      .unknown_probability = 0.5}};
  study.methods[0].unknown.category_known = {true, false};
  study.changes[0].trials[0].time_s = 0.5;
  study.changes[0].trials[2].p_changed = 0.125;
  study.changes.push_back({.method = "random", .scenario = Change::none, .trials = {}});
  study.changes[1].trials = {{.decision = Change::none, .observations = 2, .time_s = 0.25}};
  return study;
}

TEST(RecognitionTables, SayWhatTrialsCameTo) {
  const std::string text = recognition_tables(written_study());
  for (const char* part :
       {"# Recognition of 2 objects in 1 categories\n\n4 starts, the same for every method",
        ("| 100.00 | 3.00 [3.00, 3.00] | 2.00 [2.00, 2.00] | 3.00 | 0.5000 | 0.2500 | 2.0000 | "
         "2.7500 |\n"),
        "in 15 bins of equal width", "| random | 75.00 | 80.00 | 5.00 [",
        "; 2 starts of unknown ones;",
        "| random | 1.0000 [1.0000, 1.0000] | 0.00 [0.00, 0.00] | 50.0 | 0.0 | 100.0 | - |\n",
        "| pose | star | 75.00 | 50.00 | 50.0 | 50.00 | 2.00 | 0.1250 |\n",
        "| none | random | 100.00 | - | - | 100.00 | 2.00 | 0.2500 |\n"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

/// Of four known objects one is held for unknown as surely as those that are.
TEST(RecognitionTables, SkipMethodsOfWhichThereIsNothingToTell) {
  RecognitionStudy study = written_study();
  study.methods[0].trials[0].unknown_probability = 0.9;
  study.methods.insert(study.methods.begin(), method("linear_svm", 3, 1));
  study.methods[0].label_only = true;
  const std::string text = recognition_tables(study);
  EXPECT_THAT(text, HasSubstr("| random | 75.00 | 80.00 | 5.00 [5.00, 55.00] |\n"));
  const Interval alarms = summaries(study)[1].unknown->false_alarms_interval;
  ASSERT_GT(alarms.high, alarms.low);
  EXPECT_THAT(text,
              HasSubstr(fmt::format("] | 25.00 [{:.2f}, {:.2f}] | 50.0 | 25.0 | 100.0 | - |\n",
                                    100.0 * alarms.low, 100.0 * alarms.high)));
}

TEST(RecognitionTables, AnyNameOfAnObjectIsOneField) {
  const support::TemporaryDirectory folder;
  RecognitionStudy study = written_study();
  study.states.objects[0] = "mug, blue";
  study.methods[0].trials[0].name = study.methods[0].unknown.trials[0].name = "jug, \"red\"";
  write_recognition_study(study, folder.path());
  const auto first_row = [&](const char* name) { return read_csv(folder / name).rows.at(0); };
  EXPECT_THAT(first_row("results.csv"), testing::Contains("mug, blue"));
  EXPECT_THAT(first_row("results.csv"), testing::Contains("jug, \"red\""));
  EXPECT_THAT(first_row("unknown.csv"), testing::Contains("jug, \"red\""));
}

TEST(RecognitionTables, FilesHoldTheSame) {
  const support::TemporaryDirectory folder;
  write_recognition_study(written_study(), folder.path());
  const auto lines_after_header = [&](const char* name) {
    const std::string csv = read_file(folder / name);
    return csv.substr(csv.find('\n') + 1);
  };
  EXPECT_THAT(lines_after_header("results.csv"),
              testing::StartsWith("\"random\",0,cup_1,cup_1,1,1,3,2,3,1.5,0.8,0.25,0.5,0.25,2\n"));
  EXPECT_EQ(lines_after_header("unknown.csv"),
            "\"random\",0,jug_1,1,unknown,1,4,0.75\n\"random\",1,jug_1,0,cup_2,0,5,0.5\n");
  EXPECT_THAT(lines_after_header("changes.csv"),
              testing::StartsWith("pose,star,0,pose,1,0,1,0.5\npose,star,1,object,0,0,2,0\n"
                                  "pose,star,2,none,1,0.125,3,0\n"));
  const auto summary = nlohmann::json::parse(read_file(folder / "summary.json"));
  EXPECT_EQ(summary["objects"], 2);
  EXPECT_EQ(summary["categories"], 1);
  EXPECT_EQ(summary["starts"], 4);
  EXPECT_EQ(summary["unknown_starts"], 2);
  EXPECT_EQ(summary["seed"], 9);
  const auto& method = summary["methods"][0];
  EXPECT_EQ(method["category_percent"], 100.0);
  EXPECT_EQ(method["category_interval"], nlohmann::json({100.0, 100.0}));
  EXPECT_EQ(method["observations"]["mean"], 3.0);
  EXPECT_EQ(method["selection_time_s"], 0.25);
  EXPECT_EQ(method["unknown"]["found"], 0.5);
  EXPECT_EQ(method["unknown"]["threshold_at_90_percent_found"], 0.5);
  EXPECT_TRUE(method["unknown"]["category_right_where_unknown"].is_null());
  ASSERT_EQ(method["reliability"]["bins"].size(), 1U);
  EXPECT_EQ(method["reliability"]["bins"][0]["trials"], 4);
  EXPECT_EQ(method["reliability"]["bins"][0]["objects"], 4);
  EXPECT_EQ(method["reliability"]["bins"][0]["accuracy"], 0.75);
  EXPECT_EQ(summary["changes"][0]["time_s"], 0.125);
}

/// What a study does not have is removed of the one that it replaces.
TEST(RecognitionTables, FilesOfAFormerStudyAreReplaced) {
  const support::TemporaryDirectory folder;
  RecognitionStudy study = written_study();
  study.options.reliability = true;
  study.methods[0].drawn_as = "as it is";
  study.methods[0].several_views = true;
  study.methods.insert(study.methods.begin(), method("not drawn", 2, 1));
  study.methods.push_back(study.methods[1]);
  study.methods[2].several_views = false;
  write_recognition_study(study, folder.path());
  EXPECT_THAT(read_file(folder / "reliability.csv"),
              testing::AllOf(HasSubstr("views by information,as it is,0.8,4,0.75,"),
                             HasSubstr("a single view,as it is,0.8,4,0.75,")));
  EXPECT_TRUE(std::filesystem::exists(folder / "reliability.svg"));
  study.methods = {study.methods[1]};
  EXPECT_NO_THROW(prepare_recognition_study(folder.path(), true));
  EXPECT_THROW(prepare_recognition_study(folder.path(), false), ConfigError);
  study.options.reliability = false;
  study.methods[0].unknown = {};
  study.changes.clear();
  write_recognition_study(study, folder.path());
  for (const char* name : {"reliability.csv", "reliability.svg", "unknown.csv", "changes.csv"}) {
    EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
  }
  std::filesystem::create_directory(folder / "older");
  write_file(folder / "older/summary.json", "{}");
  EXPECT_THROW(prepare_recognition_study((folder / "older").string(), false), ConfigError);
  EXPECT_NO_THROW(prepare_recognition_study((folder / "new").string(), false));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "new"));
}

/// Of four objects three are right, each held for right by 0.8: drawn again, three down to one are.
TEST(RecognitionTables, CalibrationErrorsHaveTheirIntervalInPercent) {
  EXPECT_THAT(recognition_tables(written_study()),
              HasSubstr("| random | 75.00 | 80.00 | 5.00 [5.00, 55.00] |\n"));
}

TEST(RecognitionStudy, SummariesAreWrittenFieldByField) {
  using Json = nlohmann::json;
  RecognitionStudy study = written_study();
  study.methods.push_back(method("single view, all features", 2, 1));
  const support::TemporaryDirectory folder;
  write_recognition_study(study, folder.path());
  const Json whole = Json::parse(read_file(folder / "summary.json"));
  const std::vector<MethodSummary> all = summaries(study);
  ASSERT_EQ(whole["methods"].size(), 2U);
  const auto expect_interval = [](const Json& json, const Interval& interval) {
    EXPECT_EQ(json, Json::array({interval.low, interval.high}));
  };
  const auto expect_estimate = [&](const Json& json, const Estimate& estimate) {
    EXPECT_EQ(json["mean"], estimate.mean);
    expect_interval(json["interval"], estimate.interval);
  };
  for (std::size_t m = 0; m < 2; ++m) {
    const Json& json = whole["methods"][m];
    expect_estimate(json["accuracy_percent"], all[m].accuracy_percent);
    expect_estimate(json["observations"], all[m].observations);
    expect_estimate(json["bin_error"], *all[m].bin_error);
    EXPECT_EQ(json["features"], *all[m].features);
    EXPECT_EQ(json["feature_time_s"], *all[m].feature_time_s);
    EXPECT_EQ(json["view_time_s"], *all[m].view_time_s);
    EXPECT_EQ(json["reliability"]["expected_calibration_error"], all[m].reliability->error);
    EXPECT_EQ(json["reliability"]["confidence"], all[m].reliability->confidence);
    expect_interval(json["reliability"]["interval"], all[m].reliability->error_interval);
  }
  const ReliabilityBin& bin = all[0].reliability->bins[12];
  EXPECT_EQ(whole["methods"][0]["reliability"]["bins"][0]["confidence"], bin.confidence);
  expect_interval(whole["methods"][0]["reliability"]["bins"][0]["interval"], bin.interval);
  ASSERT_EQ(whole["methods"][0]["differences"].size(), 1U);
  const Json& difference = whole["methods"][0]["differences"][0];
  EXPECT_EQ(difference["reference"], "single view, all features");
  expect_estimate(difference["accuracy_percent"], all[0].differences.at(0).accuracy_percent);
  expect_estimate(difference["observations"], all[0].differences.at(0).observations);
  EXPECT_EQ(difference["p_value"], all[0].differences.at(0).p_value);
  const Json& unknown = whole["methods"][0]["unknown"];
  EXPECT_EQ(unknown["area_under_curve"], all[0].unknown->area);
  expect_interval(unknown["area_interval"], all[0].unknown->area_interval);
  EXPECT_EQ(unknown["false_alarms_at_90_percent_found"], all[0].unknown->false_alarms);
  expect_interval(unknown["false_alarms_interval"], all[0].unknown->false_alarms_interval);
  EXPECT_EQ(unknown["known_held_for_unknown"], all[0].unknown->known_missed);
  EXPECT_EQ(unknown["category_right_where_known"], 1.0);
  EXPECT_TRUE(whole["methods"][1]["unknown"].is_null());
}

/// Of twelve objects, a trial each, by the seed 9.
TEST(RecognitionStudy, IntervalsAreDrawnByTheNameOfWhatTheyAreOf) {
  RecognitionStudy study = small_study();
  study.options.seed = 9;
  study.methods = {method("random", 0, 1), method("ours", 0, 1)};
  std::vector<std::size_t> marks;
  std::vector<double> views, right, of_category, bins, more_views, more_right;
  for (MethodTrials& one : study.methods) one.trials.resize(12);
  for (int i = 0; i < 12; ++i) {
    for (MethodTrials& one : study.methods) {
      const bool ours = one.method == "ours";
      Trial& trial = one.trials[static_cast<std::size_t>(i)];
      trial.object = i;
      trial.name = "cup_" + std::to_string(i);
      trial.correct = i % (ours ? 2 : 3) == 0;
      trial.category_correct = i % 4 != 1;
      trial.observations = (7919 * i * i + 31 * i) % (ours ? 911 : 977);
      trial.bin_error = (613 * i * i + 7 * i) % 353;
    }
    const Trial& before = study.methods[0].trials[static_cast<std::size_t>(i)];
    const Trial& after = study.methods[1].trials[static_cast<std::size_t>(i)];
    marks.push_back(static_cast<std::size_t>(i));
    right.push_back(after.correct ? 100.0 : 0.0);
    of_category.push_back(after.category_correct ? 100.0 : 0.0);
    views.push_back(after.observations);
    bins.push_back(after.bin_error);
    more_views.push_back(after.observations - before.observations);
    more_right.push_back((after.correct ? 100.0 : 0.0) - (before.correct ? 100.0 : 0.0));
  }
  const Clusters each = clusters_of(marks);
  const auto expect_drawn = [&](const Interval& found, const std::vector<double>& values,
                                const std::string& stream) {
    Rng rng = Rng::stream(9, stream);
    const Interval drawn =
        bootstrap_mean(values, each, rng, {.resamples = 2000, .confidence = 0.95});
    EXPECT_EQ(found.low, drawn.low) << stream;
    EXPECT_EQ(found.high, drawn.high) << stream;
  };
  const MethodSummary ours = summaries(study)[1];
  expect_drawn(ours.accuracy_percent.interval, right, "accuracy ours");
  expect_drawn(ours.category_interval, of_category, "category ours");
  expect_drawn(ours.observations.interval, views, "observations ours");
  expect_drawn(ours.bin_error->interval, bins, "bin error ours");
  ASSERT_EQ(ours.differences.size(), 1U);
  const PairedEstimate& more = ours.differences[0];
  expect_drawn(more.accuracy_percent.interval, more_right, "accuracy ours - random");
  expect_drawn(more.observations.interval, more_views, "observations ours - random");
  Rng chance = Rng::stream(9, "p ours - random");
  EXPECT_EQ(more.p_value, sign_flip_p_value(cluster_sums(more_right, each), chance, 2000));
}

}  // namespace
}  // namespace vantage
