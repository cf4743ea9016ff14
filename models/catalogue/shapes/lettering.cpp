#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "vantage/models/catalogue/shapes/patterns.hpp"

namespace vantage {
namespace {

constexpr int kColumns = 5;
constexpr int kRows = 7;

/// 35 bits a glyph, the top left one first.
constexpr std::array<std::uint64_t, 26> kLetters{
    0x3a31fc631ULL, 0x7a31f463eULL, 0x3a308422eULL, 0x7a318c63eULL, 0x7e10f421fULL, 0x7e10f4210ULL,
    0x3a30bc62eULL, 0x4631fc631ULL, 0x38842108eULL, 0x1c4210a4cULL, 0x4654c5251ULL, 0x42108421fULL,
    0x4775ac631ULL, 0x47359c631ULL, 0x3a318c62eULL, 0x7a31f4210ULL, 0x3a318d64dULL, 0x7a31f5251ULL,
    0x3e107043eULL, 0x7c8421084ULL, 0x46318c62eULL, 0x46318c544ULL, 0x4631ad771ULL, 0x462a22a31ULL,
    0x462a21084ULL, 0x7c222221fULL,
};
constexpr std::array<std::uint64_t, 10> kDigits{
    0x3a33ae62eULL, 0x11842108eULL, 0x3a213221fULL, 0x78217043eULL, 0x08ca97c42ULL,
    0x7e1e0862eULL, 0x3a10f462eULL, 0x7c2222108ULL, 0x3a317462eULL, 0x3a317842eULL,
};

std::uint64_t glyph(char c) {
  if (c >= 'A' && c <= 'Z') return kLetters[static_cast<std::size_t>(c - 'A')];
  if (c >= '0' && c <= '9') return kDigits[static_cast<std::size_t>(c - '0')];
  return 0;
}

bool is_inked(char c, int column, int row) {
  return ((glyph(c) >> (kColumns * kRows - 1 - (row * kColumns + column))) & 1U) != 0;
}

}  // namespace

void draw_text(Image& image, const UvRect& rect, std::string_view text, const RgbColour& colour) {
  const int columns = static_cast<int>(text.size()) * (kColumns + 1) - 1;
  for (int column = 0; column < columns; ++column) {
    const char c = text[static_cast<std::size_t>(column / (kColumns + 1))];
    const int in_glyph = column % (kColumns + 1);
    if (in_glyph == kColumns) continue;
    for (int row = 0; row < kRows; ++row) {
      if (!is_inked(c, in_glyph, row)) continue;
      const double s = static_cast<double>(column) / columns;
      const double t = 1.0 - static_cast<double>(row + 1) / kRows;
      paint(image, part_of(rect, s, t, s + 1.0 / columns, t + 1.0 / kRows), colour);
    }
  }
}

void draw_small_print(Image& image, const UvRect& rect, const RgbColour& ink, Rng& rng) {
  constexpr int lines = 7;
  for (int line = 0; line < lines; ++line) {
    const double t = (line + 0.3) / lines;
    double s = 0.0;
    while (s < 0.9) {
      const double word = std::min(rng.uniform(0.06, 0.22), 1.0 - s);
      paint(image, part_of(rect, s, t, s + word, t + 0.45 / lines), ink);
      s += word + 0.05;
    }
  }
}

void draw_barcode(Image& image, const UvRect& rect, Rng& rng) {
  constexpr int modules = 38;
  paint(image, rect, RgbColour(0.97, 0.97, 0.97));
  for (int i = 2; i < modules - 2; ++i) {
    if (rng.uniform() < 0.5) continue;
    const double s = static_cast<double>(i) / modules;
    paint(image, part_of(rect, s, 0.08, s + 1.0 / modules, 0.92), RgbColour(0.05, 0.05, 0.05));
  }
}

void draw_disc(Image& image, const UvRect& rect, const RgbColour& colour) {
  const Image under = image;
  paint(image, rect, [&](double s, double t) {
    if (std::hypot(s - 0.5, t - 0.5) < 0.5) return colour;
    const Eigen::Vector2d uv = rect.at(s, t);
    return under.at(
        std::min(static_cast<int>(uv.x() * under.width_px), under.width_px - 1),
        std::min(static_cast<int>((1.0 - uv.y()) * under.height_px), under.height_px - 1));
  });
}

}  // namespace vantage
