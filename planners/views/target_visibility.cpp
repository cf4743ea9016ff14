#include "vantage/planners/views/target_visibility.hpp"

#include <algorithm>

#include "vantage/core/error.hpp"

namespace vantage {

double visible_share(const GridFrame& frame, std::span<const float> transmission,
                     const UprightCylinder& target, std::span<const std::uint8_t> own,
                     const Eigen::Vector3d& p_eye_m, double margin_m) {
  expects(transmission.size() == frame.size(), "a transmission for each cell");
  expects(own.empty() || own.size() == frame.size(), "a flag for each cell");
  const auto hides_itself = [&](std::size_t index, const Eigen::Array3i& cell) {
    return own.empty() ? target.contains(frame.centre(cell), margin_m) : own[index] != 0;
  };
  double share = 0.0;
  for (const SurfaceSample& sample : facing_samples(target, p_eye_m)) {
    double passes = 1.0;
    walk_ray(frame, p_eye_m, sample.p_world_m, [&](std::size_t index, const Eigen::Array3i& cell) {
      const double of_cell = static_cast<double>(transmission[index]);
      if (of_cell < 1.0 && !hides_itself(index, cell)) passes *= of_cell;
      return passes > 0.0;
    });
    share += sample.weight * passes;
  }
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace vantage
