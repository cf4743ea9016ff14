/// Detects objects on support surfaces in a depth image; number, places and surfaces are unknown.
#pragma once

#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/object_detection.hpp"
#include "vantage/perception/object_segmentation.hpp"
#include "vantage/perception/search/support_search.hpp"

namespace vantage {

struct ObjectSearchOptions {
  SupportSearchOptions support = {};
  ObjectSegmentationOptions cut{.radius_m = 0.3, .max_height_m = 0.5, .min_pixels = 60};
  double range_m = 3.0;
  double nearest_m = 0.85;
  int border_px = 2;
  double gap_m = 0.05;
  double noise_per_m = 0.0008;
  void fields(auto&& f) {
    f("support", support, "how support surfaces are found");
    f("cut", cut, "how an object is cut out of the image above its support surface");
    f("range_m", range_m,
      "greatest distance of an object that is reported; higher finds objects earlier and places "
      "them worse",
      Range{0.0, 20.0, true});
    f("nearest_m", nearest_m,
      "distance to the object's surface below which depth may be missing and the view does not "
      "count as whole",
      at_least(0.0));
    f("border_px", border_px,
      "distance from the edge of the image within which an object does not count as whole",
      between(0, 100));
    f("gap_m", gap_m,
      "width of gaps between parts of one object; higher joins neighbouring objects",
      between(0.002, 1.0));
    f("noise_per_m", noise_per_m,
      "standard deviation of measured heights per squared distance; higher demands that objects "
      "stand out more",
      between(0.0, 0.1));
  }
};

/// How an object that far away is cut out: what stands out of the noise there.
ObjectSegmentationOptions cut_at(const ObjectSearchOptions& options, double distance_m);

struct SeenObject {
  ObjectDetection detection;
  ObjectView view;  ///< for the recogniser
};

/// Every object that stands alone on a level surface, nearest first. Surfaces are found by
/// find_supports(), what rises from one is clustered, and each cluster is cut out as
/// segment_object() does. What rises higher than `cut.max_height_m`, or mostly stands beside the
/// surface, is no object.
/// @param images measured depth, and colour if the views are to have it: take_colour()
/// @param T_world_camera as estimated, OpenCV's axes
/// @throws ConfigError if options are out of range.
std::vector<SeenObject> find_objects(const CameraImages& images, const Pose& T_world_camera,
                                     const ObjectSearchOptions& options = {});

/// The detections alone, for ObjectTracker.
std::vector<ObjectDetection> detections_of(const std::vector<SeenObject>& seen);

}  // namespace vantage
