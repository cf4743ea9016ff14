/// The surface of an object as one view shows it.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// Why pixels of the view cannot become points; empty if they can.
std::string lacks_geometry(const ObjectView& view);

/// Why heights are not known; empty if they are.
std::string lacks_up(const ObjectView& view);

/// The pixels with depth as points, row by row. 3 x depth_count, metres, camera frame.
Eigen::Matrix3Xd object_points(const ObjectView& view, const ObjectPixels& pixels);

struct ObjectSurface {
  PointCloud cloud;           ///< camera frame; normals unit, towards the camera, or zero
  std::vector<int> point_at;  ///< of each pixel: its index in `cloud`, -1 without depth
};

/// Points and normals of the pixels with depth. A normal is the direction of least spread
/// [Hoppe1992] of the pixels in a square of `radius_m` around, at least 2 and at most 8 px; sums
/// over squares come from integral images. Fewer than 6 of them, or all in a line: zero.
ObjectSurface object_surface(const ObjectView& view, const ObjectPixels& pixels, double radius_m);

}  // namespace vantage
