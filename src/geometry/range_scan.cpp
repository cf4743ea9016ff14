#include "src/geometry/range_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vantage {
namespace {

struct Bracket {
  std::size_t low = 0;
  std::size_t high = 0;
  bool inside = false;
};

Bracket bracket(const std::vector<double>& ascending, double value) {
  if (ascending.empty() || value < ascending.front() || value > ascending.back()) return {};
  const auto above = std::ranges::lower_bound(ascending, value);
  const auto high = static_cast<std::size_t>(above - ascending.begin());
  return {*above == value || high == 0 ? high : high - 1, high, true};
}

struct Cell {
  Bracket line;
  Bracket beam;
  [[nodiscard]] bool inside() const { return line.inside && beam.inside; }
};

/// Looks behind itself through beams turned by more than a right angle.
bool wider_than_half_turn(const RangeScan& scan) {
  constexpr double right_angle = std::numbers::pi / 2.0;
  return !scan.azimuth_rad.empty() &&
         (scan.azimuth_rad.front() < -right_angle || scan.azimuth_rad.back() > right_angle);
}

Cell locate(const RangeScan& scan, const BeamAngles& angles) {
  return {bracket(scan.tilt_rad, angles.tilt_rad), bracket(scan.azimuth_rad, angles.azimuth_rad)};
}

}  // namespace

float RangeScan::swept_range(const BeamAngles& angles) const {
  Cell cell = locate(*this, angles);
  if (!cell.inside() && wider_than_half_turn(*this)) cell = locate(*this, turned_over(angles));
  constexpr float invalid = std::numeric_limits<float>::quiet_NaN();
  if (!cell.inside()) return invalid;
  float shortest = std::numeric_limits<float>::infinity();
  for (const std::size_t l : {cell.line.low, cell.line.high}) {
    for (const std::size_t b : {cell.beam.low, cell.beam.high}) {
      const float measured = range(l, b);
      if (std::isnan(measured)) return invalid;
      shortest = std::min(shortest, measured);
    }
  }
  return shortest;
}

}  // namespace vantage
