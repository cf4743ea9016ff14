#include "vantage/perception/dataset_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/images/image_files.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr double kMillimetre = 0.001;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

void require_same_size(const fs::path& file, int width_px, int height_px, const ObjectView& view) {
  if (width_px == view.width_px && height_px == view.height_px) return;
  fail(file, fmt::format("is {} x {} px, the colour crop {} x {}", width_px, height_px,
                         view.width_px, view.height_px));
}

std::pair<int, int> read_location(const fs::path& file) {
  const std::string text = read_file(file);
  const char* end = text.data() + text.size();
  std::pair<int, int> xy;
  const auto x = std::from_chars(text.data(), end, xy.first);
  const bool comma = x.ec == std::errc{} && x.ptr != end && *x.ptr == ',';
  const auto y = std::from_chars(comma ? x.ptr + 1 : end, end, xy.second);
  if (y.ec != std::errc{}) fail(file, "expected the crop's top left pixel, `x,y`");
  return xy;
}

void read_colour(const fs::path& file, ObjectView& view) {
  ColourImage image = read_colour_image(file);
  view.width_px = image.width_px;
  view.height_px = image.height_px;
  view.rgb = std::move(image.rgb);
}

void read_depth(const fs::path& file, double unit_m, ObjectView& view) {
  DepthImage image = read_depth_image(file, unit_m);
  require_same_size(file, image.width_px, image.height_px, view);
  view.depth_m = std::move(image.depth_m);
}

void read_mask(const fs::path& file, ObjectView& view) {
  MaskImage image = read_mask_image(file);
  require_same_size(file, image.width_px, image.height_px, view);
  view.mask = std::move(image.mask);
  if (std::ranges::find(view.mask, 1) == view.mask.end()) fail(file, "the mask is empty");
}

/// The file beside `<stem>_crop.png` with another ending; nothing if it is not there.
std::optional<fs::path> file_beside(const fs::path& colour, std::string_view ending) {
  constexpr std::string_view kEnding = "crop.png";
  std::string name = colour.filename().string();
  if (!name.ends_with("_crop.png")) return std::nullopt;
  name.replace(name.size() - kEnding.size(), kEnding.size(), ending);
  const fs::path file = colour.parent_path() / name;
  if (!fs::exists(file)) return std::nullopt;
  return file;
}

/// `front_mask.png` of `front_depth.npy`, `mask/front.png` of `depth/front.png`; nothing if it is
/// not there.
std::optional<fs::path> mask_of_picture(const fs::path& depth) {
  constexpr std::string_view kKind = "depth";
  std::string file = depth.filename().string();
  std::string folder = fs::absolute(depth).parent_path().filename().string();
  std::string& name = file.find(kKind) != std::string::npos ? file : folder;
  const auto at = name.rfind(kKind);
  if (at == std::string::npos) return std::nullopt;
  name.replace(at, kKind.size(), "mask");
  const fs::path mask =
      (fs::absolute(depth).parent_path().parent_path() / folder / file).replace_extension(".png");
  if (!fs::exists(mask)) return std::nullopt;
  return mask;
}

/// Of the dataset that `<root>/<category>/<object>/<stem>_crop.png` lies in.
std::optional<PictureNotes> notes_beside(const fs::path& colour) {
  if (!colour.filename().string().ends_with("_crop.png")) return std::nullopt;
  return read_picture_notes(fs::absolute(colour).parent_path().parent_path().parent_path());
}

/// The numbers in the pose beside, degrees.
std::vector<double> pose_beside(const fs::path& colour) {
  const auto file = file_beside(colour, "pose.txt");
  if (!file) return {};
  const std::string text = read_file(*file);
  const char* at = text.data();
  const char* end = at + text.size();
  std::vector<double> degrees;
  for (;;) {
    at = std::find_if_not(at, end, [](char c) { return std::isspace(c) != 0; });
    double number = 0.0;
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc{} || !std::isfinite(number)) break;
    degrees.push_back(number);
    at = read.ptr;
  }
  if (degrees.empty()) fail(*file, "expected a yaw in degrees");
  return degrees;
}

/// From the pose beside, or of the video in the name of a view of a dataset.
std::optional<double> elevation_beside(const fs::path& colour) {
  const std::vector<double> pose = pose_beside(colour);
  if (pose.size() > 1) return pose[1] * std::numbers::pi / 180.0;
  const std::string name = colour.filename().string();
  if (!name.ends_with("_crop.png")) return std::nullopt;
  const auto view = parse_view_name(name.substr(0, name.rfind('_')));
  return view ? video_elevation_rad(view->video) : std::nullopt;
}

void take_far_away(const fs::path& file, double max_depth_m, ObjectView& view) {
  if (max_depth_m <= 0.0) return;
  for (std::size_t i = 0; i < view.mask.size(); ++i) {
    const float depth_m = view.depth_m[i];
    const bool near = depth_m > 0.0F && static_cast<double>(depth_m) <= max_depth_m;
    if (!near) view.mask[i] = 0;
  }
  if (std::ranges::find(view.mask, 1) == view.mask.end()) {
    fail(file, fmt::format("nothing is nearer than {} m", max_depth_m));
  }
}

/// By depth or not at all; `up` from the support surface if it is not `known`.
void cut_as(ObjectCut cut, const fs::path& depth, bool elevation_known, ObjectView& view) {
  if (cut == ObjectCut::whole) {
    view = cut_nothing(std::move(view));
    return;
  }
  CutObject found = cut_by_depth(view);
  if (!found.view) fail(depth, found.reason);
  view = std::move(*found.view);
  if (!elevation_known && found.elevation_rad) view.up = up_in_camera(*found.elevation_rad);
}

}  // namespace

Eigen::Vector3d up_in_camera(double elevation_rad) {
  return {0.0, -std::cos(elevation_rad), -std::sin(elevation_rad)};
}

LabelledView load_view(const ViewEntry& entry) {
  LabelledView labelled{{}, entry.name, entry.yaw_rad};
  ObjectView& view = labelled.view;
  read_colour(entry.file("crop.png"), view);
  read_depth(entry.file("depthcrop.png"), kMillimetre, view);
  std::tie(view.left_px, view.top_px) = read_location(entry.file("loc.txt"));
  if (entry.notes) {
    view.focal_px = entry.notes->focal_px;
    view.centre_px = {entry.notes->centre_px[0], entry.notes->centre_px[1]};
  }
  view.up = up_in_camera(entry.elevation_rad());
  const ObjectCut cut = entry.cut.value_or(entry.mask_from());
  if (cut == entry.mask_from()) {
    read_mask(entry.file("maskcrop.png"), view);
  } else {
    cut_as(cut, entry.file("depthcrop.png"), true, view);
  }
  return labelled;
}

ImagePair load_image_pair(const fs::path& colour, const fs::path& depth,
                          const PairSetting& setting) {
  ImagePair pair;
  ObjectView& view = pair.view;
  read_colour(colour, view);
  read_depth(depth, setting.depth_unit_m, view);
  const auto notes = notes_beside(colour);
  if (const auto& camera = notes ? notes : setting.usual) {
    view.focal_px = camera->focal_px;
    view.centre_px = {camera->centre_px[0], camera->centre_px[1]};
  }
  if (setting.focal_px) view.focal_px = *setting.focal_px;
  if (const auto place = file_beside(colour, "loc.txt")) {
    std::tie(view.left_px, view.top_px) = read_location(*place);
  } else {
    view.left_px = static_cast<int>(view.centre_px.x()) - view.width_px / 2;
    view.top_px = static_cast<int>(view.centre_px.y()) - view.height_px / 2;
  }
  const auto elevation = setting.elevation_rad ? setting.elevation_rad : elevation_beside(colour);
  view.up = up_in_camera(elevation.value_or(kUsualElevation_rad));
  const auto crop_mask = file_beside(colour, "maskcrop.png");
  const auto mask = crop_mask ? crop_mask : mask_of_picture(depth);
  const ObjectCut mask_from = notes ? object_cut_of(notes->cut, kPictureNotes) : ObjectCut::mask;
  const ObjectCut wanted = setting.cut.value_or(mask ? mask_from : ObjectCut::whole);
  if (mask && wanted == mask_from) {
    read_mask(*mask, view);
    if (!crop_mask) view = crop_to_mask(view, view.mask);
    pair.cut = wanted;
  } else {
    pair.cut = wanted == ObjectCut::whole ? ObjectCut::whole : ObjectCut::depth;
    cut_as(pair.cut, depth, elevation.has_value(), view);
  }
  take_far_away(depth, setting.max_depth_m, view);
  return pair;
}

std::optional<double> yaw_beside(const fs::path& colour) {
  const std::vector<double> pose = pose_beside(colour);
  if (pose.empty()) return std::nullopt;
  const double yaw_rad = std::remainder(pose[0] * std::numbers::pi / 180.0, 2.0 * std::numbers::pi);
  return yaw_rad < 0.0 ? yaw_rad + 2.0 * std::numbers::pi : yaw_rad;
}

std::string view_name_beside(const fs::path& colour) {
  const auto notes = notes_beside(colour);
  const auto yaw_rad = yaw_beside(colour);
  if (!notes || notes->views.empty() || !yaw_rad) return {};
  return notes->views[static_cast<std::size_t>(yaw_bin(*yaw_rad, notes->bins))];
}

std::optional<LabelledView> load_view(const ViewEntry& entry, std::vector<SkippedView>& skipped) {
  try {
    return load_view(entry);
  } catch (const InputError& error) {
    skipped.push_back({entry.file("crop.png"), error.what()});
    return std::nullopt;
  }
}

}  // namespace vantage
