#include "vantage/planners/visibility/beam_gain.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace vantage {
namespace {

/// Middles of the fewest equal parts of [low, high] that are no longer than `step`.
std::vector<double> middles(double low, double high, double step) {
  const double parts = std::max(1.0, std::ceil((high - low) / step));
  std::vector<double> values(static_cast<std::size_t>(parts));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = low + (high - low) * (static_cast<double>(i) + 0.5) / parts;
  }
  return values;
}

}  // namespace

std::vector<Eigen::Vector3d> beam_directions(const FieldOfView& fov, const BeamFan& fan) {
  const double half_width_rad = fov.panorama ? std::numbers::pi : fov.half_width_rad;
  const auto azimuths = middles(-half_width_rad, half_width_rad, fan.step_rad);
  std::vector<Eigen::Vector3d> directions;
  for (const double tilt_rad : middles(fov.tilt_min_rad, fov.tilt_max_rad, fan.step_rad)) {
    for (const double azimuth_rad : azimuths) {
      directions.push_back(fov.panorama ? make_pose(Eigen::Vector3d::Zero(), azimuth_rad) *
                                              beam_direction({0.0, tilt_rad})
                                        : beam_direction({azimuth_rad, tilt_rad}));
    }
  }
  return directions;
}

}  // namespace vantage
