#include "vantage/planners/tours/planning_problem.hpp"

#include <array>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {

void PlanningProblem::check() const {
  const auto n = static_cast<Eigen::Index>(views());
  expects(travel_s.rows() == n + 1 && travel_s.cols() == n, "a travel time from and to each view");
  expects(place_m.size() == views(), "a place of each view");
  expects(scan_share.empty() || scan_share.size() == views(), "a share of a scan for each view");
  expects(beyond.empty() || beyond.size() == views(), "what lies beyond each view");
  expects(!intended || *intended < views(), "a view of the problem is intended");
  expects(home_s.empty() || home_s.size() == views() + 1,
          "a way home from each view and from here");
  for (const ShownShares& shown : shows) {
    expects(shown.block.size() == shown.share.size(), "a share of each block");
    expects(shown.block.empty() || shown.block.back() < cells.size(), "blocks of the problem");
  }
}

std::optional<std::size_t> view_near(const PlanningProblem& problem, const Eigen::Vector2d& place_m,
                                     double within_m) {
  std::optional<std::size_t> nearest;
  double nearest_m = within_m;
  for (std::size_t view = 0; view < problem.views(); ++view) {
    const double off_m = (problem.place_m[view] - place_m).norm();
    if (off_m > nearest_m || (nearest && off_m == nearest_m)) continue;
    nearest = view;
    nearest_m = off_m;
  }
  return nearest;
}

double gain_of(const PlanningProblem& problem, std::size_t view) {
  const ShownShares& shown = problem.shows[view];
  double sum = 0.0;
  for (std::size_t i = 0; i < shown.block.size(); ++i) {
    sum += static_cast<double>(shown.share[i] * problem.cells[shown.block[i]]);
  }
  return sum;
}

bool is_affordable(const PlanningProblem& problem, std::span<const std::size_t> order) {
  if (order.size() > problem.left.scans) return false;
  double driven_s = 0.0;
  double scanned_s = 0.0;
  std::size_t at = problem.here();
  for (const std::size_t view : order) {
    driven_s += problem.leg_s(at, view);
    scanned_s += problem.scan_s_of(view);
    at = view;
  }
  if (!problem.home_s.empty()) driven_s += problem.home_s[at];
  if (!std::isfinite(driven_s)) return false;
  return driven_s + scanned_s <= problem.left.time_s &&
         problem.energy_j(driven_s, scanned_s) <= problem.left.energy_j;
}

std::vector<std::size_t> affordable_views(const PlanningProblem& problem) {
  std::vector<std::size_t> views;
  for (std::size_t view = 0; view < problem.views(); ++view) {
    if (is_affordable(problem, std::array{view})) views.push_back(view);
  }
  return views;
}

}  // namespace vantage
