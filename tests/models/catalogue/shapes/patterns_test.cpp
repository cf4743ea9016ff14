#include "vantage/models/catalogue/shapes/patterns.hpp"

#include <gtest/gtest.h>

#include <string>

namespace vantage {
namespace {

const RgbColour kInk(0, 0, 0);
const RgbColour kPaper(1, 1, 1);

std::string as_ascii(const Image& image) {
  std::string text;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) text += image.at(x, y).sum() < 1.5 ? '#' : '.';
    text += '\n';
  }
  return text;
}

TEST(Patterns, TextReadsUprightFromLeftToRight) {
  Image image(17, 7, kPaper);
  draw_text(image, UvRect{}, "LF7", kInk);
  EXPECT_EQ(as_ascii(image),
            "#.....#####.#####\n"
            "#.....#.........#\n"
            "#.....#........#.\n"
            "#.....####....#..\n"
            "#.....#......#...\n"
            "#.....#......#...\n"
            "#####.#......#...\n");
}

TEST(Patterns, BandsLieAndStripesStand) {
  Image image(4, 4, kPaper);
  paint(image, UvRect{}, bands(kInk, kPaper, 1));
  EXPECT_EQ(as_ascii(image), "....\n....\n####\n####\n");
  paint(image, UvRect{}, stripes(kInk, kPaper, 2));
  EXPECT_EQ(as_ascii(image), "#.#.\n#.#.\n#.#.\n#.#.\n");
  paint(image, UvRect{}, checks(kInk, kPaper, 2, 2));
  EXPECT_EQ(as_ascii(image), "..##\n..##\n##..\n##..\n");
}

TEST(Patterns, DiscLeavesItsCorners) {
  Image image(6, 6, kPaper);
  draw_disc(image, UvRect{}, kInk);
  EXPECT_EQ(as_ascii(image), ".####.\n######\n######\n######\n######\n.####.\n");
}

TEST(Patterns, NoisyPatternsRepeatWithTheSeedAndStayInRange) {
  for (const auto make : {+[](Rng& rng) { return wood(kPaper, kInk, 3, rng); },
                          +[](Rng& rng) { return tiles(kPaper, kInk, 3, 2, rng); },
                          +[](Rng& rng) { return mottled(kPaper, kInk, 4, rng); },
                          +[](Rng& rng) { return any_pattern(kPaper, kInk, rng); }}) {
    Rng rng_a(5);
    Rng rng_b(5);
    Image a(32, 32, kPaper);
    Image b(32, 32, kPaper);
    paint(a, UvRect{}, make(rng_a));
    paint(b, UvRect{}, make(rng_b));
    EXPECT_EQ(a, b);
    EXPECT_NE(a, Image(32, 32, kPaper));
  }
}

}  // namespace
}  // namespace vantage
