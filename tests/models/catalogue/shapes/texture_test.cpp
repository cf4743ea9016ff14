#include "vantage/models/catalogue/shapes/texture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

const RgbColour kPureRed(1, 0, 0);
const RgbColour kBlue(0, 0, 1);

TEST(Texture, HsvHitsThePrimaries) {
  EXPECT_TRUE(hsv(0.0, 1.0, 1.0).isApprox(kPureRed, 1e-12));
  EXPECT_TRUE(hsv(1.0 / 3.0, 1.0, 1.0).isApprox(RgbColour(0, 1, 0), 1e-12));
  EXPECT_TRUE(hsv(2.0 / 3.0, 1.0, 1.0).isApprox(kBlue, 1e-12));
  EXPECT_TRUE(hsv(-1.0 / 3.0, 1.0, 1.0).isApprox(kBlue, 1e-12));
  EXPECT_TRUE(hsv(0.77, 0.0, 0.4).isApprox(RgbColour::Constant(0.4), 1e-12));
}

TEST(Texture, PaintFillsTheRectangleOnly) {
  //  v 1  . . . .
  //       . # # .      u from 1/4 to 3/4, v from 1/2 to 3/4:
  //       . . . .      the second row from the top
  //  v 0  . . . .
  Image image(4, 4, kBlue);
  paint(image, UvRect{0.25, 0.5, 0.75, 0.75}, kPureRed);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const bool painted = y == 1 && (x == 1 || x == 2);
      EXPECT_EQ(image.at(x, y), painted ? kPureRed : kBlue) << x << ", " << y;
    }
  }
}

TEST(Texture, PatternsSeeFractionsOfTheRectangleUpwards) {
  Image image(2, 4, kBlue);
  paint(image, UvRect{}, [](double s, double t) { return RgbColour(s, t, 0.0); });
  EXPECT_NEAR(image.at(0, 0).y(), 0.875, 1.0 / 255.0);
  EXPECT_NEAR(image.at(1, 3).y(), 0.125, 1.0 / 255.0);
  EXPECT_NEAR(image.at(1, 3).x(), 0.75, 1.0 / 255.0);
}

TEST(Texture, SpeckleDependsOnTheStreamOnly) {
  const Image plain(16, 16, RgbColour::Constant(0.5));
  Image a = plain;
  Image b = plain;
  Rng rng_a(7);
  Rng rng_b(7);
  speckle(a, UvRect{}, 0.1, 2, rng_a);
  speckle(b, UvRect{}, 0.1, 2, rng_b);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, plain);
}

TEST(Texture, PngKeepsEveryPixel) {
  const support::TemporaryDirectory directory;
  Image image(31, 17, kBlue);
  Rng rng(3);
  paint(image, UvRect{}, [&](double s, double t) { return RgbColour(s, t, rng.uniform()); });
  write_png(image, directory / "image.png");
  EXPECT_EQ(read_png(directory / "image.png"), image);
}

TEST(Texture, BadPngNamesTheFile) {
  const support::TemporaryDirectory directory;
  EXPECT_THROW(read_png(directory / "missing.png"), InputError);
  write_file(directory / "bad.png", "this is no image");
  try {
    read_png(directory / "bad.png");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bad.png"));
  }
}

}  // namespace
}  // namespace vantage
