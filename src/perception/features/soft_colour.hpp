/// Colour histogram that small changes of light change little.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vantage/perception/features/colour.hpp"

namespace vantage {

/// The bins of Colour, each pixel shared among the eight whose middles are round its colour, by how
/// near it is to them: what lies at a bin's edge does not jump with a little light more or less.
/// Hues go round, ends of saturation and value do not.
struct SoftColour {
  static constexpr std::string_view name = "soft_colour";
  static constexpr StrategyText text{
      .summary =
          "As `colour`, each pixel shared among the bins round its colour, so that a little more "
          "or less light changes little.",
      .formula =
          "sqrt of the shares of 16 x 3 x 3 bins, a pixel among the eight nearest in proportion"};
  int min_pixels = 16;
  void fields(auto&& f) {
    f("min_pixels", min_pixels,
      "least number of pixels on the object, below which the feature is skipped; higher is more "
      "careful",
      at_least(1));
  }

  [[nodiscard]] SoftColour train(std::span<const ObjectView>, Rng&) const { return *this; }
  [[nodiscard]] int dimension() const { return Colour{}.dimension(); }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const { put_options(bytes, *this); }
  static SoftColour take_state(ByteReader& reader) { return take_options<SoftColour>(reader); }
};

}  // namespace vantage
