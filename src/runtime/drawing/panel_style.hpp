/// Colours, measures and lettering of the map panel.
#pragma once

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace vantage::panel {

inline const cv::Scalar kTop(46, 32, 22);
inline const cv::Scalar kBottom(24, 16, 11);
inline const cv::Scalar kCard(44, 31, 22);
inline const cv::Scalar kText(244, 238, 232);
inline const cv::Scalar kDim(170, 152, 138);
inline const cv::Scalar kFaint(104, 86, 72);
inline const cv::Scalar kAccent(60, 190, 255);
inline const cv::Scalar kVisited(200, 170, 90);
inline const cv::Scalar kRobot(150, 230, 120);
inline const cv::Scalar kPlan(225, 140, 240);

/// Everything that scales with the panel: lengths are given as on a panel 640 px wide.
struct Layout {
  double unit;
  cv::Size size;
  [[nodiscard]] double px(double length) const { return unit * length; }
  /// A stroke, at least one pixel.
  [[nodiscard]] int stroke(double width) const {
    return std::max(1, static_cast<int>(std::lround(px(width))));
  }
  [[nodiscard]] cv::Rect rect(double x, double y, double w, double h) const {
    return {static_cast<int>(px(x)), static_cast<int>(px(y)), static_cast<int>(px(w)),
            static_cast<int>(px(h))};
  }
  [[nodiscard]] double height() const { return size.height / unit; }
};

enum class Align { left, centre, right };

/// One line; `at_px` is where its baseline begins, has its middle, or ends.
inline void text(cv::Mat& image, const Layout& layout, const std::string& words, cv::Point2d at_px,
                 double size, const cv::Scalar& bgr, Align align = Align::left, bool bold = false) {
  const double scale = layout.px(size) / 22.0;
  const int thickness = layout.stroke(bold ? 1.6 : 0.85);
  const int width =
      cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, scale, thickness, nullptr).width;
  if (align == Align::centre) at_px.x -= 0.5 * width;
  if (align == Align::right) at_px.x -= width;
  cv::putText(image, words, at_px, cv::FONT_HERSHEY_SIMPLEX, scale, bgr, thickness, cv::LINE_AA);
}

/// "12 345": digits in groups of three; "-" for not a number.
inline std::string grouped(double value) {
  if (!std::isfinite(value)) return "-";
  std::string digits = fmt::format("{:.0f}", std::abs(value));
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return fmt::format("{}{}", value < 0.0 && digits != "0" ? "-" : "", digits);
}

/// 1, 2 or 5 times a power of ten, so that about `count` steps fill `extent`.
inline double round_step(double extent, int count) {
  const double raw = extent / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * power) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace vantage::panel
