// What options of mapping tasks come to, and what these tasks say of themselves.
#include "vantage/tasks/mapping/mapping_options.hpp"

#include <gmock/gmock.h>

#include "vantage/tasks/mapping/mapping_run.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(MapOptions, CountTheirCells) {
  MapOptions map;
  EXPECT_EQ(map.count(), 1081665.0);
  map.cells = {3, 4, 7};
  EXPECT_EQ(map.count(), 84.0);
}

TEST(MapOptions, HoldAtMost67MillionCells) {
  MapOptions map;
  EXPECT_NO_THROW(map.check());
  map.cells = {512, 256, 512};
  EXPECT_NO_THROW(map.check());
  map.cells = {512, 257, 512};
  try {
    map.check();
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "cells: 512 x 257 x 512 is more than 2^26 cells");
  }
}

TEST(MapOptions, AreATableTopWhereNothingElseIsSaid) {
  MapOptions map;
  map.size_m = {2.0, 3.0, 0.8};
  EXPECT_NEAR((map.frame().box().min() - Eigen::Vector3d(-1.0, -1.5, 0.582)).norm(), 0.0, 1e-12);
  map.fill_in();
  EXPECT_THAT(*map.centre_m, ElementsAre(0.0, 0.0, 0.982));
  EXPECT_THAT(*map.size_m, ElementsAre(2.0, 3.0, 0.8));
  EXPECT_THAT(*map.cells, ElementsAre(129, 129, 65));
  MapOptions open;
  open.fill_in();
  EXPECT_THAT(*open.size_m, ElementsAre(1.0, 1.0, 0.504));
}

TEST(MappingOptions, TolerateSoManyOfTheLongestEdgeOfACell) {
  MappingOptions options;
  options.map.size_m = {2.0, 1.0, 0.5};
  options.map.cells = {4, 5, 10};
  EXPECT_DOUBLE_EQ(map_tolerance_m(options), 2.0);
  options.localisation.tolerance_cells = 3.0;
  EXPECT_DOUBLE_EQ(map_tolerance_m(options), 1.5);
}

TEST(MappingOptions, AreCalledByWhatTheChoiceGoesBy) {
  MappingOptions options;
  options.gain = SimpleGain{};
  EXPECT_EQ(options.method_name(), "simple");
  options.choice = RandomView{};
  EXPECT_EQ(options.method_name(), "random");
  options.choice = GainOverDistance{};
  EXPECT_EQ(options.method_name(), "gain_over_distance of simple");
}

std::vector<std::string> labels(const MappingOptions& options, const std::vector<Gain>& defaults) {
  std::vector<std::string> names;
  for (const Predictor& predictor : recorded_predictors(options, defaults)) {
    EXPECT_EQ(strategy_name_of(predictor.gain), predictor.label);
    names.push_back(predictor.label);
  }
  return names;
}

TEST(Predictors, AreThoseThatAreNamedAndTheGainInUse) {
  MappingOptions options;
  options.gain = AdaptiveGain{};
  EXPECT_THAT(labels(options, {SimpleGain{}, PosteriorChainGain{}}),
              ElementsAre("simple", "posterior_chain", "adaptive"));
  options.metrics.predictors = {AdaptiveGain{}, SimpleGain{}, SimpleGain{}};
  EXPECT_THAT(labels(options, {PosteriorChainGain{}}), ElementsAre("adaptive", "simple"))
      << "each once";
  options.gain = FsmiGain{};
  options.metrics.predictors = {SimpleGain{}};
  EXPECT_THAT(labels(options, {}), ElementsAre("simple")) << "it counts no cells";
}

TEST(Predictors, PredictCells) {
  MetricsOptions metrics;
  metrics.predictors = {SimpleGain{}, AdaptiveGain{}};
  EXPECT_NO_THROW(metrics.check());
  metrics.predictors.emplace_back(FsmiGain{});
  try {
    metrics.check();
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("predictors: 'fsmi' does not predict cells"));
    EXPECT_THAT(error.what(), HasSubstr("simple, posterior_chain"));
  }
}

TEST(MappingTasks, SayHowLongTheyAreAndWhereTheyLook) {
  MappingOptions options;
  options.scans = 7;
  options.gain = FsmiGain{};
  options.map.centre_m = {1.0, 2.0, 3.0};
  options.map.size_m = {4.0, 6.0, 1.0};
  options.map.cells = {4, 3, 2};
  const TaskExtent extent = mapping_extent(options);
  EXPECT_EQ(extent.key, "scans");
  EXPECT_EQ(extent.text, "scans");
  EXPECT_EQ(extent.count, 7U);
  const WindowContent window = mapping_window(options);
  EXPECT_EQ(window.scans, 7U);
  EXPECT_EQ(window.gain_unit, "bits");
  EXPECT_EQ(window.step_word, "scan");
  EXPECT_FALSE(window.follows_height);
  ASSERT_TRUE(window.map);
  EXPECT_EQ(window.map->size(), 24U);
  EXPECT_NEAR((window.overview_m.min() - Eigen::Vector2d(-1.0, -1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((window.overview_m.max() - Eigen::Vector2d(3.0, 5.0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(mapping_report().map);
  EXPECT_FALSE(mapping_report().scene);
}

}  // namespace
}  // namespace vantage
