/// What is drawn where, in colours that smooth edges have changed a little.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

#include "vantage/runtime/drawing/panel_style.hpp"

namespace vantage::support {

inline cv::Mat coloured(const cv::Mat& image, const cv::Rect& part, const cv::Scalar& bgr) {
  constexpr double kOff = 25.0;
  cv::Mat found;
  cv::inRange(image(part), bgr - cv::Scalar::all(kOff), bgr + cv::Scalar::all(kOff), found);
  return found;
}

inline int count_coloured(const cv::Mat& image, const cv::Rect& part, const cv::Scalar& bgr) {
  return cv::countNonZero(coloured(image, part, bgr));
}

inline bool is_coloured(const cv::Mat& image, cv::Point at, const cv::Scalar& bgr) {
  return count_coloured(image, {at.x, at.y, 1, 1}, bgr) == 1;
}

/// On a card.
inline bool is_written(const cv::Mat& panel, const cv::Rect& part) {
  return count_coloured(panel, part, panel::kCard) < part.area();
}

/// Holds all pixels of a part that differ by more than `tolerance` in a channel; in those of the
/// part.
inline cv::Rect box_of_changes(const cv::Mat& a, const cv::Mat& b, const cv::Rect& part,
                               double tolerance = 0.0) {
  cv::Mat changed;
  cv::absdiff(a(part), b(part), changed);
  cv::Mat same;
  cv::inRange(changed, cv::Scalar::all(0), cv::Scalar::all(tolerance), same);
  const cv::Mat differs = 255 - same;
  return cv::boundingRect(differs) + part.tl();
}

/// Of the pixels of that colour that are no farther than `reach_px` along either axis.
inline double mean_radius_px(const cv::Mat& image, cv::Point middle, int reach_px,
                             const cv::Scalar& bgr) {
  const cv::Rect part(middle.x - reach_px, middle.y - reach_px, 2 * reach_px + 1, 2 * reach_px + 1);
  const cv::Mat found = coloured(image, part, bgr);
  double sum_px = 0.0;
  for (int y = 0; y < found.rows; ++y) {
    for (int x = 0; x < found.cols; ++x) {
      if (found.at<unsigned char>(y, x) != 0) sum_px += std::hypot(x - reach_px, y - reach_px);
    }
  }
  return sum_px / cv::countNonZero(found);
}

}  // namespace vantage::support
