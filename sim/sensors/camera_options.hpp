/// An RGB-D camera: what it measures, and how well.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct RgbdOptions {
  int width_px = 640;                    ///< higher resolves more, renders slower
  int height_px = 480;                   ///< higher resolves more, renders slower
  double fovy_rad = 0.7853981633974483;  ///< vertical field of view (45 deg); higher sees more
  double range_min_m = 0.8;              ///< nearer surfaces give no depth
  double range_max_m = 3.5;              ///< farther surfaces give no depth
  /// true: +inf where the nearest surface is beyond range_max_m, as cameras tell that time light or
  /// report confidence; false: no reading (0) there as where it is too near
  bool tells_far = false;
  bool noise = true;                   ///< false: exact depth within the range
  double noise_floor_m = 0.0012;       ///< axial sigma at its smallest; higher is noisier
  double noise_growth_per_m = 0.0019;  ///< sigma's growth with squared distance
  double noise_nearest_m = 0.4;        ///< distance of the smallest sigma
  double quantisation_per_m = 0.003;   ///< step of 1/z, so 0.003 z^2 m in depth; 0 is off
  void fields(auto&& f) {
    f("width_px", width_px, between(1, 8192));
    f("height_px", height_px, between(1, 8192));
    f("fovy_rad", fovy_rad, between(0.01, 3.0));
    f("range_min_m", range_min_m, at_least(0.0));
    f("range_max_m", range_max_m, above(0.0));
    f("tells_far", tells_far);
    f("noise", noise);
    f("noise_floor_m", noise_floor_m, at_least(0.0));
    f("noise_growth_per_m", noise_growth_per_m, at_least(0.0));
    f("noise_nearest_m", noise_nearest_m, at_least(0.0));
    f("quantisation_per_m", quantisation_per_m, at_least(0.0));
  }
  void check() const;  ///< minimum below maximum
};

/// Standard deviation of a depth reading, m: floor + growth (z - nearest)^2.
/// [NguyenIzadiLovell2012]
double depth_sigma_m(const RgbdOptions& options, double z_m);

/// Standard deviation of a reading from the surface, m: noise and quantisation together.
double depth_error_m(const RgbdOptions& options, double z_m);

/// Focal length of square pixels, px.
double focal_length_px(const RgbdOptions& options);

struct ExposureOptions {
  double exposure_s = 0.004;  ///< higher blurs more; 0 is sharp
  int samples = 4;            ///< images averaged; higher blurs more smoothly, renders slower
  void fields(auto&& f) {
    f("exposure_s", exposure_s, between(0.0, 0.1));
    f("samples", samples, between(1, 64));
  }
};

}  // namespace vantage
