/// An object cut out of an image in which its table was found already.
#pragma once

#include "vantage/perception/object_segmentation.hpp"

namespace vantage {

/// As segment_object(), on a table that was found in this image; looks at no other part of it.
SegmentedObject segment_on_table(const CameraImages& images, const Pose& T_world_camera,
                                 const TablePlane& table, const Eigen::Vector3d& p_world_table_m,
                                 const ObjectSegmentationOptions& options);

}  // namespace vantage
