/// What choices that plan more than one view ahead can come to, up to the width of a beam.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/planners/candidate.hpp"

namespace vantage {

/// Every candidate must carry `true_new_cell_set`, all over the same cells. Views out of reach are
/// left out unless all are. Of equal sequences the one whose first view is nearest, then the one of
/// lower indices.
struct OracleLookahead {
  static constexpr std::string_view name = "oracle_lookahead";
  static constexpr StrategyText text{
      .summary =
          "Takes the first view of the best sequence of views that a beam search finds, knowing "
          "from ground truth what each will really show: an upper bound, up to the width of the "
          "beam and to views that show other than they should, of choices that look `depth` views "
          "ahead.",
      .formula =
          "argmax over s_1 .. s_D of sum_k |V(s_1) u .. u V(s_k)|, V the new cells of a view"};
  static constexpr bool weighs_gain = false;
  int width = 32;
  int depth = 1000;
  void fields(auto&& f) {
    f("width", width,
      "sequences that the search keeps at every step; higher comes nearer to the best one and "
      "takes time in proportion; 1: as `oracle`",
      between(1, 100000));
    f("depth", depth,
      "views that it looks ahead, no more than the scans that are left; higher sees farther and "
      "takes time in proportion; 1: as `oracle`",
      between(1, 1000));
  }
  std::size_t operator()(std::span<const Candidate> candidates, Rng& rng) const;

  /// The best sequence found, as indices of candidates, each at most once.
  [[nodiscard]] std::vector<std::size_t> best_sequence(std::span<const Candidate> candidates) const;
};

}  // namespace vantage
