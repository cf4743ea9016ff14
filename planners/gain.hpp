/// What a view is worth: the gains that `gain:` names. The contract of a gain, and a skeleton, are
/// in visibility/view_gain.hpp; one more is a header in gains/ and a line in the variant. In bits,
/// unless a gain says otherwise. With one bit per cell never
/// measured, a gain that sums over cells also predicts how many of them the view will newly show.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/strategy.hpp"
#include "vantage/planners/gains/adaptive_gain.hpp"
#include "vantage/planners/gains/area_factor_gain.hpp"
#include "vantage/planners/gains/average_entropy_gain.hpp"
#include "vantage/planners/gains/beer_lambert_gain.hpp"
#include "vantage/planners/gains/frontier_cells_gain.hpp"
#include "vantage/planners/gains/fsmi_gain.hpp"
#include "vantage/planners/gains/occlusion_aware_gain.hpp"
#include "vantage/planners/gains/posterior_chain_gain.hpp"
#include "vantage/planners/gains/proximity_count_gain.hpp"
#include "vantage/planners/gains/rear_side_entropy_gain.hpp"
#include "vantage/planners/gains/rear_side_voxel_gain.hpp"
#include "vantage/planners/gains/simple_gain.hpp"
#include "vantage/planners/gains/unmapped_volume_gain.hpp"
#include "vantage/planners/gains/unobserved_voxel_gain.hpp"
#include "vantage/planners/gains/visibility_weighted_gain.hpp"
#include "vantage/planners/visibility/view_gain.hpp"

namespace vantage {

using Gain = std::variant<SimpleGain, PosteriorChainGain, VisibilityWeightedGain, BeerLambertGain,
                          AdaptiveGain, OcclusionAwareGain, UnobservedVoxelGain, RearSideVoxelGain,
                          RearSideEntropyGain, ProximityCountGain, AverageEntropyGain,
                          AreaFactorGain, UnmappedVolumeGain, FsmiGain, FrontierCellsGain>;
template <>
inline constexpr std::string_view strategy_family<Gain> = "gain";

namespace detail {
template <class Variant>
inline constexpr bool kAllAreGains = false;
template <class... G>
inline constexpr bool kAllAreGains<std::variant<G...>> = (ViewGain<G> && ...);
static_assert(kAllAreGains<Gain>, "every alternative keeps the contract of view_gain.hpp");
}  // namespace detail

/// What the gain counts: a gain that says nothing counts bits.
inline std::string_view unit_of(const Gain& gain) {
  return std::visit(
      []<class G>(const G&) -> std::string_view {
        if constexpr (requires { G::unit; }) {
          return G::unit;
        } else {
          return "bits";
        }
      },
      gain);
}

/// Whether its value is a number of cells, to be held against what a view showed.
inline bool predicts_cells(const Gain& gain) {
  return std::visit([](const auto& g) { return g.predicts_cells; }, gain);
}

/// The transmission of an unobserved cell that the gain assumes, if it assumes one and the same for
/// all: the gain says so by a member of this name.
inline std::optional<double> transmission_unobserved(const Gain& gain) {
  return std::visit(
      [](const auto& g) -> std::optional<double> {
        if constexpr (requires { g.transmission_unobserved(); }) {
          return g.transmission_unobserved();
        } else {
          return {};
        }
      },
      gain);
}

/// The gains that predict cells, with their defaults.
inline std::vector<Gain> cell_predictors() {
  std::vector<Gain> predictors;
  for (const std::string_view name : strategy_names<Gain>()) {
    Gain gain = make_strategy<Gain>(name);
    if (predicts_cells(gain)) predictors.push_back(gain);
  }
  return predictors;
}

}  // namespace vantage
