/// What a view is worth, in bits. With one bit per cell never measured, a gain also predicts how
/// many cells the view will newly show.
#pragma once

#include <string_view>
#include <variant>

#include "planners/adaptive_gain.hpp"
#include "planners/beer_lambert_gain.hpp"
#include "planners/posterior_chain_gain.hpp"
#include "planners/simple_gain.hpp"
#include "planners/visibility_weighted_gain.hpp"
#include "src/core/strategy.hpp"

namespace vantage {

using Gain = std::variant<SimpleGain, PosteriorChainGain, VisibilityWeightedGain, BeerLambertGain,
                          AdaptiveGain>;
template <>
inline constexpr std::string_view strategy_family<Gain> = "gain";

}  // namespace vantage
