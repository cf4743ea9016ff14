/// Where a head turns its camera, and what it sees then.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace vantage {

/// Of one image, from the pose that a sweep is taken from: x forward, y left, z up.
struct Gaze {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;  ///< positive looks down
};
/// Where the middle of the image is, of length 1.
Eigen::Vector3d direction_of(const Gaze& gaze);

/// The images that a sweep is made of, by direction alone: the camera is as good as on the pan
/// axis.
class SweepImages {
 public:
  /// All of one width and height. @param tan_half_width of the angle of view
  SweepImages(std::vector<Gaze> gazes, double tan_half_width, double tan_half_height);

  [[nodiscard]] const std::vector<Gaze>& gazes() const { return gazes_; }
  [[nodiscard]] bool shows(std::size_t image, const Eigen::Vector3d& p_sweep) const;
  /// Whether any of these images does.
  [[nodiscard]] bool any_shows(std::span<const std::size_t> images,
                               const Eigen::Vector3d& p_sweep) const;
  /// The image whose middle is nearest in direction; of equals the first.
  [[nodiscard]] std::size_t nearest(const Eigen::Vector3d& p_sweep) const;

 private:
  /// Of an image, each of length 1.
  struct Axes {
    Eigen::Vector3d ahead;
    Eigen::Vector3d left;
    Eigen::Vector3d up;
  };

  std::vector<Gaze> gazes_;
  std::vector<Axes> axes_;  ///< of each
  double tan_half_width_ = 0.0;
  double tan_half_height_ = 0.0;
};

}  // namespace vantage
