/// Extents of an object that stands on something.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/features/kit/feature_result.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// Metres: height above what the object stands on, as seen beside it, then the greater and the
/// smaller extent as in BoundingBox. How much of an object's foot is seen changes with the height
/// it is seen from, and from how far, by more than near-duplicates differ in size; where its top is
/// over its support surface does not. Outliers of depth are told along the line of sight.
struct StandingBox {
  static constexpr std::string_view name = "standing_box";
  static constexpr StrategyText text{
      .summary =
          "As `bounding_box`, with the height taken from the support surface seen beside the "
          "object: does not depend on how much of its foot is seen.",
      .formula = "(top above the support surface, greater, smaller horizontal extent) in m"};
  double low_quantile = 0.01;
  double high_quantile = 0.99;
  double outlier_floor_m = 0.06;
  double stand_below_m = 0.1;
  int min_pixels = 16;
  void fields(auto&& f) {
    f("low_quantile", low_quantile,
      "share of the points cut off at the low end of the horizontal extents; higher drops more "
      "outliers, and more of the object",
      between(0.0, 0.5));
    f("high_quantile", high_quantile,
      "share of the points below the high end of each extent; lower drops more outliers, and more "
      "of the object",
      between(0.5, 1.0));
    f("outlier_floor_m", outlier_floor_m,
      "distance from the median along the line of sight within which no point is an outlier; "
      "higher keeps the walls of wider bowls",
      between(0.0, 1.0));
    f("stand_below_m", stand_below_m,
      "how far below the lowest points of the object its support surface is looked for; higher "
      "finds feet hidden deeper",
      between(0.0, 1.0));
    f("min_pixels", min_pixels,
      "least number of pixels with depth, on the object and on the surface beside it each, below "
      "which the feature is skipped",
      at_least(3));
  }

  [[nodiscard]] StandingBox train(std::span<const ObjectView>, Rng&) const { return *this; }
  [[nodiscard]] int dimension() const { return 3; }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const { put_options(bytes, *this); }
  static StandingBox take_state(ByteReader& reader) { return take_options<StandingBox>(reader); }
};

}  // namespace vantage
