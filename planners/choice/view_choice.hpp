/// Which of the proposed views to take.
///
/// A choice knows nothing of the map: gains, path lengths and reachability are values of the
/// candidates, and the episode decides which candidates it passes. Unreachable ones may be chosen
/// (navigation then goes as near as it can), by those that weigh paths only where no other is left;
/// so an episode that wants none of them leaves them out.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <variant>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/candidate.hpp"

namespace vantage {

/// Any view, each as likely as the other.
struct RandomView {
  static constexpr std::string_view name = "random";
  static constexpr bool weighs_gain = false;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// The largest gain; of equal ones the shorter path, then the lower id.
struct GreedyGain {
  static constexpr std::string_view name = "greedy";
  static constexpr bool weighs_gain = true;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// The view that will really show most: an upper bound for one-step choices, as it knows the scene.
/// Every candidate must carry `true_new_cells`. Ties as in GreedyGain.
struct OracleView {
  static constexpr std::string_view name = "oracle";
  static constexpr bool weighs_gain = false;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// The shortest path, whatever is to be seen there; of equal ones the lower id. Unreachable views
/// come last.  [Yamauchi1997]
struct NearestFrontier {
  static constexpr std::string_view name = "nearest_frontier";
  static constexpr bool weighs_gain = false;
  void fields(auto&&) {}
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

/// The largest gain discounted by the way there, A(q) exp(-lambda L(q)). Ties as in GreedyGain;
/// unreachable views come last.  [GonzalezBanosLatombe2002]
struct GainOverDistance {
  static constexpr std::string_view name = "gain_over_distance";
  static constexpr bool weighs_gain = true;
  double lambda_per_m = 0.2;
  void fields(auto&& f) {
    f("lambda_per_m", lambda_per_m, "1/m, >= 0; higher prefers near views, 0 is greedy",
      at_least(0.0));
  }
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;
};

using ViewChoice =
    std::variant<RandomView, GreedyGain, OracleView, NearestFrontier, GainOverDistance>;
template <>
inline constexpr std::string_view strategy_family<ViewChoice> = "view choice";

/// Whether it looks at Candidate::gain_bits.
inline bool weighs_gain(const ViewChoice& choice) {
  return std::visit([](const auto& c) { return c.weighs_gain; }, choice);
}

/// Index of the view to take; exhausted candidates are left out unless all are. `candidates` must
/// not be empty.
std::size_t choose_view(const ViewChoice& choice, std::span<const Candidate> candidates, Rng& rng);

}  // namespace vantage
