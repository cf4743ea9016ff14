/// Detection of an object in an image: what perception hands to the belief.
#pragma once

#include <Eigen/Core>

namespace vantage {

/// Of one object in one image; sizes and places are those of the part that is seen.
struct ObjectDetection {
  Eigen::Vector3d p_world_object_m = Eigen::Vector3d::Zero();  ///< its middle
  double support_z_m = 0.0;  ///< world height of what it stands on
  double radius_m = 0.0;     ///< of the upright cylinder round p_world_object_m that holds it
  double height_m = 0.0;     ///< over its support
  double distance_m = 0.0;   ///< from the camera to its middle
  int pixels = 0;            ///< that show it
  bool whole = false;        ///< neither cut by the frame nor partly too near for depth
};

}  // namespace vantage
