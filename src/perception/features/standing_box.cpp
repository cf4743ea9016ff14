#include "vantage/perception/features/standing_box.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "vantage/information/quantile.hpp"
#include "vantage/perception/features/kit/cut_off_extents.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/kit/object_surface.hpp"
#include "vantage/perception/features/kit/upright_extents.hpp"

namespace vantage {
namespace {

/// Above an object's lowest points, what may be seen of its support surface: noise.
constexpr double kAbove_m = 0.015;
/// About a level support surface.
constexpr double kThick_m = 0.008;

/// Along `up`, of what is beside the mask and between these heights: most of it, which is level.
std::vector<double> level_beside(const ObjectView& view, const Eigen::Vector3d& up, double lowest_m,
                                 double highest_m) {
  std::vector<double> heights_m;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t i = view.index(row, column);
      if (view.mask[i] != 0 || !std::isfinite(view.depth_m[i]) || !(view.depth_m[i] > 0.0F)) {
        continue;
      }
      const double height_m = up.dot(view.point(row, column));
      if (height_m > lowest_m && height_m < highest_m) heights_m.push_back(height_m);
    }
  }
  if (heights_m.empty()) return heights_m;
  const double level_m = quantile(heights_m, 0.5);
  std::erase_if(heights_m, [&](double m) { return std::abs(m - level_m) > kThick_m; });
  return heights_m;
}

}  // namespace

FeatureResult StandingBox::extract(const ObjectView& view) const {
  if (auto why = lacks_geometry(view); !why.empty()) return FeatureResult::skip(why);
  if (auto why = lacks_up(view); !why.empty()) return FeatureResult::skip(why);
  const ObjectPixels pixels =
      object_pixels(view, {.floor_m = outlier_floor_m, .along_sight = true});
  if (auto why = lacks_depth(pixels, min_pixels); !why.empty()) return FeatureResult::skip(why);
  const Eigen::Vector3d up = view.up.normalized();
  const UprightExtents box =
      upright_extents(object_points(view, pixels), up, low_quantile, high_quantile);
  double stand_m = 0.0;
  if (view.support_m) {
    stand_m = *view.support_m;
  } else {
    const std::vector<double> level_m =
        level_beside(view, up, box.bottom_m - stand_below_m, box.bottom_m + kAbove_m);
    if (std::ssize(level_m) < min_pixels) {
      return FeatureResult::skip(
          fmt::format("{} pixels beside the object show its support surface, fewer than {}",
                      level_m.size(), min_pixels));
    }
    stand_m = quantile(level_m, 0.5);
  }
  const double height_m = box.top_m - stand_m;
  return {.vector = Eigen::Vector3d(height_m, box.greater_m, box.smaller_m).cast<float>(),
          .skipped = {},
          .readings = extent_readings(view, box, up, Foot::of_support)};
}

}  // namespace vantage
