// From episodes whose results are written by hand to the tables and figures of their study.
#include "vantage/study/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/study/manifest_of_files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/study/collect.hpp"
#include "vantage/study/results_csv.hpp"
#include "vantage/study/study_page.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

class Evaluated : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_ / "study.yaml", R"(title: By hand
episode: assets/episodes/tabletop.yaml
factors:
  start: {near: {robot.start_view: 0}, far: {robot.start_view: 5}}
  method: {random: {choice: random}, simple: {gain: simple}}
report: {compare: method, reference: random, panels: start, tables: [area], curves: [share_left],
  predictors_along: simple}
)");
    results_.study = read_study(folder_ / "study.yaml");
    results_.directory = folder_.path();
    results_.plan = plan_study(results_.study);
    results_.states = {EpisodeState::completed, EpisodeState::completed, EpisodeState::failed,
                       EpisodeState::missing};
    results_.measures.resize(4);
    put(0, 3.0, {0.9, 0.7}, {});
    put(1, 1.5, {0.8, 0.5, 0.2}, {{"simple", {10.0, 5.0}}, {"adaptive", {2.0}}});
    put(2, 7.0, {0.6}, {});
  }

  void put(std::size_t episode, double area, const Curve& share_left,
           const PredictionErrors& errors) {
    EpisodeMeasures& taken = results_.measures[episode].emplace();
    taken.scalars.resize(scalar_measures().size());
    taken.curves.resize(curve_measures().size());
    taken.scalars[*find_scalar("area")] = area;
    taken.curves[*find_curve("share_left")] = share_left;
    taken.prediction_errors = errors;
    const fs::path folder = episode_folder(folder_.path(), results_.plan[episode]);
    fs::create_directories(folder);
    const Json metrics = {{"state_hash", "00ff"},
                          {"wall_time_s", 12.5},
                          {"real_time_factor", 1.75},
                          {"scans",
                           {{{"plan_time_s", 0.25}, {"map_time_s", 2.0}},
                            {{"plan_time_s", 0.5}, {"map_time_s", 4.0}}}}};
    write_file(folder / "metrics.json", metrics.dump());
    write_file(folder / "manifest.json",
               R"({"threads": 3, "cpu": "fast, really", "versions": {"vantage": "abc"}})");
  }
  /// Of a table by the name of its column.
  CsvTable table(const std::string& csv) {
    write_file(folder_ / "table.csv", csv);
    return read_csv(folder_ / "table.csv");
  }
  static std::string field(const CsvTable& table, std::size_t row, const std::string& column) {
    const auto found = std::ranges::find(table.columns, column);
    if (found == table.columns.end()) return "no column";
    return table.rows.at(row)[static_cast<std::size_t>(found - table.columns.begin())];
  }

  support::TemporaryDirectory folder_;
  StudyResults results_;
};

TEST_F(Evaluated, ResultsHaveARowAnEpisode) {
  const CsvTable csv = table(results_csv(results_));
  ASSERT_EQ(csv.rows.size(), 4U);
  EXPECT_THAT(std::vector(csv.columns.begin(), csv.columns.begin() + 4),
              ElementsAre("episode", "start", "method", "status"));
  EXPECT_EQ(field(csv, 1, "episode"), "near/simple");
  EXPECT_EQ(field(csv, 1, "start"), "near");
  EXPECT_EQ(field(csv, 1, "method"), "simple");
  EXPECT_EQ(field(csv, 1, "status"), "completed");
  EXPECT_EQ(field(csv, 1, "area"), "1.5");
  EXPECT_EQ(field(csv, 1, "recall"), "");
  EXPECT_EQ(field(csv, 1, "prediction_error_simple_cells"), "7.5");
  EXPECT_EQ(field(csv, 1, "prediction_error_adaptive_cells"), "2");
  EXPECT_EQ(field(csv, 0, "prediction_error_simple_cells"), "");
  EXPECT_EQ(field(csv, 1, "state_hash"), "00ff");
  EXPECT_EQ(field(csv, 1, "commit"), "abc");
  EXPECT_EQ(field(csv, 2, "status"), "failed");
  EXPECT_EQ(field(csv, 2, "area"), "7");
  EXPECT_EQ(field(csv, 3, "status"), "missing");
  for (const char* empty : {"area", "state_hash", "config_hash", "commit"}) {
    EXPECT_EQ(field(csv, 3, empty), "") << empty;
  }
  for (const char* wall : {"wall_time_s", "real_time_factor", "threads"}) {
    EXPECT_EQ(field(csv, 1, wall), "no column") << wall;
  }
}

TEST_F(Evaluated, TheHashOfAConfigurationIsThatOfAnyThreads) {
  const auto hashes = [&] {
    const CsvTable csv = table(results_csv(results_));
    return std::vector{field(csv, 0, "config_hash"), field(csv, 1, "config_hash")};
  };
  const std::vector<std::string> before = hashes();
  EXPECT_NE(before[0], before[1]);
  results_.plan[1].resolved.setup.options.threads = 7;
  EXPECT_EQ(hashes(), before);
  results_.plan[1].resolved.setup.options.seed = 77;
  EXPECT_EQ(hashes()[0], before[0]);
  EXPECT_NE(hashes()[1], before[1]);
}

TEST_F(Evaluated, TimingsAreOfWhatCameToSomething) {
  const CsvTable csv = table(timings_csv(results_));
  ASSERT_EQ(csv.rows.size(), 3U);
  EXPECT_EQ(field(csv, 1, "episode"), "near/simple");
  EXPECT_EQ(field(csv, 1, "wall_time_s"), "12.5");
  EXPECT_EQ(field(csv, 1, "real_time_factor"), "1.75");
  EXPECT_EQ(field(csv, 1, "plan_time_s"), "0.75");
  EXPECT_EQ(field(csv, 1, "map_time_s"), "6");
  EXPECT_EQ(field(csv, 1, "threads"), "3");
  EXPECT_EQ(field(csv, 1, "cpu"), "fast, really");
  EXPECT_EQ(field(csv, 1, "area"), "no column");
}

TEST_F(Evaluated, TablesCompareWhatCameToSomething) {
  const Evaluation evaluation = evaluate(results_);
  ASSERT_EQ(evaluation.comparisons.size(), 2U);
  const Comparison& area = evaluation.comparisons[0];
  EXPECT_EQ(area.name, "area");
  EXPECT_EQ(area.reference, "random");
  EXPECT_EQ(area.better, Better::lower);
  const auto row = [&](std::size_t i) {
    const ComparisonRow& r = area.rows[i];
    return r.panel + " " + r.level;
  };
  ASSERT_EQ(area.rows.size(), 5U);
  EXPECT_EQ(row(0), "near random");
  EXPECT_EQ(row(1), "near simple");
  EXPECT_EQ(row(2), "far random");
  EXPECT_EQ(row(3), "all random");
  EXPECT_EQ(row(4), "all simple");
  EXPECT_EQ(area.rows[1].mean, 1.5);
  EXPECT_DOUBLE_EQ(area.rows[1].difference->mean, -1.5);
  EXPECT_DOUBLE_EQ(area.rows[3].mean, 5.0);
  EXPECT_EQ(area.rows[4].difference->pairs, 1U);
}

TEST_F(Evaluated, CurvesHaveAPanelALevelAndASeriesAMethod) {
  const Evaluation evaluation = evaluate(results_);
  ASSERT_EQ(evaluation.figures.size(), 2U);
  const Figure& figure = evaluation.figures[0];
  EXPECT_EQ(figure.name, "share_left");
  EXPECT_EQ(figure.title, "By hand");
  EXPECT_EQ(figure.x_label, "scans");
  EXPECT_EQ(figure.note.find("resampled by"), std::string::npos);
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_EQ(figure.panels[0].title, "near");
  ASSERT_EQ(figure.panels[0].series.size(), 2U);
  ASSERT_EQ(figure.panels[1].series.size(), 1U) << "of the missing one there is nothing";
  const FigureSeries& simple = figure.panels[0].series[1];
  EXPECT_EQ(simple.name, "simple");
  EXPECT_EQ(simple.style, 1U);
  ASSERT_EQ(simple.points.size(), 3U);
  EXPECT_EQ(simple.points[0].x, 1.0);
  EXPECT_EQ(simple.points[2].x, 3.0);
  EXPECT_EQ(simple.points[2].mean, 0.2);
  EXPECT_EQ(figure.panels[1].series[0].name, "random");
  results_.study.report.cluster = "start";
  EXPECT_THAT(evaluate(results_).figures[0].note, HasSubstr("resampled by start."));
}

/// Of the episodes of one method, from the second scan on.
TEST_F(Evaluated, PredictorsAreComparedAlongOneMethod) {
  const Evaluation evaluation = evaluate(results_);
  const Comparison& errors = evaluation.comparisons[1];
  EXPECT_EQ(errors.name, "predictors");
  EXPECT_EQ(errors.reference, "simple") << "the first, as the reference predicts nothing";
  EXPECT_THAT(errors.title, HasSubstr("along the episodes of simple, lower is better"));
  ASSERT_EQ(errors.rows.size(), 4U);
  EXPECT_EQ(errors.rows[0].level, "simple");
  EXPECT_EQ(errors.rows[0].mean, 7.5);
  EXPECT_EQ(errors.rows[1].level, "adaptive");
  EXPECT_DOUBLE_EQ(errors.rows[1].difference->mean, -5.5);
  const Figure& figure = evaluation.figures[1];
  EXPECT_EQ(figure.y_label, "absolute prediction error, cells");
  EXPECT_EQ(figure.subtitle, errors.title);
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_TRUE(figure.panels[1].series.empty());
  ASSERT_EQ(figure.panels[0].series.size(), 2U);
  const std::vector<FigurePoint>& points = figure.panels[0].series[0].points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].x, 2.0);
  EXPECT_EQ(points[0].mean, 10.0);
  EXPECT_EQ(points[1].x, 3.0);
  EXPECT_EQ(figure.panels[0].series[1].points.size(), 1U);
}

TEST_F(Evaluated, ACollectionSaysHowFarTheStudyIs) {
  const Evaluation evaluation = evaluate(results_);
  write_collection(results_, evaluation);
  const Json summary = Json::parse(read_file(folder_ / "summary.json"));
  EXPECT_EQ(summary["title"], "By hand");
  EXPECT_EQ(summary["episodes"], 4);
  EXPECT_EQ(summary["completed"], 2);
  EXPECT_EQ(summary["not_completed"], Json({{"far/random", "failed"}, {"far/simple", "missing"}}));
  EXPECT_EQ(summary["compare"], "method");
  EXPECT_EQ(summary["reference"], "random");
  EXPECT_EQ(summary["tables"]["area"]["near"]["simple"]["mean"], 1.5);
  for (const char* file : {"results.csv", "timings.csv", "summary.md", "tables/area.csv",
                           "tables/area.md", "tables/predictors.csv", "figures/share_left.svg",
                           "figures/share_left.csv", "figures/predictors.md"}) {
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  }
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".collection"));
  }
  const TextTable overview = study_overview(evaluation);
  EXPECT_EQ(overview.header.size(), 2U) << "predictors are no methods";
  EXPECT_THAT(study_verdicts(evaluation),
              ElementsAre("simple against random: area -1.5, no interval (1 pair)"));
  EXPECT_THAT(study_summary(results_, evaluation),
              testing::EndsWith("\n\n- simple against random: area -1.5, no interval (1 pair)\n"));
  EXPECT_FALSE(results_.complete());
  results_.states.assign(4, EpisodeState::completed);
  EXPECT_TRUE(results_.complete());
}

/// As metrics.json has it.
Json one_scan() {
  return {{"unobserved_cells", 70.0},
          {"observable_unobserved_cells", 60.0},
          {"predicted", {{"simple", 0.0}}},
          {"actual_new_cells", 40.0},
          {"path_length_m", 1.5},
          {"leg_length_m", 1.5},
          {"pose_error_m", 0.002},
          {"pose_error_before_registration_m", 0.02},
          {"fallback", false},
          {"precision", 1.0},
          {"recall", 0.5}};
}

/// One of the four has come to a result.
TEST_F(Evaluated, MeasuresAreReadFromTheFoldersOfTheEpisodes) {
  const PlannedEpisode& episode = results_.plan[1];
  const fs::path folder = episode_folder(folder_.path(), episode);
  const Json metrics = {{"status", "completed"},
                        {"method", "simple"},
                        {"observable_cells", 100.0},
                        {"path_length_m", 1.5},
                        {"collisions", 0},
                        {"simulated_time_s", 60.0},
                        {"map", {{"precision", 0.9}, {"recall", 0.8}}},
                        {"scans", Json::array({one_scan()})}};
  write_file(folder / "config.yaml", episode_yaml(episode.resolved));
  write_file(folder / "manifest.json", manifest_of_files(episode.resolved));
  write_file(folder / "metrics.json", metrics.dump());
  const StudyResults read = read_study_results(folder_.path());
  ASSERT_EQ(read.measures.size(), 4U);
  EXPECT_EQ(read.states[1], EpisodeState::completed);
  ASSERT_TRUE(read.measures[1]);
  EXPECT_EQ(read.measures[1]->scalars[*find_scalar("path_length_m")], 1.5);
  EXPECT_FALSE(read.measures[0]);
}

TEST_F(Evaluated, PredictorsAreHeldAgainstThatOfTheReference) {
  put(1, 1.5, {0.8, 0.5, 0.2}, {{"adaptive", {2.0}}, {"simple", {10.0, 5.0}}});
  results_.study.report.reference = "simple";
  const Evaluation evaluation = evaluate(results_);
  const Comparison& errors = evaluation.comparisons[1];
  EXPECT_EQ(errors.reference, "simple");
  ASSERT_TRUE(errors.rows[0].difference);
  EXPECT_DOUBLE_EQ(errors.rows[0].difference->mean, 2.0 - 7.5);
}

TEST_F(Evaluated, TheReferenceMayBeOfTheFirstEpisodeAlone) {
  results_.plan.resize(2);
  results_.states.resize(2);
  results_.measures.resize(2);
  put(1, 1.5, {0.8}, {{"adaptive", {2.0}}, {"random", {10.0}}});
  EXPECT_EQ(evaluate(results_).comparisons[1].reference, "random");
}

TEST_F(Evaluated, WithoutPredictionsNoPredictorsAreCompared) {
  put(1, 1.5, {0.8, 0.5, 0.2}, {});
  const Evaluation evaluation = evaluate(results_);
  ASSERT_EQ(evaluation.comparisons.size(), 1U);
  EXPECT_EQ(evaluation.comparisons[0].name, "area");
  ASSERT_EQ(evaluation.figures.size(), 1U);
  EXPECT_EQ(evaluation.figures[0].name, "share_left");
}

/// A run that is whole, but for how it ended.
TEST_F(Evaluated, WhatFailedIsMeasuredAndWhatDivergedIsNot) {
  const PlannedEpisode& episode = results_.plan[1];
  const fs::path folder = episode_folder(folder_.path(), episode);
  write_file(folder / "config.yaml", episode_yaml(episode.resolved));
  write_file(folder / "manifest.json", manifest_of_files(episode.resolved));
  Json metrics = {{"method", "simple"},       {"observable_cells", 100.0},
                  {"path_length_m", 1.5},     {"collisions", 0},
                  {"simulated_time_s", 60.0}, {"map", {{"precision", 0.9}, {"recall", 0.8}}}};
  metrics["scans"] = Json::array({one_scan()});
  const auto is_measured = [&](const char* status) {
    metrics["status"] = status;
    write_file(folder / "metrics.json", metrics.dump());
    return read_study_results(folder_.path()).measures[1].has_value();
  };
  EXPECT_TRUE(is_measured("completed"));
  EXPECT_TRUE(is_measured("failed"));
  EXPECT_FALSE(is_measured("diverged"));
  EXPECT_FALSE(is_measured("interrupted"));
  metrics.erase("map");
  try {
    is_measured("completed");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith((folder / "metrics.json: ").string()));
  }
}

/// Then `path_length_m` of a scan was the length of its leg.
TEST_F(Evaluated, MetricsOfAFormerVersionMeanWhatTheySaid) {
  write_file(episode_folder(folder_.path(), results_.plan[1]) / "metrics.json",
             R"({"scans": [{"path_length_m": 1.5}, {"path_length_m": 2.0}]})");
  const Json now = Json::parse(R"({"scans": [{"path_length_m": 1.5, "leg_length_m": 1.5},
                                             {"path_length_m": 3.5, "leg_length_m": 2.0}]})");
  EXPECT_EQ(episode_metrics(results_, 1), now);
  EXPECT_TRUE(episode_metrics(results_, 3).is_null()) << "of one that is missing";
}

TEST_F(Evaluated, AFileThatHoldsSomethingOfAnotherKindIsNamed) {
  const fs::path folder = episode_folder(folder_.path(), results_.plan[1]);
  write_file(folder / "metrics.json", R"({"state_hash": 5, "wall_time_s": "long"})");
  for (const auto& csv : {results_csv, timings_csv}) {
    try {
      csv(results_);
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  testing::StartsWith(folder.string() + ": metrics.json or manifest.json: "));
    }
  }
}

/// What comes after it counts all the same.
TEST_F(Evaluated, WhatIsMissingHidesNothing) {
  results_.measures[0].reset();
  const Evaluation evaluation = evaluate(results_);
  ASSERT_EQ(evaluation.comparisons.size(), 2U);
  ASSERT_EQ(evaluation.comparisons[0].rows.size(), 4U);
  EXPECT_EQ(evaluation.comparisons[0].rows[0].level, "simple");
  ASSERT_EQ(evaluation.figures[0].panels[0].series.size(), 1U);
  EXPECT_EQ(evaluation.figures[0].panels[0].series[0].name, "simple");
  EXPECT_EQ(field(table(results_csv(results_)), 1, "prediction_error_simple_cells"), "7.5");
  EXPECT_EQ(table(timings_csv(results_)).rows.size(), 2U);
}

/// Of two starts: a curve that has ended keeps its last value, but nothing is predicted after it.
TEST_F(Evaluated, CurvesOfOnePanelAreAveraged) {
  results_.study.report.panels.clear();
  put(0, 3.0, {0.9, 0.7}, {{"simple", {100.0}}, {"other", {1.0}}});
  put(3, 2.0, {0.5}, {{"adaptive", {4.0, 8.0}}});
  const Evaluation evaluation = evaluate(results_);
  const std::vector<FigurePoint>& random = evaluation.figures[0].panels.at(0).series.at(0).points;
  ASSERT_EQ(random.size(), 2U);
  EXPECT_EQ(random[1].count, 2U);
  EXPECT_DOUBLE_EQ(random[1].mean, 0.65);
  const Comparison& errors = evaluation.comparisons.at(1);
  ASSERT_EQ(errors.rows.size(), 2U) << "what is predicted along another method is left out";
  EXPECT_DOUBLE_EQ(errors.rows[0].mean, 7.5);
  EXPECT_EQ(errors.rows[1].level, "adaptive");
  EXPECT_EQ(errors.rows[1].count, 2U);
  EXPECT_DOUBLE_EQ(errors.rows[1].mean, 4.0);
  const std::vector<FigurePoint>& adaptive = evaluation.figures[1].panels.at(0).series.at(1).points;
  ASSERT_EQ(adaptive.size(), 2U);
  EXPECT_EQ(adaptive[1].count, 1U);
  EXPECT_EQ(adaptive[1].mean, 8.0);
}

TEST_F(Evaluated, PredictorsMayBeThoseOfTheFirstEpisodeAlone) {
  results_.study.report.predictors_along = "random";
  put(0, 3.0, {0.9, 0.7}, {{"simple", {3.0}}});
  const Evaluation evaluation = evaluate(results_);
  ASSERT_EQ(evaluation.comparisons.size(), 2U);
  ASSERT_FALSE(evaluation.comparisons[1].rows.empty());
  EXPECT_EQ(evaluation.comparisons[1].rows[0].panel, "near");
  EXPECT_EQ(evaluation.comparisons[1].rows[0].mean, 3.0);
}

TEST_F(Evaluated, WhatIsAlikeIsSaidOfTablesAndPredictors) {
  results_.study.report.cluster = "start";
  const Evaluation evaluation = evaluate(results_);
  EXPECT_EQ(evaluation.comparisons[0].cluster, "start");
  EXPECT_EQ(evaluation.comparisons[1].cluster, "start");
  EXPECT_EQ(evaluation.comparisons[1].better, Better::lower);
  EXPECT_THAT(evaluation.figures[1].note, HasSubstr("resampled by start."));
}

TEST_F(Evaluated, StepsAreCalledAsThoseOfTheFirstEpisode) {
  results_.plan.back().resolved.task = RecognitionTask{};
  EXPECT_EQ(evaluate(results_).figures[0].x_label, "scans");
}

TEST_F(Evaluated, VerdictsAreTheItemsOfOneList) {
  Evaluation evaluation = evaluate(results_);
  evaluation.comparisons.push_back(Comparison(evaluation.comparisons[0]));
  const std::string item = "- simple against random: area -1.5, no interval (1 pair)\n";
  EXPECT_THAT(study_summary(results_, evaluation), testing::EndsWith("\n\n" + item + item));
}

TEST_F(Evaluated, ACollectionThatCannotBeWrittenLeavesNothingBehind) {
  write_file(folder_ / "tables", "no folder");
  EXPECT_THROW(write_collection(results_, evaluate(results_)), OutputError);
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".collection")) << entry.path();
  }
}

TEST_F(Evaluated, TheFirstEpisodeIsReadAsTheOthers) {
  const PlannedEpisode& episode = results_.plan[0];
  const fs::path folder = episode_folder(folder_.path(), episode);
  write_file(folder / "config.yaml", episode_yaml(episode.resolved));
  write_file(folder / "manifest.json", manifest_of_files(episode.resolved));
  Json metrics = {{"status", "completed"},
                  {"method", "random"},
                  {"observable_cells", 100.0},
                  {"path_length_m", 1.5},
                  {"collisions", 0},
                  {"simulated_time_s", 60.0},
                  {"scans", Json::array({one_scan()})}};
  metrics["map"] = {{"precision", 0.9}, {"recall", 0.8}};
  write_file(folder / "metrics.json", metrics.dump());
  EXPECT_TRUE(read_study_results(folder_.path()).measures.at(0));
}

TEST_F(Evaluated, TimesAndMachinesThatAreNotToldAreNone) {
  const fs::path folder = episode_folder(folder_.path(), results_.plan[1]);
  write_file(folder / "metrics.json", R"({"scans": [{}]})");
  fs::remove(folder / "manifest.json");
  const CsvTable csv = table(timings_csv(results_));
  for (const char* none :
       {"wall_time_s", "real_time_factor", "plan_time_s", "map_time_s", "threads"}) {
    EXPECT_EQ(field(csv, 1, none), "0") << none;
  }
  EXPECT_EQ(field(csv, 1, "cpu"), "");
}

TEST_F(Evaluated, APageHoldsStatusVerdictsFiguresAndTables) {
  write_study_page(results_, evaluate(results_));
  const std::string page = read_file(folder_ / "report.html");
  for (const char* part :
       {"2 completed, 1 failed, 1 missing of 4 episodes",
        "<ul>\n<li>simple against random: area -1.5, no interval (1 pair)</li>\n</ul>\n",
        "<section class=\"panel figure\">\n<svg ",
        "<details><summary>absolute prediction error, cells, along the episodes of simple, "
        "lower is better</summary>\n"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
}

}  // namespace
}  // namespace vantage
