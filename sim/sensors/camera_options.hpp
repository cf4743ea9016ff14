/// An RGB-D camera: what it measures, and how well.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct RgbdOptions {
  int width_px = 640;
  int height_px = 480;
  double fovy_rad = 0.7853981633974483;  // 45 deg
  double range_min_m = 0.8;
  double range_max_m = 3.5;
  bool tells_far = false;  ///< as cameras that time light or report confidence
  bool noise = true;
  double noise_floor_m = 0.0012;
  double noise_growth_per_m = 0.0019;
  double noise_nearest_m = 0.4;
  double quantisation_per_m = 0.003;
  void fields(auto&& f) {
    f("width_px", width_px, "width of the image; higher resolves finer and renders slower",
      between(1, 8192));
    f("height_px", height_px, "height of the image; higher resolves finer and renders slower",
      between(1, 8192));
    f("fovy_rad", fovy_rad, "vertical field of view; higher sees more, less finely",
      between(0.01, 3.0));
    f("range_min_m", range_min_m, "least depth; nearer surfaces give none", at_least(0.0));
    f("range_max_m", range_max_m, "greatest depth; farther surfaces give none", above(0.0));
    f("tells_far", tells_far,
      "true: depth is infinite where the nearest surface is beyond `range_max_m`; false: there is "
      "no reading, as where it is too near");
    f("noise", noise, "true: depth is noisy and quantised; false: exact within the range");
    f("noise_floor_m", noise_floor_m, "least standard deviation of depth; higher is noisier",
      at_least(0.0));
    f("noise_growth_per_m", noise_growth_per_m,
      "growth of the standard deviation of depth with the squared distance from `noise_nearest_m`; "
      "higher is noisier far away",
      at_least(0.0));
    f("noise_nearest_m", noise_nearest_m,
      "distance at which the standard deviation of depth is least", at_least(0.0));
    f("quantisation_per_m", quantisation_per_m,
      "step of the inverse depth, so that depth z is in steps of this times z^2; higher is "
      "coarser; 0: none",
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
    f("exposure_s", exposure_s, "exposure time; higher blurs images more in motion; 0: sharp",
      between(0.0, 0.1));
    f("samples", samples,
      "number of images that are averaged over the exposure; higher blurs more smoothly and "
      "renders slower",
      between(1, 64));
  }
};

}  // namespace vantage
