/// Which pixels of a view can be trusted to show the object. Masks reach over its edges and depth
/// there belongs to what lies behind; every feature starts from here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vantage/perception/object_view.hpp"

namespace vantage {

struct ObjectPixels {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> colour;  ///< 1: inside the eroded mask; row-major as the view's
  std::vector<std::uint8_t> depth;   ///< 1: in `colour`, measured, no outlier
  int colour_count = 0;
  int depth_count = 0;
  int left_px = 0;    ///< first column of `colour`
  int top_px = 0;     ///< first row of `colour`
  int right_px = 0;   ///< one past its last column
  int bottom_px = 0;  ///< one past its last row
};

/// What is no outlier of depth however little the object is spread.
struct OutlierOptions {
  double floor_m = 0.02;  ///< higher keeps a bowl's far wall, and more of what is behind an object
  /// Depth is taken along the line of sight to the mask's middle, not along the optical axis: the
  /// same pixels then count wherever in the image the object is.
  bool along_sight = false;
};

/// The mask loses 2 px at its edges, fewer where that would take more than half of it; the frame's
/// border is no edge. Of its depths, those farther from the median than 4 median absolute
/// deviations, and than the floor, are outliers: an object spread evenly in depth reaches 2 of
/// them.
ObjectPixels object_pixels(const ObjectView& view, const OutlierOptions& outliers = {});

/// Why fewer than `min_pixels` pixels of colour, or of depth, are too few; empty if there are
/// enough.
std::string lacks_colour(const ObjectPixels& pixels, int min_pixels);
std::string lacks_depth(const ObjectPixels& pixels, int min_pixels);

/// Bounds of pyramid cells and patches: `x_px`, `y_px` as shares of the object's box, 0 .. 1.
std::array<float, 2> place_in_box(const ObjectPixels& pixels, double x_px, double y_px);

/// Flags of the same pixels at another size, each of the nearest. Pixels are told apart at the
/// camera's own resolution, before a view is resized: what is interpolated stays on the object.
ObjectPixels resized(const ObjectPixels& pixels, int width_px, int height_px);

/// The view at another size: colour averaged or interpolated, depth and mask of the nearest pixel,
/// intrinsics scaled with it.
ObjectView resized(const ObjectView& view, int width_px, int height_px);

}  // namespace vantage
