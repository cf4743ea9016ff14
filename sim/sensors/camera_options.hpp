/// An RGB-D camera: what it measures, and how well.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct RgbdOptions {
  int width_px = 640;
  int height_px = 480;
  double fovy_rad = 0.7853981633974483;
  double range_min_m = 0.8;
  double range_max_m = 3.5;
  bool tells_far = false;
  bool noise = true;
  double noise_floor_m = 0.0012;
  double noise_growth_per_m = 0.0019;
  double noise_nearest_m = 0.4;
  double quantisation_per_m = 0.003;
  void fields(auto&& f) {
    f("width_px", width_px, "higher resolves more, renders slower", between(1, 8192));
    f("height_px", height_px, "higher resolves more, renders slower", between(1, 8192));
    f("fovy_rad", fovy_rad, "vertical field of view (45 deg); higher sees more",
      between(0.01, 3.0));
    f("range_min_m", range_min_m, "nearer surfaces give no depth", at_least(0.0));
    f("range_max_m", range_max_m, "farther surfaces give no depth", above(0.0));
    f("tells_far", tells_far,
      "true: +inf where the nearest surface is beyond range_max_m, as cameras tell that time light "
      "or report confidence; false: no reading (0) there as where it is too near");
    f("noise", noise, "false: exact depth within the range");
    f("noise_floor_m", noise_floor_m, "axial sigma at its smallest; higher is noisier",
      at_least(0.0));
    f("noise_growth_per_m", noise_growth_per_m, "sigma's growth with squared distance",
      at_least(0.0));
    f("noise_nearest_m", noise_nearest_m, "distance of the smallest sigma", at_least(0.0));
    f("quantisation_per_m", quantisation_per_m, "step of 1/z, so 0.003 z^2 m in depth; 0 is off",
      at_least(0.0));
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
  double exposure_s = 0.004;
  int samples = 4;
  void fields(auto&& f) {
    f("exposure_s", exposure_s, "higher blurs more; 0 is sharp", between(0.0, 0.1));
    f("samples", samples, "images averaged; higher blurs more smoothly, renders slower",
      between(1, 64));
  }
};

}  // namespace vantage
