/// How much of every cell is seen from one place, carried outward from layer to layer of cells:
/// a constant effort per cell instead of a ray.  [MihalasAuer1978, Franklin1994]
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/visibility/block_sums.hpp"
#include "vantage/planners/visibility/pyramid.hpp"
#include "vantage/planners/visibility/sampled_sum.hpp"
#include "vantage/planners/visibility/sweep_tables.hpp"

namespace vantage {

struct SweepOptions {
  /// Most rays walked for each view and pyramid, to cells that the sweep saw partly: they tell how
  /// far interpolation is off round the edges of what hides them. Higher is slower and closer to
  /// exact; 0 is the sweep alone. Views that these leave close to zero get a ray to every cell.
  int rays_per_view = 4096;
  /// Standard error of that correction, of the sum, at which fewer rays are enough.
  double tolerance = 0.0014;
  /// One in so many of the rays is walked first, then twice as many, until the tolerance is met; a
  /// power of two. Higher is faster where the sweep is right; 1 walks all of them.
  int first_share = 16;
};
/// The sweep alone.
inline constexpr SweepOptions kNoRays{.rays_per_view = 0};
/// A ray to every cell that the sweep saw partly.
inline constexpr SweepOptions kEveryRay{.rays_per_view = std::numeric_limits<int>::max(),
                                        .first_share = 1};

struct SweptView {
  ViewCone cone;
  SweepOptions options;
  BlockSums* blocks =
      nullptr;  ///< if given, what is seen of each block by the sweep alone is added
};

/// Expected utility of each of `views` as far as it lies in the pyramid, bits. All have one apex.
///
/// A ray to a cell's centre crosses the layer before between four cells: the transmittance
/// there, interpolated, is weakened by the cells the ray goes through from there on.
std::vector<SampledSum> sweep_pyramid(const SweepTables& tables, std::span<const SweptView> views,
                                      const Pyramid& pyramid);

}  // namespace vantage
