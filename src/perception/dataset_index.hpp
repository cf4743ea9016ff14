/// What there is in a folder of views laid out like the RGB-D Object Dataset [LaiBoRenFox2011]:
/// <root>/<category>/<category>_<instance>/<category>_<instance>_<video>_<frame>_{crop.png,
/// depthcrop.png, maskcrop.png, loc.txt, pose.txt}.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/perception/object_cut.hpp"
#include "vantage/perception/picture_notes.hpp"

namespace vantage {

/// What a file name says. Categories may contain underscores.
struct ViewName {
  std::string category;  ///< "coffee_mug"
  std::string object;    ///< "coffee_mug_3"
  int video = 0;         ///< 1, 2 or 4; of imported pictures the recording, from 1
  int frame = 0;         ///< from 1
  bool operator==(const ViewName&) const = default;
};

/// "coffee_mug_3_1_42"; nothing if it is not of that form.
std::optional<ViewName> parse_view_name(std::string_view text);
std::string to_string(const ViewName& name);

/// Of the camera above the turntable: 30, 45, 60 deg for videos 1, 2, 4; nothing for others.
std::optional<double> video_elevation_rad(int video);

/// Nearest of `bins` yaw bins, bin q centred on q * 2 pi / bins.
int yaw_bin(double yaw_rad, int bins = 8);

struct ViewEntry {
  ViewName name;
  std::filesystem::path folder;                    ///< of the object
  double yaw_rad = 0.0;                            ///< of the object on the turntable, [0, 2 pi)
  std::optional<double> given_elevation_rad = {};  ///< in its pose; nothing: that of its video
  /// Of the dataset it was imported into; null: none, as of a rendered dataset.
  std::shared_ptr<const PictureNotes> notes = {};
  /// How it is to be cut when it is loaded, whatever its mask; nothing: by its mask.
  std::optional<ObjectCut> cut = {};

  [[nodiscard]] double elevation_rad() const;  ///< of the camera above the object's support
  /// How its mask was made; `mask` unless its dataset says otherwise.
  [[nodiscard]] ObjectCut mask_from() const;
  /// One of the view's files; `suffix` is "crop.png", "loc.txt", ...
  [[nodiscard]] std::filesystem::path file(std::string_view suffix) const;
};

struct SkippedView {
  std::filesystem::path file;
  std::string reason;
};

enum class OnBadView { fail, skip };

struct DatasetIndex {
  std::vector<ViewEntry> views;      ///< by category, object, video and frame
  std::vector<SkippedView> skipped;  ///< empty with OnBadView::fail
};

/// Lists the views and reads their pose, `yaw` or `yaw elevation` in degrees; no image is opened. A
/// view is bad if one of its files is missing, `..._crop.png` is no name as above, its pose is no
/// such numbers, or its elevation is neither in its pose nor that of its video; in a dataset
/// without notes also if its category has no other view. Files of other names are left alone. The
/// category is the folder that the object is named after, so that it may have mug_red_1 and mug_2.
/// @throws InputError naming the file of the first bad view (OnBadView::fail), or the root if it is
/// no folder or holds no view.
DatasetIndex index_dataset(const std::filesystem::path& root, OnBadView on_bad = OnBadView::fail);

}  // namespace vantage
