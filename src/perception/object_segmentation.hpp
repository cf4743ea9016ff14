/// The one object on a table, cut out of an image by depth.
#pragma once

#include <optional>
#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/perception/object_view.hpp"
#include "vantage/perception/table_extraction.hpp"

namespace vantage {

struct ObjectSegmentationOptions {
  double radius_m = 0.2;
  double max_height_m = 0.5;
  double min_height_m = 0.006;
  double table_tolerance_m = 0.06;
  int min_pixels = 150;
  int mask_growth_px = 1;
  int margin_px = 3;
  void fields(auto&& f) {
    f("radius_m", radius_m,
      "greatest horizontal distance of the object's points from the place where it stands; higher "
      "takes in more of its surroundings",
      Range{0.0, 2.0, true});
    f("max_height_m", max_height_m, "greatest height of the object above its support surface",
      Range{0.0, 2.0, true});
    f("min_height_m", min_height_m,
      "height above the support surface from which points are object and not noise; higher loses "
      "more of the object's foot",
      between(0.0, 0.1));
    f("table_tolerance_m", table_tolerance_m,
      "how far above and below its known height the table top is looked for, because of pose "
      "errors; of no effect where the height of supports is found, as in `trajectory`",
      Range{0.0, 0.5, true});
    f("min_pixels", min_pixels,
      "least number of pixels of an object; smaller patches are taken for noise", at_least(1));
    f("mask_growth_px", mask_growth_px, "how far the mask is grown beyond what was found",
      between(0, 20));
    f("margin_px", margin_px, "margin of the crop round the mask", between(0, 50));
  }
};

struct SegmentedObject {
  std::optional<ObjectView> view;
  std::string reason;      ///< why there is none; empty when found
  bool place_seen = true;  ///< whether the image shows where it is to stand, empty or not
};

/// The largest connected patch of what rises from the table near its middle. The table's plane is
/// found in the image itself, so that an error of the pose shifts the column but not the cut
/// between object and table. Mask and `up` are what the camera's owner can know: no truth is used.
/// @param images measured depth, and colour if the view is to have it
/// @param T_world_camera as estimated, OpenCV's axes
/// @param p_world_table_m middle of the table top, on its surface
SegmentedObject segment_object(const CameraImages& images, const Pose& T_world_camera,
                               const Eigen::Vector3d& p_world_table_m,
                               const ObjectSegmentationOptions& options, Rng& rng);

/// Gives a view that was cut out of the depth of `images` its colour.
void take_colour(const CameraImages& images, ObjectView& view);

}  // namespace vantage
