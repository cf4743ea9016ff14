/// Text of figures, kept inside their borders. What is drawn with has fonts of its own, so widths
/// are those of a wide one.
#pragma once

#include <string>
#include <string_view>

namespace vantage {

struct SvgText {
  double size_px = 12.0;
  bool bold = false;
  std::string_view colour = {};  ///< empty: the figure's
  std::string_view anchor = "start";
};

/// One line at (x, y), pressed together if it would be wider than `room_px`.
/// @param attributes further ones of the element
std::string svg_line(double x, double y, double room_px, std::string_view content,
                     const SvgText& text, std::string_view attributes = {});

/// Broken at spaces into lines of at most `room_px`, the first at `y`, each `advance_px` below the
/// one before; `y` is afterwards where the next line would be.
std::string svg_lines(double x, double& y, double room_px, double advance_px,
                      std::string_view content, const SvgText& text);

}  // namespace vantage
