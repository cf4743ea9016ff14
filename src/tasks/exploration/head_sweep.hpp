/// Where the head turns its camera to see all round, and what it sees then.
#pragma once

#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/gaze.hpp"
#include "vantage/sim/sensors/camera_options.hpp"

namespace vantage {

/// Where the head turns the camera at a stop: rows of images at one tilt, all round.
struct HeadSweep {
  int pans = 9;
  std::vector<double> tilts_rad{0.0, 0.7};
  void fields(auto&& f) {
    f("pans", pans, "images per row, evenly all round; more overlap, and take longer",
      between(1, 360));
    f("tilts_rad", tilts_rad, "tilt of each row of images, ascending; positive looks down",
      between(-1.5, 1.5));
  }
  void check() const;  ///< at least one row, tilts ascending
};

/// Pan angles of a row, evenly round, ascending.
std::vector<double> pan_angles_rad(const HeadSweep& sweep);
/// Row by row, as pan_angles_rad() has them.
SweepImages images_of(const HeadSweep& sweep, const RgbdOptions& camera);
/// What the images of a sweep see from the head's pan axis in every direction. Nearer than
/// range_min_m space is seen empty, though no surface is.
/// @param camera_ahead_m how far the camera is before the axis: it sees so much farther
/// @throws ConfigError if the images leave gaps, between the columns or between the rows.
FieldOfView swept_field(const HeadSweep& sweep, const RgbdOptions& camera, double camera_ahead_m);

}  // namespace vantage
