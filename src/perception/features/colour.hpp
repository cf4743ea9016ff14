/// Colour histogram of an object.
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

/// Bin (h * 3 + s) * 3 + v. [Potthast2016, 4.5.3]
struct Colour {
  static constexpr std::string_view name = "colour";
  static constexpr StrategyText text{
      .summary =
          "Colour histogram of the object: 144 bins of hue, saturation and value. Cheap, and "
          "strong where light is steady.",
      .formula = "sqrt of the shares of 16 x 3 x 3 bins of hue, saturation, value",
      .source = "Potthast2016, 4.5.3"};
  int min_pixels = 16;
  void fields(auto&& f) {
    f("min_pixels", min_pixels,
      "least number of pixels on the object, below which the feature is skipped; higher is more "
      "careful",
      at_least(1));
  }

  static constexpr int hues = 16;
  static constexpr int saturations = 3;
  static constexpr int values = 3;

  [[nodiscard]] Colour train(std::span<const ObjectView>, Rng&) const { return *this; }
  [[nodiscard]] int dimension() const { return hues * saturations * values; }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const { put_options(bytes, *this); }
  static Colour take_state(ByteReader& reader) { return take_options<Colour>(reader); }
};

}  // namespace vantage
