#include "vantage/geometry/gaze.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {

Eigen::Vector3d direction_of(const Gaze& gaze) {
  const double level = std::cos(gaze.tilt_rad);
  return {level * std::cos(gaze.pan_rad), level * std::sin(gaze.pan_rad), -std::sin(gaze.tilt_rad)};
}

bool SweepImages::shows(std::size_t image, const Eigen::Vector3d& p_sweep) const {
  const Gaze& gaze = gazes[image];
  const Eigen::Vector3d left(-std::sin(gaze.pan_rad), std::cos(gaze.pan_rad), 0.0);
  const Eigen::Vector3d ahead = direction_of(gaze);
  const double depth_m = ahead.dot(p_sweep);
  return depth_m > 0.0 && std::abs(left.dot(p_sweep)) <= tan_half_width * depth_m &&
         std::abs(ahead.cross(left).dot(p_sweep)) <= tan_half_height * depth_m;
}

bool SweepImages::any_shows(std::span<const std::size_t> images,
                            const Eigen::Vector3d& p_sweep) const {
  return std::ranges::any_of(images, [&](std::size_t image) { return shows(image, p_sweep); });
}

std::size_t SweepImages::nearest(const Eigen::Vector3d& p_sweep) const {
  expects(!gazes.empty(), "a sweep of images");
  const auto towards = [&](const Gaze& gaze) { return direction_of(gaze).dot(p_sweep); };
  return static_cast<std::size_t>(std::ranges::max_element(gazes, {}, towards) - gazes.begin());
}

}  // namespace vantage
