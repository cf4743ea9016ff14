#include "vantage/planners/visibility/sweep_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Sanitizers start too late for the resolvers that choose a clone.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VANTAGE_SIMD_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define VANTAGE_SIMD_CLONES
#endif

namespace vantage {

VANTAGE_SIMD_CLONES
void blend_rows(const float* a, const float* b, float fraction, int begin, int end, float* out) {
  for (int j = begin; j < end; ++j) out[j] = a[j] + fraction * (b[j] - a[j]);
}

VANTAGE_SIMD_CLONES
void advance_row(const SweepRow& row, int shift, int begin, int end, float* __restrict visible,
                 float* __restrict seen_utility) {
  const float* __restrict arriving = row.arriving + shift;
  const float* __restrict straight = row.straight;
  const float* __restrict slanted = row.slanted + shift;
  const float* __restrict cells = row.cells;
  const float* __restrict straight_depth = row.straight_depth;
  const float* __restrict slanted_depth = row.slanted_depth + shift;
  const float across = row.across;
  const float source = row.source;
  const float per_layer = 1.0F / row.depth;
  const auto offset = static_cast<float>(shift);
  const int whole = begin + (end - begin + kLanes - 1) / kLanes * kLanes;
  for (int i = begin; i < whole; ++i) {
    const float along = (source - static_cast<float>(i)) * per_layer;
    const float fraction = along - offset;
    const float transmittance = arriving[i] + fraction * (arriving[i + 1] - arriving[i]);
    // The ray ends in the column of cell i and comes from that of the nearest cell.
    const float own = straight[i];
    const float near = slanted[i];
    const float far = slanted[i + 1];
    const float near_depth = slanted_depth[i];
    const float far_depth = slanted_depth[i + 1];
    const float other = fraction < 0.5F ? near : far;
    const float other_depth = fraction < 0.5F ? near_depth : far_depth;
    const float own_depth = straight_depth[i];
    const float first = own > 0.0F ? own_depth : 0.0F;
    const float second = other > 0.0F ? other_depth : 0.0F;
    const float x = first + (across + std::fabs(along)) * second;
    // exp(-x) = (exp(-x / 8))^8 with a second-order series: 3e-6 off at x = 0.1.
    const float eighth = std::min(0.125F * x, 1.0F);
    float passes = 1.0F - eighth + 0.5F * eighth * eighth;
    passes *= passes;
    passes *= passes;
    passes *= passes;
    const float seen = std::min(own, other) < 0.0F ? 0.0F : transmittance * passes;
    visible[i] = seen;
    const float value = seen * std::max(cells[i], 0.0F);
    seen_utility[i] = seen > kDark ? value : 0.0F;
  }
}

VANTAGE_SIMD_CLONES
double sum_run(const float* utility, int begin, int end) {
  std::array<float, kLanes> lanes{};
  for (int i = begin; i < end; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const float cell = utility[i + lane];
      lanes[static_cast<std::size_t>(lane)] += i + lane < end ? cell : 0.0F;
    }
  }
  double sum = 0.0;
  for (const float lane : lanes) sum += static_cast<double>(lane);
  return sum;
}

VANTAGE_SIMD_CLONES
void keep_in_view(const ConeRow& view, const float* __restrict utility, int begin, int end,
                  float* __restrict kept) {
  const ConeRow row = view;  // no write changes it
  for (int i = begin; i < end; ++i) {
    const float cell = utility[i];
    kept[i] = row.contains(static_cast<float>(i)) ? cell : 0.0F;
  }
}

}  // namespace vantage
