/// Extents of an object.
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

/// The principal axes are those of the points seen from above. [Potthast2016, 4.5.3]
struct BoundingBox {
  static constexpr std::string_view name = "bounding_box";
  static constexpr StrategyText text{
      .summary =
          "Extents of the object: height along gravity and the two horizontal principal extents.",
      .formula = "(height, greater, smaller horizontal extent) in m, each between two quantiles",
      .source = "Potthast2016, 4.5.3"};
  double low_quantile = 0.01;
  double high_quantile = 0.99;
  int min_pixels = 16;
  void fields(auto&& f) {
    f("low_quantile", low_quantile,
      "share of the points cut off at the low end of each extent; higher drops more outliers, and "
      "more of the object",
      between(0.0, 0.5));
    f("high_quantile", high_quantile,
      "share of the points below the high end of each extent; lower drops more outliers, and more "
      "of the object",
      between(0.5, 1.0));
    f("min_pixels", min_pixels,
      "least number of pixels with depth on the object, below which the feature is skipped; higher "
      "is more careful",
      at_least(3));
  }

  [[nodiscard]] BoundingBox train(std::span<const ObjectView>, Rng&) const { return *this; }
  [[nodiscard]] int dimension() const { return 3; }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const { put_options(bytes, *this); }
  static BoundingBox take_state(ByteReader& reader) { return take_options<BoundingBox>(reader); }
};

}  // namespace vantage
