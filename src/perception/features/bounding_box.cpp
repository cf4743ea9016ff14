#include "vantage/perception/features/bounding_box.hpp"

#include "vantage/perception/features/kit/cut_off_extents.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/kit/object_surface.hpp"
#include "vantage/perception/features/kit/upright_extents.hpp"

namespace vantage {

FeatureResult BoundingBox::extract(const ObjectView& view) const {
  const ObjectPixels pixels = object_pixels(view);
  if (auto why = lacks_depth(pixels, min_pixels); !why.empty()) return FeatureResult::skip(why);
  if (auto why = lacks_geometry(view); !why.empty()) return FeatureResult::skip(why);
  if (auto why = lacks_up(view); !why.empty()) return FeatureResult::skip(why);
  const Eigen::Vector3d up = view.up.normalized();
  const UprightExtents box =
      upright_extents(object_points(view, pixels), up, low_quantile, high_quantile);
  return {.vector =
              Eigen::Vector3d(box.top_m - box.bottom_m, box.greater_m, box.smaller_m).cast<float>(),
          .skipped = {},
          .readings = extent_readings(view, box, up, Foot::of_object)};
}

}  // namespace vantage
