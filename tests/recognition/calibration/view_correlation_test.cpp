// How far views of one object repeat each other.
#include "vantage/recognition/calibration/view_correlation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vantage {
namespace {

constexpr int kSeries = 40;
constexpr int kBins = 4;
constexpr int kRecordings = 3;

/// Views whose noise is `shared` to this share of its variance among all of one object in one
/// recording, which is a folder or a video.
double learnt(double shared, int recordings, bool by_video = false) {
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
        const Eigen::Vector3d seen =
            at[object] + std::sqrt(shared) * common + std::sqrt(1.0 - shared) * noise();
        view.features.push_back({seen.cast<float>(), {}});
        shown.push_back(model.states.state(k, i % kBins));
      }
    }
  }
  return learn_view_correlation(views, shown, model, ShrunkVariance{}, 1, {.threads = 2});
}

TEST(ViewCorrelation, IsSmallWhereViewsAreIndependent) { EXPECT_LE(learnt(0.0, kRecordings), 0.1); }

TEST(ViewCorrelation, IsWhatTheViewsOfARecordingShare) {
  const double little = learnt(0.3, kRecordings);
  const double much = learnt(0.8, kRecordings);
  EXPECT_NEAR(little, 0.3, 0.15);
  EXPECT_GE(much, little + 0.2);
}

TEST(ViewCorrelation, OfOneFolderIsThatOfItsVideos) {
  EXPECT_EQ(learnt(0.3, kRecordings, true), learnt(0.3, kRecordings));
}

TEST(ViewCorrelation, OfOneRecordingIsNotTold) { EXPECT_EQ(learnt(0.8, 1), 0.0); }

}  // namespace
}  // namespace vantage
