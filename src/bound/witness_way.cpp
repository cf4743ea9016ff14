#include "vantage/bound/witness_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace vantage {
namespace {

constexpr double kNoWay_m = std::numeric_limits<double>::infinity();
constexpr std::size_t kPlaces = 40;
constexpr std::size_t kMaxOnWay = 12;
constexpr double kSizes[] = {0.08, 0.14, 0.2, 0.3};  // radii, of the distance of the farthest view

double farthest_m(const CoverProblem& problem) {
  double farthest_m = 0.0;
  for (std::size_t view = 0; view < problem.views(); ++view) {
    const double away_m = problem.between_m(0, view);
    if (std::isfinite(away_m)) farthest_m = std::max(farthest_m, away_m);
  }
  return farthest_m;
}

/// Views, each as far as possible from view 0 and those before it.
std::vector<std::size_t> spread_views(const CoverProblem& problem) {
  std::vector<double> away_m;
  for (std::size_t view = 0; view < problem.views(); ++view) {
    away_m.push_back(problem.between_m(0, view));
  }
  std::vector<std::size_t> spread;
  while (spread.size() < kPlaces) {
    std::size_t farthest = 0;
    for (std::size_t view = 0; view < away_m.size(); ++view) {
      if (std::isfinite(away_m[view]) && away_m[view] > away_m[farthest]) farthest = view;
    }
    if (away_m[farthest] <= 0.0) break;
    spread.push_back(farthest);
    for (std::size_t view = 0; view < away_m.size(); ++view) {
      away_m[view] = std::min(away_m[view], problem.between_m(farthest, view));
    }
  }
  return spread;
}

Witness witness_around(const CoverProblem& problem, const CellBits& all, std::size_t centre,
                       double radius_m) {
  Witness witness;
  CellBits elsewhere(all.size(), 0);
  for (std::size_t view = 0; view < problem.views(); ++view) {
    if (problem.between_m(centre, view) <= radius_m) {
      witness.around.push_back(view);
    } else {
      unite(elsewhere, problem.shows[view]);
    }
  }
  witness.cells = count_without(all, elsewhere);
  for (const std::size_t view : witness.around) {
    if (count_without(problem.shows[view], elsewhere) > 0) witness.views.push_back(view);
  }
  return witness;
}

/// The distance from view 0 within which views show enough.
double reach_m(const CoverProblem& problem) {
  std::vector<std::size_t> nearest(problem.views());
  std::iota(nearest.begin(), nearest.end(), std::size_t{0});
  std::ranges::stable_sort(nearest, {},
                           [&](std::size_t view) { return problem.between_m(0, view); });
  CellBits shown(problem.shows.front().size(), 0);
  for (const std::size_t view : nearest) {
    unite(shown, problem.shows[view]);
    if (count_cells(shown) >= problem.needed) return problem.between_m(0, view);
  }
  return kNoWay_m;
}

/// Witnesses without a common view, those with most cells first.
std::vector<Witness> apart(std::vector<Witness> witnesses, std::size_t views) {
  std::ranges::stable_sort(witnesses, std::greater<>(), &Witness::cells);
  std::vector<std::uint8_t> taken(views, 0);
  std::vector<Witness> chosen;
  for (Witness& witness : witnesses) {
    if (chosen.size() == kMaxOnWay) break;
    if (std::ranges::any_of(witness.around, [&](std::size_t v) { return taken[v] != 0; })) continue;
    for (const std::size_t view : witness.around) taken[view] = 1;
    chosen.push_back(std::move(witness));
  }
  return chosen;
}

/// Ways between groups of views, from the nearest to the nearest; group 0 is view 0.
Eigen::MatrixXd between_groups_m(const CoverProblem& problem, const std::vector<Witness>& groups) {
  const auto n = static_cast<Eigen::Index>(groups.size() + 1);
  Eigen::MatrixXd way_m = Eigen::MatrixXd::Constant(n, n, kNoWay_m);
  const std::vector<std::size_t> start{0};
  const auto views = [&](Eigen::Index i) -> const std::vector<std::size_t>& {
    return i == 0 ? start : groups[static_cast<std::size_t>(i - 1)].views;
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      for (const std::size_t a : views(i)) {
        for (const std::size_t b : views(j))
          way_m(i, j) = std::min(way_m(i, j), problem.between_m(a, b));
      }
    }
  }
  return way_m;
}

/// The shortest way that leaves out no more than `spare` cells. Where groups are near each other
/// between two far ones, a way to more groups may seem shorter than one to fewer: whoever comes to
/// the more has come to the fewer too.
double way_to_most_m(const CoverProblem& problem, const std::vector<Witness>& groups,
                     std::size_t spare) {
  std::vector<double> way_m = ways_through_sets_m(between_groups_m(problem, groups));
  double least_m = kNoWay_m;
  for (std::size_t set = 0; set < way_m.size(); ++set) {
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const std::size_t with = std::size_t{1} << i;
      if ((set & with) == 0) {
        left_out += groups[i].cells;
      } else {
        way_m[set] = std::max(way_m[set], way_m[set & ~with]);
      }
    }
    if (left_out <= spare) least_m = std::min(least_m, way_m[set]);
  }
  return least_m;
}

}  // namespace

std::vector<Witness> find_witnesses(const CoverProblem& problem) {
  problem.check();
  const CellBits all = shown_by_all(problem);
  const double extent_m = farthest_m(problem);
  std::vector<Witness> witnesses;
  for (const double size : kSizes) {
    for (const std::size_t centre : spread_views(problem)) {
      const double radius_m = size * extent_m;
      if (problem.between_m(0, centre) <= radius_m) continue;
      Witness witness = witness_around(problem, all, centre, radius_m);
      if (witness.cells > 0) witnesses.push_back(std::move(witness));
    }
  }
  return witnesses;
}

double least_way_m(const CoverProblem& problem, const std::vector<Witness>& witnesses) {
  const std::size_t all = count_cells(shown_by_all(problem));
  if (all < problem.needed) return kNoWay_m;
  const std::vector<Witness> groups = apart(witnesses, problem.views());
  return std::max(reach_m(problem), way_to_most_m(problem, groups, all - problem.needed));
}

}  // namespace vantage
