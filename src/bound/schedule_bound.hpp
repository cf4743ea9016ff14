/// What any schedule of views needs at least to see enough.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "vantage/bound/cover_problem.hpp"
#include "vantage/bound/exact_schedule.hpp"

namespace vantage {

struct BoundOptions {
  double place_m = 0.05;  ///< the way is bounded between places, not between views of one
  double work = 1e10;     ///< words of cells that exact searches may look at
  std::function<void(std::size_t)> done = {};  ///< told how many bounds there are by now
};

/// After view 0. What is exact is reached by some schedule; what is not, no schedule comes below.
struct ScheduleBound {
  LeastSchedule least;
  bool exact_scans = false;
  bool exact_way = false;
  bool exact_time = false;
};

/// For each number of needed cells, in place of that of the problem; none where not even all views
/// show that many.
std::vector<std::optional<ScheduleBound>> schedule_bounds(const CoverProblem& problem,
                                                          std::span<const std::size_t> needed,
                                                          const BoundOptions& options = {});

/// The same by what holds of any number of views, without the exact searches.
std::optional<ScheduleBound> relaxed_bound(const CoverProblem& problem);

}  // namespace vantage
