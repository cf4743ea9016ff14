#include "vantage/perception/features/kit/darkness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace vantage {

std::string lacks_light(const ObjectView& view) {
  constexpr int kDark = 24;  // of 255; the noise of a camera stays below
  constexpr double kLeastShare = 0.05;
  const std::size_t pixels = view.rgb.size() / 3;
  std::size_t lit = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    lit += *std::ranges::max_element(std::span(view.rgb).subspan(3 * i, 3)) >= kDark ? 1 : 0;
  }
  if (static_cast<double>(lit) >= kLeastShare * static_cast<double>(pixels)) return {};
  return fmt::format(
      "too dark: {} of {} pixels, surroundings included, are brighter than {} of 255", lit, pixels,
      kDark);
}

}  // namespace vantage
