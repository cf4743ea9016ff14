// How far views of one object repeat each other.
#include "vantage/recognition/calibration/view_correlation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vantage {
namespace {

constexpr int kSeries = 40;
constexpr int kBins = 4;
constexpr int kRecordings = 3;

/// Views whose noise is `shared` to this share of its variance among all of one object in one
/// recording, which is a folder or a video.
/// @param beside_a_mute of two features, the first of which tells nothing
/// @param burst that many first views of each series share all of their noise
/// @param elevations_deg of each recording; empty: one of all
double learnt(double shared, int recordings, bool by_video = false, bool beside_a_mute = false,
              int burst = 0, const std::vector<double>& elevations_deg = {}) {
  RecognitionModel model;
  model.states.bins = kBins;
  model.states.categories = {"cup"};
  FeatureModel& feature = model.features.emplace_back();
  feature.name = "colour";
  feature.statistics = empty_statistics(3, kSeries * kBins);
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  Rng rng(1);
  const auto noise = [&] { return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()); };
  std::vector<Eigen::Vector3d> at;
  for (int k = 0; k < kSeries; ++k) {
    model.states.objects.push_back(fmt::format("cup_{}", k));
    model.states.category_of.push_back(0);
    at.emplace_back(1.2 * noise());
  }
  for (int recording = 0; recording < recordings; ++recording) {
    for (int k = 0; k < kSeries; ++k) {
      const auto object = static_cast<std::size_t>(k);
      const Eigen::Vector3d common = noise();
      for (int i = 0; i < 4 * kBins; ++i) {
        ViewFeatures& view = views.emplace_back();
        view.name = {
            .category = "cup", .object = model.states.objects[object], .video = 1, .frame = i};
        if (by_video) view.name.video += recording;
        view.folder = fmt::format("/data/{}/cup/{}", by_video ? 0 : recording, view.name.object);
        view.yaw_rad = (i % kBins) * 2.0 * std::numbers::pi / kBins;
        if (!elevations_deg.empty()) {
          const double elevation_deg = elevations_deg[static_cast<std::size_t>(recording)];
          view.elevation_rad = elevation_deg * std::numbers::pi / 180.0;
        }
        const double of_all = i < burst ? 1.0 : shared;
        const Eigen::Vector3d seen =
            at[object] + std::sqrt(of_all) * common + std::sqrt(1.0 - of_all) * noise();
        view.features.push_back({seen.cast<float>(), {}});
        shown.push_back(model.states.state(k, i % kBins));
      }
    }
  }
  if (beside_a_mute) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto number = static_cast<float>(i % 3);
      views[i].features.insert(views[i].features.begin(),
                               FeatureResult{Eigen::VectorXf::Constant(1, number), {}});
    }
    FeatureModel mute = model.features[0];
    mute.statistics = empty_statistics(1, kSeries * kBins);
    mute.psi = 0.0;
    model.features.insert(model.features.begin(), mute);
  }
  return learn_view_correlation(views, shown, model, ShrunkVariance{}, 1, {.threads = 2});
}

TEST(ViewCorrelation, IsSmallWhereViewsAreIndependent) { EXPECT_LE(learnt(0.0, kRecordings), 0.1); }

TEST(ViewCorrelation, IsWhatTheViewsOfARecordingShare) {
  const double little = learnt(0.3, kRecordings);
  const double much = learnt(0.8, kRecordings);
  EXPECT_NEAR(little, 0.3, 0.15);
  EXPECT_GE(much, little + 0.2);
  EXPECT_NEAR(20.0 * little, std::round(20.0 * little), 1e-9) << "in twentieths";
}

TEST(ViewCorrelation, OfOneFolderIsThatOfItsVideos) {
  EXPECT_EQ(learnt(0.3, kRecordings, true), learnt(0.3, kRecordings));
}

TEST(ViewCorrelation, OfOneRecordingIsNotTold) { EXPECT_EQ(learnt(0.8, 1), 0.0); }

TEST(ViewCorrelation, IsOfAllFeaturesTogether) {
  EXPECT_EQ(learnt(0.3, kRecordings, false, true), learnt(0.3, kRecordings));
}

/// Two objects of the same four sides, the other way round: only turning tells them, by views that
/// are independent. Held to turn the other way, each would be taken for the other.
TEST(ViewCorrelation, GoesByHowTheObjectTurns) {
  RecognitionModel model;
  model.states = {
      .objects = {"cup_0", "cup_1"}, .categories = {"cup"}, .category_of = {0, 0}, .bins = kBins};
  FeatureModel& feature = model.features.emplace_back();
  feature.name = "colour";
  feature.statistics = empty_statistics(1, 2 * kBins);
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  Rng rng(1);
  for (int recording = 0; recording < kRecordings; ++recording) {
    for (int i = 0; i < 8 * kBins; ++i) {
      const int object = i % 2;
      const int bin = i / 2 % kBins;
      const int side = object == 0 ? bin : (kBins - bin) % kBins;
      ViewFeatures& view = views.emplace_back();
      view.name = {.category = "cup",
                   .object = model.states.objects[static_cast<std::size_t>(object)],
                   .video = 1,
                   .frame = i};
      view.folder = fmt::format("/data/{}/cup/{}", recording, view.name.object);
      view.yaw_rad = bin * 2.0 * std::numbers::pi / kBins;
      view.features.push_back(
          {Eigen::VectorXf::Constant(1, static_cast<float>(10.0 * side + rng.normal())), {}});
      shown.push_back(model.states.state(object, bin));
    }
  }
  EXPECT_LE(learn_view_correlation(views, shown, model, ShrunkVariance{}, 1, {}), 0.1);
}

/// Six of sixteen views are alike.
TEST(ViewCorrelation, IsOfViewsFromAllOverTheTurntable) {
  EXPECT_LE(learnt(0.0, kRecordings, false, false, 6), 0.5);
}

/// Objects look different from above, which is no repetition.
TEST(ViewCorrelation, OfVideosFromOtherElevationsIsNotTold) {
  EXPECT_GE(learnt(0.8, 2, true), 0.5);
  EXPECT_EQ(learnt(0.8, 2, true, false, 0, {30.0, 60.0}), 0.0);
  EXPECT_EQ(learnt(0.8, 2, false, false, 0, {30.0, 60.0}), 0.0) << "of folders";
  EXPECT_EQ(learnt(0.8, 2, true, false, 0, {30.0, 39.0}), learnt(0.8, 2, true));
  EXPECT_EQ(learnt(0.8, 2, true, false, 0, {41.0, 30.0}), 0.0);
}

/// What is learnt of 250 objects, seen by a number, and how many items of each part of the work
/// were told of.
/// @param elevations_deg of each recording's views, one after the other; empty: one of all
/// @param first_deg elevation of the very first view; nothing: as the others
std::pair<double, std::map<std::string, std::size_t>> learnt_of_many(
    int recordings, int views_each, const std::vector<std::vector<double>>& elevations_deg = {},
    std::optional<double> first_deg = {}) {
  constexpr int kMany = 250;
  RecognitionModel model;
  model.states.bins = 1;
  model.states.categories = {"cup"};
  FeatureModel& feature = model.features.emplace_back();
  feature.name = "colour";
  feature.statistics = empty_statistics(1, kMany);
  std::vector<ViewFeatures> views;
  std::vector<int> shown;
  Rng rng(1);
  for (int k = 0; k < kMany; ++k) {
    model.states.objects.push_back(fmt::format("cup_{}", k));
    model.states.category_of.push_back(0);
    for (int i = 0; i < recordings * views_each; ++i) {
      ViewFeatures& view = views.emplace_back();
      view.name = {
          .category = "cup", .object = model.states.objects.back(), .video = 1, .frame = i};
      view.folder = fmt::format("/data/{}/cup/{}", i / views_each, view.name.object);
      if (!elevations_deg.empty()) {
        const auto& of_recording = elevations_deg[static_cast<std::size_t>(i / views_each)];
        const auto at = static_cast<std::size_t>(i % views_each) % of_recording.size();
        view.elevation_rad = of_recording[at] * std::numbers::pi / 180.0;
      }
      const auto number = static_cast<float>(3.0 * k + rng.normal());
      view.features.push_back({Eigen::VectorXf::Constant(1, number), {}});
      shown.push_back(k);
    }
  }
  if (first_deg) views.front().elevation_rad = *first_deg * std::numbers::pi / 180.0;
  std::map<std::string, std::size_t> told;
  const LongWork how{
      .tell = [&](const std::string& part, std::size_t, std::size_t of) { told[part] = of; }};
  const double correlation = learn_view_correlation(views, shown, model, ShrunkVariance{}, 1, how);
  return {correlation, told};
}

TEST(ViewCorrelation, IsOf240WalksOfAllRecordings) {
  const auto [correlation, told] = learnt_of_many(2, 2);
  EXPECT_EQ(told.at("views that repeat each other"), 120U);
  EXPECT_EQ(told.at("correlation of views"), 240U);
  EXPECT_LE(correlation, 1.0);
  EXPECT_TRUE(learnt_of_many(1, 2).second.empty()) << "of one recording";
}

/// By the same product and quotient: each is as high as the other, to the bit.
TEST(ViewCorrelation, IsOfRecordingsTenDegreesApart) {
  const auto told = learnt_of_many(2, 2, {{0.0}, {10.0}}).second;
  EXPECT_EQ(told.at("views that repeat each other"), 120U);
  EXPECT_EQ(told.at("correlation of views"), 240U);
}

/// One view of the first recording is seen from between the two.
TEST(ViewCorrelation, IsOfRecordingsThatASingleViewIsAsHighAs) {
  EXPECT_TRUE(learnt_of_many(2, 2, {{30.0}, {55.0}}).second.empty());
  const auto told = learnt_of_many(2, 2, {{30.0}, {55.0}}, 46.0).second;
  EXPECT_EQ(told.at("views that repeat each other"), 120U) << "of the second one";
}

/// Of three recordings two are seen from lower or higher than all others.
TEST(ViewCorrelation, IsOfRecordingsWhoseElevationsOthersLieRound) {
  const auto told = learnt_of_many(3, 2, {{30.0}, {45.0}, {60.0}}).second;
  EXPECT_EQ(told.at("views that repeat each other"), 240U) << "of the middle one";
  EXPECT_EQ(told.at("correlation of views"), 240U);
}

/// The third view of each series of the first recording is seen from where no other one is.
TEST(ViewCorrelation, IsOfTheViewsThatOthersAreAsHighAs) {
  EXPECT_EQ(learnt_of_many(2, 3, {{30.0, 30.0, 75.0}, {30.0}}).second.at("correlation of views"),
            240U);
  EXPECT_TRUE(learnt_of_many(2, 1, {{75.0}, {30.0}}).second.empty());
}

TEST(ViewCorrelation, OfSingleViewsIsNone) { EXPECT_EQ(learnt_of_many(2, 1).first, 0.0); }

}  // namespace
}  // namespace vantage
