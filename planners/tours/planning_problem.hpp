/// What planning several views ahead looks at: what each view shows, what they show together, and
/// how long everything takes.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {

/// The share of each block of cells that a view is expected to show; blocks of no share are left
/// out.
struct ShownShares {
  std::vector<std::uint32_t> block;  ///< ascending
  std::vector<float> share;          ///< of the block's cells, (0, 1]
};

struct ShownBlocks {
  std::vector<float> cells;        ///< per block, its unobserved cells in the unit of the gain
  std::vector<ShownShares> shows;  ///< per view
};

/// What is left to spend. The way home is kept affordable where there is a home.
struct Allowance {
  std::size_t scans = std::numeric_limits<std::size_t>::max();
  double time_s = std::numeric_limits<double>::infinity();
  double energy_j = std::numeric_limits<double>::infinity();
};

/// Of a robot that stands somewhere and may take any of n views, each after a drive.
struct PlanningProblem {
  std::vector<float> cells;        ///< per block: the unobserved cells, in the unit of the gain
  std::vector<ShownShares> shows;  ///< per view
  std::vector<Eigen::Vector2d> place_m;  ///< per view, on the floor, world
  /// Per view: what lies behind what all views show, that this one leads to, in the unit of the
  /// gain. Only views that nobody can propose yet will show it. Empty: nothing is known of it.
  std::vector<double> beyond;
  double seen = 0.0;  ///< what is observed already, in the unit of the gain; 0: not known in it
  double pace_per_s = 0.0;     ///< at which it was observed; 0: unknown, nothing beyond counts
  Eigen::MatrixXd travel_s;    ///< (n + 1) x n, from row to column; row n is where the robot stands
  std::vector<double> home_s;  ///< per view, and last from here: the way home; empty: none is kept
  double scan_s = 0.0;         ///< of a whole scan
  std::vector<double> scan_share;  ///< per view, of a whole scan's time; empty: whole scans alone
  double driving_w = 0.0;          ///< power while driving
  double scanning_w = 0.0;         ///< power while scanning
  Allowance left;
  /// The view that the plan before wanted next, if it is still among these.
  std::optional<std::size_t> intended;
  /// What the same views would show on another map that the belief allows, drawn from it. Empty
  /// where nothing can be drawn.
  std::function<ShownBlocks(Rng&)> draw;

  [[nodiscard]] std::size_t views() const { return shows.size(); }
  /// Stands for the robot's place in `travel_s` and `home_s`.
  [[nodiscard]] std::size_t here() const { return views(); }
  [[nodiscard]] double leg_s(std::size_t from, std::size_t to) const {
    return travel_s(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to));
  }
  [[nodiscard]] double scan_s_of(std::size_t view) const {
    return scan_share.empty() ? scan_s : scan_share[view] * scan_s;
  }
  [[nodiscard]] double beyond_of(std::size_t view) const {
    return beyond.empty() || pace_per_s <= 0.0 ? 0.0 : beyond[view];
  }
  /// Time until what lies beyond the view is observed, once the robot is there.
  [[nodiscard]] double dwell_s(std::size_t view) const {
    const double cells = beyond_of(view);
    return cells > 0.0 ? cells / pace_per_s : 0.0;
  }
  [[nodiscard]] double energy_j(double driven_s, double scanned_s) const {
    return driving_w * driven_s + scanning_w * scanned_s;
  }
  void check() const;  ///< asserts that the sizes fit
};

/// The view nearest to `place_m` if it is no farther than `within_m`.
std::optional<std::size_t> view_near(const PlanningProblem& problem, const Eigen::Vector2d& place_m,
                                     double within_m);

/// Cells that one view alone is expected to show.
double gain_of(const PlanningProblem& problem, std::size_t view);

/// Whether the views, in that order, can be taken within what is left, and the way home after them.
bool is_affordable(const PlanningProblem& problem, std::span<const std::size_t> order);

/// The views that can be reached and that are affordable as the next one, ascending.
std::vector<std::size_t> affordable_views(const PlanningProblem& problem);

/// Of tours as a whole, as the choice weighs them, in s.
struct PlanCosts {
  double taken_s = 0.0;
  /// The best tour found that begins with the view that was intended next, if there is one.
  std::optional<double> intended_s = {};
};

/// What a choice that plans ahead wants to do: the views in order, the first one next. Empty if no
/// view is affordable.
struct PlannedViews {
  std::vector<std::size_t> order;
  std::optional<PlanCosts> costs = {};  ///< of a choice that weighs whole tours
};

}  // namespace vantage
