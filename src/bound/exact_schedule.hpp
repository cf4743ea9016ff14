/// The least that suffices, exactly, where there are few views.
#pragma once

#include <cstddef>
#include <optional>

#include "vantage/bound/cover_problem.hpp"

namespace vantage {

/// After view 0; each is the least on its own, so that no one schedule need have all three.
struct LeastSchedule {
  std::size_t scans = 0;
  double way_m = 0.0;
  double time_s = 0.0;
};

/// Up to so many views besides view 0, every set of them is looked at.
inline constexpr std::size_t kMaxEnumeratedViews = 14;

/// By looking at every set of views. None if not even all of them show enough.
/// @pre at most kMaxEnumeratedViews besides view 0
std::optional<LeastSchedule> least_schedule(const CoverProblem& problem);

struct LeastTime {
  double time_s = 0.0;
  /// By some schedule. Else none comes below: the way through more than kMaxExactWay views is not
  /// known exactly.
  bool reached = false;
};

/// Fewest scans, or least time, by branch and bound over sets of views; none if it takes more than
/// that many sets, or cannot be done.
std::optional<std::size_t> fewest_scans_exactly(const CoverProblem& problem, std::size_t most_sets);
std::optional<LeastTime> least_time_exactly(const CoverProblem& problem, std::size_t most_sets);

}  // namespace vantage
