/// Views of the RGB-D Object Dataset, or of one rendered in its layout, from files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vantage/perception/dataset_index.hpp"
#include "vantage/perception/object_view.hpp"

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

/// Opens the images of a view. `up` follows from the elevation of its video.
/// @throws InputError naming the file if an image is missing, damaged or of another kind (8-bit
/// colour, 16-bit depth, mask), sizes differ, the mask is empty or loc.txt is not `x,y`.
LabelledView load_view(const ViewEntry& entry);

/// The same, but a bad view is recorded and nothing returned.
std::optional<LabelledView> load_view(const ViewEntry& entry, std::vector<SkippedView>& skipped);

/// What two images do not say of themselves.
struct PairSetting {
  double elevation_rad = 0.785;  ///< of the camera above the object's table
  double max_depth_m = 0.0;      ///< what is beyond is not the object; 0: everything is
};

/// A view from an image and its depth, of the same size. Files of the dataset's form that lie
/// beside `<stem>_crop.png` are used: the mask, the place in the image, and the video's elevation.
/// Without a mask what is nearer than `max_depth_m` is the object; without a place the images are
/// the middle of the full image.
/// @throws InputError as load_view, also if nothing is near enough.
ObjectView load_image_pair(const std::filesystem::path& colour, const std::filesystem::path& depth,
                           const PairSetting& setting);

/// Yaw in the `_pose.txt` beside `<stem>_crop.png`, [0, 2 pi); nothing if there is no such file.
/// @throws InputError naming the file if it holds no number.
std::optional<double> yaw_beside(const std::filesystem::path& colour);

}  // namespace vantage
