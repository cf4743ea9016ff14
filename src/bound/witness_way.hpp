/// A lower bound on the way, where there are too many views to try sets of them.
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/bound/cover_problem.hpp"

namespace vantage {

/// Views round a place, and the cells that are seen from nowhere else: whoever does not come there
/// lacks them all.
struct Witness {
  std::vector<std::size_t> around;  ///< all views that are so near, ascending
  std::vector<std::size_t> views;   ///< those of them that show any of its cells
  std::size_t cells = 0;
};

/// Round places that are spread out, of several sizes; none round view 0. Of the same problem with
/// another `needed` they are the same.
std::vector<Witness> find_witnesses(const CoverProblem& problem);

/// No schedule drives less. Two reasons, of which the better counts: the views within some distance
/// do not show enough; and of witnesses that have no view in common it may leave out only so many
/// that their cells are not needed, and has to come to the others one after the other.
double least_way_m(const CoverProblem& problem, const std::vector<Witness>& witnesses);

}  // namespace vantage
