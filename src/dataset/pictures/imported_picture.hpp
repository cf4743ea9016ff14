/// A picture on its way into a dataset.
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "vantage/dataset/pictures/picture_layout.hpp"
#include "vantage/perception/dataset_index.hpp"

namespace vantage {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad

struct ImportedPicture {
  FoundPicture picture;
  ViewEntry entry;
  std::optional<double> elevation_deg;  ///< that is known
  std::optional<double> measured_deg;   ///< over the table it shows
  double unit_m = 0.001;
  int width_px = 0;
  bool cropped = false;  ///< out of the image that the intrinsics are of
  std::string bad;       ///< why it cannot be used
};

}  // namespace vantage
