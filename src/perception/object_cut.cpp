#include "vantage/perception/object_cut.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/perception/background_planes.hpp"
#include "vantage/perception/column_cut.hpp"

namespace vantage {
namespace {

constexpr int kMinPixels = 40;
constexpr int kMargin_px = 8;
constexpr int kFullFrame_px = 300;    ///< height from which a picture is no crop
constexpr float kStep_m = 0.025F;     ///< in depth, that parts one surface from the next
constexpr float kStepShare = 0.01F;   ///< of the depth, likewise
constexpr float kSamePart_m = 0.06F;  ///< in depth, of an object's parts with a hole between them
constexpr std::array<std::string_view, 3> kNames{"mask", "depth", "whole"};

/// How far a hole may be bridged.
int reach_px(const ObjectView& view) {
  return std::clamp(std::max(view.width_px, view.height_px) / 60, 1, 4);
}

/// Measured pixels before every plane.
cv::Mat1b foreground(const ObjectView& view, const std::vector<BackgroundPlane>& planes) {
  cv::Mat1b before(view.height_px, view.width_px);
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const float z_m = view.depth_m[view.index(row, column)];
      const bool measured = z_m > 0.0F && std::isfinite(z_m);
      before(row, column) =
          measured && std::ranges::all_of(planes, [&](const BackgroundPlane& plane) {
            return plane.height_above(view.point(row, column)) > plane_tolerance_m(z_m);
          });
    }
  }
  return before;
}

/// A patch of the foreground that hangs together in depth.
struct Part {
  std::vector<cv::Point> pixels;
  double weight = 0.0;  ///< pixels, those in the middle of the picture most
  float median_m = 0.0F;
  cv::Rect box;
};

/// Of a pixel by its place: one in the middle, a fiftieth at a corner.
double centrality(const ObjectView& view, const cv::Point& at) {
  const double x = 2.0 * (at.x + 0.5) / view.width_px - 1.0;
  const double y = 2.0 * (at.y + 0.5) / view.height_px - 1.0;
  return std::exp(-2.0 * (x * x + y * y));
}

bool at_border(const ObjectView& view, const cv::Point& at) {
  return at.x == 0 || at.y == 0 || at.x == view.width_px - 1 || at.y == view.height_px - 1;
}

void finish_part(const ObjectView& view, Part& part) {
  std::vector<float> depths_m;
  int border = 0;
  for (const cv::Point& at : part.pixels) {
    part.weight += centrality(view, at);
    depths_m.push_back(view.depth_m[view.index(at.y, at.x)]);
    border += at_border(view, at) ? 1 : 0;
  }
  // Of a whole picture, what is cut by its frame is the room.
  if (view.height_px >= kFullFrame_px && border > 0) part.weight *= 0.2;
  const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::ranges::nth_element(depths_m, middle);
  part.median_m = *middle;
  part.box = cv::boundingRect(part.pixels);
}

/// Steps over holes of `reach` pixels, but over no step of depth.
std::vector<Part> parts_of(const ObjectView& view, cv::Mat1b left, int reach) {
  std::vector<Part> parts;
  std::vector<cv::Point> open;
  const auto depth_m = [&](const cv::Point& at) { return view.depth_m[view.index(at.y, at.x)]; };
  for (int row = 0; row < left.rows; ++row) {
    for (int column = 0; column < left.cols; ++column) {
      if (left(row, column) == 0) continue;
      Part part;
      left(row, column) = 0;
      open.assign(1, {column, row});
      while (!open.empty()) {
        const cv::Point at = open.back();
        open.pop_back();
        part.pixels.push_back(at);
        const cv::Rect around = cv::Rect(at.x - reach, at.y - reach, 2 * reach + 1, 2 * reach + 1) &
                                cv::Rect(0, 0, left.cols, left.rows);
        for (int y = around.y; y < around.y + around.height; ++y) {
          for (int x = around.x; x < around.x + around.width; ++x) {
            const cv::Point next(x, y);
            const float step_m = std::abs(depth_m(next) - depth_m(at));
            if (left(next) == 0 || step_m > kStep_m + kStepShare * depth_m(at)) continue;
            left(next) = 0;
            open.push_back(next);
          }
        }
      }
      finish_part(view, part);
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

/// Whether only a hole of depth is between them.
bool belong_together(const Part& a, const Part& b, int gap_px) {
  const cv::Rect wide(a.box.x - gap_px, a.box.y - gap_px, a.box.width + 2 * gap_px,
                      a.box.height + 2 * gap_px);
  return (wide & b.box).area() > 0 && std::abs(a.median_m - b.median_m) < kSamePart_m;
}

void join(Part& into, Part& from) {
  const auto a = static_cast<double>(into.pixels.size());
  const auto b = static_cast<double>(from.pixels.size());
  into.median_m = static_cast<float>((a * into.median_m + b * from.median_m) / (a + b));
  into.weight += from.weight;
  into.box |= from.box;
  into.pixels.insert(into.pixels.end(), from.pixels.begin(), from.pixels.end());
}

/// Joins what holes have parted, largest first, until nothing is near its like.
void join_parts(std::vector<Part>& parts, int gap_px) {
  std::ranges::stable_sort(parts, std::greater{}, [](const Part& p) { return p.pixels.size(); });
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = parts.size() - 1; j > i; --j) {
        if (!belong_together(parts[i], parts[j], gap_px)) continue;
        join(parts[i], parts[j]);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
        joined = true;
      }
    }
  }
}

/// The part of most weight.
cv::Mat1b mask_of(const ObjectView& view, const std::vector<Part>& parts) {
  cv::Mat1b mask = cv::Mat1b::zeros(view.height_px, view.width_px);
  for (const cv::Point& at : std::ranges::max_element(parts, {}, &Part::weight)->pixels) {
    mask(at) = 255;
  }
  return mask;
}

/// Adds what was not measured and lies within the mask's convex hull; smooths the edge.
void fill(const ObjectView& view, cv::Mat1b& mask) {
  cv::Mat1b unmeasured(mask.size());
  std::ranges::transform(view.depth_m, unmeasured.begin(), [](float z_m) {
    return static_cast<std::uint8_t>(z_m > 0.0F && std::isfinite(z_m) ? 0 : 255);
  });
  std::vector<cv::Point> pixels, hull;
  cv::findNonZero(mask, pixels);
  cv::convexHull(pixels, hull);
  cv::Mat1b within = cv::Mat1b::zeros(mask.size());
  cv::fillConvexPoly(within, hull, 255);
  mask |= within & unmeasured;
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, square(1));
  cv::Mat1b smooth;
  cv::morphologyEx(mask, smooth, cv::MORPH_OPEN, square(1));
  if (10 * cv::countNonZero(smooth) >= 7 * cv::countNonZero(mask)) mask = smooth;
}

ObjectView cropped(const ObjectView& picture, const cv::Mat1b& mask) {
  cv::Rect place = cv::boundingRect(mask);
  place -= cv::Point(kMargin_px, kMargin_px);
  place += cv::Size(2 * kMargin_px, 2 * kMargin_px);
  place &= cv::Rect(0, 0, picture.width_px, picture.height_px);
  ObjectView view;
  view.width_px = place.width;
  view.height_px = place.height;
  view.left_px = picture.left_px + place.x;
  view.top_px = picture.top_px + place.y;
  view.focal_px = picture.focal_px;
  view.centre_px = picture.centre_px;
  view.up = picture.up;
  for (int row = place.y; row < place.y + place.height; ++row) {
    for (int column = place.x; column < place.x + place.width; ++column) {
      const std::size_t i = picture.index(row, column);
      view.depth_m.push_back(picture.depth_m[i]);
      view.mask.push_back(mask(row, column) != 0 ? 1 : 0);
      for (std::size_t c = 0; c < 3; ++c) view.rgb.push_back(picture.rgb[3 * i + c]);
    }
  }
  return view;
}

}  // namespace

std::string_view to_string(ObjectCut cut) { return kNames.at(static_cast<std::size_t>(cut)); }

ObjectCut object_cut_of(std::string_view text, std::string_view where) {
  const auto found = std::ranges::find(kNames, text);
  if (found == kNames.end()) {
    throw ConfigError(fmt::format("{}: '{}' is none of mask, depth, whole", where, text));
  }
  return static_cast<ObjectCut>(found - kNames.begin());
}

CutObject cut_by_depth(const ObjectView& picture) {
  const auto planes = background_planes(picture);
  CutObject cut;
  if (const double elevation_rad = elevation_over(planes); elevation_rad >= 0.0) {
    cut.elevation_rad = elevation_rad;
  }
  cv::Mat1b before = foreground(picture, planes);
  const int reach = reach_px(picture);
  cv::Mat1b opened;
  cv::morphologyEx(before, opened, cv::MORPH_OPEN, square(1));
  if (10 * cv::countNonZero(opened) >= 7 * cv::countNonZero(before)) before = opened;
  std::vector<Part> parts = parts_of(picture, before.clone(), reach);
  if (parts.empty()) {
    cut.reason = "no pixel of it has depth before the background";
    return cut;
  }
  join_parts(parts, 4 * reach);
  cv::Mat1b mask = mask_of(picture, parts);
  fill(picture, mask);
  const int pixels = cv::countNonZero(mask);
  if (pixels < kMinPixels) {
    cut.reason =
        fmt::format("{} pixels stand out from the background by depth, an object has at least {}",
                    pixels, kMinPixels);
    return cut;
  }
  cut.view = cropped(picture, mask);
  return cut;
}

ObjectView crop_to_mask(const ObjectView& picture, const std::vector<std::uint8_t>& mask) {
  const cv::Mat1b flags(picture.height_px, picture.width_px,
                        const_cast<std::uint8_t*>(mask.data()));
  return cropped(picture, flags);
}

ObjectView cut_nothing(ObjectView picture) {
  picture.mask.assign(picture.depth_m.size(), 1);
  return picture;
}

}  // namespace vantage
