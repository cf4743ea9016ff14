// What is read off an episode's metrics.
#include "src/study/measures.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

Json scan(double left, double actual, double simple, double adaptive, double leg_m) {
  return {{"unobserved_cells", left + 10.0},
          {"observable_unobserved_cells", left},
          {"predicted", {{"simple", simple}, {"adaptive", adaptive}}},
          {"actual_new_cells", actual},
          {"path_length_m", leg_m},
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
           {scan(60.0, 50.0, 0.0, 0.0, 0.0), scan(30.0, 30.0, 40.0, 33.0, 1.5),
            scan(20.0, 10.0, 15.0, 9.0, 3.0)}}};
}

Episode planned_scans(int scans) {
  Episode episode;
  episode.scans = scans;
  return episode;
}

std::optional<double> scalar(const EpisodeMeasures& measures, const char* name) {
  return measures.scalars[*find_scalar(name)];
}

TEST(Measures, AreaSumsTheShareLeft) {
  const auto full = measure(metrics("adaptive"), planned_scans(3));
  EXPECT_DOUBLE_EQ(*scalar(full, "area"), 0.6 + 0.3 + 0.2);
  EXPECT_DOUBLE_EQ(*scalar(full, "observed_share"), 0.8);
}

TEST(Measures, AnEpisodeThatEndsEarlyKeepsItsLastShare) {
  const auto early = measure(metrics("adaptive"), planned_scans(5));
  EXPECT_DOUBLE_EQ(*scalar(early, "area"), 0.6 + 0.3 + 3 * 0.2);
  EXPECT_DOUBLE_EQ(*scalar(early, "scans"), 3.0);
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

}  // namespace
}  // namespace vantage
