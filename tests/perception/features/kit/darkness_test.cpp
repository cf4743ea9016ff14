// What a feature goes by must have been there: without light, colour says nothing and depth all.
#include "vantage/perception/features/kit/darkness.hpp"

#include <gmock/gmock.h>

#include "tests/support/object_views.hpp"
#include "vantage/perception/features/feature.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;

/// The same view when the lights are out: noise of a camera, of 4 of 255, and no more.
ObjectView in_the_dark(ObjectView view, Rng& rng) {
  for (std::uint8_t& value : view.rgb) {
    value = static_cast<std::uint8_t>(std::clamp(std::lround(4.0 * rng.normal()), 0L, 255L));
  }
  return view;
}

TEST(Darkness, IsToldFromAnyLight) {
  Rng rng(1);
  const ObjectView lit = ball_view(120, {}, rng);
  EXPECT_EQ(lacks_light(lit), "");
  EXPECT_THAT(lacks_light(in_the_dark(lit, rng)), HasSubstr("too dark: 0 of 14400 pixels"));
  EXPECT_EQ(lacks_light({}), "");
}

/// A black thing before a lit wall is no darkness.
TEST(Darkness, IsNotABlackObject) {
  Rng rng(1);
  ObjectView view = ball_view(120, {}, rng);
  for (std::size_t i = 0; i < view.mask.size(); ++i) {
    if (view.mask[i] != 0) std::fill_n(view.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 0);
  }
  EXPECT_EQ(lacks_light(view), "");
}

TEST(Darkness, SilencesWhatGoesByLightAndNothingElse) {
  Rng rng(1);
  const ObjectView lit = ball_view(120, {}, rng);
  const ObjectView dark = in_the_dark(lit, rng);
  for (const TrainedFeature& feature :
       {TrainedFeature(Colour{}, 0.0), TrainedFeature(SoftColour{}, 0.0)}) {
    EXPECT_TRUE(feature.extract(lit).extracted()) << feature.name();
    EXPECT_THAT(feature.extract(dark).skipped, HasSubstr("too dark")) << feature.name();
  }
  for (const TrainedFeature& feature :
       {TrainedFeature(BoundingBox{}, 0.0), TrainedFeature(StandingBox{}, 0.0),
        TrainedFeature(Vfh{}, 0.0)}) {
    const FeatureResult by_day = feature.extract(lit);
    ASSERT_TRUE(by_day.extracted()) << feature.name() << ": " << by_day.skipped;
    EXPECT_EQ(feature.extract(dark).vector, by_day.vector) << feature.name();
  }
}

/// 100 pixels, so many of them just bright enough in one channel.
TEST(Darkness, IsLessThanATwentiethOfPixelsThatAreLit) {
  const auto with = [](std::size_t lit, std::uint8_t value) {
    ObjectView view = blank_view(10, 10);
    for (std::size_t i = 0; i < lit; ++i) view.rgb[3 * i + i % 3] = value;
    return lacks_light(view);
  };
  EXPECT_EQ(with(5, 24), "");
  EXPECT_EQ(with(4, 24),
            "too dark: 4 of 100 pixels, surroundings included, are brighter than 24 of 255");
  EXPECT_THAT(with(100, 23), HasSubstr("too dark: 0 of 100 pixels"));
}

}  // namespace
}  // namespace vantage
