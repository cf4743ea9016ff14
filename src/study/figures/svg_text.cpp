#include "vantage/study/figures/svg_text.hpp"

#include <fmt/format.h>

#include "vantage/core/schema.hpp"
#include "vantage/report/page.hpp"

namespace vantage {
namespace {

/// Mean width of a letter by its size.
double letter_width(const SvgText& text) { return (text.bold ? 0.64 : 0.56) * text.size_px; }

double letters(std::string_view content) {
  double count = 0.0;
  for (const char c : content)
    count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1.0 : 0.0;
  return count;
}

}  // namespace

std::string svg_line(double x, double y, double room_px, std::string_view content,
                     const SvgText& text, std::string_view attributes) {
  std::string facts = fmt::format(R"(font-size="{}")", text.size_px);
  if (text.bold) facts += R"( font-weight="650")";
  if (!text.colour.empty()) facts += fmt::format(R"( fill="{}")", text.colour);
  if (letters(content) * letter_width(text) > room_px) {
    facts += fmt::format(R"( textLength="{:.0f}" lengthAdjust="spacingAndGlyphs")", room_px);
  }
  if (!attributes.empty()) facts += fmt::format(" {}", attributes);
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" {}>{}</text>)"
                     "\n",
                     x, y, text.anchor, facts, html_escaped(content));
}

std::string svg_lines(double x, double& y, double room_px, double advance_px,
                      std::string_view content, const SvgText& text) {
  std::string svg;
  const auto width = static_cast<std::size_t>(room_px / letter_width(text));
  for (const std::string_view line : wrapped(content, width)) {
    svg += svg_line(x, y, room_px, line, text);
    y += advance_px;
  }
  return svg;
}

}  // namespace vantage
