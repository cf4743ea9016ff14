/// The views of an object in one video, as a camera that goes round it finds them.
#pragma once

#include <span>
#include <vector>

#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

struct TurntableViews {
  std::vector<std::size_t> views;  ///< indices into those of the dataset, at least one
};

/// Of every object and video of each recording, in order of appearance.
std::vector<TurntableViews> turntables_of(std::span<const ViewFeatures> views);

/// The one nearest to `yaw_rad` of the object; of equal ones the first.
std::size_t nearest_view(const TurntableViews& turntable, std::span<const ViewFeatures> views,
                         double yaw_rad);

}  // namespace vantage
