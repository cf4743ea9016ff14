#include "vantage/dataset/pictures/import_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/dataset/view_files.hpp"
#include "vantage/perception/images/image_files.hpp"
#include "vantage/perception/object_cut.hpp"

namespace vantage {
namespace {

using Item = ImportedPicture;

/// Whether a camera with that principal point took the picture as it is: it is about in the middle.
bool is_whole(const ObjectView& picture) {
  constexpr double kOffMiddle = 0.1;  // of the picture's size
  const Eigen::Array2d size_px(picture.width_px, picture.height_px);
  return ((picture.centre_px.array() - 0.5 * size_px).abs() <= kOffMiddle * size_px).all();
}

/// Where in the camera's image a crop was is not known: in its middle. Without a principal point
/// given, that of a picture is in its middle too.
void place(const ImportOptions& options, Item& item, ObjectView& picture) {
  if (options.centre_px && is_whole(picture)) return;
  item.cropped = options.centre_px.has_value();
  picture.left_px = static_cast<int>(picture.centre_px.x()) - picture.width_px / 2;
  picture.top_px = static_cast<int>(picture.centre_px.y()) - picture.height_px / 2;
}

ObjectView picture_view(Item& item, const ImportOptions& options, const PictureNotes& notes) {
  ColourImage colour = read_colour_image(item.picture.colour);
  DepthImage depth = read_depth_image(item.picture.depth, options.depth_unit_m);
  item.unit_m = depth.unit_m;
  item.width_px = colour.width_px;
  if (depth.width_px != colour.width_px || depth.height_px != colour.height_px) {
    throw InputError(
        fmt::format("{}: is {} x {} px, its colour {} x {}; depth must be registered to colour",
                    item.picture.depth.string(), depth.width_px, depth.height_px, colour.width_px,
                    colour.height_px));
  }
  constexpr int kLeast_px = 8;
  if (std::min(colour.width_px, colour.height_px) < kLeast_px) {
    throw InputError(fmt::format("{}: is {} x {} px; a picture has at least {} x {}",
                                 item.picture.colour.string(), colour.width_px, colour.height_px,
                                 kLeast_px, kLeast_px));
  }
  ObjectView view;
  view.width_px = colour.width_px;
  view.height_px = colour.height_px;
  view.rgb = std::move(colour.rgb);
  view.depth_m = std::move(depth.depth_m);
  view.focal_px = notes.focal_px;
  view.centre_px = {notes.centre_px[0], notes.centre_px[1]};
  place(options, item, view);
  return view;
}

ObjectView cut_out(ObjectView view, ObjectCut cut, Item& item) {
  if (cut == ObjectCut::whole) return cut_nothing(std::move(view));
  if (cut == ObjectCut::depth) {
    CutObject found = cut_by_depth(view);
    if (!found.view)
      throw InputError(fmt::format("{}: {}", item.picture.depth.string(), found.reason));
    if (found.elevation_rad) item.measured_deg = *found.elevation_rad / kDegree;
    return std::move(*found.view);
  }
  MaskImage mask = read_mask_image(*item.picture.mask);
  const std::string file = item.picture.mask->string();
  if (mask.width_px != view.width_px || mask.height_px != view.height_px) {
    throw InputError(fmt::format("{}: is {} x {} px, its colour {} x {}", file, mask.width_px,
                                 mask.height_px, view.width_px, view.height_px));
  }
  if (std::ranges::find(mask.mask, 1) == mask.mask.end())
    throw InputError(file + ": the mask is empty");
  return crop_to_mask(view, mask.mask);
}

}  // namespace

void take_in(Item& item, const ImportOptions& options, const PictureNotes& notes) {
  try {
    const ObjectView view = picture_view(item, options, notes);
    write_view(cut_out(view, object_cut_of(notes.cut, "--cut"), item), item.entry);
  } catch (const InputError& error) {
    item.bad = error.what();
  }
}

}  // namespace vantage
