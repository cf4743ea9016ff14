#include "vantage/bound/cover_problem.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Makes every way no longer than any detour.
void close_ways(Eigen::MatrixXd& way_m) {
  for (Eigen::Index k = 0; k < way_m.rows(); ++k) {
    for (Eigen::Index i = 0; i < way_m.rows(); ++i) {
      for (Eigen::Index j = 0; j < way_m.rows(); ++j) {
        way_m(i, j) = std::min(way_m(i, j), way_m(i, k) + way_m(k, j));
      }
    }
  }
}

/// Of the tree that spans view 0 and these: no way through all of them is shorter.
double spanning_tree_m(const CoverProblem& problem, std::span<const std::size_t> views) {
  std::vector<double> nearest_m;
  for (const std::size_t view : views) nearest_m.push_back(problem.between_m(0, view));
  std::vector<std::uint8_t> in_tree(views.size(), 0);
  double length_m = 0.0;
  for (std::size_t step = 0; step < views.size(); ++step) {
    std::size_t next = views.size();
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (in_tree[i] != 0) continue;
      if (next == views.size() || nearest_m[i] < nearest_m[next]) next = i;
    }
    in_tree[next] = 1;
    length_m += nearest_m[next];
    for (std::size_t i = 0; i < views.size(); ++i) {
      nearest_m[i] = std::min(nearest_m[i], problem.between_m(views[next], views[i]));
    }
  }
  return length_m;
}

/// By dynamic programming over subsets. [HeldKarp1962]
double held_karp_m(const CoverProblem& problem, std::span<const std::size_t> views) {
  const std::size_t n = views.size();
  std::vector<double> best_m((std::size_t{1} << n) * n, kInfinity);
  for (std::size_t i = 0; i < n; ++i)
    best_m[(std::size_t{1} << i) * n + i] = problem.between_m(0, views[i]);
  const std::size_t all = (std::size_t{1} << n) - 1;
  for (std::size_t set = 1; set < all; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      const double so_far_m = best_m[set * n + last];
      if (so_far_m == kInfinity) continue;
      for (std::size_t next = 0; next < n; ++next) {
        if ((set >> next & 1U) != 0) continue;
        double& entry = best_m[(set | std::size_t{1} << next) * n + next];
        entry = std::min(entry, so_far_m + problem.between_m(views[last], views[next]));
      }
    }
  }
  return *std::min_element(best_m.begin() + static_cast<std::ptrdiff_t>(all * n), best_m.end());
}

}  // namespace

std::size_t count_cells(const CellBits& cells) {
  std::size_t count = 0;
  for (const std::uint64_t word : cells) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

std::size_t count_without(const CellBits& a, const CellBits& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    count += static_cast<std::size_t>(std::popcount(a[i] & ~b[i]));
  }
  return count;
}

void unite(CellBits& cells, const CellBits& others) {
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] |= others[i];
}

void CoverProblem::check() const {
  const auto n = static_cast<Eigen::Index>(views());
  expects(n > 0 && way_m.rows() == n && way_m.cols() == n, "ways between all views");
  expects(speed_m_s > 0.0 && scan_s >= 0.0, "a speed, and a time of a scan");
  for (const CellBits& cells : shows) {
    expects(cells.size() == shows.front().size(), "sets of the same cells");
  }
}

CellBits shown_by_all(const CoverProblem& problem) {
  CellBits shown = problem.shows.front();
  for (const CellBits& cells : problem.shows) unite(shown, cells);
  return shown;
}

CoverProblem merged(const CoverProblem& problem, std::span<const std::size_t> group) {
  expects(group.size() == problem.views() && group.front() == 0, "a group of each view");
  const std::size_t groups = *std::ranges::max_element(group) + 1;
  const auto n = static_cast<Eigen::Index>(groups);
  CoverProblem result = problem;
  result.shows.assign(groups, CellBits(problem.shows.front().size(), 0));
  result.way_m = Eigen::MatrixXd::Constant(n, n, kInfinity);
  for (std::size_t i = 0; i < problem.views(); ++i) {
    unite(result.shows[group[i]], problem.shows[i]);
    for (std::size_t j = 0; j < problem.views(); ++j) {
      double& way_m =
          result.way_m(static_cast<Eigen::Index>(group[i]), static_cast<Eigen::Index>(group[j]));
      way_m = group[i] == group[j] ? 0.0 : std::min(way_m, problem.between_m(i, j));
    }
  }
  if (groups < problem.views()) close_ways(result.way_m);
  return result;
}

std::vector<std::size_t> places_of(const CoverProblem& problem, double within_m) {
  std::vector<std::size_t> firsts;
  std::vector<std::size_t> group;
  for (std::size_t view = 0; view < problem.views(); ++view) {
    const auto near = std::ranges::find_if(
        firsts, [&](std::size_t first) { return problem.between_m(first, view) <= within_m; });
    group.push_back(static_cast<std::size_t>(near - firsts.begin()));
    if (near == firsts.end()) firsts.push_back(view);
  }
  return group;
}

std::vector<double> ways_through_sets_m(const Eigen::MatrixXd& way_m) {
  const auto n = static_cast<std::size_t>(way_m.cols() - 1);
  const auto leg_m = [&](std::size_t a, std::size_t b) {
    return way_m(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  };
  std::vector<double> to_last_m((std::size_t{1} << n) * n, kInfinity);
  std::vector<double> through_m(std::size_t{1} << n, kInfinity);
  through_m[0] = 0.0;
  for (std::size_t set = 1; set < through_m.size(); ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      if ((set >> last & 1U) == 0) continue;
      const std::size_t before = set & ~(std::size_t{1} << last);
      double best_m = before == 0 ? leg_m(0, last + 1) : kInfinity;
      for (std::size_t from = 0; from < n; ++from) {
        if ((before >> from & 1U) == 0) continue;
        best_m = std::min(best_m, to_last_m[before * n + from] + leg_m(from + 1, last + 1));
      }
      to_last_m[set * n + last] = best_m;
      through_m[set] = std::min(through_m[set], best_m);
    }
  }
  return through_m;
}

double shortest_way_m(const CoverProblem& problem, std::span<const std::size_t> views) {
  if (views.empty()) return 0.0;
  return views.size() <= kMaxExactWay ? held_karp_m(problem, views)
                                      : spanning_tree_m(problem, views);
}

}  // namespace vantage
