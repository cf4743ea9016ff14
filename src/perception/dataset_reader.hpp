/// Views of the RGB-D Object Dataset, or of one rendered in its layout, from files.
#pragma once

#include <optional>
#include <vector>

#include "src/perception/dataset_index.hpp"
#include "src/perception/object_view.hpp"

namespace vantage {

/// A view with what is known of it.
struct LabelledView {
  ObjectView view;
  ViewName name;
  double yaw_rad = 0.0;  ///< of the object, [0, 2 pi)
  int bin = 0;           ///< yaw_bin(yaw_rad)
};

/// Against gravity in the frame of a camera that looks down by `elevation_rad`.
Eigen::Vector3d up_in_camera(double elevation_rad);

/// Opens the pictures of a view. `up` follows from the elevation of its video.
/// @throws InputError naming the file if a picture is missing, damaged or of another kind (8-bit
/// colour, 16-bit depth, mask), sizes differ, the mask is empty or loc.txt is not `x,y`.
LabelledView load_view(const ViewEntry& entry);

/// The same, but a bad view is recorded and nothing returned.
std::optional<LabelledView> load_view(const ViewEntry& entry, std::vector<SkippedView>& skipped);

}  // namespace vantage
