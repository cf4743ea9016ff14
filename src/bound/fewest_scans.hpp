/// A lower bound on the number of scans, where there are too many views to try sets of them.
#pragma once

#include <cstddef>
#include <optional>

#include "vantage/bound/cover_problem.hpp"

namespace vantage {

struct ScanBoundOptions {
  int rounds = 60;  ///< cuts at most; each raises the bound or leaves it
  double tolerance =
      0.002;  ///< stops where the cells that its solution shows lack no more than that
};

/// No schedule takes fewer scans besides view 0: partial set cover, relaxed to a linear program
/// that is cut where its solution shows less than it seems to. For any set T of cells, the views
/// have to show `needed` - |T| more: sum_i min(|V_i \ T|, needed - |T|) x_i >= needed - |T|.
/// [Wolsey1982] None if not even all views show enough.
std::optional<std::size_t> fewest_scans(const CoverProblem& problem,
                                        const ScanBoundOptions& options = {});

}  // namespace vantage
