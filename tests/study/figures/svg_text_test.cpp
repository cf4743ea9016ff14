// Lines of text of figures, as they stand in the image.
#include "vantage/study/figures/svg_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(SvgLine, SaysItsPlaceAndLettering) {
  EXPECT_EQ(svg_line(12.34, 56.78, 100.0, "a<b", {}),
            "<text x=\"12.3\" y=\"56.8\" text-anchor=\"start\" font-size=\"12\">a&lt;b</text>\n");
  EXPECT_EQ(svg_line(1.0, 2.0, 100.0, "x",
                     {.size_px = 13.5, .bold = true, .colour = "#123456", .anchor = "end"}, "id=7"),
            "<text x=\"1.0\" y=\"2.0\" text-anchor=\"end\" font-size=\"13.5\" font-weight=\"650\" "
            "fill=\"#123456\" id=7>x</text>\n");
}

/// Ten letters of 10 px: 56 px wide, in bold 64 px.
TEST(SvgLine, IsPressedTogetherWhereItIsTooWide) {
  const auto line = [](double room_px, bool bold, std::string_view letters) {
    return svg_line(0.0, 0.0, room_px, letters, {.size_px = 10.0, .bold = bold});
  };
  const auto pressed = [&](double room_px, bool bold) {
    return line(room_px, bold, "abcdefghij").find("textLength") != std::string::npos;
  };
  EXPECT_TRUE(pressed(55.5, false));
  EXPECT_FALSE(pressed(56.5, false));
  EXPECT_TRUE(pressed(63.5, true));
  EXPECT_FALSE(pressed(64.5, true));
  EXPECT_THAT(svg_line(0.0, 0.0, 40.0, "abcde", {.size_px = 12.5, .bold = true}),
              testing::Not(testing::HasSubstr("textLength")))
      << "what just fits is not too wide";
  EXPECT_THAT(line(40.0, false, "abcdefghij"),
              testing::HasSubstr("textLength=\"40\" lengthAdjust=\"spacingAndGlyphs\""));
  const std::string umlauts =
      "\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4";
  EXPECT_THAT(line(60.0, false, umlauts), testing::Not(testing::HasSubstr("textLength")))
      << "a letter of two bytes is one letter";
}

/// 60 px hold ten letters of 10 px.
TEST(SvgLines, BreakAtSpacesAndAdvance) {
  double y = 10.0;
  EXPECT_EQ(svg_lines(5.0, y, 60.0, 17.0, "aaaa bbbb cccc", {.size_px = 10.0}),
            "<text x=\"5.0\" y=\"10.0\" text-anchor=\"start\" font-size=\"10\">aaaa bbbb</text>\n"
            "<text x=\"5.0\" y=\"27.0\" text-anchor=\"start\" font-size=\"10\">cccc</text>\n");
  EXPECT_DOUBLE_EQ(y, 44.0);
  EXPECT_EQ(svg_lines(5.0, y, 60.0, 17.0, "", {.size_px = 10.0}), "");
  EXPECT_DOUBLE_EQ(y, 44.0);
}

}  // namespace
}  // namespace vantage
