#include "vantage/perception/features/kit/object_pixels.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "vantage/core/error.hpp"
#include "vantage/information/quantile.hpp"

namespace vantage {
namespace {

constexpr int kErosion_px = 2;
constexpr double kOutlierDeviations = 4.0;

void expect_whole(const ObjectView& view) {
  const auto pixels = static_cast<std::size_t>(view.width_px) * view.height_px;
  expects(view.width_px >= 0 && view.height_px >= 0 && view.rgb.size() == 3 * pixels &&
              view.depth_m.size() == pixels && view.mask.size() == pixels,
          "an object view's images have its size");
}

int count_of(const std::vector<std::uint8_t>& flags) {
  return std::accumulate(flags.begin(), flags.end(), 0);
}

std::vector<std::uint8_t> eroded_mask(const ObjectView& view) {
  std::vector<std::uint8_t> mask(view.mask.size());
  std::ranges::transform(view.mask, mask.begin(), [](std::uint8_t m) { return m != 0 ? 1 : 0; });
  const int whole = count_of(mask);
  cv::Mat source(view.height_px, view.width_px, CV_8U, mask.data());
  for (int radius_px = kErosion_px; radius_px > 0 && whole > 0; --radius_px) {
    const int side_px = 2 * radius_px + 1;
    std::vector<std::uint8_t> eroded(mask.size());
    cv::Mat target(view.height_px, view.width_px, CV_8U, eroded.data());
    cv::erode(source, target, cv::Mat::ones(side_px, side_px, CV_8U));
    if (2 * count_of(eroded) >= whole) return eroded;
  }
  return mask;
}

/// To the middle of what is marked: unit length, camera frame; the optical axis if nothing is.
Eigen::Vector3d sight_of(const ObjectView& view, const std::vector<std::uint8_t>& marked) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (marked[view.index(row, column)] != 0) sum += view.ray(row, column);
    }
  }
  return sum.isZero() ? Eigen::Vector3d::UnitZ() : sum.normalized();
}

void mark_depth(const ObjectView& view, const OutlierOptions& outliers, ObjectPixels& pixels) {
  pixels.depth.assign(view.depth_m.size(), 0);
  const Eigen::Vector3d sight =
      outliers.along_sight ? sight_of(view, pixels.colour) : Eigen::Vector3d::UnitZ();
  std::vector<double> depths_m;
  std::vector<std::size_t> places;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t i = view.index(row, column);
      const float z = view.depth_m[i];
      if (pixels.colour[i] == 0 || !std::isfinite(z) || !(z > 0.0F)) continue;
      depths_m.push_back(outliers.along_sight ? sight.dot(view.point(row, column)) : z);
      places.push_back(i);
    }
  }
  if (depths_m.empty()) return;
  const double median_m = quantile(depths_m, 0.5);
  for (double& z : depths_m) z = std::abs(z - median_m);
  const double reach_m = std::max(kOutlierDeviations * quantile(depths_m, 0.5), outliers.floor_m);
  for (std::size_t k = 0; k < places.size(); ++k) {
    pixels.depth[places[k]] = depths_m[k] <= reach_m ? 1 : 0;
  }
}

void mark_bounds(ObjectPixels& pixels) {
  pixels.left_px = pixels.width_px;
  pixels.top_px = pixels.height_px;
  std::size_t i = 0;
  for (int row = 0; row < pixels.height_px; ++row) {
    for (int column = 0; column < pixels.width_px; ++column, ++i) {
      if (pixels.colour[i] == 0) continue;
      pixels.left_px = std::min(pixels.left_px, column);
      pixels.top_px = std::min(pixels.top_px, row);
      pixels.right_px = std::max(pixels.right_px, column + 1);
      pixels.bottom_px = std::max(pixels.bottom_px, row + 1);
    }
  }
}

}  // namespace

ObjectPixels object_pixels(const ObjectView& view, const OutlierOptions& outliers) {
  expect_whole(view);
  ObjectPixels pixels;
  pixels.width_px = view.width_px;
  pixels.height_px = view.height_px;
  if (view.mask.empty()) return pixels;
  pixels.colour = eroded_mask(view);
  mark_depth(view, outliers, pixels);
  pixels.colour_count = count_of(pixels.colour);
  pixels.depth_count = count_of(pixels.depth);
  mark_bounds(pixels);
  return pixels;
}

std::string lacks_colour(const ObjectPixels& pixels, int min_pixels) {
  if (pixels.colour_count >= min_pixels) return {};
  return fmt::format("the mask has {} usable pixels, fewer than {}", pixels.colour_count,
                     min_pixels);
}

std::string lacks_depth(const ObjectPixels& pixels, int min_pixels) {
  if (pixels.depth_count >= min_pixels) return {};
  return fmt::format("{} pixels of the object have depth, fewer than {}", pixels.depth_count,
                     min_pixels);
}

std::array<float, 2> place_in_box(const ObjectPixels& pixels, double x_px, double y_px) {
  const double x = (x_px - pixels.left_px) / std::max(1, pixels.right_px - pixels.left_px);
  const double y = (y_px - pixels.top_px) / std::max(1, pixels.bottom_px - pixels.top_px);
  return {static_cast<float>(std::clamp(x, 0.0, 1.0)), static_cast<float>(std::clamp(y, 0.0, 1.0))};
}

ObjectPixels resized(const ObjectPixels& pixels, int width_px, int height_px) {
  if (pixels.colour.empty()) return pixels;
  ObjectPixels result;
  result.width_px = width_px;
  result.height_px = height_px;
  const auto resize = [&](std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& from) {
    to.resize(static_cast<std::size_t>(width_px) * height_px);
    const cv::Mat source(pixels.height_px, pixels.width_px, CV_8U,
                         const_cast<std::uint8_t*>(from.data()));
    cv::Mat target(height_px, width_px, CV_8U, to.data());
    cv::resize(source, target, target.size(), 0.0, 0.0, cv::INTER_NEAREST);
  };
  resize(result.colour, pixels.colour);
  resize(result.depth, pixels.depth);
  result.colour_count = count_of(result.colour);
  result.depth_count = count_of(result.depth);
  mark_bounds(result);
  return result;
}

ObjectView resized(const ObjectView& view, int width_px, int height_px) {
  if (width_px == view.width_px && height_px == view.height_px) return view;
  ObjectView result = view;
  const auto resize = [&](auto& target, const auto& source, int type, int mode) {
    using Value = typename std::decay_t<decltype(source)>::value_type;
    target.resize(static_cast<std::size_t>(width_px) * height_px * CV_MAT_CN(type));
    const cv::Mat from(view.height_px, view.width_px, type, const_cast<Value*>(source.data()));
    cv::Mat to(height_px, width_px, type, target.data());
    cv::resize(from, to, to.size(), 0.0, 0.0, mode);
  };
  const bool shrinks = width_px < view.width_px;
  resize(result.rgb, view.rgb, CV_8UC3, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
  resize(result.depth_m, view.depth_m, CV_32F, cv::INTER_NEAREST);
  resize(result.mask, view.mask, CV_8U, cv::INTER_NEAREST);
  const double scale = static_cast<double>(width_px) / view.width_px;
  result.width_px = width_px;
  result.height_px = height_px;
  result.left_px = static_cast<int>(std::lround(view.left_px * scale));
  result.top_px = static_cast<int>(std::lround(view.top_px * scale));
  result.focal_px = view.focal_px * scale;
  result.centre_px = view.centre_px * scale;
  result.cut_off.clear();  // a line of pixels, of which resizing leaves some
  return result;
}

}  // namespace vantage
