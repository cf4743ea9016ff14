#include "vantage/tasks/exploration/head_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace vantage {
namespace {

/// Angle below the horizon of a point at the height `row` of an image (1 its lower edge, -1 its
/// upper one) that looks down by `tilt_rad`, in the vertical plane turned by `azimuth_rad`.
double depression_at(double tilt_rad, double half_fovy_rad, double row, double azimuth_rad) {
  return std::atan(std::tan(tilt_rad + row * half_fovy_rad) * std::cos(azimuth_rad));
}

/// Least azimuth at which a side edge of an image is met, over its rows.
double half_width_rad(double tilt_rad, double half_width, double half_height) {
  const auto at = [&](double v) {
    return std::atan2(half_width, std::cos(tilt_rad) - v * std::sin(tilt_rad));
  };
  return std::min(at(half_height), at(-half_height));
}

}  // namespace

void HeadSweep::check() const {
  if (tilts_rad.empty()) throw ConfigError("tilts_rad: expected at least one row");
  if (std::ranges::adjacent_find(tilts_rad, std::greater_equal<>()) != tilts_rad.end()) {
    throw ConfigError("tilts_rad: expected ascending tilts");
  }
}

std::vector<double> pan_angles_rad(const HeadSweep& sweep) {
  std::vector<double> pans_rad;
  for (int i = 0; i < sweep.pans; ++i) {
    pans_rad.push_back((i - 0.5 * (sweep.pans - 1)) * 2.0 * std::numbers::pi / sweep.pans);
  }
  return pans_rad;
}

SweepImages images_of(const HeadSweep& sweep, const RgbdOptions& camera) {
  std::vector<Gaze> gazes;
  for (const double tilt_rad : sweep.tilts_rad) {
    for (const double pan_rad : pan_angles_rad(sweep)) gazes.push_back({pan_rad, tilt_rad});
  }
  const double half_height = std::tan(0.5 * camera.fovy_rad);
  return {std::move(gazes), half_height * camera.width_px / camera.height_px, half_height};
}

FieldOfView swept_field(const HeadSweep& sweep, const RgbdOptions& camera, double camera_ahead_m) {
  check_options(sweep, "sweep");
  const double half_fovy_rad = 0.5 * camera.fovy_rad;
  const double half_height = std::tan(half_fovy_rad);
  const double half_width = half_height * camera.width_px / camera.height_px;
  const double max_azimuth_rad = std::numbers::pi / sweep.pans;
  for (const double tilt_rad : sweep.tilts_rad) {
    if (std::abs(tilt_rad) + half_fovy_rad > 1.5) {
      throw ConfigError(
          fmt::format("sweep.tilts_rad: at tilt {} the image reaches past the vertical", tilt_rad));
    }
    if (half_width_rad(tilt_rad, half_width, half_height) < max_azimuth_rad) {
      throw ConfigError(fmt::format("sweep.pans: {} images leave gaps in the row at tilt {}",
                                    sweep.pans, tilt_rad));
    }
  }
  FieldOfView field{
      .range_min_m = 0.0, .range_max_m = camera.range_max_m + camera_ahead_m, .panorama = true};
  // The edges of an image are highest in its middle column and nearest the horizon at its sides.
  const auto bound = [&](double tilt_rad, double row, auto narrower) {
    return narrower(depression_at(tilt_rad, half_fovy_rad, row, 0.0),
                    depression_at(tilt_rad, half_fovy_rad, row, max_azimuth_rad));
  };
  const auto least = [](double a, double b) { return std::min(a, b); };
  const auto most = [](double a, double b) { return std::max(a, b); };
  field.tilt_min_rad = bound(sweep.tilts_rad.front(), -1.0, most);
  field.tilt_max_rad = bound(sweep.tilts_rad.front(), 1.0, least);
  for (const double tilt_rad : sweep.tilts_rad) {
    if (bound(tilt_rad, -1.0, most) > field.tilt_max_rad) {
      throw ConfigError(fmt::format("sweep.tilts_rad: a gap above the row at tilt {}", tilt_rad));
    }
    field.tilt_max_rad = bound(tilt_rad, 1.0, least);
  }
  return field;
}

}  // namespace vantage
