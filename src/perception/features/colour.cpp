#include "vantage/perception/features/colour.hpp"

#include <opencv2/imgproc.hpp>

#include "vantage/perception/features/kit/histogram.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"

namespace vantage {

FeatureResult Colour::extract(const ObjectView& view) const {
  const ObjectPixels pixels = object_pixels(view);
  if (auto why = lacks_colour(pixels, min_pixels); !why.empty()) return FeatureResult::skip(why);
  const cv::Mat rgb(view.height_px, view.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(view.rgb.data()));
  cv::Mat hsv;
  cv::cvtColor(rgb, hsv, cv::COLOR_RGB2HSV);  // hue in units of 2 deg
  Eigen::VectorXf histogram = Eigen::VectorXf::Zero(dimension());
  for (std::size_t i = 0; i < pixels.colour.size(); ++i) {
    if (pixels.colour[i] == 0) continue;
    const std::uint8_t* p = hsv.data + 3 * i;
    const int h = p[0] * hues / 180;
    const int s = p[1] * saturations / 256;
    const int v = p[2] * values / 256;
    histogram[(h * saturations + s) * values + v] += 1.0F;
  }
  return {root_of_shares(histogram), {}};
}

}  // namespace vantage
