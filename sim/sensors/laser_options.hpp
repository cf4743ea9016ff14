/// Laser scanners: what they measure, and how well.
#pragma once

#include "vantage/core/fields.hpp"
#include "vantage/geometry/field_of_view.hpp"

namespace vantage {

/// A Hokuyo-like line scanner on a tilt joint.
struct LaserOptions {
  double sector_rad = 0.2617993877991494;  ///< width of a line (15 deg); higher sees more per scan
  double step_rad = 0.004363323129985824;  ///< between beams (0.25 deg); higher is coarser, faster
  double line_rate_hz = 40.0;              ///< lines per second; higher packs lines closer
  double tilt_min_rad = -0.36;             ///< where the sweep starts (negative looks up)
  double tilt_max_rad = 0.62;              ///< where it ends; higher looks nearer to the robot
  double scan_duration_s = 15.0;           ///< of a sweep; higher packs lines closer
  double range_min_m = 0.08;               ///< nearer returns are invalid
  double range_max_m = 10.0;               ///< farther surfaces give no return
  double noise_sigma_m = 0.005;            ///< Gaussian, on each range
  void fields(auto&& f) {
    f("sector_rad", sector_rad, Range{0.0, 3.1416, true});
    f("step_rad", step_rad, above(0.0));
    f("line_rate_hz", line_rate_hz, above(0.0));
    f("tilt_min_rad", tilt_min_rad, between(-1.5, 1.5));
    f("tilt_max_rad", tilt_max_rad, between(-1.5, 1.5));
    f("scan_duration_s", scan_duration_s, between(0.1, 3600.0));
    f("range_min_m", range_min_m, at_least(0.0));
    f("range_max_m", range_max_m, above(0.0));
    f("noise_sigma_m", noise_sigma_m, at_least(0.0));
  }
  void check() const;  ///< minima below maxima, step within the sector, at most 10^7 beams
};

/// What a scan with these options sweeps; its width is that of the outermost beams.
FieldOfView field_of_view(const LaserOptions& options);

/// A fixed scanner parallel to the floor, for driving.
struct PlanarScannerOptions {
  double sector_rad = 4.71238898038469;    ///< 270 deg; higher sees more to the sides
  double step_rad = 0.008726646259971648;  ///< between beams (0.5 deg); higher is coarser, faster
  double range_min_m = 0.05;               ///< nearer returns are invalid
  double range_max_m = 10.0;               ///< farther surfaces give no return
  double noise_sigma_m = 0.01;             ///< Gaussian, on each range
  void fields(auto&& f) {
    f("sector_rad", sector_rad, Range{0.0, 6.2832, true});
    f("step_rad", step_rad, above(0.0));
    f("range_min_m", range_min_m, at_least(0.0));
    f("range_max_m", range_max_m, above(0.0));
    f("noise_sigma_m", noise_sigma_m, at_least(0.0));
  }
  void check() const;  ///< minimum below maximum, step within the sector, at most 10^7 beams
};

}  // namespace vantage
