#include "vantage/recognition/dataset/turntable_views.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

std::vector<TurntableViews> turntables_of(std::span<const ViewFeatures> views) {
  std::vector<TurntableViews> turntables;
  std::map<std::pair<std::filesystem::path, int>, std::size_t> index;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto [found, added] =
        index.emplace(std::pair(views[i].folder, views[i].name.video), turntables.size());
    if (added) turntables.emplace_back();
    turntables[found->second].views.push_back(i);
  }
  return turntables;
}

std::size_t nearest_view(const TurntableViews& turntable, std::span<const ViewFeatures> views,
                         double yaw_rad) {
  expects(!turntable.views.empty(), "a turntable has views");
  return *std::ranges::min_element(turntable.views, {}, [&](std::size_t i) {
    return std::abs(std::remainder(views[i].yaw_rad - yaw_rad, 2.0 * std::numbers::pi));
  });
}

}  // namespace vantage
