/// Level surfaces that something may stand on, found in a depth image.
#pragma once

#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/perception/table_extraction.hpp"

namespace vantage {

struct SupportSearchOptions {
  double min_height_m = 0.3;
  double max_height_m = 1.5;
  int columns = 160;
  double cell_m = 0.05;
  double min_area_m2 = 0.03;
  double inlier_distance_m = 0.02;
  double max_tilt_rad = 0.08;
  void fields(auto&& f) {
    f("min_height_m", min_height_m, "world z; lower surfaces are floor");
    f("max_height_m", max_height_m, "world z");
    f("columns", columns, "of the image that are looked at; higher is slower", between(16, 4096));
    f("cell_m", cell_m, "of the raster that surfaces are found in", Range{0.0, 0.5, true});
    f("min_area_m2", min_area_m2, "of the free part that is seen; smaller ones are none",
      above(0.0));
    f("inlier_distance_m", inlier_distance_m, "of a point from its surface", above(0.0));
    f("max_tilt_rad", max_tilt_rad, "from horizontal, errors of the estimated pose included",
      between(0.0, 0.8));
  }
  void check() const;  ///< min_height_m below max_height_m
};

/// The lowest surface wherever several lie above each other (a book's top is no table), ascending
/// height. `world`: points in the world frame. Without random draws: the same points in, the same
/// surfaces out.
/// @throws ConfigError if options are out of range.
std::vector<TablePlane> find_supports(const PointCloud& world, const SupportSearchOptions& options);

}  // namespace vantage
