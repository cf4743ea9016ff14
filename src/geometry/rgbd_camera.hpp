/// The sensor that views on a map are scored with if none is given.
#pragma once

#include "vantage/geometry/field_of_view.hpp"

namespace vantage {

/// A Kinect-like RGB-D camera, 57.8 x 45 deg.
inline constexpr FieldOfView kRgbdCamera{.half_width_rad = 0.5044,
                                         .tilt_min_rad = -0.3927,
                                         .tilt_max_rad = 0.3927,
                                         .range_min_m = 0.8,
                                         .range_max_m = 3.5};

}  // namespace vantage
