#include "vantage/perception/features/soft_colour.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/perception/features/kit/histogram.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"

namespace vantage {
namespace {

/// The two bins whose middles are on either side, and what they get.
struct Neighbours {
  std::array<int, 2> bin{};
  std::array<float, 2> share{};
};

enum class Ends { joined, apart };

/// @param at 0 .. 1 from the first bin's lower edge to the last one's upper
Neighbours neighbours(float at, int bins, Ends ends) {
  const float from_first = at * static_cast<float>(bins) - 0.5F;  // its middle
  const float below = std::floor(from_first);
  const int first = static_cast<int>(below);
  const auto within = [&](int bin) {
    return ends == Ends::joined ? (bin + bins) % bins : std::clamp(bin, 0, bins - 1);
  };
  const float rest = from_first - below;
  return {{within(first), within(first + 1)}, {1.0F - rest, rest}};
}

void add_pixel(const cv::Vec3f& hsv, Eigen::VectorXf& histogram) {
  const Neighbours hue = neighbours(hsv[0] / 360.0F, Colour::hues, Ends::joined);
  const Neighbours saturation = neighbours(hsv[1], Colour::saturations, Ends::apart);
  const Neighbours value = neighbours(hsv[2], Colour::values, Ends::apart);
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t h = i / 4, s = i / 2 % 2, v = i % 2;
    const int bin = (hue.bin[h] * Colour::saturations + saturation.bin[s]) * Colour::values;
    histogram[bin + value.bin[v]] += hue.share[h] * saturation.share[s] * value.share[v];
  }
}

}  // namespace

FeatureResult SoftColour::extract(const ObjectView& view) const {
  const ObjectPixels pixels = object_pixels(view);
  if (auto why = lacks_colour(pixels, min_pixels); !why.empty()) return FeatureResult::skip(why);
  const cv::Mat rgb(view.height_px, view.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(view.rgb.data()));
  cv::Mat3f hsv;
  rgb.convertTo(hsv, CV_32FC3, 1.0 / 255.0);
  cv::cvtColor(hsv, hsv, cv::COLOR_RGB2HSV);  // hue in degrees
  Eigen::VectorXf histogram = Eigen::VectorXf::Zero(dimension());
  for (std::size_t i = 0; i < pixels.colour.size(); ++i) {
    if (pixels.colour[i] != 0)
      add_pixel(*(hsv.begin() + static_cast<std::ptrdiff_t>(i)), histogram);
  }
  return {root_of_shares(histogram), {}};
}

}  // namespace vantage
