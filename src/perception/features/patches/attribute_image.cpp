#include "vantage/perception/features/patches/attribute_image.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage {
namespace {

constexpr int kMinSide_px = 45;
constexpr int kMaxSide_px = 300;
constexpr double kGradientSigma_px = 0.8;
constexpr int kGradientRadius_px = 2;
constexpr double kVarianceFloor = 0.001;

cv::Mat colours_of(const ObjectView& view) {
  const cv::Mat rgb(view.height_px, view.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(view.rgb.data()));
  cv::Mat scaled;
  rgb.convertTo(scaled, CV_32FC3, 1.0 / 255.0);
  return scaled;
}

cv::Mat grey_of(const ObjectView& view) {
  cv::Mat grey;
  cv::cvtColor(colours_of(view), grey, cv::COLOR_RGB2GRAY);
  return grey;
}

cv::Mat flags_of(const ObjectView& view, const std::vector<std::uint8_t>& flags) {
  return cv::Mat(view.height_px, view.width_px, CV_8U, const_cast<std::uint8_t*>(flags.data()));
}

/// Where depth is known in a square around.
cv::Mat known_around(const ObjectView& view, const ObjectPixels& pixels, int radius_px) {
  const int side_px = 2 * radius_px + 1;
  cv::Mat known;
  cv::erode(flags_of(view, pixels.depth), known, cv::Mat::ones(side_px, side_px, CV_8U),
            cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return known;
}

/// Zero where it is not known.
cv::Mat depth_of(const ObjectView& view, const ObjectPixels& pixels) {
  cv::Mat depth = cv::Mat::zeros(view.height_px, view.width_px, CV_32F);
  for (std::size_t i = 0; i < pixels.depth.size(); ++i) {
    if (pixels.depth[i] != 0) depth.at<float>(static_cast<int>(i)) = view.depth_m[i];
  }
  return depth;
}

AttributeImage empty_image(const cv::Mat& like, int axes) {
  const auto pixels = static_cast<Eigen::Index>(like.total());
  return {like.cols, like.rows, Eigen::MatrixXf::Zero(axes, pixels), Eigen::VectorXf::Zero(pixels)};
}

AttributeImage gradients(const cv::Mat& values, const cv::Mat& valid) {
  constexpr int taps = 2 * kGradientRadius_px + 1;
  cv::Mat smooth(taps, 1, CV_32F);
  cv::Mat derive(taps, 1, CV_32F);
  for (int i = 0; i < taps; ++i) {
    const double x = i - kGradientRadius_px;
    const double bell = std::exp(-x * x / (2.0 * kGradientSigma_px * kGradientSigma_px));
    smooth.at<float>(i) = static_cast<float>(bell);
    derive.at<float>(i) = static_cast<float>(x * bell);
  }
  smooth /= cv::norm(smooth, cv::NORM_L1);
  derive *= 2.0 / cv::norm(derive, cv::NORM_L1);
  cv::Mat gx;
  cv::Mat gy;
  const cv::Point centre(-1, -1);
  cv::sepFilter2D(values, gx, CV_32F, derive, smooth, centre, 0.0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(values, gy, CV_32F, smooth, derive, centre, 0.0, cv::BORDER_REPLICATE);
  AttributeImage image = empty_image(values, 2);
  for (int i = 0; i < static_cast<int>(values.total()); ++i) {
    const float norm = std::hypot(gx.at<float>(i), gy.at<float>(i));
    if (valid.at<std::uint8_t>(i) == 0 || !(norm > 0.0F)) continue;
    image.attributes(0, i) = gx.at<float>(i) / norm;
    image.attributes(1, i) = gy.at<float>(i) / norm;
    image.weights[i] = norm;
  }
  return image;
}

AttributeImage patterns(const cv::Mat& values, const cv::Mat& valid) {
  constexpr std::array<std::array<int, 2>, 8> around{
      {{-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}}};
  cv::Mat padded;
  cv::copyMakeBorder(values, padded, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  AttributeImage image = empty_image(values, 1);
  Eigen::Index i = 0;
  for (int row = 0; row < values.rows; ++row) {
    for (int column = 0; column < values.cols; ++column, ++i) {
      if (valid.at<std::uint8_t>(row, column) == 0) continue;
      const float centre = values.at<float>(row, column);
      unsigned code = 0;
      float sum = 0.0F;  // of differences from the centre, whose own is zero
      float sum2 = 0.0F;
      for (std::size_t k = 0; k < around.size(); ++k) {
        const float d =
            padded.at<float>(row + 1 + around[k][0], column + 1 + around[k][1]) - centre;
        code |= (d >= 0.0F ? 1U : 0U) << k;
        sum += d;
        sum2 += d * d;
      }
      image.attributes(0, i) = static_cast<float>(code);
      image.weights[i] = std::sqrt(std::max(0.0F, sum2 / 9.0F - sum * sum / 81.0F));
    }
  }
  return image;
}

}  // namespace

ObjectView at_kernel_size(const ObjectView& view) {
  const int shorter_px = std::min(view.width_px, view.height_px);
  const int longer_px = std::max(view.width_px, view.height_px);
  if (shorter_px < 1) return view;
  double scale = std::max(1.0, static_cast<double>(kMinSide_px) / shorter_px);
  scale = std::min(scale, static_cast<double>(kMaxSide_px) / longer_px);
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  return resized(view, side(view.width_px), side(view.height_px));
}

AttributeImage rgb_gradient_image(const ObjectView& view, const ObjectPixels& pixels) {
  return gradients(grey_of(view), flags_of(view, pixels.colour));
}

AttributeImage depth_gradient_image(const ObjectView& view, const ObjectPixels& pixels) {
  return gradients(depth_of(view, pixels), known_around(view, pixels, kGradientRadius_px));
}

AttributeImage lbp_image(const ObjectView& view, const ObjectPixels& pixels) {
  return patterns(grey_of(view), flags_of(view, pixels.colour));
}

AttributeImage depth_lbp_image(const ObjectView& view, const ObjectPixels& pixels) {
  return patterns(depth_of(view, pixels), known_around(view, pixels, 1));
}

AttributeImage normalised_rgb_image(const ObjectView& view, const ObjectPixels& pixels) {
  const cv::Mat rgb = colours_of(view);
  const cv::Size window(5, 5);
  cv::Mat mean;
  cv::transform(rgb, mean, cv::Matx13f(1.0F / 3.0F, 1.0F / 3.0F, 1.0F / 3.0F));
  cv::blur(mean, mean, window);
  cv::Mat squares(rgb.size(), CV_32F);
  for (int i = 0; i < static_cast<int>(rgb.total()); ++i) {
    const cv::Vec3f d = rgb.at<cv::Vec3f>(i) - cv::Vec3f::all(mean.at<float>(i));
    squares.at<float>(i) = d.dot(d);
  }
  cv::blur(squares, squares, window);
  AttributeImage image = empty_image(rgb, 3);
  for (int i = 0; i < static_cast<int>(rgb.total()); ++i) {
    if (pixels.colour[static_cast<std::size_t>(i)] == 0) continue;
    const auto deviation = static_cast<float>(std::sqrt(squares.at<float>(i) + kVarianceFloor));
    const cv::Vec3f d = rgb.at<cv::Vec3f>(i) - cv::Vec3f::all(mean.at<float>(i));
    for (int c = 0; c < 3; ++c) image.attributes(c, i) = d[c] / deviation / 4.0F;
    image.weights[i] = deviation;
  }
  return image;
}

}  // namespace vantage
