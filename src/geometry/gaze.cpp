#include "vantage/geometry/gaze.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

Eigen::Vector3d direction_of(const Gaze& gaze) {
  const double level = std::cos(gaze.tilt_rad);
  return {level * std::cos(gaze.pan_rad), level * std::sin(gaze.pan_rad), -std::sin(gaze.tilt_rad)};
}

SweepImages::SweepImages(std::vector<Gaze> gazes, double tan_half_width, double tan_half_height)
    : gazes_(std::move(gazes)), tan_half_width_(tan_half_width), tan_half_height_(tan_half_height) {
  expects(!gazes_.empty(), "a sweep of images");
  for (const Gaze& gaze : gazes_) {
    const Eigen::Vector3d ahead = direction_of(gaze);
    const Eigen::Vector3d left(-std::sin(gaze.pan_rad), std::cos(gaze.pan_rad), 0.0);
    axes_.push_back({ahead, left, ahead.cross(left)});
  }
}

bool SweepImages::shows(std::size_t image, const Eigen::Vector3d& p_sweep) const {
  const Axes& axes = axes_[image];
  const double depth_m = axes.ahead.dot(p_sweep);
  return depth_m > 0.0 && std::abs(axes.left.dot(p_sweep)) <= tan_half_width_ * depth_m &&
         std::abs(axes.up.dot(p_sweep)) <= tan_half_height_ * depth_m;
}

bool SweepImages::any_shows(std::span<const std::size_t> images,
                            const Eigen::Vector3d& p_sweep) const {
  return std::ranges::any_of(images, [&](std::size_t image) { return shows(image, p_sweep); });
}

std::size_t SweepImages::nearest(const Eigen::Vector3d& p_sweep) const {
  const auto towards = [&](const Axes& axes) { return axes.ahead.dot(p_sweep); };
  return static_cast<std::size_t>(std::ranges::max_element(axes_, {}, towards) - axes_.begin());
}

}  // namespace vantage
