#include "vantage/perception/clouds/usable_readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vantage {
namespace {

constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();

std::size_t discard_ranges(std::vector<float>& range_m, double range_max_m) {
  const auto end_m = static_cast<float>(range_max_m);
  std::size_t discarded = 0;
  for (float& range : range_m) {
    if (range > 0.0F && (range < end_m || std::isinf(range))) continue;
    range = kInvalid;
    ++discarded;
  }
  return discarded;
}

std::span<float> line_of(RangeScan& scan, std::size_t line) {
  return std::span(scan.range_m).subspan(line * scan.beams(), scan.beams());
}

bool is_measured(float range_m) { return range_m > 0.0F && std::isfinite(range_m); }

}  // namespace

std::size_t discard_unusable(CameraImages& images) {
  const auto end_m = static_cast<float>(images.range_max_m);
  std::size_t discarded = 0;
  for (float& depth : images.depth_m) {
    if (depth >= 0.0F && (depth < end_m || std::isinf(depth))) continue;
    depth = 0.0F;
    ++discarded;
  }
  return discarded;
}

std::size_t discard_unusable(RangeScan& scan) {
  return discard_ranges(scan.range_m, scan.field_of_view.range_max_m);
}

std::size_t discard_unusable(PlanarScan& scan) {
  return discard_ranges(scan.range_m, scan.range_max_m);
}

bool is_repeated(const CameraImages& before, const CameraImages& now) {
  return before.depth_m == now.depth_m && std::ranges::any_of(now.depth_m, is_measured);
}

std::size_t discard_repeated_lines(RangeScan& scan, std::vector<float>& last) {
  const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  std::vector<std::size_t> repeated;
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    const std::span<const float> now = line_of(scan, line);
    if (std::ranges::all_of(now, [](float range) { return std::isnan(range); })) continue;
    if (std::ranges::equal(last, now, same) && std::ranges::any_of(now, is_measured)) {
      repeated.push_back(line);
    }
    last.assign(now.begin(), now.end());
  }
  for (const std::size_t line : repeated) std::ranges::fill(line_of(scan, line), kInvalid);
  return repeated.size();
}

double share_of_valid_lines(const RangeScan& scan) {
  std::size_t valid = 0;
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    const auto beams = std::span(scan.range_m).subspan(line * scan.beams(), scan.beams());
    valid += std::ranges::any_of(beams, [](float range) { return !std::isnan(range); }) ? 1 : 0;
  }
  return scan.lines() == 0 ? 0.0 : static_cast<double>(valid) / static_cast<double>(scan.lines());
}

}  // namespace vantage
