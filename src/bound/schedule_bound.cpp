#include "vantage/bound/schedule_bound.hpp"

#include <algorithm>

#include "vantage/bound/fewest_scans.hpp"
#include "vantage/bound/witness_way.hpp"

namespace vantage {
namespace {

std::size_t most_sets(const CoverProblem& problem, double work) {
  const auto words = static_cast<double>(problem.views() * problem.shows.front().size());
  return static_cast<std::size_t>(work / std::max(1.0, words));
}

/// Of more views there are too many sets for a search to end.
constexpr std::size_t kMaxSearchedViews = 64;

/// Replaces what branch and bound finds in time.
void sharpen(const CoverProblem& problem, std::size_t sets, ScheduleBound& bound) {
  if (problem.views() > kMaxSearchedViews) return;
  if (const auto scans = fewest_scans_exactly(problem, sets)) {
    bound.least.scans = *scans;
    bound.exact_scans = true;
  }
  bound.least.time_s = problem.time_s(bound.least.way_m, bound.least.scans);
  if (!bound.exact_scans) return;
  if (const auto least = least_time_exactly(problem, sets)) {
    bound.least.time_s = least->time_s;
    bound.exact_time = least->reached;
  }
}

/// Whether the views of each group are all at one point, so that no way is lost by merging them.
bool are_points(const CoverProblem& problem, std::span<const std::size_t> group) {
  for (std::size_t view = 0; view < problem.views(); ++view) {
    const auto first = std::ranges::find(group, group[view]) - group.begin();
    if (problem.between_m(static_cast<std::size_t>(first), view) > 0.0) return false;
  }
  return true;
}

/// The way alone, between places that are few.
void sharpen_way(const CoverProblem& places, bool exact, ScheduleBound& bound) {
  if (places.views() > kMaxEnumeratedViews + 1) return;
  if (const auto least = least_schedule(places)) {
    bound.least.way_m = std::max(bound.least.way_m, least->way_m);
    bound.exact_way = exact;
  }
}

std::optional<ScheduleBound> relaxed(const CoverProblem& problem,
                                     const std::vector<Witness>& witnesses) {
  const auto scans = fewest_scans(problem);
  if (!scans) return std::nullopt;
  ScheduleBound bound;
  bound.least.scans = *scans;
  bound.least.way_m = least_way_m(problem, witnesses);
  bound.least.time_s = problem.time_s(bound.least.way_m, bound.least.scans);
  return bound;
}

}  // namespace

std::optional<ScheduleBound> relaxed_bound(const CoverProblem& problem) {
  return relaxed(problem, find_witnesses(problem));
}

std::vector<std::optional<ScheduleBound>> schedule_bounds(const CoverProblem& problem,
                                                          std::span<const std::size_t> needed,
                                                          const BoundOptions& options) {
  problem.check();
  std::vector<std::optional<ScheduleBound>> bounds;
  CoverProblem one = problem;
  if (problem.views() <= kMaxEnumeratedViews + 1) {
    for (const std::size_t cells : needed) {
      one.needed = cells;
      const auto least = least_schedule(one);
      bounds.push_back(least ? std::optional(ScheduleBound{*least, true, true, true})
                             : std::nullopt);
    }
    return bounds;
  }
  const std::vector<Witness> witnesses = find_witnesses(problem);
  const std::vector<std::size_t> group = places_of(problem, options.place_m);
  const bool points = are_points(problem, group);
  CoverProblem places = merged(problem, group);
  for (const std::size_t cells : needed) {
    if (options.done) options.done(bounds.size());
    one.needed = places.needed = cells;
    bounds.push_back(relaxed(one, witnesses));
    if (!bounds.back()) continue;
    sharpen_way(places, points, *bounds.back());
    sharpen(one, most_sets(one, options.work), *bounds.back());
    ScheduleBound& bound = *bounds.back();
    bound.least.time_s =
        std::max(bound.least.time_s, one.time_s(bound.least.way_m, bound.least.scans));
  }
  return bounds;
}

}  // namespace vantage
