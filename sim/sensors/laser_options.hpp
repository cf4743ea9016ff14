/// Laser scanners: what they measure, and how well.
#pragma once

#include "vantage/core/fields.hpp"
#include "vantage/geometry/field_of_view.hpp"

namespace vantage {

/// A Hokuyo-like line scanner on a tilt joint.
struct LaserOptions {
  double sector_rad = 0.2617993877991494;  // 15 deg
  double step_rad = 0.004363323129985824;  // 0.25 deg
  double line_rate_hz = 40.0;
  double tilt_min_rad = -0.36;
  double tilt_max_rad = 0.62;
  double scan_duration_s = 15.0;
  double range_min_m = 0.08;
  double range_max_m = 10.0;
  double noise_sigma_m = 0.005;
  void fields(auto&& f) {
    f("sector_rad", sector_rad, "angular width of a scan line; higher sees more per scan",
      Range{0.0, 3.1416, true});
    f("step_rad", step_rad, "angle between beams; higher is faster and coarser", above(0.0));
    f("line_rate_hz", line_rate_hz, "scan lines per second; higher packs lines closer", above(0.0));
    f("tilt_min_rad", tilt_min_rad, "tilt at which the sweep starts; negative looks up",
      between(-1.5, 1.5));
    f("tilt_max_rad", tilt_max_rad,
      "tilt at which the sweep ends; higher looks nearer to the robot", between(-1.5, 1.5));
    f("scan_duration_s", scan_duration_s,
      "duration of a sweep; higher packs lines closer and takes longer", between(0.1, 3600.0));
    f("range_min_m", range_min_m, "least range; nearer returns are invalid", at_least(0.0));
    f("range_max_m", range_max_m, "greatest range; farther surfaces give no return", above(0.0));
    f("noise_sigma_m", noise_sigma_m,
      "standard deviation of the Gaussian noise on each range; higher is noisier", at_least(0.0));
  }
  void check() const;  ///< minima below maxima, step within the sector, at most 10^7 beams
};

/// What a scan with these options sweeps; its width is that of the outermost beams.
FieldOfView field_of_view(const LaserOptions& options);

/// A fixed scanner parallel to the floor, for driving.
struct PlanarScannerOptions {
  double sector_rad = 4.71238898038469;    // 270 deg
  double step_rad = 0.008726646259971648;  // 0.5 deg
  double range_min_m = 0.05;
  double range_max_m = 10.0;
  double noise_sigma_m = 0.01;
  void fields(auto&& f) {
    f("sector_rad", sector_rad, "horizontal field of view; higher sees more to the sides",
      Range{0.0, 6.2832, true});
    f("step_rad", step_rad, "angle between beams; higher is faster and coarser", above(0.0));
    f("range_min_m", range_min_m, "least range; nearer returns are invalid", at_least(0.0));
    f("range_max_m", range_max_m, "greatest range; farther surfaces give no return", above(0.0));
    f("noise_sigma_m", noise_sigma_m,
      "standard deviation of the Gaussian noise on each range; higher is noisier", at_least(0.0));
  }
  void check() const;  ///< minimum below maximum, step within the sector, at most 10^7 beams
};

}  // namespace vantage
