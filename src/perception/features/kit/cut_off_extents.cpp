#include "vantage/perception/features/kit/cut_off_extents.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace vantage {
namespace {

/// So near to an end, what is cut off may have gone on beyond it.
constexpr double kNear_m = 0.015;
constexpr double kNear = 0.15;  ///< the same as a share of the extent
/// Fewer pixels than that are noise.
constexpr std::ptrdiff_t kPixels = 3;
/// Of the edge: where so much is cut off, extents are of another part of the object.
constexpr double kMuch = 0.25;

/// Of a mask, those with a pixel beside them that is not in it.
bool on_edge(const ObjectView& view, int row, int column) {
  if (view.mask[view.index(row, column)] == 0) return false;
  if (row == 0 || column == 0 || row + 1 == view.height_px || column + 1 == view.width_px) {
    return true;
  }
  return view.mask[view.index(row - 1, column)] == 0 ||
         view.mask[view.index(row + 1, column)] == 0 ||
         view.mask[view.index(row, column - 1)] == 0 || view.mask[view.index(row, column + 1)] == 0;
}

struct CutOff {
  std::vector<Eigen::Vector3d> points;  ///< camera frame
  double share = 0.0;                   ///< of the edge
};

CutOff cut_off_points(const ObjectView& view) {
  CutOff found;
  int edge = 0;
  int cut = 0;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (!on_edge(view, row, column)) continue;
      ++edge;
      const std::size_t i = view.index(row, column);
      if (view.cut_off[i] == 0) continue;
      ++cut;
      if (view.depth_m[i] > 0.0F && std::isfinite(view.depth_m[i])) {
        found.points.push_back(view.point(row, column));
      }
    }
  }
  found.share = edge > 0 ? static_cast<double>(cut) / edge : 0.0;
  return found;
}

/// Whether some of the points are at an end of [lower, upper] along `axis`.
bool reaches(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& axis, double lower_m,
             double upper_m) {
  const double near_m = std::max(kNear_m, kNear * (upper_m - lower_m));
  return std::ranges::count_if(points, [&](const Eigen::Vector3d& p) {
           const double at_m = axis.dot(p);
           return at_m < lower_m + near_m || at_m > upper_m - near_m;
         }) >= kPixels;
}

}  // namespace

std::vector<Reading> extent_readings(const ObjectView& view, const UprightExtents& box,
                                     const Eigen::Vector3d& up, Foot foot) {
  if (view.cut_off.empty()) return {};
  const CutOff cut = cut_off_points(view);
  if (std::ssize(cut.points) < kPixels) return {};
  const auto reading = [](bool bound) { return bound ? Reading::at_least : Reading::exact; };
  const double far_below_m = box.bottom_m - 1.0;
  const double foot_m = foot == Foot::of_object ? box.bottom_m : far_below_m;
  const bool top = std::ranges::count_if(cut.points, [&](const Eigen::Vector3d& p) {
                     return up.dot(p) > box.top_m - kNear_m || up.dot(p) < foot_m + kNear_m;
                   }) >= kPixels;
  const bool much = cut.share > kMuch;
  const auto level = [&](const LevelExtent& extent) {
    return reading(much || reaches(cut.points, extent.axis, extent.ends_m.x(), extent.ends_m.y()));
  };
  return {reading(top), level(box.greater), level(box.smaller)};
}

}  // namespace vantage
