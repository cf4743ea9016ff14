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
};

/// Against gravity in the frame of a camera that looks down by `elevation_rad`.
Eigen::Vector3d up_in_camera(double elevation_rad);

/// Opens the images of a view. `up` follows from its elevation; intrinsics are those of its
/// dataset's notes. It is cut as `entry.cut` says.
/// @throws InputError naming the file if an image is missing, damaged or of another kind (8-bit
/// colour, 16-bit depth, mask), sizes differ, the mask is empty, loc.txt is not `x,y`, or nothing
/// is left by the cut.
LabelledView load_view(const ViewEntry& entry);

/// The same, but a bad view is recorded and nothing returned.
std::optional<LabelledView> load_view(const ViewEntry& entry, std::vector<SkippedView>& skipped);

/// What two images do not say of themselves.
struct PairSetting {
  /// Of the camera above the object's support; nothing: from the files beside, else as the picture
  /// shows its support surface, where it is cut by that, else kUsualElevation_rad.
  std::optional<double> elevation_rad = {};
  double max_depth_m = 0.0;  ///< what is beyond is not the object; 0: nothing is
  /// As the model's pictures were cut; nothing: by the mask beside, or not at all.
  std::optional<ObjectCut> cut = {};
  std::optional<double> focal_px = {};     ///< nothing: of the notes beside, else of `usual`
  std::optional<PictureNotes> usual = {};  ///< the model's camera; nothing: ObjectView's
  double depth_unit_m = 0.0;               ///< what 1 in the depth file stands for; 0: found out
};
inline constexpr double kUsualElevation_rad = 0.785;

struct ImagePair {
  ObjectView view;
  ObjectCut cut = ObjectCut::mask;  ///< how it was done
};

/// A view from an image and its depth of the same size, of the formats of image_files.hpp. Of
/// `<stem>_crop.png` in a dataset the files beside count: mask, place in the image, elevation,
/// intrinsics. Of another picture a mask counts that is named as its depth, with `mask` for
/// `depth`: `front_depth.png` and `front_mask.png`. Asked to cut by a mask where there is none, it
/// cuts by depth. What is beyond `max_depth_m` is never the object. Without a place the images are
/// the middle of the full image.
/// @throws InputError as load_view, also if nothing is near enough.
ImagePair load_image_pair(const std::filesystem::path& colour, const std::filesystem::path& depth,
                          const PairSetting& setting);

/// Yaw in the `_pose.txt` beside `<stem>_crop.png`, [0, 2 pi); nothing if there is no such file.
/// @throws InputError naming the file if it holds no number.
std::optional<double> yaw_beside(const std::filesystem::path& colour);

/// The name of the view in an imported dataset; empty if it has none, or lies in no such dataset.
/// @throws InputError, ConfigError if the files beside are damaged.
std::string view_name_beside(const std::filesystem::path& colour);

}  // namespace vantage
