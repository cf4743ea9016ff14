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
    f("min_height_m", min_height_m,
      "least height of a support surface in the world frame; lower ones are floor",
      between(-10.0, 100.0));
    f("max_height_m", max_height_m, "greatest height of a support surface in the world frame",
      between(-10.0, 100.0));
    f("columns", columns,
      "number of image columns that are used; higher resolves finer and is slower",
      between(16, 4096));
    f("cell_m", cell_m,
      "cell edge of the raster that surfaces are found in; higher bridges wider gaps and is "
      "coarser",
      between(0.002, 0.5));
    f("min_area_m2", min_area_m2,
      "least visible area of a support surface beside its objects; smaller ones are ignored",
      above(0.0));
    f("inlier_distance_m", inlier_distance_m,
      "greatest distance of a point from its surface; higher tolerates more noise", above(0.0));
    f("max_tilt_rad", max_tilt_rad,
      "greatest tilt of a support surface from horizontal, errors of the estimated pose included",
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
