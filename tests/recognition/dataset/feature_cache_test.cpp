#include "vantage/recognition/dataset/feature_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <set>

#include "tests/recognition/painted_dataset.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/bytes.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

class FeatureCaching : public ::testing::Test {
 protected:
  FeatureCaching() { test::put_painted_object(folder_.path() / "data", {"cup", "cup_1", 0}, 8); }

  [[nodiscard]] std::vector<ViewFeatures> extract(const fs::path& cache,
                                                  const Colour& colour = {}) const {
    const std::vector<TrainedFeature> extractors{TrainedFeature(colour, 0.0),
                                                 TrainedFeature(Vfh{.min_points = 100000}, 0.0)};
    return extract_features(index_dataset(folder_.path() / "data").views, extractors,
                            {.feature_cache = cache}, "extracting");
  }
  [[nodiscard]] std::vector<fs::path> files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "cache")) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
  }
  [[nodiscard]] fs::path cache() const { return folder_.path() / "cache"; }

  support::TemporaryDirectory folder_;
};

void expect_equal(const std::vector<ViewFeatures>& a, const std::vector<ViewFeatures>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].yaw_rad, b[i].yaw_rad);
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_EQ(a[i].features[f].vector, b[i].features[f].vector);
      EXPECT_EQ(a[i].features[f].skipped, b[i].features[f].skipped);
    }
  }
}

TEST_F(FeatureCaching, GivesWhatExtractionGives) {
  const auto plain = extract({});
  EXPECT_FALSE(plain[0].features[1].extracted());  // a reason is kept as well
  expect_equal(extract(cache()), plain);
  const auto kept = files();
  EXPECT_EQ(kept.size(), 2U);
  expect_equal(extract(cache()), plain);
  EXPECT_EQ(files(), kept);
}

TEST_F(FeatureCaching, ViewsAreAsHighAsTheirVideos) {
  for (const ViewFeatures& view : extract({})) {
    EXPECT_EQ(view.elevation_rad, video_elevation_rad(view.name.video));
  }
}

TEST_F(FeatureCaching, AnotherPictureIsAnotherView) {
  const auto before = extract(cache());
  const ViewEntry first = index_dataset(folder_.path() / "data").views.front();
  const std::uint64_t hash = view_hash(first);
  const std::string other =
      read_file(index_dataset(folder_.path() / "data").views[4].file("crop.png"));
  write_file(first.file("crop.png"), other);
  EXPECT_NE(view_hash(first), hash);
  const auto after = extract(cache());
  EXPECT_NE(after[0].features[0].vector, before[0].features[0].vector);
  expect_equal(after, extract({}));
}

TEST_F(FeatureCaching, AnotherExtractorIsAnotherFolder) {
  const Colour demanding{.min_pixels = 100000};
  EXPECT_TRUE(extract(cache())[0].features[0].extracted());
  const auto changed = extract(cache(), demanding);
  EXPECT_FALSE(changed[0].features[0].extracted());
  expect_equal(changed, extract({}, demanding));
}

TEST_F(FeatureCaching, AViewIsWhatItIsExtractedFrom) {
  const ViewEntry plain = index_dataset(folder_.path() / "data").views.front();
  std::vector<ViewEntry> views(7, plain);
  views[1].name.video = 2;
  for (const char* file : {"crop.png", "depthcrop.png", "maskcrop.png", "loc.txt"}) {
    write_file(views[1].file(file), read_file(plain.file(file)));
  }
  views[2].notes = std::make_shared<const PictureNotes>();
  PictureNotes nearer;
  nearer.focal_px = 400.0;
  views[3].notes = std::make_shared<const PictureNotes>(nearer);
  views[4].cut = ObjectCut::depth;
  views[5].cut = ObjectCut::whole;
  views[6].given_elevation_rad = 0.25;
  std::set<std::uint64_t> hashes;
  for (const ViewEntry& view : views) hashes.insert(view_hash(view));
  EXPECT_EQ(hashes.size(), views.size());
  EXPECT_EQ(view_hash(plain), view_hash(views[0]));
  for (const char* file : {"crop.png", "depthcrop.png", "maskcrop.png", "loc.txt"}) {
    const std::uint64_t before = view_hash(plain);
    write_file(plain.file(file), read_file(plain.file(file)) + " ");
    EXPECT_NE(view_hash(plain), before) << file;
  }
}

TEST_F(FeatureCaching, AFileIsWrittenForEvery256Views) {
  const std::vector<TrainedFeature> extractors{TrainedFeature(Colour{}, 0.0)};
  {
    FeatureCache kept(cache(), extractors);
    for (std::uint64_t i = 0; i < 255; ++i) kept.keep(0, i, FeatureResult::skip("hidden"));
    EXPECT_FALSE(fs::exists(cache()));
    kept.keep(0, 255, FeatureResult::skip("far"));
    EXPECT_EQ(files().size(), 1U);
  }
  EXPECT_EQ(files().size(), 1U) << "nothing was left to write";
  const FeatureCache again(cache(), extractors);
  for (std::uint64_t i = 0; i < 256; ++i) {
    ASSERT_TRUE(again.find(0, i)) << i;
    EXPECT_EQ(again.find(0, i)->skipped, i < 255 ? "hidden" : "far");
  }
  EXPECT_FALSE(again.find(0, 256));
  const fs::path file = files().front();
  fs::rename(file, file.string() + ".old");
  EXPECT_FALSE(FeatureCache(cache(), extractors).find(0, 0)) << "it is called otherwise";
}

TEST_F(FeatureCaching, WithoutAFolderNothingIsKept) {
  const std::vector<TrainedFeature> extractors{TrainedFeature(Colour{}, 0.0)};
  FeatureCache none({}, extractors);
  EXPECT_FALSE(none.active());
  none.keep(0, 1, FeatureResult::skip("hidden"));
  EXPECT_FALSE(none.find(0, 1));
}

TEST_F(FeatureCaching, DamagedFilesAreExtractedAgain) {
  const auto plain = extract(cache());
  for (const fs::path& file : files()) {
    std::string bytes = read_file(file);
    bytes[bytes.size() / 2] ^= 1;
    write_file(file, bytes);
  }
  expect_equal(extract(cache()), plain);
  for (const fs::path& file : files()) write_file(file, "vantage features\n");
  expect_equal(extract(cache()), plain);
}

TEST_F(FeatureCaching, WorkThatIsBrokenOffIsKept) {
  struct Stop {};
  int polled = 0;
  const LongWork how{.poll =
                         [&] {
                           if (++polled > 5) throw Stop{};
                         },
                     .feature_cache = cache()};
  const std::vector<TrainedFeature> extractors{TrainedFeature(Colour{}, 0.0)};
  const std::vector<ViewEntry> views = index_dataset(folder_.path() / "data").views;
  EXPECT_THROW((void)extract_features(views, extractors, how, "extracting"), Stop);
  const FeatureCache kept(cache(), extractors);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(kept.find(0, view_hash(views[i])).has_value(), i < 5) << i;
  }
}

/// Else all that users have kept would be extracted anew.
TEST_F(FeatureCaching, WhatTheFirstVersionKeptIsWhereItIsLookedFor) {
  const TrainedFeature colour(Colour{}, 0.0);
  (void)extract(cache());
  const std::uint64_t hash = hash_bytes("version 1", colour.state_hash());
  EXPECT_TRUE(fs::is_directory(cache() / ("colour-" + hash_text(hash))));
}

TEST_F(FeatureCaching, WhatIsLeftIsWrittenToAFileOfItsOwn) {
  const std::vector<TrainedFeature> extractors{TrainedFeature(Colour{}, 0.0)};
  {
    FeatureCache kept(cache(), extractors);
    for (std::uint64_t i = 0; i < 257; ++i) kept.keep(0, i, FeatureResult::skip("hidden"));
  }
  EXPECT_EQ(files().size(), 2U);
  testing::internal::CaptureStderr();
  const FeatureCache again(cache(), extractors);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "nothing is wrong with either";
  for (std::uint64_t i = 0; i < 257; ++i) EXPECT_TRUE(again.find(0, i)) << i;
}

TEST_F(FeatureCaching, AFileOfAnotherKindIsLeftOut) {
  const std::vector<TrainedFeature> extractors{TrainedFeature(Colour{}, 0.0)};
  FeatureCache(cache(), extractors).keep(0, 1, FeatureResult::skip("hidden"));
  EXPECT_TRUE(FeatureCache(cache(), extractors).find(0, 1));
  const fs::path file = files().front();
  std::string bytes = read_file(file);
  bytes.resize(bytes.size() - sizeof(std::uint64_t));
  bytes[0] = 'V';
  put(bytes, hash_bytes(bytes));
  write_file(file, bytes);
  EXPECT_FALSE(FeatureCache(cache(), extractors).find(0, 1));
}

}  // namespace
}  // namespace vantage
