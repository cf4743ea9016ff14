// What every feature promises, whichever it is.
#include "vantage/perception/features/feature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/perception/features/onnx_bytes.hpp"
#include "tests/support/object_views.hpp"
#include "tests/support/temporary_directory.hpp"

namespace vantage {
namespace {

/// Quick to train, and with what it needs.
Feature quick(std::string_view name, const std::filesystem::path& directory) {
  auto feature = make_strategy<Feature>(name);
  std::visit(
      [&](auto& options) {
        if constexpr (requires { options.match; }) {
          options.match.words = 20;
          options.match.levels = 2;
          options.learning.iterations = 3;
        }
        if constexpr (requires { options.samples_per_word; }) options.words = 10;
        if constexpr (requires { options.file; }) {
          options.file = (directory / "mean.onnx").string();
          std::ofstream(options.file, std::ios::binary) << averaging_network();
        }
      },
      feature);
  return feature;
}

class EveryFeature : public testing::TestWithParam<std::string_view> {
 protected:
  EveryFeature() {
    Rng rng(1);
    views = ball_views(8, 48, rng, 3.0);  // with what is beside them
  }
  [[nodiscard]] TrainedFeature trained(std::uint64_t seed = 1) const {
    Rng rng(seed);
    return train_feature(quick(GetParam(), directory.path()), views, rng);
  }
  support::TemporaryDirectory directory;
  std::vector<ObjectView> views;
};

TEST_P(EveryFeature, KnowsItsNameDimensionAndCost) {
  const TrainedFeature feature = trained();
  EXPECT_EQ(feature.name(), GetParam());
  EXPECT_GT(feature.cost_s(), 0.0);
  std::set<float> firsts;
  for (const ObjectView& view : views) {
    const FeatureResult result = feature.extract(view);
    ASSERT_TRUE(result.extracted()) << result.skipped;
    ASSERT_EQ(result.vector.size(), feature.dimension());
    EXPECT_TRUE(result.vector.allFinite());
    firsts.insert(result.vector.sum());
  }
  EXPECT_GT(firsts.size(), 4U);  // it depends on the view
}

TEST_P(EveryFeature, SameSeedSameBits) {
  EXPECT_EQ(trained(3).extract(views[0]).vector, trained(3).extract(views[0]).vector);
}

TEST_P(EveryFeature, ComesBackFromBytes) {
  const TrainedFeature feature = trained();
  const TrainedFeature back = TrainedFeature::from_bytes(feature.to_bytes(), "model");
  EXPECT_EQ(back.name(), feature.name());
  EXPECT_EQ(back.cost_s(), feature.cost_s());
  EXPECT_EQ(back.dimension(), feature.dimension());
  EXPECT_EQ(back.extract(views[2]).vector, feature.extract(views[2]).vector);
}

TEST_P(EveryFeature, DamagedBytesAreRefused) {
  const std::string bytes = trained().to_bytes();
  const auto load = [](std::string_view part) { (void)TrainedFeature::from_bytes(part, "model"); };
  for (std::size_t i = 0; i < 40; ++i) {
    const std::size_t size = bytes.size() * i / 40;
    EXPECT_THROW(load(std::string_view(bytes).substr(0, size)), InputError) << size;
  }
  EXPECT_THROW(load(bytes + "x"), InputError);
  EXPECT_THROW(load("PK" + bytes), InputError);
}

/// Skipped with a reason, or finite numbers: nothing else.
void expect_sound(const TrainedFeature& feature, const ObjectView& view, bool extractable) {
  const FeatureResult result = feature.extract(view);
  if (!extractable) {
    EXPECT_FALSE(result.extracted());
  }
  if (result.extracted()) {
    EXPECT_EQ(result.vector.size(), feature.dimension());
    EXPECT_TRUE(result.vector.allFinite());
  } else {
    EXPECT_EQ(result.vector.size(), 0);
  }
}

TEST_P(EveryFeature, ViewsWithoutAnObjectAreSkipped) {
  const TrainedFeature feature = trained();
  expect_sound(feature, blank_view(0, 0), false);
  expect_sound(feature, blank_view(40, 40), false);
  ObjectView unseen = views[0];
  std::ranges::fill(unseen.mask, 0);
  expect_sound(feature, unseen, false);
}

TEST_P(EveryFeature, OddViewsGiveNumbersOrAReason) {
  const TrainedFeature feature = trained();
  ObjectView pixel = views[0];
  std::ranges::fill(pixel.mask, 0);
  pixel.mask[pixel.index(24, 24)] = 1;
  expect_sound(feature, pixel, GetParam() == "sift");  // one grid point may be on it
  for (const float depth : {0.0F, 1.0F, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), 1e30F, 1e-30F}) {
    ObjectView odd = views[0];
    std::ranges::fill(odd.depth_m, depth);
    expect_sound(feature, odd, true);
  }
  ObjectView flat = views[0];
  std::ranges::fill(flat.rgb, 200);
  expect_sound(feature, flat, true);
  ObjectView lost = views[0];
  lost.focal_px = std::numeric_limits<double>::quiet_NaN();
  expect_sound(feature, lost, true);
  for (const auto& [width_px, height_px] : {std::pair{1, 1}, {1, 60}, {3, 400}, {400, 5}}) {
    ObjectView strip = blank_view(width_px, height_px);
    std::ranges::fill(strip.mask, 1);
    std::ranges::fill(strip.depth_m, 1.0F);
    expect_sound(feature, strip, true);
  }
}

/// A ball of which the frame shows the left half.
TEST_P(EveryFeature, ViewsCutByTheFrameAreExtracted) {
  ObjectView cut = blank_view(24, 48);
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 24; ++column) {
      const std::size_t from = views[0].index(row, column);
      const std::size_t to = cut.index(row, column);
      cut.mask[to] = views[0].mask[from];
      cut.depth_m[to] = views[0].depth_m[from];
      std::copy_n(views[0].rgb.begin() + static_cast<std::ptrdiff_t>(3 * from), 3,
                  cut.rgb.begin() + static_cast<std::ptrdiff_t>(3 * to));
    }
  }
  const FeatureResult result = trained().extract(cut);
  EXPECT_TRUE(result.extracted()) << result.skipped;
}

INSTANTIATE_TEST_SUITE_P(All, EveryFeature, testing::ValuesIn(strategy_names<Feature>()),
                         [](const auto& info) { return std::string(info.param); });

TEST(TrainFeature, OptionsOutOfRangeAreNamed) {
  Rng rng(1);
  EXPECT_THROW(train_feature(Sift{.words = 0}, {}, rng), ConfigError);
}

TEST(TrainFeature, WithoutViewsThereIsNothingToLearnOrTime) {
  Rng rng(1);
  EXPECT_EQ(train_feature(Colour{}, {}, rng).cost_s(), 0.0);
  EXPECT_THROW(train_feature(KernelDescriptor<PatchKind::lbp>{}, {}, rng), InputError);
}

TEST_P(EveryFeature, DarknessSilencesWhatDoesNotGoByDepth) {
  const std::set<std::string_view> by_depth{"bounding_box", "standing_box", "vfh", "depth_gradient",
                                            "depth_lbp",    "normal_spin",  "size"};
  ObjectView dark = views[0];
  std::ranges::fill(dark.rgb, 0);
  const FeatureResult result = trained().extract(dark);
  EXPECT_EQ(result.extracted(), by_depth.contains(GetParam())) << result.skipped;
}

TEST(TrainedFeature, ItsHashIsOfWhatItExtracts) {
  const TrainedFeature colour(Colour{}, 0.5);
  const TrainedFeature dear = colour.with_cost_s(2.0);
  EXPECT_EQ(colour.cost_s(), 0.5);
  EXPECT_EQ(dear.cost_s(), 2.0);
  EXPECT_EQ(dear.state_hash(), colour.state_hash());
  EXPECT_NE(TrainedFeature(Colour{.min_pixels = 17}, 0.5).state_hash(), colour.state_hash());
  EXPECT_NE(TrainedFeature(SoftColour{}, 0.5).state_hash(), colour.state_hash());
}

std::string bytes_of_colour(std::string_view name, double cost_s) {
  std::string bytes = "vantage feature 1\n";
  put_text(bytes, name);
  put(bytes, cost_s);
  put(bytes, 23);
  return bytes;
}

TEST(TrainedFeature, ItsBytesAreChecked) {
  const auto read = [](const std::string& bytes) {
    return TrainedFeature::from_bytes(bytes, "model");
  };
  EXPECT_EQ(read(bytes_of_colour("colour", 0.0)).cost_s(), 0.0);
  EXPECT_EQ(read(bytes_of_colour("colour", 0.25)).to_bytes(), bytes_of_colour("colour", 0.25));
  for (const double cost_s : {-0.001, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(read(bytes_of_colour("colour", cost_s)), InputError) << cost_s;
  }
  EXPECT_THROW(read(bytes_of_colour("nose", 0.25)), InputError);
}

/// A view that lacks its pixels ends the program as soon as a feature looks at it.
TEST(TrainFeature, NineViewsAreTimedAndNoMore) {
  Rng rng(1);
  std::vector<ObjectView> views = ball_views(9, 48, rng, 3.0);
  ObjectView broken;
  broken.width_px = broken.height_px = 1;
  views.push_back(broken);
  EXPECT_GT(train_feature(Colour{}, views, rng).cost_s(), 0.0) << "the tenth is left alone";
  views.erase(views.begin());
  EXPECT_DEATH(train_feature(Colour{}, views, rng), "images have its size");
}

TEST(TrainFeature, AKernelDescriptorNeedsTwoViews) {
  Rng rng(1);
  const std::vector<ObjectView> views = ball_views(2, 48, rng, 3.0);
  KernelDescriptor<PatchKind::size> descriptor;
  descriptor.match.words = 5;
  EXPECT_NO_THROW(train_feature(descriptor, views, rng));
  try {
    train_feature(descriptor, {views.data(), 1}, rng);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()).find("feature size: 1 training view can be used, fewer than 2"),
        0U)
        << error.what();
  }
}

}  // namespace
}  // namespace vantage
