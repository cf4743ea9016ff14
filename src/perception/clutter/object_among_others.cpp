#include "vantage/perception/clutter/object_among_others.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

#include "vantage/information/quantile.hpp"
#include "vantage/perception/clutter/depth_pieces.hpp"

namespace vantage {
namespace {

constexpr double kLeastRadius_m = 0.015;

cv::Mat1b mask_of(const std::vector<const DepthPiece*>& pieces, cv::Size size) {
  cv::Mat1b mask(size, 0);
  for (const DepthPiece* piece : pieces) {
    for (const cv::Point& at : piece->pixels) mask(at) = 255;
  }
  return mask;
}

/// Closes gaps, adds the foot and grows the mask, but not over what else rises there.
void complete(cv::Mat1b& mask, const DepthPieces& scene, const CameraImages& images,
              double distance_m, const ObjectSegmentationOptions& options) {
  const RisingColumn& column = scene.column();
  cv::Mat1b others = column.rises & ~mask;
  const cv::Mat1b measured = column.patch.depth_m > 0.0F;
  const cv::Mat1b before = column.patch.depth_m < distance_m - options.radius_m;
  others |= measured & before;
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, square(2));
  mask &= ~others;
  add_foot(mask, column.heights_m, images, distance_m, options.min_height_m);
  fill_holes(mask, column.heights_m, kLow * options.min_height_m);
  if (options.mask_growth_px > 0) cv::dilate(mask, mask, square(options.mask_growth_px));
  mask &= ~others;
}

/// Of the bare mask, the pixels that something nearer is beside, or the image's border.
cv::Mat1b cut_off_edge(const cv::Mat1b& mask, const DepthPieces& scene, cv::Size image) {
  constexpr int kBeside_px = 2;
  cv::Mat1b cut(mask.size(), 0);
  const cv::Point corner = scene.column().patch.place.tl();
  for (int row = 0; row < mask.rows; ++row) {
    for (int x = 0; x < mask.cols; ++x) {
      const cv::Point at(x, row);
      if (mask(at) == 0) continue;
      const cv::Point in_image = at + corner;
      bool found = in_image.x < kBeside_px || in_image.y < kBeside_px ||
                   in_image.x >= image.width - kBeside_px ||
                   in_image.y >= image.height - kBeside_px;
      for (const cv::Point& step : {cv::Point(kBeside_px, 0), cv::Point(-kBeside_px, 0),
                                    cv::Point(0, kBeside_px), cv::Point(0, -kBeside_px)}) {
        const cv::Point beside = at + step;
        found = found || (scene.inside(beside) && mask(beside) == 0 && scene.nearer(beside, at));
      }
      if (found) cut(at) = 255;
    }
  }
  return cut;
}

/// Its foot is where the robot knows it to stand.
UprightCylinder shape_of(const std::vector<const DepthPiece*>& pieces, const DepthPieces& scene,
                         const Eigen::Vector3d& p_place_m) {
  std::vector<double> away_m;
  std::vector<double> heights_m;
  for (const DepthPiece* piece : pieces) {
    for (const cv::Point& at : piece->pixels) {
      away_m.push_back((scene.p_world(at) - p_place_m).head<2>().norm());
      heights_m.push_back(static_cast<double>(scene.column().heights_m(at)));
    }
  }
  return {p_place_m, std::max(kLeastRadius_m, quantile(std::move(away_m), 0.95)),
          std::max(kLeastRadius_m, quantile(std::move(heights_m), 0.99))};
}

/// Of the samples of its surface that show the object or what hides it, those that show it.
double share_seen(const UprightCylinder& shape, const CameraImages& images,
                  const Pose& T_world_camera, const cv::Mat1b& mask, const RisingColumn& column,
                  const DepthStep& step) {
  double seen = 0.0;
  double hidden = 0.0;
  const Pose T_camera_world = T_world_camera.inverse();
  for (const SurfaceSample& sample : facing_samples(shape, T_world_camera.translation())) {
    const Eigen::Vector3d p = T_camera_world * sample.p_world_m;
    if (p.z() <= 0.0) {  // behind the camera
      hidden += sample.weight;
      continue;
    }
    const cv::Point at(static_cast<int>(std::lround(p.x() / p.z() * images.focal_px +
                                                    0.5 * (images.width_px - 1))),
                       static_cast<int>(std::lround(p.y() / p.z() * images.focal_px +
                                                    0.5 * (images.height_px - 1))));
    if (!cv::Rect(0, 0, images.width_px, images.height_px).contains(at)) {
      hidden += sample.weight;
      continue;
    }
    const cv::Point in_patch = at - column.patch.place.tl();
    const bool known = cv::Rect(cv::Point(), mask.size()).contains(in_patch);
    if (known && mask(in_patch) != 0) {
      seen += sample.weight;
      continue;
    }
    const float z_m = images.depth_at(at.y, at.x);
    if (z_m > 0.0F && p.z() - static_cast<double>(z_m) > step.at_m(z_m)) {
      hidden += sample.weight;
    }
  }
  return seen + hidden > 0.0 ? seen / (seen + hidden) : 0.0;
}

/// The cut-off edge, brought to the edge of the crop's mask, which is wider.
std::vector<std::uint8_t> in_crop(const cv::Mat1b& cut_off, const cv::Point& corner,
                                  const ObjectView& view) {
  cv::Mat1b wider;
  cv::dilate(cut_off, wider, square(3));
  const cv::Rect known(corner, wider.size());
  std::vector<std::uint8_t> result;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const cv::Point at(view.left_px + column, view.top_px + row);
      const bool cut = known.contains(at) && wider(at - corner) != 0;
      result.push_back(cut && view.mask[view.index(row, column)] != 0 ? 1 : 0);
    }
  }
  return result;
}

UprightCylinder joined(const UprightCylinder& a, const std::optional<UprightCylinder>& b) {
  if (!b) return a;
  return {a.p_foot_m, std::max(a.radius_m, b->radius_m), std::max(a.height_m, b->height_m)};
}

RisingColumn column_over(const CameraImages& images, const Pose& T_world_camera,
                         const TablePlane& table, const Eigen::Vector3d& p_place_m,
                         const cv::Rect& place, const ObjectSegmentationOptions& options) {
  RisingColumn column{patch_of(images, place), {}, {}};
  column.heights_m = heights_over(column.patch, images, T_world_camera, table, p_place_m, options);
  column.rises = column.heights_m >= options.min_height_m;
  cv::morphologyEx(column.rises, column.rises, cv::MORPH_OPEN, square(1));
  return column;
}

/// With what features are to know of what hides it.
ObjectView view_of(const CameraImages& images, const Pose& T_world_camera, const cv::Mat1b& mask,
                   const cv::Mat1b& edge, const cv::Point& corner, int margin_px) {
  ObjectView view = cut(images, mask, corner, margin_px);
  view.up = T_world_camera.linear().transpose() * Eigen::Vector3d::UnitZ();
  if (cv::countNonZero(edge) > 0) view.cut_off = in_crop(edge, corner, view);
  return view;
}

ObjectAmongOthers nothing(ObjectAmongOthers found, std::string reason) {
  found.object = {std::nullopt, std::move(reason), false};
  return found;
}

}  // namespace

ObjectAmongOthers find_among_others(const CameraImages& images, const Pose& T_world_camera,
                                    const Eigen::Vector3d& p_world_place_m,
                                    const ObjectSegmentationOptions& options,
                                    const SeparationOptions& separation,
                                    const std::optional<UprightCylinder>& known, Rng& rng) {
  const Eigen::Vector3d& p_m = p_world_place_m;
  ObjectAmongOthers result{.object = {}, .shape = known, .outline = {}, .table_height_m = {}};
  const TableSearch table = find_table_top(images, T_world_camera, p_m, options, rng);
  if (!table.table) return nothing(result, "no table: " + table.reason);
  result.table_height_m = p_m.z() - table.table->height_above(p_m);
  const cv::Rect place = place_of_column(images, T_world_camera, p_m, options);
  if (place.empty()) return nothing(result, "the image does not show the place");
  const DepthStep step{separation.gap_m, separation.gap_growth_per_m};
  const DepthPieces scene(images, T_world_camera,
                          column_over(images, T_world_camera, *table.table, p_m, place, options),
                          step);
  const std::vector<DepthPiece> pieces = scene.all();
  const auto own = round_place(pieces, p_m.head<2>(), separation.reach_m,
                               scene.is_bare(p_m, separation.reach_m));
  cv::Mat1b mask = mask_of(own, place.size());
  if (const int pixels = cv::countNonZero(mask); pixels < options.min_pixels) {
    return nothing(result, fmt::format("hidden: {} pixels rise from the table where it stands, an "
                                       "object has at least {}",
                                       pixels, options.min_pixels));
  }
  std::vector<Eigen::Vector2d> outline;
  for (const DepthPiece* piece : own) {
    outline.insert(outline.end(), piece->hull.begin(), piece->hull.end());
  }
  result.outline = convex_hull(std::move(outline));
  const cv::Mat1b edge = cut_off_edge(mask, scene, {images.width_px, images.height_px});
  complete(mask, scene, images, (T_world_camera.translation() - p_m).norm(), options);
  const UprightCylinder shape = joined(shape_of(own, scene, p_m), known);
  result.seen_share = share_seen(shape, images, T_world_camera, mask, scene.column(), step);
  if (result.seen_share < separation.min_share) {
    return nothing(result, fmt::format("hidden: {:.0f} % of it is seen, at least {:.0f} % must be",
                                       100.0 * result.seen_share, 100.0 * separation.min_share));
  }
  result.shape = shape;
  ObjectView view = view_of(images, T_world_camera, mask, edge, place.tl(), options.margin_px);
  view.seen_share = result.seen_share;
  view.support_m = view.up.dot(T_world_camera.inverse() *
                               Eigen::Vector3d(p_m.x(), p_m.y(), *result.table_height_m));
  result.object = {std::move(view), {}};
  return result;
}

}  // namespace vantage
